"""Emitted code beside motions that are known in closed form, over many periods: tops, a solid
in flight, masses on a spring, and geodesics of SL(2) and SL(3)."""

import numpy as np
import pytest

from tests.oracles import (
    free_top,
    general,
    geodesics,
    lagrange_top,
    relative_error,
    sampling,
)
from tests.support.library import arrange, module_of
from tests.support.states import flow

RNG = np.random.default_rng(2)
BODY_TURN, SPACE_TURN = sampling.random_rotation(RNG), sampling.random_rotation(RNG)
MOMENTS = (1.25, 2.0, 2.75)
INERTIA = BODY_TURN @ np.diag(MOMENTS) @ BODY_TURN.T
CENTRE = np.array([0.3, -0.2, 0.5])


def constants(name, body):
    """A committed module, and its constants for a body of points."""
    code = module_of(name)
    return code, code.constants(arrange(code, sampling.parameters(name, body)))


# ---------------------------------------------------------------- tops


def turning(t, momentum):
    """Attitude and angular velocity of a free top of energy 1, its body and its space turned."""
    A, W = free_top.motion(t, MOMENTS, 1.0, momentum)
    return SPACE_TURN @ A @ BODY_TURN.T, BODY_TURN @ W


def free(momentum, times):
    """By Jacobi's functions and Legendre's Pi; the middle moment is 2, so that 2 is a separatrix,
    where what rounding does at the start grows by exp(0.42 t)."""
    states = [np.concatenate([np.ravel(x) for x in turning(t, momentum)]) for t in times]
    return *constants("so3", sampling.solid_body(INERTIA)), times, states, [9]


def over_periods(momentum):
    return free(momentum, np.linspace(0, 25.25, 26) * free_top.period(MOMENTS, 1.0, momentum))


TOP = (1.3, 0.5), 4.0


def axial_top(moments, weight):
    """A body of mass 1 with these moments about its fixed point, in gravity."""
    first, third = moments
    height = weight / 9.81
    central = np.diag([first - height**2, first - height**2, third])
    return sampling.solid_body(central, 1.0, (0, 0, height), (0, 0, -9.81))


def released(*start):
    """A heavy top with an axis, over 20 to 150 nutations: all three angles and their rates."""
    times = np.linspace(0, 10, 21)
    states = [lagrange_top.motion(t, *TOP, *start) for t in times]
    return *constants("so3", axial_top(*TOP)), times, states, [9]


def cone():
    """The ready-made top: a cone about its apex."""
    code, (rho, R, h, g) = module_of("top"), (800.0, 0.03, 0.05, 9.81)
    m = rho * np.pi * R**2 * h / 3
    moments = m * (3 / 20 * R**2 + 3 / 5 * h**2), 3 / 10 * m * R**2
    times = np.linspace(0, 1, 11)
    states = [lagrange_top.motion(t, moments, m * g * 3 / 4 * h, 0.8, 2.0, 150.0) for t in times]
    return code, code.constants({"rho": rho, "R": R, "h": h, "g": g}), times, states, [9]


# ---------------------------------------------------------------- flight and swings


def flight(t, place, velocity):
    """The state of a free solid in SE(3) that turns as a free top about its centre of mass."""
    A, W = turning(t, 2.2)
    w = A.T @ velocity - np.cross(W, CENTRE)
    return np.concatenate([A.ravel(), place - A @ CENTRE, W, w])


def thrown():
    """The centre of mass on a parabola; the first moment is not zero."""
    g, q, v = np.array([[0.3, -1.0, -9.81], [1.0, 2.0, -1.0], [0.5, -0.3, 9.0]])
    times = np.linspace(0, 10, 9)
    states = [flight(t, q + v * t + g * t**2 / 2, v + g * t) for t in times]
    body = sampling.solid_body(INERTIA, 1.7, CENTRE, g)
    return *constants("se3", body), times, states, [9, 12, 15]


def pair_on_a_spring(t, masses, stiffness, q, v):
    """Positions and velocities (2, 3) at t of two masses tied by a spring of no length.

    The centre goes straight on and the difference d is d_0 cos wt + d_0' sin wt / w, with
    w^2 = k (1 / m_1 + 1 / m_2).
    """
    masses = np.asarray(masses, float)
    shares, w = masses / masses.sum(), np.sqrt(stiffness * np.sum(1 / masses))
    drift, d, speed = shares @ v, q[1] - q[0], v[1] - v[0]
    gap = d * np.cos(w * t) + speed * np.sin(w * t) / w
    change = speed * np.cos(w * t) - d * w * np.sin(w * t)
    sides = np.array([-shares[1], shares[0]])[:, None]
    return shares @ q + drift * t + sides * gap, drift + sides * change


