"""Reductions against oracles: Euler's angles, the least energy on a level, trajectories."""

import operator
from functools import cache, reduce

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.python.derived import derive
from tests.oracles import routh

RNG = np.random.default_rng(11)
FIRST = RNG.bit_generator.state


@pytest.fixture(autouse=True)
def afresh():
    """The same numbers whatever ran before: a start by chance may pass where sin θ is near 0."""
    RNG.bit_generator.state = FIRST


TURN = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])
DEFAULTS = {
    "lagrange_top": {"I1": 1.0, "I3": 0.4, "mgl": 1.5},
    "gyrostat": {"I1": 1.0, "I2": 1.6, "I3": 2.2, "h1": 0.3, "h3": 0.8, "mgl": 1.5},
    "charged_body": {"I1": 1.0, "I2": 1.4, "I3": 1.9, "K1": 0.5, "K2": 0.2, "K3": 0.6, "b": 0.7},
    "spherical_pendulum": {"m": 1.0, "l": 0.8, "g": 9.81},
}


@cache
def found(name):
    return derive(name).reduction()


def value(t, **known):
    """The value of a tree of numbers."""
    if isinstance(t, str):
        return known[t]
    if not isinstance(t, tuple):
        return float(t)
    if t[0] == "par":
        return known["p"][t[1]]
    if t[0] == "entry":
        return known[t[1]][tuple(i - 1 for i in t[2:])]
    if t[0] in ("at", "call"):
        return known["𝒥" if t[0] == "at" else "𝒜"][(t if t[0] == "at" else t[1])[2] - 1]
    if t[0] == "pow":
        return value(t[1], **known) ** t[2]
    a = [value(x, **known) for x in t[1:]]
    if t[0] == "div":
        return a[0] / a[1]
    return reduce({"add": operator.add, "mul": operator.mul}[t[0]], a)


