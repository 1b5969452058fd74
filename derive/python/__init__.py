"""What Python gets: problems in words, derivations in a notebook, compiled code, SymPy."""
