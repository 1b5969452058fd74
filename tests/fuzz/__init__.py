"""Files of strangers: hostile ones by hand, and any number by mutation, all deterministic.

``python -m tests.fuzz`` runs them (make fuzz); tests/test_strangers.py runs those of tests/corpus.
"""
