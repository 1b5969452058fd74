"""Problems of every kind as the text of a file: groups, potentials, inputs, products."""

from pathlib import Path
from random import Random

import derive

READY = Path(derive.__file__).parent / "problems"

GROUPS = (
    "GL(2)", "GL(3)", "SL(2)", "SL(4)", "SO(2)", "SO(4)", "SE(2)", "SAff(2)", "SAff(3)", "Aff(2)",
    "Sp(2)", "Sp(4)", "Sim(2)", "Sim(3)", "UT(2)", "UT(3)", "U(1)", "U(2)", "SU(2)",
)  # fmt: skip
SIZES = {"U": 2, "SU": 2}

FORCES = """
[[potential]]
kind = "spring"
on = 1
anchor = [3, 1, 2]
stiffness = "k"
length = "l"
[[potential]]
kind = "spring"
at = [0.3, 0.3, 0.1]
anchor = [0, 1, 2]
stiffness = "2*k"
[[potential]]
kind = "attraction"
strength = "mu"
centre = [10, 0, 0]
[[potential]]
kind = "expression"
U = "sin(w*t)*r1_x*r2_y + exp(r3_z/10)*atan(r1_y) + sqrt(2 + cos(r4_x))"
[[damping]]
coefficient = 0.3
[[damping]]
coefficient = "mu/7"
on = [2, 3]
[[input]]
name = "F"
kind = "force"
on = 2
[[input]]
name = "u"
kind = "covector"
[[input]]
name = "G"
kind = "force"
at = [0.2, 0.1, 0.7]
frame = "body"
"""

PRODUCT = """
[parameters]
k = 2.0
l = 0.7
[[point]]
mass = 1.0
at = [1, 0, 0.5]
[[point]]
mass = 2.0
at = [0, 1, 0]
[[point]]
mass = 0.5
at = [0, 0.3, 1]
[[point]]
mass = 1.0
at = [1, 0, 0.5]
block = 2
[[point]]
mass = 2.0
at = [0, 1, 0]
block = 2
[[potential]]
kind = "gravity"
g = [0, 0, "-9.81"]
[[potential]]
kind = "spring"
between = [1, 4]
stiffness = "k"
length = "l"
[[potential]]
kind = "spring"
between = [2, 5]
stiffness = "k"
[[potential]]
kind = "expression"
U = "r3_x*r4_y*sin(t)"
[[damping]]
coefficient = 0.3
[[input]]
name = "F"
kind = "force"
on = 2
frame = "body"
[[input]]
name = "u"
kind = "covector"
[[input]]
name = "H"
kind = "force"
at = [1, 2, 3]
block = 2
"""

SCREW = """
[parameters]
k = 2.0
[group]
name = "Screw"
action = "affine"
basis = [
  [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, "1/3"], [0, 0, 0, 0]],
  [[0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
  [[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, 0]],
]
[[point]]
mass = 1.0
at = [1, 0, 0.5]
[[point]]
mass = 2.0
at = [0, 1, 0]
[[potential]]
kind = "spring"
on = 1
anchor = [0, 0, 3]
stiffness = "k"
[[damping]]
coefficient = 0.3
[[input]]
name = "u"
kind = "covector"
"""

WEIGHTED = """
[group]
name = "Weighted"
basis = [
  [[1, 0], [0, -2]],
  [[0, 1], [0, 0]],
]
[[point]]
mass = 1.0
at = [1, 0.5]
[[point]]
mass = 2.0
at = [0, 1]
[[potential]]
kind = "gravity"
g = [1, -9.81]
"""


def of_group(name):
    """Points, gravity and a spring on a named group."""
    family, n = name.split("(")[0], int(name.split("(")[1][:-1])
    n *= SIZES.get(family, 1)
    random = Random(name)
    lines = ["[parameters]", "k = 2.5", "b = 0.7"]
    for i in range(n + 1):
        at = [random.randint(-4, 4) / 2 + (3 if j == i else 0) for j in range(n)]
        shown = [f'"{at[0]} + b"' if i == 0 else str(at[0]), *map(str, at[1:])]
        lines += ["[[point]]", f"mass = {1 + i / 4}", f"at = [{', '.join(shown)}]"]
    gravity = ", ".join(str(random.randint(-9, 9)) for _ in range(n))
    lines += ["[[potential]]", 'kind = "gravity"', f"g = [{gravity}]"]
    lines += ["[[potential]]", 'kind = "spring"', "between = [1, 2]", 'stiffness = "k"']
    return f'name = "test"\ngroup = "{name}"\n' + "\n".join(lines) + "\n"


