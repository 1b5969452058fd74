"""Emitted code of solids and masses in flight and in orbit against motions in closed form."""

from pathlib import Path

import numpy as np
import pytest

import derive
from tests.oracles import free_top, general, kepler, relative_error, sampling
from tests.support.emitted import arrange, import_python
from tests.support.flows import emitted, flow

RNG = np.random.default_rng(2)
BODY_TURN, SPACE_TURN = sampling.random_rotation(RNG), sampling.random_rotation(RNG)
MOMENTS, ENERGY, MOMENTUM = (1.25, 2.0, 2.75), 1.0, 2.2
INERTIA = BODY_TURN @ np.diag(MOMENTS) @ BODY_TURN.T
CENTRE = np.array([0.3, -0.2, 0.5])
MU, AXIS = 1.7, 1.3
YEAR = 2 * np.pi * np.sqrt(AXIS**3 / MU)


def worst(found, expected, ends):
    """The largest relative error of the columns up to each of the ``ends``."""
    blocks = zip(*(np.split(np.asarray(x), ends, axis=1) for x in (found, expected)), strict=True)
    return max(relative_error(*pair) for pair in blocks)


SOLID = [9, 12, 15]


def flight(t, place, velocity):
    """The state of a free solid in SE(3) that turns as a free top about its centre of mass."""
    A, W = free_top.motion(t, MOMENTS, ENERGY, MOMENTUM)
    A, W = SPACE_TURN @ A @ BODY_TURN.T, BODY_TURN @ W
    w = A.T @ velocity - np.cross(W, CENTRE)
    return np.concatenate([A.ravel(), place - A @ CENTRE, W, w])


def listed(masses, places):
    """Points as a problem file has them."""
    pairs = zip(masses, places, strict=True)
    return "\n".join(f"[[point]]\nmass = {float(m)}\nat = {[*map(float, r)]}" for m, r in pairs)


def test_a_solid_thrown():
    """The centre of mass on a parabola and the free top about it: first moment not zero."""
    code, g = import_python("se3"), np.array([0.3, -1.0, -9.81])
    q, v = np.array([1.0, 2.0, -1.0]), np.array([0.5, -0.3, 9.0])
    times = np.linspace(0, 10, 9)
    expected = [flight(t, q + v * t + g * t**2 / 2, v + g * t) for t in times]
    body = sampling.solid_body(INERTIA, 1.7, CENTRE, g)
    k = code.constants(arrange(code, sampling.parameters("se3", body)))
    found = flow(code, k, expected[0], times)
    # 6e-15 is found
    assert worst(found, expected, SOLID) < 3e-13


ATTRACTED = """
name = "orbiter"
group = "SE(3)"
[parameters]
M = 3.0
mu = 1.0
{points}
[[potential]]
kind = "expression"
U = "-mu*M/sqrt(r1_x^2 + r1_y^2 + r1_z^2)"
"""


@pytest.mark.parametrize("e", [0.0, 0.6])
def test_a_solid_in_orbit(e):
    """Attracted at its centre of mass: five of Kepler's orbits, and the free top about it."""
    body = sampling.solid_body(INERTIA, 3.0, CENTRE)
    code = emitted(ATTRACTED.format(points=listed(body.masses, body.points)))
    times = np.linspace(0, 5, 11) * YEAR
    expected = [flight(t, *kepler.orbit(t, MU, AXIS, e, SPACE_TURN[:, :2])) for t in times]
    found = flow(code, code.constants([3.0, MU]), expected[0], times)
    # 6e-12 is found: the error of the energy moves the body along its orbit, ever more
    assert worst(found, expected, SOLID) < 1e-10


PLANETS = """
name = "planets"
group = "GL(2)"
[parameters]
mu = 1.0
[[point]]
mass = 2.0
at = [1, 0]
[[point]]
mass = 0.5
at = [0, 1]
[[potential]]
kind = "attraction"
strength = "mu"
"""


def test_two_masses_on_one_orbit():
    """GL(2) ties two masses by nothing: Kepler's orbits, the second ahead by 1/12 of a year."""
    code, times = emitted(PLANETS), np.linspace(0, 5, 11) * YEAR

    def state(t):
        both = [kepler.orbit(t + ahead * YEAR, MU, AXIS, 0.6) for ahead in (0.0, 1 / 12)]
        A, V = (np.column_stack([one[i][:2] for one in both]) for i in (0, 1))
        return np.concatenate([A.ravel(), np.linalg.solve(A, V).ravel()])

    expected = [state(t) for t in times]
    found = flow(code, code.constants([MU]), expected[0], times)
    # 5e-12 is found, as for the solid
    assert worst(found, expected, [4]) < 1e-10


def comet(size, times):
    """Places (times, 3) of the centre of mass of the ready-made comet, which turns as well."""
    code, s = emitted("comet"), np.array([0, size / 3, 0])
    q, v = kepler.orbit(0.0, MU, AXIS, 0.6)
    W = np.array([0.3, -0.2, 0.5])
    w = SPACE_TURN.T @ v - np.cross(W, s)
    x = np.concatenate([SPACE_TURN.ravel(), q - SPACE_TURN @ s, W, w])
    states = flow(code, code.constants({"mu": MU, "m": 0.8, "s": size}), x, times)
    return states[:, 9:12] + states[:, :9].reshape(-1, 3, 3) @ s


