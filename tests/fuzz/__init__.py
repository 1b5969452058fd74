"""Files of strangers: hostile ones by hand, by rule and by mutation, all deterministic.

``python -m tests.fuzz`` runs those by mutation (make fuzz); ``python -m tests.fuzz.corpus`` the
others, which tests/command/test_strangers.py does, among them the tables of tests/corpus.
"""