def with_forces(name):
    """Everything that a file may say of forces, on a group of R³."""
    points = ((1.0, [1, 0, 0.5]), (2.0, [0, 1, 0]), (0.5, [0, 0.3, 1]), (0.7, [-1, 0.3, -1]))
    lines = "".join(f"[[point]]\nmass = {m}\nat = {r}\n" for m, r in points)
    parameters = "[parameters]\nk = 2.0\nl = 0.7\nmu = 3.0\nw = 1.3\n"
    gravity = '[[potential]]\nkind = "gravity"\ng = [0, 0, "-9.81"]\n'
    return f'name = "test"\ngroup = "{name}"\n' + parameters + lines + gravity + FORCES


SPATIAL = ("SE(3)", "SO(3)", "SL(3)", "SAff(3)", "Sim(3)")
PRODUCTS = ("SO(3) x SO(3)", "SE(3) x SO(3)")
MORE = ("SE(3) x SE(3)", "SL(3) x SE(3)")  # one point more: a rod may not turn

PROBLEMS = {name: of_group(name) for name in GROUPS}
PROBLEMS |= {f"{name} forces": with_forces(name) for name in SPATIAL}
PROBLEMS |= {name: f'name = "test"\ngroup = "{name}"\n{PRODUCT}' for name in PRODUCTS}
THIRD = "[[point]]\nmass = 3.0\nat = [0, 0, -1]\nblock = 2\n[[potential]]"
PROBLEMS |= {
    name: f'name = "test"\ngroup = "{name}"\n{PRODUCT.replace("[[potential]]", THIRD, 1)}'
    for name in MORE
}
PROBLEMS |= {"screw": 'name = "test"\n' + SCREW, "weighted": 'name = "test"\n' + WEIGHTED}

# so(3) otherwise: some of it, in another order, and with the translations
AXIS = "[[0, -1, 0], [1, 0, 0], [0, 0, 0]]"
OTHERWISE = "[[0, 0, 1], [0, 0, 0], [-1, 0, 0]], [[0, 0, 0], [0, 0, -1], [0, 1, 0]], " + AXIS
POINTS = ((1.0, [1, 0, 0.5]), (2.0, [0, 1, 0]), (0.5, [0, 0.3, 1]))
TURNING = (
    "".join(f"[[point]]\nmass = {m}\nat = {r}\n" for m, r in POINTS)
    + '[[potential]]\nkind = "gravity"\ng = [1, 2, -3]\n'
    + '[[input]]\nname = "u"\nkind = "covector"\n'
)
TRANSLATIONS = ", ".join(
    str([[0, 0, 0, int(i == j)] for j in range(3)] + [[0, 0, 0, 0]]) for i in range(3)
)
CYLINDER = "[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]], " + TRANSLATIONS


def own_group(basis, action="linear"):
    """A group given by its basis."""
    table = f'[group]\nname = "Own"\naction = "{action}"\nbasis = [{basis}]\n'
    return f'name = "test"\n{TURNING}{table}'


# so(3) and se(3) in bases of which no member is j(e_i) up to a factor, or in which they are mixed
SKEWED = "[[0, -2, 1], [2, 0, -3], [-1, 3, 0]], [[0, 0, 1], [0, 0, 0], [-1, 0, 0]], " + AXIS


def displacement(turn, shift):
    """j(turn) with a translation, as a matrix of se(3)."""
    x, y, z = turn
    rows = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return str([[*row, s] for row, s in zip(rows, shift, strict=True)] + [[0, 0, 0, 0]])


SCREWS = [((3, 1, 2), (1, 2, 3)), ((1, 0, 0), (0, 0, 1)), ((0, 0, 1), (0, 0, 0))]
TURNS = [(turn, (0, 0, 0)) for turn, _ in SCREWS]
MIXED = ", ".join([displacement(*SCREWS[0]), TRANSLATIONS, *(displacement(*x) for x in SCREWS[1:])])
APART = ", ".join([*(displacement(*x) for x in TURNS), TRANSLATIONS])

