"""The checker's account of the torus: su(N) over a prime field with roots of unity."""
