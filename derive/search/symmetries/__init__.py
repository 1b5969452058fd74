"""Symmetries of the Lagrangian of a problem, all of a kind, and what the motion keeps by them."""