PROBLEMS |= {
    "so(3) skewed": own_group(SKEWED),
    "se(3) mixed": own_group(MIXED, "affine"),
    "se(3) apart": own_group(APART, "affine"),
    "an axis": own_group(AXIS),
    "so(3) otherwise": own_group(OTHERWISE),
    "a cylinder": own_group(CYLINDER, "affine"),
    "translations": own_group(TRANSLATIONS, "affine"),
}

# C is not 1, and drops out: of every body's metric where lengths of images are kept; of this one's
SHEARS = "[[0, 0, 1], [0, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 1], [0, 0, 0]]"
JORDAN = "[[0, 1, 0], [0, 0, 1], [0, 0, 0]]"
FLAT = """
[parameters]
a = 2.0
b = 1.0
[[point]]
mass = "a"
at = ["a", "b", 0]
[[point]]
mass = "a*(a + b)/b"
at = ["b", "a", "b - a - (b^2 - a^2)/(a + b)"]
[[potential]]
kind = "gravity"
g = [1, 2, -3]
[[potential]]
kind = "spring"
between = [1, 2]
stiffness = 3
[[damping]]
coefficient = 0.3
[[input]]
name = "F"
kind = "force"
on = 2
frame = "body"
"""


def flat(body=FLAT):
    """A body in the plane that one Jordan block keeps, unless the text is changed."""
    return f'name = "test"\n{body}[group]\nname = "Jordan"\nbasis = [{JORDAN}]\n'


PROBLEMS |= {
    "shears": own_group(SHEARS),
    "a flat body": flat(),
    "a solid body": flat(FLAT.replace("(b^2 - a^2)", "b^2")),
}

# functions that are written out in others
PROBLEMS["kinks"] = """
name = "test"
group = "GL(2)"
point = [{ mass = 1, at = [1, 0] }, { mass = 2, at = [0, 1] }]
[[potential]]
kind = "expression"
U = "max(r1_x, r2_y)^2/3 + abs(r1_y + 0.3) + atan2(r1_x, 3 + r2_x^2)"
[[potential]]
kind = "expression"
U = "hypot(r1_x, 2)^(3/2) + sign(r2_x)*r1_y*min(r2_x, 0.2)"
"""

# inputs of one number, with moments, and torques: of R³ and of the plane, alone and in a product
ALONG = """
[parameters]
a = 0.7
c = -0.3
[[input]]
name = "tau"
kind = "torque"
frame = "body"
[[input]]
name = "thrust"
kind = "force"
at = ["a", 0.2, 0]
frame = "body"
direction = [0, "sin(a)", 1]
moment = [0.1, 0, "c"]
[[input]]
name = "rope"
kind = "force"
on = 2
direction = ["c", 1, 0.5]
moment = ["a", 1, 0]
[[input]]
name = "reel"
kind = "torque"
direction = [1, "a*c", 0]
[[input]]
name = "u"
kind = "covector"
"""
IN_THE_PLANE = """
[[input]]
name = "motor"
kind = "torque"
block = 2
[[input]]
name = "fan"
kind = "force"
at = ["a", 0.2]
block = 2
frame = "body"
direction = ["c", 2]
moment = [0.4]
[[point]]
mass = 1
at = [1, 0.5]
block = 2
[[point]]
mass = 2
at = [-1, 0.2]
block = 2
"""
MASSES = "".join(f"[[point]]\nmass = {m}\nat = {r}\n" for m, r in POINTS)
PROBLEMS |= {
    f"{group} torques": f'name = "test"\ngroup = "{group}"\n{ALONG}{MASSES}'
    for group in ("SO(3)", "SE(3)")
}
PROBLEMS |= {
    f"SE(3) x {group} torques": f'name = "test"\ngroup = "SE(3) x {group}"\n{ALONG}{MASSES}'
    + IN_THE_PLANE
    for group in ("SO(2)", "SE(2)")
}
PLANE = IN_THE_PLANE.replace("block = 2\n", "")
PROBLEMS |= {
    "SE(2) torques": f'name = "test"\ngroup = "SE(2)"\nparameters = {{ a = 0.7, c = 2 }}\n{PLANE}',
    "cylinder torques": own_group(CYLINDER, "affine").replace(
        "[group]", ALONG[: ALONG.rindex("[[input]]")] + "[group]"
    ),
}

