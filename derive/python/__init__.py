"""The interface from Python: problems built in words, derivations in a notebook, compiled code,
SymPy."""
