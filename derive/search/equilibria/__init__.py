"""Relative equilibria of reduced equations, and what is proved of their stability."""
