"""Files of strangers: hostile ones by hand, by rule and by mutation, all deterministic.

``python -m tests.fuzz`` runs those by mutation (make fuzz); ``python -m tests.fuzz.corpus`` the
others, among them the tables of tests/corpus, and the first of these, which
tests/command/test_strangers.py does.
"""
