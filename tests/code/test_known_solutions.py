"""Emitted code of tops against motions in closed form, over many periods."""

import numpy as np
import pytest
from mpmath import mp

from tests.oracles import free_top, lagrange_top, sampling
from tests.support.emitted import arrange, compile_c, import_python
from tests.support.flows import emitted, flow

RNG = np.random.default_rng(1)
BODY_TURN, SPACE_TURN = sampling.random_rotation(RNG), sampling.random_rotation(RNG)


def gap(found, expected):
    """The largest difference of the attitudes, and that of the velocities over their size."""
    differences = np.abs(found - expected)
    return np.max(differences[:, :9]), np.max(differences[:, 9:]) / np.max(np.abs(expected[:, 9:]))


def constants(code, body):
    """The constants of so3, a module, for a body of points."""
    return code.constants(arrange(code, sampling.parameters("so3", body)))


# ---------------------------------------------------------------- the free asymmetric top

MOMENTS = (1.25, 2.0, 2.75)
INERTIA = BODY_TURN @ np.diag(MOMENTS) @ BODY_TURN.T
REGIMES = {"about the largest moment": 2.2, "about the smallest moment": 1.75}


def free_state(t, momentum):
    """The state of so3 with energy 1, its body and its space turned at will."""
    A, W = free_top.motion(t, MOMENTS, 1.0, momentum)
    return np.concatenate([(SPACE_TURN @ A @ BODY_TURN.T).ravel(), BODY_TURN @ W])


def attitude(q):
    """The rotation of a quaternion, scalar first."""
    j = sampling.cross_matrix(q[1:])
    return np.eye(3) + 2 * (q[0] * j + j @ j) / (q @ q)


def by_python(body, x, times, folder):
    code = import_python("so3")
    return flow(code, constants(code, body), x, times)


def by_c(body, x, times, folder):
    code = compile_c("cc", "so3", folder)
    p = arrange(import_python("so3"), sampling.parameters("so3", body))
    return flow(code, code.constants(p)[1], x, times)


def by_quaternion(body, x, times, folder):
    code, q = emitted("so3", attitude="quaternion"), sampling.quaternion(x[:9].reshape(3, 3))
    states = flow(code, constants(code, body), [*q, *x[9:]], times)
    return np.array([np.append(attitude(y[:4]), y[4:]) for y in states])


def by_principal_frame(body, x, times, folder):
    code = emitted("so3", frame="principal")
    k = constants(code, body)
    states = flow(code, k, code.into_frame(x, k), times)
    return np.array([code.out_of_frame(y, k) for y in states])


FORMS = [by_python, by_c, by_quaternion, by_principal_frame]


@pytest.mark.parametrize("form", FORMS, ids=lambda f: f.__name__[3:])
@pytest.mark.parametrize("regime", REGIMES)
def test_free_asymmetric_top(regime, form, tmp_path):
    """Angular velocity by Jacobi's functions and attitude by Legendre's Pi, over 25 periods."""
    times = np.linspace(0, 25.25, 26) * free_top.period(MOMENTS, 1.0, REGIMES[regime])
    expected = np.array([free_state(t, REGIMES[regime]) for t in times])
    found = form(sampling.solid_body(INERTIA), expected[0], times, tmp_path)
    # 1.5e-12 and 3e-13 are found: rounding of some 5000 steps, which grows with the time
    assert max(gap(found, expected)) < 1e-11


def test_free_top_on_the_separatrix():
    """M^2 = 2 E I_2: from the middle axis, once round, to the opposite of the middle axis."""
    times = np.linspace(-12, 12, 13)
    expected = np.array([free_state(t, 2.0) for t in times])
    assert gap(expected[:1], expected[-1:])[1] > 1.9
    found = by_python(sampling.solid_body(INERTIA), expected[0], times, None)
    # rounding at the start grows by exp(24 p), p = 0.42, to 2e4 times what it was
    assert max(gap(found, expected)) < 1e-11


