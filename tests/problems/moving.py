"""Bodies of given moments, in whose files tests write where they start and what they watch."""

BODY = '[body]\ngiven = { m = 1, c = [0, 0, 0], J = [["7/4", 0, 0], [0, 1, 0], [0, 0, "1/4"]] }\n'
WEIGHT = '[[potential]]\nkind = "gravity"\ng = [0, 0, "-9.81"]\n'
SPIN = f'name = "spin"\ngroup = "SO(3)"\n[parameters]\nw = 2.0\n{BODY}'
STONE = f"""
name = "stone"
group = "SE(3)"
[parameters]
H = {{ default = 3.0, meaning = "height" }}
{BODY}{WEIGHT}[initial]
zeta_2 = 3
w_1 = 1
T_3 = "H"
[[event]]
name = "ground"
when = "T_3"
terminal = true
"""
"""A body that turns as it falls, up to the ground."""
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
"""A point on a line that falls into a centre of attraction, the potential −1/|x|."""
