"""Emitted code of SL(2) and SL(3), without forces, against geodesics that are known explicitly.

Its body has the moments J = h h^T: where A h / (det h)^(1/n) = G runs along a geodesic of J = 1,
A along one of the body; and G may be turned, U G V, on both sides.
"""

from functools import cache

import numpy as np
import pytest

from tests.oracles import general, geodesics, relative_error, sampling
from tests.support.emitted import arrange, import_python
from tests.support.flows import emitted, flow

FREE = """
name = "free"
group = "SL({n})"
[body]
moments = "symbolic"
"""


@cache
def body(n, shape):
    """The emitted module of a free body, its constants, and h (n, n); ``shape``: its J."""
    code = emitted(FREE.format(n=n))
    h = np.eye(n)
    if shape == "general":
        h += 0.3 * np.random.default_rng(n).normal(size=(n, n))
    J = h @ h.T
    p = {f"J_{i + 1}{j + 1}": J[i, j] for i in range(n) for j in range(i, n)}
    return code, code.constants(arrange(code, p)), h


def turns(n, shape):
    """Two rotations (n, n), other than 1 for a general body."""
    rng = np.random.default_rng(7)
    draw = [general.expm(X - X.T) for X in rng.normal(size=(2, n, n))]
    return draw if shape == "general" else [np.eye(n)] * 2


def state(code, h, G, V):
    """The state of the emitted code where A h is G up to its determinant, and its velocity V."""
    A, Z = np.linalg.solve(h.T, G.T).T, np.linalg.solve(G, V)
    Z = h @ Z @ np.linalg.inv(h)
    return np.concatenate([(A * np.linalg.det(h) ** (1 / len(h))).ravel(), entries(code, Z)])


def entries(code, Z):
    """The coordinates of Z in the basis of the module."""
    flat = np.reshape(code.BASIS, (len(code.BASIS), -1))
    return np.linalg.solve(flat @ flat.T, flat @ Z.ravel())


def second(code, h, x, dx):
    """G, its velocity and its acceleration, from a state of the emitted code and its velocity."""
    n = len(h)
    A, d = x[: n * n].reshape(n, n), n * n
    Z, change = (np.tensordot(y[d:], code.BASIS, 1) for y in (x, dx))
    scale = np.linalg.det(h) ** (-1 / n)
    return [A @ M @ h * scale for M in (np.eye(n), Z, change + Z @ Z)]


def gap(n, found, expected):
    """The larger relative error of the group elements and of the velocities."""
    pairs = zip(*(np.split(x, [n * n], axis=1) for x in (found, expected)), strict=True)
    return max(relative_error(*pair) for pair in pairs)


SHAPES = pytest.mark.parametrize("shape", ["unit", "general"])
KNOWN = {
    "plane": (2, geodesics.plane, (1.3, 0.7, 0.4)),
    "plane, little spin": (2, geodesics.plane, (0.8, 0.05, -0.9)),
    "plane, through a rotation": (2, geodesics.plane, (1.3, 0.7, 0.0)),
    "stretch": (2, geodesics.stretch, (1.3,)),
    "swirl": (3, geodesics.swirl, (1.3, 0.7)),
    "strain": (3, geodesics.strain, (1.3,)),
}


@SHAPES
@pytest.mark.parametrize("name", KNOWN)
def test_explicit_geodesics(name, shape):
    n, motion, given = KNOWN[name]
    code, k, h = body(n, shape)
    U, V = turns(n, shape)
    found = [motion(s, *given) for s in np.linspace(-1.5, 1.5, 9)]
    times = [t for t, _, _ in found]
    expected = np.array([state(code, h, U @ G @ V, U @ dG @ V) for _, G, dG in found])
    states = flow(code, k, expected[0], times)
    # 3e-14 is found
    assert gap(n, states, expected) < 3e-13


NILPOTENT = {
    "shear of the plane": [[0, 1], [0, 0]],
    "shear": [[0, 0, 1], [0, 0, 0], [0, 0, 0]],
    "N^2 not 0": [[0, 1, -2], [0, 0, 1.5], [0, 0, 0]],
}


