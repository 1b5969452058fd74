"""SO(3) and SE(3) in vectors of R³: Euler's equations, momenta, principal axes."""
