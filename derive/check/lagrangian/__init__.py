"""The checker's account of a Lagrangian that no points give: a function ℓ(t, g, Z)."""
