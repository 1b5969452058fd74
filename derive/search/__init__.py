"""What is found of the equations of motion: symmetries, integrals, equilibria, reductions."""
