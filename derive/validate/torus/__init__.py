"""Emitted code of a fluid on the torus, with its loops, read or run in a prime field."""
