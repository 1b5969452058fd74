"""Symmetries of the Lagrangian of a problem, what the motion keeps by them, its reduction."""