@SHAPES
@pytest.mark.parametrize("name", NILPOTENT)
def test_straight_lines(name, shape):
    """A (1 + t N), N nilpotent, is a straight line inside SL(n): a geodesic, its multiplier 0."""
    N = np.array(NILPOTENT[name], float)
    n = len(N)
    code, k, h = body(n, shape)
    U, V = turns(n, shape)
    times = np.linspace(0, 10, 6)
    lines = [geodesics.line(t, U, V.T @ N @ V) for t in times]
    expected = np.array([state(code, h, *line) for line in lines])
    for x in expected:
        G, dG, acceleration = second(code, h, x, code.rhs(0.0, x, k))
        Z = np.linalg.solve(G, dG)
        # A'' is A (dZ/dt + Z^2): 7e-15 of these two remain, where they no longer cancel exactly
        assert np.max(np.abs(acceleration)) < 1e-13 * np.max(np.abs(dG) + np.abs(G @ Z @ Z))
    states = flow(code, k, expected[0], times)
    # 4e-14 is found for N^2 not 0 on a general body at t = 10, 4e-15 otherwise
    assert gap(n, states, expected) < 4e-13


def test_a_shear_is_exact():
    """With numbers that doubles hold, not even rounding moves the velocity of a shear."""
    code, k, _ = body(3, "unit")
    x = np.concatenate([np.eye(3).ravel(), entries(code, 0.5 * np.eye(3, k=2))])
    for t in (0.0, 1.0, 1024.0):
        x[2] = t / 2
        np.testing.assert_array_equal(code.rhs(t, x, k), [0, 0, 0.5, *[0] * 14])


def test_rotations_of_the_plane_are_geodesics_and_those_of_space_are_not():
    """exp t W stays on a geodesic where W^2 is a multiple of 1 (Rosevear, Sottile, Wong)."""
    for n, still in ((2, True), (3, False)):
        code, k, _ = body(n, "unit")
        W = np.zeros((n, n))
        W[0, 1], W[1, 0] = -1.5, 1.5
        dx = code.rhs(0.0, np.concatenate([np.eye(n).ravel(), entries(code, W)]), k)
        assert (np.max(np.abs(dx[n * n :])) == 0) == still


@SHAPES
@pytest.mark.parametrize("n", [2, 3])
def test_the_multiplier(n, shape):
    """A'' = A^-T Tr Z^2 / Tr (A^T A)^-1, in random states."""
    code, k, h = body(n, shape)
    data, rng = {"group": f"SL({n})"}, np.random.default_rng(4)
    for _ in range(50):
        x = general.random_state(data, code.BASIS, rng)
        G, dG, found = second(code, h, x, code.rhs(0.0, x, k))
        # 2e-14 is found: random A have condition numbers of some 10
        assert relative_error(found, geodesics.acceleration(G, dG)) < 2e-13


@SHAPES
@pytest.mark.parametrize("n", [2, 3])
def test_momenta_on_both_sides(n, shape):
    """Noether for A -> U A V: angular momentum, circulation and energy, on motions of any kind."""
    code, k, h = body(n, shape)
    data, rng = {"group": f"SL({n})"}, np.random.default_rng(5)
    for _ in range(3):
        x = general.random_state(data, code.BASIS, rng)
        states = flow(code, k, x, np.linspace(0, 4, 5))
        kept = []
        for y in states:
            G, dG, _ = second(code, h, y, y)
            kept.append([*map(np.ravel, geodesics.momenta(G, dG)), [code.energy(0.0, y, k)]])
        kept = np.array([np.concatenate(row) for row in kept])
        # 3e-13 is found for n = 3, where A grows to entries of 20 and the momenta cancel
        assert np.max(np.abs(kept - kept[0])) < 3e-12 * np.max(np.abs(kept[0]))


def test_the_four_points_of_the_committed_code():
    """generated/sl3 without springs, four points with J = 1, on the same geodesics."""
    code, side = import_python("sl3"), np.sqrt(0.5)
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) * side / np.sqrt(2)
    made = sampling.Body(np.ones(4), corners, np.zeros(3), np.zeros((4, 4)))
    k = code.constants(arrange(code, sampling.parameters("sl3", made)))
    found = [geodesics.swirl(s, 1.3, 0.7) for s in np.linspace(-1.5, 1.5, 9)]
    times = [t for t, _, _ in found]
    expected = np.array([state(code, np.eye(3), G, V) for _, G, V in found])
    # 2e-14 is found
    assert gap(3, flow(code, k, expected[0], times), expected) < 3e-13
