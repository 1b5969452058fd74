"""What a problem may say: the keys of each table with their types, bodies, the kinds of potentials.

Files, records and Python read the same descriptions; the walk and the checker each have, by kind,
what they make of a potential (``walk/given/potential_words.py``,
``check/trials/potential_accounts.py``), and share no more than these.
"""
