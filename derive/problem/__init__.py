"""Bodies, potentials, problem files."""
