"""Polynomial first integrals and Casimirs of Lie–Poisson equations, by exact linear algebra."""
