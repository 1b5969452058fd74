"""Exercise 1: any Lagrangian L̃(t, g, Z) on a group; and the errors of a motion ġ = f_u(g)."""
