"""What no points give: a Lagrangian ℓ(t, g, Z), or two elements with the same ġ = f_u(g)."""