# forces that are functions of the state: of R³ and of the plane, in a wind, alone and in a product
OF_STATE = """
[parameters]
c = 0.7
w = 1.3
[[input]]
name = "pull"
kind = "force"
on = 1
direction = [1, 0, 0]
[[force]]
name = "drag"
on = 3
frame = "body"
relative_to = ["w*sin(r_3)", "w*t", 0]
force = ["-c*hypot(v_1, v_2)*v_1", "-c*abs(v_2)*v_2 + c*pull", "-w*v_3*A_33"]
[[force]]
at = [0, "c", 1]
force = ["-w*v_1", "r_1*v_2 + zeta_2", 1]
"""
OF_TURNING = """
[[force]]
on = 2
frame = "body"
moment = ["-c*zeta_1", 0, "max(v_1, 0)"]
[[force]]
name = "turn"
on = 2
moment = ["-c*zeta_1", "pull", 0]
"""


def pushed(name, text=OF_STATE):
    """Four points on which functions of the state act."""
    points = ((1.0, [1, 0, 0.5]), (2.0, [0, 1, 0]), (0.5, [0, 0.3, 1]), (0.7, [-1, 0.3, -1]))
    lines = "".join(f"[[point]]\nmass = {m}\nat = {r}\n" for m, r in points)
    return f'name = "test"\ngroup = "{name}"\n{text}{lines}'


PROBLEMS |= {f"{x} of the state": pushed(x, OF_STATE + OF_TURNING) for x in ("SO(3)", "SE(3)")}
PROBLEMS |= {f"{x} of the state": pushed(x) for x in ("SL(3)", "Aff(3)")}
PROBLEMS["SE(2) of the state"] = """
name = "test"
group = "SE(2)"
parameters = { c = 0.7 }
point = [{ mass = 1, at = [1, 0] }, { mass = 2, at = [0, 1] }]
[[force]]
name = "wind"
on = 2
frame = "body"
relative_to = ["c*r_2", 1]
force = ["-c*v_1", "sin(t)*T_1 + w_2*A_12"]
moment = ["-c*zeta_1"]
[[input]]
name = "gas"
kind = "scalar"
[[force]]
name = "brake"
on = 1
moment = ["-gas*zeta_1"]
"""
PROBLEMS["a product of the state"] = """
name = "test"
group = "SE(2) x SL(2)"
parameters = { c = 0.7 }
point = [
  { mass = 1, at = [1, 0] }, { mass = 2, at = [0, 1] },
  { mass = 1, at = [1, 2], block = 2 }, { mass = 2, at = [0, 1], block = 2 },
]
[[force]]
on = 2
frame = "body"
relative_to = ["r_2", "t"]
force = ["-c*hypot(v_1, v_2)*v_1", "-c*v_2*A1_12*T1_1"]
moment = ["-c*zeta_1"]
[[force]]
on = 4
frame = "body"
force = ["-c*v_1 + zeta_4", "A2_12 - v_2"]
[[force]]
name = "Q"
covector = ["-c*zeta_1", "t*zeta_3", "A1_12", "-zeta_4^3", "A2_11*zeta_1", "c*T1_2"]
"""
WITH_COVECTOR = """
[[input]]
name = "push"
kind = "covector"
[[force]]
covector = [{0}]
[[force]]
name = "loads"
covector = [{0}]
"""
VALUES = ["-zeta_1", "zeta_1*A_12", "t*zeta_3", "push_1*w_1", "A_33*T_2", "-w_2*abs(w_2)"]
PROBLEMS |= {
    "SE(3) covector of the state": pushed("SE(3)", WITH_COVECTOR.format(str(VALUES)[1:-1])),
    "SL(3) covector of the state": pushed(
        "SL(3)", WITH_COVECTOR.format(str([*VALUES[:3], "push_1*zeta_8", *VALUES[:4]])[1:-1])
    ).replace("w_1", "zeta_8"),
}
DAMPED = """
parameters = { k = 0.3 }
point = [
  { mass = 1, at = [1, 0] }, { mass = 2, at = [0, 1] }, { mass = 1, at = [1, 2, 0], block = 2 },
  { mass = 2, at = [0, 1, 1], block = 2 }, { mass = 3, at = [0, 1, -1], block = 2 },
]
damping = [
  { kind = "quadratic", coefficient = "k", on = [1, 3] }, { coefficient = 0.1 },
  { kind = "rotational", coefficient = 0.2 },
  { kind = "rotational", coefficient = "2*k", block = 2 },
]
"""
PROBLEMS |= {
    f"SE(2) x {group} damped": f'name = "test"\ngroup = "SE(2) x {group}"\n{DAMPED}'
    for group in ("SO(3)", "SE(3)")
}
PROBLEMS["SE(3) damped"] = pushed(
    "SE(3)",
    """
damping = [
  { kind = "quadratic", coefficient = 0.4 }, { kind = "rotational", coefficient = 0.2 },
]
""",
)
PROBLEMS["so(3) skewed of the state"] = (
    own_group(SKEWED)
    + """
[[force]]
covector = ["-zeta_1*abs(zeta_1)", "zeta_1*A_12", "t*zeta_3"]
[[force]]
on = 1
frame = "body"
force = ["-v_1", "zeta_1*A_12", "zeta_2 - v_3"]
moment = [0, 0, "-zeta_3"]
"""
)
PROBLEMS["se(3) mixed of the state"] = (
    own_group(MIXED, "affine")
    + """
[[force]]
covector = ["-zeta_1", "zeta_1*A_12", "t*zeta_3", "-zeta_4", "T_2*zeta_5", "-zeta_6^3"]
[[force]]
on = 1
frame = "body"
force = ["-v_1 + zeta_5", "zeta_1*A_12*T_1", "zeta_2 - v_3"]
"""
)