def rotation():
    q, _ = np.linalg.qr(RNG.normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def test_lagranges_top_in_eulers_angles():
    """The potential and the cubic are those that SymPy finds from the angles."""
    r = found("lagrange_top")
    for u, one, two, h in RNG.uniform(-0.9, 0.9, (20, 4)):
        p = dict(zip(("I1", "I3", "mgl"), RNG.uniform(0.5, 2, 3), strict=True))
        A = np.zeros((3, 3))
        A[2, 2] = u
        known = {"p": p, "A": A, "𝒥": (one, two), "h̃": h}
        V, cubic = routh.lagrange_top(u, one, two, *p.values(), h)
        assert value(r.effective_potential.rhs, **known) == pytest.approx(V, rel=1e-11)
        across, own = p["I1"], p["I3"]  # the vertical has the share u of the axis
        rows = [[value(x, **known) for x in row[1:]] for row in r.locked_inertia.rhs[1:]]
        wanted = [[across * (1 - u**2) + own * u**2, own * u], [own * u, own]]
        assert np.array(rows, float) == pytest.approx(np.array(wanted), rel=1e-12)
        assert value(r.quadrature.rhs, **known) == pytest.approx(cubic, rel=1e-10, abs=1e-11)


def bodies(name, g, p):
    """M, b, U and the fields of a problem, typed once more."""
    above = g[2]
    fields = [routh.turned(g, TURN)]
    if name == "lagrange_top":
        spin = np.array([0, 0, 1.0])
        return (
            np.diag([p["I1"], p["I1"], p["I3"]]),
            np.zeros(3),
            p["mgl"] * above[2],
            [
                *fields,
                spin,
            ],
        )
    if name == "gyrostat":
        b = np.array([p["h1"], 0, p["h3"]])
        return np.diag([p["I1"], p["I2"], p["I3"]]), b, p["mgl"] * above[2], fields
    if name == "charged_body":
        b = p["b"] / 2 * np.array([p["K1"], p["K2"], p["K3"]]) * above
        return np.diag([p["I1"], p["I2"], p["I3"]]), b, 0.0, fields
    inertia = p["m"] * p["l"] ** 2
    U = p["m"] * p["g"] * p["l"] * above[2]
    return np.diag([inertia, inertia, 0]), np.zeros(3), U, fields


@pytest.mark.parametrize("name", DEFAULTS)
def test_the_effective_potential_is_the_least_energy_on_a_level(name):
    r, p = found(name), DEFAULTS[name]
    for _ in range(10):
        g, mu = rotation(), RNG.normal(size=len(r.kinds))
        body = bodies(name, g, p)
        wanted = routh.least_energy(*body, mu)
        mine = value(r.effective_potential.rhs, p=p, A=g, **{"𝒥": mu})
        assert mine == pytest.approx(wanted, rel=1e-9)


def motion(name, t):
    """A trajectory of the emitted code at these times: its attitudes, ζ and its energy."""
    d, space = derive(name), {}
    exec(d.emit(languages=("python",))[f"{name}.py"], space)
    k = space["constants"](space["DEFAULTS"])
    start = np.concatenate([rotation().ravel(), RNG.normal(size=len(space["STATE"]) - 9)])
    given = {"t_eval": t, "method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    x = solve_ivp(lambda t, x: space["rhs"](t, x, k), (t[0], t[-1]), start, **given).y.T
    return x[:, :9].reshape(-1, 3, 3), x[:, 9:], space["energy"](t, x, k)


def momenta(name, g, z, p):
    """Those of the fields, by the metric typed above."""
    M, b, _, fields = bodies(name, g, p)
    z = np.append(z, 0) if len(z) == 2 else z
    return np.array([(M @ z + b) @ eta for eta in fields])


@pytest.mark.parametrize("name", DEFAULTS)
def test_along_trajectories(name):
    """The momenta are kept, and the horizontal kinetic energy with the potential is the energy."""
    r, p = found(name), DEFAULTS[name]
    attitudes, speeds, energy = motion(name, np.linspace(0, 10, 60))
    own = [momenta(name, g, z, p) for g, z in zip(attitudes, speeds, strict=True)]
    assert np.ptp(own, axis=0).max() < 1e-9
    steps = {e.lhs: e.rhs for x in ("connection", "effective") for e in r[x].equations}
    kinetic = next(e.rhs for e in r["effective"].equations if e.lhs == "h̃")
    for g, z, mu, h in zip(attitudes, speeds, own, energy, strict=True):
        z = np.append(z, 0) if len(z) == 2 else z
        known = {"p": p, "A": g, "𝒥": mu, "ζ": z, "𝒜": np.zeros(len(mu))}
        told = [k for k in steps if isinstance(k, tuple) and k[0] == "call"]
        for k in told:
            known["𝒜"][k[1][2] - 1] = value(steps[k], **known)
        flat = np.zeros(3)
        for k in steps:
            if isinstance(k, tuple) and k[0] == "entry":
                flat[k[2] - 1] = value(steps[k], **known)
        V = value(r.effective_potential.rhs, **known)
        total = value(kinetic, **known, **{"ζ_h": flat, "𝒱": V})
        assert total == pytest.approx(h, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", ["lagrange_top", "spherical_pendulum"])
def test_the_reduced_equation_moves_as_the_full_one(name):
    """u of ü = ½ df/du, integrated alone, is A₃₃ of the full motion."""
    r, p = found(name), DEFAULTS[name]
    t = np.linspace(0, 10, 200)
    attitudes, speeds, energy = motion(name, t)
    mu = momenta(name, attitudes[0], speeds[0], p)

    def f(u):
        A = np.zeros((3, 3))
        A[2, 2] = u
        return value(r.quadrature.rhs, p=p, A=A, **{"𝒥": mu, "h̃": energy[0]})

    nodes = np.linspace(-1, 1, 7)
    slope = np.polyder(np.polyfit(nodes, [f(u) for u in nodes], 3))
    u0, z = attitudes[0, 2], np.append(speeds[0], 0)[:3]
    rate = u0[0] * z[1] - u0[1] * z[0]
    assert rate**2 == pytest.approx(f(u0[2]), rel=1e-9)
    given = {"t_eval": t, "method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    alone = solve_ivp(
        lambda _, y: [y[1], np.polyval(slope, y[0]) / 2], (0, 10), [u0[2], rate], **given
    )
    assert np.abs(alone.y[0] - attitudes[:, 2, 2]).max() < 1e-7
