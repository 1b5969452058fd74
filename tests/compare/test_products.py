"""``derive compare`` on products of groups: attitudes, places and velocities of each factor, and
coordinates of factors of one parameter, by either name of a velocity, beside the user's own."""

import re

import pytest

from derive.command.simulating import made
from derive.compare.comparison import comparison, reports
from derive.compare.users_code import CompareError
from derive.problem.toml import load

PAIR = """
name = "pair"
group = "SE(3) x SE(3)"
parameters = { k = 7.0, g = 9.81, b = 0.3 }
point = [
  { mass = 2, at = [0.2, 0, 0.1] },
  { mass = 1, at = [0, 0.5, 0] },
  { mass = 1.5, at = [-0.1, 0, 0.6] },
  { mass = 0.7, at = [0.4, 0, 0], block = 2 },
  { mass = 1.2, at = [0, -0.3, 0.2], block = 2 },
  { mass = 0.9, at = [0.1, 0.6, 0], block = 2 },
]
[[potential]]
kind = "gravity"
g = [0, 0, "-g"]
[[potential]]
kind = "spring"
between = [1, 4]
stiffness = "k"
length = 0
[[input]]
name = "thrust"
kind = "force"
at = [0.3, -0.2, 0.1]
block = 1
frame = "body"
[[damping]]
coefficient = "b"
kind = "rotational"
block = 2
"""
BODIES = """
import numpy as np
k, g, b = 7.0, 9.81, 0.3
MASSES = np.array([2, 1, 1.5]), np.array([0.7, 1.2, 0.9])
AT = (
    np.array([[0.2, 0, 0.1], [0, 0.5, 0], [-0.1, 0, 0.6]]),
    np.array([[0.4, 0, 0], [0, -0.3, 0.2], [0.1, 0.6, 0]]),
)
ARM = np.array([0.3, -0.2, 0.1])

def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])

def rotation(w, x, y, z):
    q = np.array([x, y, z])
    return np.eye(3) + 2*w*hat(q) + 2*hat(q) @ hat(q)

def moved(i, R, v, w, force, moment):
    # about the origin of the body, along its axes
    m, p = MASSES[i], AT[i]
    c = m @ p
    I = sum(n * (r @ r * np.eye(3) - np.outer(r, r)) for n, r in zip(m, p))
    fall = R.T @ [0, 0, -g]
    force = force + m.sum() * fall - m.sum() * np.cross(w, v) - np.cross(w, np.cross(w, c))
    moment = moment + np.cross(c, fall) - np.cross(w, I @ w) - np.cross(c, np.cross(w, v))
    M = np.block([[I, hat(c)], [-hat(c), m.sum() * np.eye(3)]])
    a = np.linalg.solve(M, [*moment, *force])
    return a[:3], a[3:]

def f(x, u):
    p1, q1, V1, w1, x, y, z, s, p2, v2, w2 = np.split(x, [3, 7, 10, 13, 14, 15, 16, 17, 20, 23])
    R1, R2 = rotation(*q1), rotation(*s, *x, *y, *z)
    v1 = R1.T @ V1
    pull = k * (p2 + R2 @ AT[1][0] - p1 - R1 @ AT[0][0])
    F1, F2 = R1.T @ pull, -R2.T @ pull
    dw1, dv1 = moved(0, R1, v1, w1, F1 + u, np.cross(AT[0][0], F1) + np.cross(ARM, u))
    dw2, dv2 = moved(1, R2, v2, w2, F2, np.cross(AT[1][0], F2) - b * w2)
    q = q1[1:]
    dq1 = [-q @ w1 / 2, *(q1[0] * w1 + np.cross(q, w1)) / 2]
    q = np.concatenate([x, y, z])
    dq2 = [*(s * w2 + np.cross(q, w2)) / 2, -q @ w2 / 2]
    # a velocity along the axes of space has no term of axes that turn
    dV1 = R1 @ (dv1 + np.cross(w1, v1))
    return np.concatenate([V1, dq1, dV1, dw1, dq2, R2 @ v2, dv2, dw2])
"""
SAID = """
call = "f(x, u) -> dx"
state = ["position1", "quaternion1", "velocity1", "omega1", "quaternion2", "position2",
  "velocity2", "omega2"]
quaternion2.order = "xyzw"
velocity1.frame = "space"
"""

