"""Files of strangers: hostile ones by hand, and any number by mutation, all deterministic.

``python -m tests.fuzz`` runs them (make fuzz); tests/command/test_strangers.py those of
tests/corpus.
"""
