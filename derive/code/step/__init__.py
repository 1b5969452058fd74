"""Integrators: the numbers of their methods, from the definitions."""
