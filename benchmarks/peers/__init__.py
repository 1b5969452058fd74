"""Our emitted code against an expert's and other generators': ``python -m benchmarks.peers``."""
