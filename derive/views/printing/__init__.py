"""Formulas as LaTeX and MathML: trees, letters, and where lines break."""
