"""``derive compare`` on products of groups: attitudes, places and velocities of each factor, and
coordinates of factors of one parameter beside the user's own."""

import re

import pytest

from derive.command.simulating import made
from derive.compare.comparison import comparison, reports
from derive.compare.users_code import CompareError
from derive.problem.toml import load

PAIR = """
name = "pair"
group = "SE(3) x SE(3)"
[parameters]
k = 7.0
g = 9.81
b = 0.3
[[point]]
mass = 2
at = [0.2, 0, 0.1]
[[point]]
mass = 1
at = [0, 0.5, 0]
[[point]]
mass = 1.5
at = [-0.1, 0, 0.6]
[[point]]
mass = 0.7
at = [0.4, 0, 0]
block = 2
[[point]]
mass = 1.2
at = [0, -0.3, 0.2]
block = 2
[[point]]
mass = 0.9
at = [0.1, 0.6, 0]
block = 2
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

# A block that slides, and an arm that turns about an axis of it, as one group by a basis.
SLIDER = """
name = "slider"
[group]
name = "Slider"
action = "linear"
basis = [
  [[0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]],
  [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1], [0, 0, 1, 0]],
]
[parameters]
M = 2.5
m = 0.6
l = 0.9
k = 5.0
g = 9.81
[lagrangian]
L = "(M + m)*zeta_1^2/2 + m*l*A_33*zeta_1*zeta_2 + m*l^2*zeta_2^2/2 - k*A_12^2/2 + m*g*l*A_33"
"""
SLIDES = """
import numpy as np
M, m, l, k, g = 2.5, 0.6, 0.9, 5.0, 9.81

def f(x):
    s, angle, v, w = x
    mass = np.array([[M + m, m*l*np.cos(angle)], [m*l*np.cos(angle), m*l*l]])
    b = [m*l*np.sin(angle)*w*w - k*s, -m*g*l*np.sin(angle)]
    return np.array([v, w, *np.linalg.solve(mass, b)])
"""
SLID = 'call = "f(x) -> dx"\nstate = ["s_1", "theta_2", "zeta_1", "zeta_2"]\n'

# Coordinates of a scale, and of two shears that commute.
CLOTH = """
name = "cloth"
[group]
name = "Cloth"
action = "linear"
basis = [
  [[1, 0, 0, 0, 0], [0, -2, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]],
  [[0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 1, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]],
  [[0, 0, 0, 0, 0], [0, 0, 0, 0, 0], [0, 0, 0, 0, 1], [0, 0, 0, 0, 0], [0, 0, 0, 0, 0]],
]
[parameters]
a = 2.0
c = 0.4
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
CASES = {"pair": (PAIR, BODIES, SAID), "slider": (SLIDER, SLIDES, SLID)}
CASES |= {"cloth": (CLOTH, STRETCHED, STRETCH)}


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
    "degrees": (
        "slider",
        (" = x\n", " = x\n    angle, w = np.radians([angle, w])\n"),
        ("w, *np.linalg.solve(mass, b)]", "w, *np.linalg.solve(mass, b)] * np.array([1, D, 1, D])"),
        ("def f", "D = np.degrees(1)\ndef f"),
        "it agrees if theta_2 and zeta_2 have the unit 57.295779513082323, degrees",
    ),
    "sign of an energy": ("cloth", ("+ 2*c", "- 2*c"), ("-2*c", "2*c"), "c has the other sign"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_faults(fault, tmp_path):
    name, *changes, words = FAULTS[fault]
    agrees, lines = compared(tmp_path, name, *changes)
    assert not agrees
    assert any(words in x for x in lines[1:]), lines


@pytest.mark.parametrize(
    ("state", "words"),
    [
        ('["omega"]', "'omega' means nothing here; did you mean 'omega"),
        ('["matrix1", "position1", "quaternion2", "matrix2"]', "the state says twice A2_11"),
        ('["quaternion2", "omega2"]', "the state does not say A1_11"),
    ],
)
def test_what_a_state_of_blocks_does_not_say(state, words, tmp_path):
    with pytest.raises(CompareError, match=re.escape(words)):
        compared(tmp_path, "pair", said=f'call = "f(x, u) -> dx"\nstate = {state}')


def test_coordinates_that_one_part_has_are_all_said(tmp_path):
    said = STRETCH.replace('"s_3", ', "")
    with pytest.raises(CompareError, match="the state does not say s_3"):
        compared(tmp_path, "cloth", said=said)
