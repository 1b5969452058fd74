"""``derive compare`` names terms that a derivation by hand loses: what two bodies make of each
other's rates, the rate of a momentum at rest, what mass that flows makes of momenta, the axes of
a force in its moment alone."""

import pytest

from tests.compare import codes

HEAD = """
import numpy as np


def hat(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])

"""
WHEELS = """
name = "wheels"
group = "SE(3) x R(2)"
parameters = { Jw = 0.21, K = 1.3, b = 0.4 }
input = [{ name = "motor", kind = "scalar" }]
[lagrangian]
L = "(K*zeta_1^2 + 1.7*zeta_2^2 + 2.3*zeta_3^2)/2 + zeta_1*zeta_3/5 \
 + zeta_4^2 + 3*zeta_5^2/2 + 2*zeta_6^2 \
 + Jw*((zeta_1 + zeta_7)^2 + (0.6*zeta_1 + 0.8*zeta_3 + zeta_8)^2)/2"
[[force]]
covector = [0, 0, 0, 0, 0, 0, "motor - b*zeta_7", "-motor/2"]
"""
WHEELS_CODE = """
I, J, N = np.array([[1.3, 0, 0.2], [0, 1.7, 0], [0.2, 0, 2.3]]), 0.21, np.array([2, 3, 4])
a = np.array([[1, 0, 0], [0.6, 0, 0.8]])


def rhs(t, x, k, u):
    A, w, v, W = np.reshape(x[:9], (3, 3)), x[14:17], x[17:20], x[20:]
    q, h = np.array([u[0] - 0.4 * W[0], -u[0] / 2]), J * (a @ w + W)
    dw = np.linalg.solve(I, -a.T @ q - np.cross(w, I @ w + a.T @ h) - np.cross(v, N * v))
    turned = np.cross(w, N * v) / N
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, W, dw, -turned, q / J - a @ dw])
"""
CURRENT = """
name = "current"
group = "SE(3)"
parameters = { m = 3.1, zg = 0.2, X = 0.9, Y = 3.5, cx = 0.4, cy = -0.3 }
[inertia]
operator = [
  ["1.2 + m*zg^2", 0, 0, 0, "-m*zg", 0], [0, "2.5 + m*zg^2", 0, "m*zg", 0, 0], [0, 0, 3, 0, 0, 0],
  [0, "m*zg", 0, "m + X", 0, 0], ["-m*zg", 0, 0, 0, "m + Y", 0], [0, 0, 0, 0, 0, "m + Y"]]
momentum = [0, 0, 0, "-X*(A_11*cx + A_21*cy)", "-Y*(A_12*cx + A_22*cy)", "-Y*(A_13*cx + A_23*cy)"]
U = "-(X*(A_11*cx + A_21*cy)^2 + Y*(A_12*cx + A_22*cy)^2 + Y*(A_13*cx + A_23*cy)^2)/2 - m*zg*A_33"
"""
CURRENT_CODE = """
m, rg, N = 3.1, np.array([0, 0, 0.2]), np.diag([0.9, 3.5, 3.5])
M = np.zeros((6, 6))
M[:3, :3], M[3:, 3:] = np.diag([1.2, 2.5, 3]) - m * hat(rg) @ hat(rg), m * np.eye(3) + N
M[:3, 3:], M[3:, :3] = m * hat(rg), -m * hat(rg)


def rhs(t, x, k, u):
    A, w, v = np.reshape(x[:9], (3, 3)), x[12:15], x[15:]
    c = A.T @ [0.4, -0.3, 0]
    rigid = m * np.cross(w, v + np.cross(w, rg))
    moment = m * np.cross(rg, A.T @ [0, 0, 1]) - np.cross(v - c, N @ (v - c))
    moment = moment - np.cross(w, M[:3, :3] @ w) - m * np.cross(rg, np.cross(w, v))
    force = -rigid - np.cross(w, N @ (v - c)) - N @ np.cross(w, c)
    a = np.linalg.solve(M, np.concatenate([moment, force]))
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, a])
"""
SLUNG = """
name = "slung"
group = "SE(3) x R(3)"
parameters = { k = 7.0, l = 0.6 }
point = [
  { mass = 1, at = [0.4, 0, 0] },
  { mass = 2, at = [0, 0.3, 0] },
  { mass = 1, at = [-0.4, -0.6, 0] },
  { mass = 0, at = [0.1, 0, -0.5] },
  { mass = 0.7, at = [0, 0, 0], block = 2 },
]
[[potential]]
kind = "spring"
between = [4, 5]
stiffness = "k"
length = "l"
"""
SLUNG_CODE = """
P = np.array([[0.4, 0, 0], [0, 0.3, 0], [-0.4, -0.6, 0]])
I, h = sum(m * hat(r).T @ hat(r) for m, r in zip([1, 2, 1], P)), np.array([0.1, 0, -0.5])


def rhs(t, x, k, u):
    A, T, S, w, v, V = np.reshape(x[:9], (3, 3)), x[9:12], x[12:15], x[15:18], x[18:21], x[21:]
    d = S - T - A @ h
    pull = 7 * (np.linalg.norm(d) - 0.6) * d / np.linalg.norm(d)
    moment = np.cross(h, A.T @ pull) - np.cross(w, I @ w)
    force = A.T @ pull / 4 - np.cross(w, v)
    spun = np.linalg.solve(I, moment)
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, V, spun, force, -pull / 0.7])
"""
ROCKET = """
name = "rocket"
group = "SE(3)"
parameters = { fuel = 6.0, b = 0.3, U = 9.0 }
input = [{ name = "throttle", kind = "scalar" }]
[[flow]]
name = "jet"
at = [0, 0.1, -0.5]
mass = "fuel"
rate = "-b*throttle"
velocity = [0, 0, "-U"]
steady = true
[body]
given = { m = "8 + fuel", c = [0.2, 0, "2 + fuel/2"], J = [
  ["2 + fuel/9", 0, 0], [0, "3 + fuel/7", 0], [0, 0, "4 + fuel/3"]] }
"""
ROCKET_CODE = """
r, e = np.array([0, 0.1, -0.5]), np.array([0, 0, -9.0])


def tensor(J):
    return (sum(J)) * np.eye(3) - np.diag(J)


def rhs(t, x, k, u):
    A, w, v, f, lost = np.reshape(x[:9], (3, 3)), x[12:15], x[15:18], x[18], -0.3 * u[0]
    m, c, dc = 8 + f, np.array([0.2, 0, 2 + f / 2]), np.array([0, 0, lost / 2])
    I, dI = tensor([2 + f / 9, 3 + f / 7, 4 + f / 3]), tensor([lost / 9, lost / 7, lost / 3])
    p = dc - lost * r
    P, H = m * v + np.cross(w, c) + p, I @ w + np.cross(c, v)
    out = lost * (v + np.cross(w, r) + e)
    force = out - lost * v - np.cross(w, dc) - np.cross(w, P)
    moment = np.cross(r, out) - dI @ w - np.cross(dc, v) - np.cross(w, H) - np.cross(v, P)
    M = np.block([[I, hat(c)], [-hat(c), m * np.eye(3)]])
    a = np.linalg.solve(M, np.concatenate([moment, force]))
    return np.concatenate([(A @ hat(w)).ravel(), A @ v, a, [lost]])
"""
CODES = {
    "wheels": (WHEELS, WHEELS_CODE),
    "current": (CURRENT, CURRENT_CODE),
    "slung": (SLUNG, SLUNG_CODE),
    "rocket": (ROCKET, ROCKET_CODE),
}
FAULTS = {
    "wheels without the rate of the body": (
        "wheels",
        ("J * (a @ w + W)", "J * W"),
        "the velocity of block 1 in the momenta of block 2 that turn with it (of a wheel, the aω "
        "of J(Ω + aω)) is missing",
    ),
    "wheels without its acceleration": (
        "wheels",
        ("q / J - a @ dw", "q / J"),
        "the acceleration of block 1 in the equations of block 2 (of a wheel, aω̇) is missing",
    ),
    "wheels counted twice in the inertia": (
        "wheels",
        ("solve(I,", "solve(I + J * a.T @ a,"),
        "what block 2 adds to the inertia of block 1 (of a wheel, about its axis) has the factor 2",
    ),
    "wheels without what their motors push back": (
        "wheels",
        ("-a.T @ q -", "-"),
        "the reaction of the covector of block 2 on block 1 is missing",
    ),
    "a friction by the rate in space": (
        "wheels",
        ("* W[0]", "* (W + a @ w)[0]"),
        "the covector is made of the velocity of block 2 and what block 1 adds to it (of a wheel, ",
    ),
    "Munk's moment of what carries wheels": (
        "wheels",
        (" - np.cross(v, N * v)", ""),
        "v × p of the momenta π = ∂ℓ/∂ω, p = ∂ℓ/∂v of block 1 is missing",
    ),
    "a current that does not turn": (
        "current",
        (" - N @ np.cross(w, c)", ""),
        "the rate of the momentum p = ∂ℓ/∂ζ at rest, as it is seen from where ζ is, is missing",
    ),
    "sign of the righting moment": (
        "current",
        ("m * np.cross(rg, A.T @ [0", "-m * np.cross(rg, A.T @ [0"),
        "m in the force of the place in ℓ alone has the other sign; the same in numbers: zg in the",
    ),
    "moment of a cable by its force in space": (
        "slung",
        ("np.cross(h, A.T @ pull)", "np.cross(h, pull)"),
        "in block 1: the force of spring is along the axes of space in its moment by the arm alone",
    ),
    "moment of a cable by the place of another point": (
        "slung",
        ("np.cross(h, A.T @ pull)", "np.cross(P[2], A.T @ pull)"),
        "in block 1: the lever arm of spring in its moment is that of point 3",
    ),
    "no momentum of what flows inside": (
        "rocket",
        ("np.cross(w, c) + p,", "np.cross(w, c),"),
        "the momentum p of what flows inside, in the momentum m v + ω × c + p, is missing",
    ),
    "a tensor that does not change": (
        "rocket",
        (" - dI @ w", ""),
        "İω of the tensor of inertia that changes is missing",
    ),
    "a first moment that does not change": (
        "rocket",
        (" - np.cross(dc, v)", ""),
        "ċ × v of the first moment c that changes is missing",
    ),
    "this in the force": (
        "rocket",
        (" - np.cross(w, dc)", ""),
        "ω × ċ of the first moment c that changes is missing",
    ),
    "the law of mass that is left at rest": (
        "rocket",
        (" - lost * v", " - 2 * lost * v"),
        "ṁ v of the mass that changes has the factor 2",
    ),
    "what leaves does not turn with the body": (
        "rocket",
        ("v + np.cross(w, r) + e", "v + e"),
        "ω × r in the velocity of what leaves at r is missing",
    ),
}


def compared(capsys, folder, name, *changes):
    """The exit code and what is printed of a code, with some of its text changed."""
    problem, code = CODES[name]
    found, told = codes.compared(capsys, folder, problem, HEAD + code, "", *changes)
    return found, told.out


@pytest.mark.parametrize("name", CODES)
def test_the_right_code_agrees(name, capsys, tmp_path):
    code, told = compared(capsys, tmp_path, name)
    assert (code, told[:6]) == (0, "agrees"), told


@pytest.mark.parametrize("fault", FAULTS)
def test_the_fault_is_named(fault, capsys, tmp_path):
    name, change, words = FAULTS[fault]
    code, told = compared(capsys, tmp_path, name, change)
    assert code == 1
    assert words in told.splitlines()[1], told


def test_of_a_body_by_an_operator_nothing_that_explains_is_told(capsys, tmp_path):
    """A group by itself is no product whose factors are tried apart."""
    change = ("return np.concatenate", "a = a * (1 + np.tanh(w) @ v)\n    return np.concatenate")
    code, told = compared(capsys, tmp_path, "current", change)
    assert code == 1
    assert "no change of our equations that was tried explains this" in told