def on_a_spring(velocity, end):
    """The ready-made gl3: two masses swing about their centre, the third goes straight on.

    With the entries of dA/dt as velocities also where det A = 0, twice in every swing.
    """
    code, masses, k = module_of("gl3", velocity=velocity), np.array([1.0, 2.0]), 1.7
    rng = np.random.default_rng(3)
    A, V = np.eye(3) + 0.1 * rng.normal(size=(3, 3)), 0.3 * rng.normal(size=(3, 3))
    times, states = np.linspace(0, end, 11), []
    for t in times:
        q, v = pair_on_a_spring(t, masses, k, A.T[:2], V.T[:2])
        B, U = np.vstack([q, A[:, 2] + t * V[:, 2]]).T, np.vstack([v, V[:, 2]]).T
        last = np.linalg.solve(B, U) if velocity == "body" else U
        states.append(np.concatenate([B.ravel(), last.ravel()]))
    return code, code.constants([k]), times, states, [9]


# ---------------------------------------------------------------- geodesics of SL(n)

FREE = """
name = "free"
group = "SL({n})"
[body]
moments = "symbolic"
"""
NILPOTENT = {2: [[0, 1], [0, 0]], 3: [[0, 1, -2], [0, 0, 1.5], [0, 0, 0]]}


def geodesic(n, motion, given, general_body):
    """Of a body with the moments J = h h^T: where A h / (det h)^(1/n) = G runs along a geodesic of
    J = 1, A along one of the body; and G may be turned, U G V, on both sides."""
    code, h, U, V = module_of(FREE.format(n=n)), np.eye(n), np.eye(n), np.eye(n)
    if general_body:
        h = h + 0.3 * np.random.default_rng(n).normal(size=(n, n))
        draw = np.random.default_rng(7).normal(size=(2, n, n))
        U, V = (general.expm(X - X.T) for X in draw)
    J = h @ h.T
    p = {f"J_{i + 1}{j + 1}": J[i, j] for i in range(n) for j in range(i, n)}
    basis = np.reshape(code.BASIS, (len(code.BASIS), -1))
    times, states = [], []
    for s in np.linspace(-1.5, 1.5, 9):
        t, G, dG = motion(s, *given)
        Z = h @ V.T @ np.linalg.solve(G, dG) @ V @ np.linalg.inv(h)
        A = U @ G @ V @ np.linalg.inv(h) * np.linalg.det(h) ** (1 / n)
        times.append(t)
        states.append(np.append(A.ravel(), np.linalg.solve(basis @ basis.T, basis @ Z.ravel())))
    return code, code.constants(arrange(code, p)), times, states, [n * n]


def straight(s, n):
    """1 + tN, N nilpotent: a straight line inside SL(n), its multiplier 0."""
    N = np.array(NILPOTENT[n], float)
    return 5 * s, *geodesics.line(5 * s, np.eye(n), N)


GEODESICS = {
    "plane": (2, geodesics.plane, (1.3, 0.7, 0.4)),
    "plane, little spin": (2, geodesics.plane, (0.8, 0.05, -0.9)),
    "plane, through a rotation": (2, geodesics.plane, (1.3, 0.7, 0.0)),
    "stretch": (2, geodesics.stretch, (1.3,)),
    "swirl": (3, geodesics.swirl, (1.3, 0.7)),
    "strain": (3, geodesics.strain, (1.3,)),
    "shear of the plane": (2, straight, (2,)),
    "shear": (3, straight, (3,)),
}
MOTIONS = {
    "free: about the largest moment": (lambda: over_periods(2.2), 1e-11),
    "free: about the smallest moment": (lambda: over_periods(1.75), 1e-11),
    "free: on the separatrix": (lambda: free(2.0, np.linspace(-12, 12, 13)), 1e-11),
    "heavy: waves": (lambda: released(0.5, 0.2, 20.0), 3e-12),
    "heavy: cusps": (lambda: released(0.5, 0.0, 20.0), 3e-12),
    "heavy: loops": (lambda: released(0.5, -2.0, 20.0), 3e-12),
    "heavy: fast loops": (lambda: released(0.5, 3.0, 20.0), 3e-12),
    "heavy: falls and rises": (lambda: released(0.9, 0.1, 3.0), 3e-12),
    "heavy: hangs": (lambda: released(-0.2, 1.5, 3.0), 3e-12),
    "cone: on its apex": (cone, 3e-12),
    "solid: thrown": (thrown, 3e-13),
    "spring: by dA/dt": (lambda: on_a_spring("tangent", 41.3), 2e-12),
    "spring: by Z": (lambda: on_a_spring("body", 1.0), 2e-12),
    **{
        f"geodesic: {name}, {'any' if any_body else 'unit'} body": (
            lambda given=given, any_body=any_body: geodesic(*given, any_body),
            4e-13,
        )
        for name, given in GEODESICS.items()
        for any_body in (False, True)
    },
}
"""A motion → what gives its module, constants, times, states and where these are divided; how
closely it is followed."""


@pytest.mark.parametrize("name", MOTIONS)
def test_emitted_code_moves_as_is_known(name):
    made, close = MOTIONS[name]
    code, k, times, states, ends = made()
    found = flow(code, k, states[0], times)
    parts = (np.split(np.asarray(x), ends, axis=1) for x in (found, states))
    errors = [relative_error(*pair) for pair in zip(*parts, strict=True)]
    assert max(errors) < close, errors