@pytest.mark.parametrize("regime", REGIMES)
def test_precession_is_the_integral_of_its_rate(regime):
    """Legendre's Pi against a quadrature of M (2 E - I_c W_c^2) / (M^2 - I_c^2 W_c^2)."""
    M, c = REGIMES[regime], 2 if REGIMES[regime] > 2 else 0
    size = free_top.motion(0.0, MOMENTS, 1.0, M)[1][c]
    a, b, third = MOMENTS[2 - c], MOMENTS[1], MOMENTS[c]
    p = 4 * float(mp.ellipk(m := (b - a) * (2 * third - M**2) / ((third - b) * (M**2 - 2 * a))))
    p /= free_top.period(MOMENTS, 1.0, M)

    def rate(t):
        turning = third * (size * mp.ellipfun("dn", p * t, m=m)) ** 2
        return M * (2 - turning) / (M**2 - third * turning)

    for t in (1.0, -3.0, 30.0):
        axis = free_top.motion(t, MOMENTS, 1.0, M)[0][:, c]
        angle = mp.quad(rate, mp.linspace(0, t, 2 + int(abs(t))))
        expected = np.array([np.cos(float(angle)), np.sin(float(angle))])
        # the angle, up to 30, has an absolute rounding of some 1e-14
        assert np.max(np.abs(axis[:2] / np.hypot(*axis[:2]) - expected)) < 3e-14


# ---------------------------------------------------------------- the Lagrange top

TOP = (1.3, 0.5), 4.0
RELEASED = {
    "waves": (0.5, 0.2, 20.0),
    "cusps": (0.5, 0.0, 20.0),
    "loops": (0.5, -2.0, 20.0),
    "fast loops": (0.5, 3.0, 20.0),
    "falls and rises": (0.9, 0.1, 3.0),
    "hangs": (-0.2, 1.5, 3.0),
}


def axial_top(moments, weight):
    """A body of mass 1 with these moments about its fixed point, in gravity."""
    first, third = moments
    height = weight / 9.81
    central = np.diag([first - height**2, first - height**2, third])
    return sampling.solid_body(central, 1.0, (0, 0, height), (0, 0, -9.81))


@pytest.mark.parametrize("kind", RELEASED)
def test_nutation_of_the_lagrange_top(kind):
    """All three angles and their rates, over 10 s: 20 to 150 nutations."""
    code, times = import_python("so3"), np.linspace(0, 10, 21)
    expected = np.array([lagrange_top.motion(t, *TOP, *RELEASED[kind]) for t in times])
    found = flow(code, constants(code, axial_top(*TOP)), expected[0], times)
    # 2e-13 is found
    assert max(gap(found, expected)) < 3e-12


@pytest.mark.parametrize(
    ("kind", "least"), [("waves", 0.2), ("cusps", 0.0), ("loops", -2.0), ("fast loops", -4.8)]
)
def test_the_kinds_of_nutation(kind, least):
    """The rate of phi keeps its sign, or vanishes on the upper ring, or changes sign there."""
    states = [lagrange_top.motion(t, *TOP, *RELEASED[kind]) for t in np.linspace(0, 0.82, 13)]
    rates = [(x[6:9] @ x[9:] - x[8] * x[11]) / (1 - x[8] ** 2) for x in states]
    assert abs(min(rates) - least) < 0.05
    assert max(rates) > 0.4


@pytest.mark.parametrize("tilt", [0.8, 2.2], ids=["stands", "hangs"])
@pytest.mark.parametrize("which", ["slow", "fast"])
def test_steady_precession(which, tilt):
    """Both roots of the quadratic, for tops that stand and that hang, ten turns of each."""
    code, spin = import_python("so3"), 12.0
    slow, fast = lagrange_top.steady_rates(*TOP, np.cos(tilt), spin)
    rate = slow if which == "slow" else fast
    times = np.linspace(0, 20 * np.pi / abs(rate), 11)
    own = spin - rate * np.cos(tilt)
    expected = np.array([sampling.precession(t, rate, tilt, own) for t in times])
    found = flow(code, constants(code, axial_top(*TOP)), expected[0], times)
    # 6e-12 is found for the slow ones, which meanwhile spin 160 to 190 times
    assert max(gap(found, expected)) < 4e-11


def test_a_cone_on_its_apex():
    """The ready-made top: the moments of a cone about its apex are those of the tables."""
    code, (rho, R, h, g) = emitted("top"), (800.0, 0.03, 0.05, 9.81)
    m = rho * np.pi * R**2 * h / 3
    moments = m * (3 / 20 * R**2 + 3 / 5 * h**2), 3 / 10 * m * R**2
    given = moments, m * g * 3 / 4 * h, 0.8, 2.0, 150.0
    times = np.linspace(0, 1, 11)
    expected = np.array([lagrange_top.motion(t, *given) for t in times])
    k = code.constants({"rho": rho, "R": R, "h": h, "g": g})
    # 2e-13 is found
    assert max(gap(flow(code, k, expected[0], times), expected)) < 3e-12
