"""Operator trees: the language of equations, its text, its derivatives and its values."""
