"""Equilibria under inputs: which inputs keep a velocity, and what is proved of its stability."""