# solids are no points: the oracle has them with the moments of their integrals, see below; a
# Lagrangian that no points give has one of its own (tests/walk/lie)
TEXTS = ("linear", "affine", "ellipsoid", "top", "hammer", "so3", "se3", "sl3")
TEXTS += ("charged_body", "coupled", "euler_poisson", "gyrostat", "kirchhoff")
TEXTS += ("rod", "spherical_pendulum", "zeitlin")
TEXTS += ("euler_top", "lagrange_top", "kovalevskaya_top", "manakov")
TEXTS += ("dirichlet", "riemann_ellipsoid", "gas_cloud", "ideal_fluid", "inhomogeneous_fluid")
TEXTS += ("stratified_fluid", "imu")
PROBLEMS |= {
    path.stem: path.read_text(encoding="utf-8")
    for path in sorted(READY.glob("*.toml"))
    if path.stem not in TEXTS
}

# what is read off a motion, in words, in entries of a product, where C stays
READ_OFF = """
[[potential]]
kind = "gravity"
g = {falling}
[[potential]]
kind = "spring"
between = [1, 2]
stiffness = "k"
length = 0.4
[[output]]
name = "place"
kind = "place"
at = {away}
[[output]]
name = "pace"
kind = "velocity"
on = 2
frame = "body"
[[output]]
name = "rush"
kind = "acceleration"
at = {away}
[[output]]
name = "felt"
kind = "specific_force"
at = {away}
[[output]]
name = "north"
kind = "direction"
direction = {away}
frame = "body"
[[output]]
name = "nose"
kind = "direction"
direction = {away}
[[output]]
name = "far"
kind = "distance"
on = 1
to = {away}
[[output]]
name = "near"
kind = "distance"
on = 1
to = 2
[[output]]
name = "carried"
kind = "momentum"
frame = "body"
[[output]]
name = "pull"
kind = "tension"
of = 2
[[output]]
name = "power"
y = ["k*v_1*r_2 + A{mark}_11", "t*zeta_1"]
on = 1
[[damping]]
coefficient = 0.3
"""
RATES = '[[output]]\nname = "gyro"\nkind = "rate"\n'
POWERS = '[[output]]\nname = "lost"\nkind = "power"\nof = "damping"\n'
POWERS += '[[output]]\nname = "whole"\nkind = "power"\n'
OTHER = RATES.replace("gyro", "turn") + "block = 2\n"
OTHER += '[[output]]\nname = "beside"\nkind = "momentum"\n'


