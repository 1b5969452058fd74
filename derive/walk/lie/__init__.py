"""Exercise 1 in full: any Lagrangian L̃(t, g, Z) on a group, trivialised on the left or right."""