# A block that slides, and an arm that turns about an axis of it: as one group by a basis.
NUMBERS = "parameters = { M = 2.5, m = 0.6, l = 0.9, k = 5.0, g = 9.81, c = 0.3 }"
SLIDER = f"""
name = "slider"
{NUMBERS}
[group]
name = "Slider"
action = "linear"
basis = [
  [[0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
  [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]],
]
[lagrangian]
L = "(M + m)*zeta_1^2/2 + m*l*A_33*zeta_1*zeta_2 + m*l^2*zeta_2^2/2 - k*A_12^2/2 + m*g*l*A_33"
[[force]]
name = "hinge"
covector = ["0", "-c*zeta_2"]
"""
BASIS = SLIDER[SLIDER.index("[group]") : SLIDER.index("[lagrangian]")]
CART = SLIDER.replace(BASIS, "").replace('"slider"', '"cart"\ngroup = "R(1) x SO(2)"')
CART = CART.replace("A_33", "A2_11").replace("A_12", "T1_1")
POLE = """
import numpy as np
M, m, l, k, g, c = 2.5, 0.6, 0.9, 5.0, 9.81, 0.3

def by_angle(x):
    place, angle, v, w = x
    mass = np.array([[M + m, m*l*np.cos(angle)], [m*l*np.cos(angle), m*l*l]])
    b = [m*l*np.sin(angle)*w*w - k*place, -m*g*l*np.sin(angle) - c*w]
    return np.array([v, w, *np.linalg.solve(mass, b)])

def turning_in_degrees(x):
    unit = np.degrees([np.pi/180, 1, np.pi/180, 1])
    return unit * by_angle(x / unit)

def by_matrix(x):
    place, C, a, S, b, v, w = x
    rates = by_angle([place, np.arctan2(S, C), v, w])
    return np.array([v, -S*w, -C*w, C*w, -S*w, *rates[2:]])
"""
STATES = {
    "cart by_matrix": '["T1_1", "A2_11", "A2_12", "A2_21", "A2_22", "zeta1_1", "zeta2_1"]',
    "cart by_angle": '["T1_1", "theta_2", "zeta1_1", "zeta2_1"]',
    "cart by_angle, names of the state": '["T1_1", "theta_2", "zeta_1", "zeta_2"]',
    "slider by_angle": '["s_1", "theta_2", "zeta_1", "zeta_2"]',
}
SLID = {
    name: f'call = "{name.split()[1].strip(",")}(x) -> dx"\nstate = {x}\n'
    for name, x in STATES.items()
}

# Coordinates of a scale, and of two shears that commute.
CLOTH = """
name = "cloth"
parameters = { a = 2.0, c = 0.4 }
[group]
name = "Cloth"
action = "linear"
basis = [
  [[1, 0, 0, 0, 0], [0, -2, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]],
  [[0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 1, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]],
  [[0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 1], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]],
]
[lagrangian]
L = "a*zeta_1^2/2 + zeta_2^2 + zeta_3^2/2 - A_11*A_34 - c*A_22*A_35^2"
"""
STRETCHED = """
import numpy as np
a, c = 2.0, 0.4

def f(x):
    scale, one, other, *rates = x
    e = np.exp(scale)
    b = [-e*one + 2*c*other**2/e**2, -e, -2*c*other/e**2]
    return np.array([*rates, b[0] / a, b[1] / 2, b[2]])
"""
STRETCH = 'call = "f(x) -> dx"\nstate = ["s_1", "s_2", "s_3", "zeta_1", "zeta_2", "zeta_3"]\n'
CAR = """
name = "car"
group = "SE(2)"
parameters = { m = 2.0, g = 9.81 }
[body]
given = { m = "m", centre = [0.1, 0], J = [[0.3, 0], [0, 0.4]] }
[[potential]]
kind = "gravity"
g = [0, "-g"]
"""
SKID = """
import numpy as np
m, r, g, I = 2.0, 0.1, 9.81, 0.7

def f(x):
    X, Y, angle, u, v, w = x
    c, s = np.cos(angle), np.sin(angle)
    # about the body's origin, along its axes; the centre of mass at (r, 0)
    mass = np.array([[m, 0, 0], [0, m, m*r], [0, m*r, I]])
    force = [m*w*v + m*r*w*w - m*g*s, -m*w*u - m*g*c, -m*r*w*u - m*r*g*c]
    return np.array([c*u - s*v, s*u + c*v, w, *np.linalg.solve(mass, force)])
"""
BY_ANGLE = 'call = "f(x) -> dx"\nstate = ["T_1", "T_2", "theta_1", "w_1", "w_2", "zeta_1"]'
CASES = {"pair": (PAIR, BODIES, SAID), "cloth": (CLOTH, STRETCHED, STRETCH)}
CASES |= {x: (CART if "cart" in x else SLIDER, POLE, table) for x, table in SLID.items()}
CASES |= {"car": (CAR, SKID, BY_ANGLE)}


