"""What a problem may say: the kinds of potentials, and the keys of each with their types.

Files, records and Python read the same descriptions; the walk and the checker each have, by kind,
what they make of a potential (``walk/kinds``, ``check/kinds``), and share no more than these.
"""
