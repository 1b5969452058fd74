"""The interface from Python: problems in words, derivations in a notebook, compiled code, SymPy."""
