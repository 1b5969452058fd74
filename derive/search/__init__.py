"""What is found of the equations of motion: symmetries, integrals, equilibria, reductions."""

FIRST = {
    "symmetries": "symmetries",
    "integrals": "poisson",
    "equilibria": "equilibrium_1",
    "families": "equilibrium_1",
    "reduction": "momentum_1",
    "trim": "trim",
}
"""Search → the first of the steps that tell, in its record, what was found."""
