"""A point on a line that falls into a centre of attraction, the potential −1/|x|."""

FALLING = """
name = "line"
[group]
name = "R"
action = "affine"
basis = [[[0, 0, 1], [0, 0, 0], [0, 0, 0]]]
[[point]]
mass = 1
at = [0, 0]
[[potential]]
kind = "expression"
U = "-1/sqrt(r1_x^2)"
"""
