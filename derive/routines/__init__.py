"""Run-time algorithms, each written once (``algorithms/``) and printed in every language."""