def test_a_small_comet_is_keplers():
    """Every mass is attracted: Kepler's orbit but for powers, from the second, of the size."""
    times = np.linspace(0, 1, 5) * YEAR
    expected = np.array([kepler.orbit(t, MU, AXIS, 0.6)[0] for t in times])
    large, middle, small = (comet(size, times) - expected for size in (2e-3, 1e-3, 5e-4))
    assert 3.9 < np.max(np.abs(large)) / np.max(np.abs(middle)) < 4.1
    # Richardson's extrapolation to no size takes the second and the third power away
    first, second = (4 * middle - large) / 3, (4 * small - middle) / 3
    # of 4e-5 remain 2e-11, of the fourth power
    assert np.max(np.abs(8 * second - first)) / 7 < 1e-9


def spring_state(t, A, V, masses, k):
    """Positions and velocities, columns of A and V (3, 3), of gl3 at the time t."""
    q, v = kepler.pair_on_a_spring(t, masses, k, A.T[:2], V.T[:2])
    return np.vstack([q, A[:, 2] + t * V[:, 2]]).T, np.vstack([v, V[:, 2]]).T


@pytest.mark.parametrize(("velocity", "end"), [("body", 1.0), ("tangent", 41.3)])
def test_masses_on_a_spring(velocity, end):
    """The ready-made gl3: two masses swing about their centre, the third goes straight on.

    With the entries of dA/dt as velocities also where det A = 0, twice in every swing.
    """
    code, masses, k = emitted("gl3", velocity=velocity), np.array([1.0, 2.0]), 1.7
    rng = np.random.default_rng(3)
    A, V = np.eye(3) + 0.1 * rng.normal(size=(3, 3)), 0.3 * rng.normal(size=(3, 3))
    times = np.linspace(0, end, 11)
    expected = []
    for t in times:
        B, U = spring_state(t, A, V, masses, k)
        last = np.linalg.solve(B, U) if velocity == "body" else U
        expected.append(np.concatenate([B.ravel(), last.ravel()]))
    found = flow(code, code.constants([k]), expected[0], times)
    # 4e-15, and after ten swings 2e-13
    assert worst(found, expected, [9]) < 2e-12


# ---------------------------------------------------------------- Exercise 2 in space

READY = Path(derive.__file__).parent / "problems" / "saff3.toml"
DOWN = np.array([0.0, 0.0, -9.81])
CORNERS = np.vstack([np.eye(3), np.zeros(3)])


def in_space(centre):
    """saff3, its tetrahedron moved so that ``centre`` (3,) is its centre of mass."""
    text = READY.read_text(encoding="utf-8")
    for row in CORNERS:
        at = [*map(float, row - CORNERS.mean(axis=0) + centre)]
        text = text.replace(f"at = {[*map(int, row)]}", f"at = {at}")
    return emitted(text)


@pytest.mark.parametrize("where", [(0, 0, 0), (0.25, 0.25, 0.25), (-0.5, 2.0, 1.0)], ids=str)
def test_the_centre_of_mass_separates(where):
    """A moves as under SL(3) for the body about its centre of mass, which falls on a parabola."""
    s, linear = np.array(where), import_python("sl3")
    whole = in_space(s)
    m, stiffness, times = 0.7, 1.9, np.linspace(0, 4, 9)
    springs = np.diag([stiffness] * 3, 1) + np.diag([stiffness] * 3, -1)
    body = sampling.Body(np.full(4, m), CORNERS - CORNERS.mean(axis=0), np.zeros(3), springs)
    x = sampling.random_state("sl3", np.random.default_rng(6))
    A, Z = sampling.split("sl3", x)
    q, v = np.array([1.0, -2.0, 3.0]), np.array([0.3, 0.2, 5.0])
    w = np.linalg.solve(A, v) - Z @ s
    start = np.concatenate([x[:9], q - A @ s, x[9:], w])
    p = arrange(linear, sampling.parameters("sl3", body))
    expected = flow(linear, linear.constants(p), x, times)
    found = flow(whole, whole.constants({"m": m, "k": stiffness, "g": 9.81}), start, times)
    parts = np.split(found, [9, 12, 20], axis=1)
    A, Z = parts[0].reshape(-1, 3, 3), np.tensordot(parts[2], linear.BASIS, 1)
    centre = parts[1] + A @ s, np.einsum("tij,tj->ti", A, parts[3] + Z @ s)
    # 1e-13 is found for velocities, 4e-14 otherwise
    assert relative_error(parts[0], expected[:, :9]) < 1e-12
    assert relative_error(parts[2], expected[:, 9:]) < 1e-12
    t = times[:, None]
    assert relative_error(centre[0], q + t * v + t**2 / 2 * DOWN) < 1e-12
    assert relative_error(centre[1], v + t * DOWN) < 1e-12


def test_the_tetrahedron_is_that_of_the_ready_made_problem():
    code, same = emitted("saff3"), in_space(CORNERS.mean(axis=0))
    x = general.random_state({"group": "SAff(3)"}, code.BASIS, np.random.default_rng(8))
    dx = (each.rhs(0.0, x, each.constants({})) for each in (code, same))
    np.testing.assert_array_equal(*dx)