def compared(folder, name, *changes, said=None):
    """Do both agree, and what is told of a code with some of its text changed."""
    problem, code, table = CASES[name]
    for old, new in changes:
        assert old in code
        code = code.replace(old, new)
    for file, text in (("problem.toml", problem), ("users.py", code), ("as.toml", said or table)):
        (folder / file).write_text(text, encoding="utf-8")
    read = load(folder / "problem.toml")
    held = comparison(read, made, folder / "users.py", "", folder / "as.toml", 0, 12)
    agrees, lines = reports(held, made)
    return agrees, [*lines]


@pytest.mark.parametrize("name", CASES)
def test_right_codes(name, tmp_path):
    agrees, lines = compared(tmp_path, name)
    assert agrees, lines


FAULTS = {
    "order of a quaternion": (
        "pair",
        ("rotation(*s, *x, *y, *z)", "rotation(*x, *y, *z, *s)"),
        ("q = np.concatenate([x, y, z])", "s, x, y, z = x, y, z, s; q = np.concatenate([x, y, z])"),
        (
            "[*(s * w2 + np.cross(q, w2)) / 2, -q @ w2 / 2]",
            "[-q @ w2 / 2, *(s * w2 + np.cross(q, w2)) / 2]",
        ),
        "it agrees if quaternion2 has order 'wxyz'",
    ),
    "frame of ω in the rate of one": (
        "pair",
        ("np.cross(q, w1)", "np.cross(w1, q)"),
        "the rate of quaternion1 is right if omega1 has frame 'space'",
    ),
    "axes that turn": (
        "pair",
        ("R1 @ (dv1 + np.cross(w1, v1))", "R1 @ dv1"),
        "the rate of velocity1 has −ω × v, ω along the axes of space and v along those of space",
    ),
    "a thrust in space": (
        "pair",
        ("F1 + u,", "F1 + R1.T @ u,"),
        ("np.cross(ARM, u)", "np.cross(ARM, R1.T @ u)"),
        "in block 1: the force of all inputs, with its moment by the arm, has its numbers along",
    ),
    "one moment of a spring": (
        "pair",
        ("np.cross(AT[1][0], F2) - b", "- b"),
        "in block 2: the moment of spring is missing",
    ),
    **{f"friction of a {x}": (x, ("- c*w]", "+ c*w]"), "c has the other sign") for x in STATES},
    "centrifugal term": (
        "slider by_angle",
        ("m*l*np.sin(angle)*w*w ", ""),
        "the centrifugal term by zeta_2²",
    ),
    "sign of an energy": ("cloth", ("+ 2*c", "- 2*c"), ("-2*c", "2*c"), "c has the other sign"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_faults(fault, tmp_path):
    name, *changes, words = FAULTS[fault]
    agrees, lines = compared(tmp_path, name, *changes)
    assert not agrees
    assert any(words in x for x in lines[1:]), lines


def test_an_angle_and_its_rate_are_in_degrees(tmp_path):
    said = SLID["cart by_angle"].replace("by_angle", "turning_in_degrees")
    agrees, lines = compared(tmp_path, "cart by_angle", said=said)
    assert not agrees
    assert ", zeta2_1 (" in lines[0]
    assert "  it agrees if theta_2 and zeta2_1 have the unit 57.295779513082323, degrees" in lines
    said += "[units]\ntheta_2 = 57.295779513082323\nzeta2_1 = 57.295779513082323\n"
    assert compared(tmp_path, "cart by_angle", said=said)[0]
    assert not (tmp_path / "__pycache__").exists()


NOT_SAID = [
    ("pair", '["omega"]', "'omega' means nothing here; did you mean 'omega"),
    ("pair", '["matrix1", "position1", "quaternion2", "matrix2"]', "the state says twice A2_11"),
    ("pair", '["quaternion2", "omega2"]', "the state does not say A1_11"),
    ("cart", '["theta"]', "'theta' means nothing here; did you mean 'theta_2'? known: theta_2, "),
    ("cart", '["position"]', "blocks are of SO(3) and SE(3); give names: theta_2, T1_1, "),
    ("cart", '["T1_1", "theta_2", "A2_11", "zeta_1", "zeta_2"]', "the state says twice A2_11"),
    ("cart", '["T1_1", "theta_2", "zeta_1", "zeta1_1"]', "the state says twice zeta_1"),
    ("cloth", '["s_1", "s_2", "zeta_1", "zeta_2", "zeta_3"]', "the state does not say s_3"),
]


@pytest.mark.parametrize(("name", "state", "words"), NOT_SAID)
def test_what_the_state_does_not_say(name, state, words, tmp_path):
    name += " by_angle" * (name == "cart")
    with pytest.raises(CompareError, match=re.escape(words)):
        compared(tmp_path, name, said=f'call = "f(x) -> dx"\nstate = {state}')