DRIVEN = ALONG[ALONG.index("[[input]]") :]


def read_off(group, n, *more):
    """Points, gravity, a spring and outputs, on a group of Rⁿ."""
    points = "".join(f"[[point]]\nmass = {m}\nat = {at[:n]}\n" for m, at in POINTS)
    falling, away = [0.3, 1, -2][:n], [0.2, -0.5, 0.7][:n]
    text = READ_OFF.format(falling=falling, away=away, mark="1" if " x " in group else "")
    others = ", a = 0.7, c = -0.3" if '"a"' in "".join(more) else ""
    head = f'name = "test"\ngroup = "{group}"\nparameters = {{ k = 1.7{others} }}\n'
    return "".join((head, text, points, *more))


PROBLEMS |= {
    "SE(3) outputs": read_off("SE(3)", 3, RATES, DRIVEN),
    "SE(2) x SO(2) outputs": read_off("SE(2) x SO(2)", 2, RATES, OTHER, IN_THE_PLANE),
    "SL(2) outputs": read_off("SL(2)", 2, POWERS),
    "SO(2) outputs": read_off("SO(2)", 2, RATES),
}
# all that acts, each with its power; a potential that knows the time, alone and beside one that
# does not, with one that acts; the power of an input is no P_thrust, which is a parameter
ACTING = """
name = "test"
group = "SE(3)"
parameters = { c = 0.4, k = 0.15, s = 2.5, P_thrust = 9.81 }
[[potential]]
kind = "gravity"
g = ["sin(t)", 0, "-P_thrust*(1 + t/3)"]
[[potential]]
kind = "spring"
at = [0, 0, -0.1]
anchor = ["cos(t)", "t^2", 2]
stiffness = "s*(2 + sin(3*t))"
length = "1 + t/5"
[[input]]
name = "thrust"
kind = "force"
at = [0.2, 0.1, 0.05]
frame = "body"
direction = [0, 0, 1]
moment = [0, 0, 0.3]
[[input]]
name = "line"
kind = "force"
at = [0, 0.1, -0.2]
[[input]]
name = "twist"
kind = "torque"
[[input]]
name = "u"
kind = "covector"
[[force]]
name = "drag"
at = [0.1, 0, 0.02]
force = ["-c*sqrt(v_1^2 + v_2^2 + v_3^2)*v_1", "-c*v_2", "-c*abs(v_3)*v_3"]
[[damping]]
coefficient = "k"
at = [-0.1, 0.05, 0]
[[output]]
name = "whole"
kind = "power"
"""
ACTING += "".join(
    f'[[output]]\nname = "of_{x}"\nkind = "power"\nof = "{x}"\n'
    for x in ("thrust", "line", "twist", "u", "drag", "damping")
)
PROBLEMS["SE(3) powers outputs"] = ACTING + MASSES
PROBLEMS["SL(3) one power outputs"] = (
    """
name = "test"
group = "SL(3)"
potential = [
  { kind = "spring", between = [1, 2], stiffness = "1 + t^3" },
  { kind = "spring", between = [2, 3], stiffness = 3 },
]
input = [{ name = "line", kind = "force", at = [0, 1, -2] }]
output = [{ name = "whole", kind = "power" }, { name = "of_line", kind = "power", of = "line" }]
"""
    + MASSES
)
PROBLEMS["SE(2) outputs"] = """
name = "test"
group = "SE(2)"
point = [{ mass = 1, at = [1, 0.5] }, { mass = 2, at = [-1, 0.2] }]
[[potential]]
kind = "expression"
U = "r1_x^2 + r2_y^4/3"
[[output]]
name = "place"
kind = "place"
at = [0.2, -0.5]
frame = "body"
[[output]]
name = "pace"
kind = "velocity"
on = 1
[[output]]
name = "rush"
kind = "acceleration"
at = [0.2, -0.5]
frame = "body"
[[output]]
name = "felt"
kind = "specific_force"
at = [0.2, -0.5]
[[output]]
name = "along"
kind = "momentum"
[[output]]
name = "twice"
y = ["2*T_1 + zeta_1*w_2"]
"""
