"""Zeitlin's model of a fluid on the torus: su(N) by sums over its lattice."""
