"""Mass that flows: beside the balances of momentum of a control volume, and known solutions."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.check.checker import Checker
from derive.language.tree import add
from derive.problem.toml import doubts, problem_of
from derive.schema.kind import Parameter
from tests.oracles import relative_error
from tests.oracles.control_volume import Leaking
from tests.support.library import ONE_BUILD, arrange, emission, library, module_of
from tests.support.needs import present
from tests.support.walks import own_verdicts, stands

G, RATE, SPEED = 9.81, 0.3, 4.0
LOST = "m0 - b*t*(1 + t/9)"
ROCKET = {
    "name": "rocket",
    "group": "SE(3)",
    "parameters": {"m0": 10.0, "b": RATE, "u": SPEED},
    "point": [
        {"mass": LOST, "at": [0.1, 0.2, 1]},
        {"mass": "2 + sin(t)/4", "at": [1, 0, 0]},
        {"mass": 3, "at": [0, 1, -1]},
        {"mass": 1, "at": [-1, 0.5, -0.3]},
    ],
    "potential": [{"kind": "gravity", "g": [0, 0, -G]}],
    "flow": [
        {
            "name": "jet",
            "at": [0.3, -0.2, -2],
            "rate": "-b*(1 + 2*t/9)",
            "velocity": [0.5, "1 + t", "-u"],
        },
        {"on": 3, "rate": "cos(t)/4", "velocity": ["t", 0, "u"]},
    ],
}
PLACES = np.array([[0.1, 0.2, 1], [1, 0, 0], [0, 1, -1], [-1, 0.5, -0.3]])
EXITS = np.array([[0.3, -0.2, -2], [0, 1, -1]])


def masses(t):
    return np.array([10 - RATE * t * (1 + t / 9), 2 + np.sin(t) / 4, 3 + 0 * t, 1 + 0 * t])


def mass_rates(t):
    return np.array([-RATE * (1 + 2 * t / 9), np.cos(t) / 4, 0 * t, 0 * t])


def rates(t):
    return mass_rates(t)[:2]


def velocities(t):
    return np.array([[0.5, 1 + t, -SPEED], [t, 0, SPEED]])


def on(what, rocket=ROCKET):
    """A rocket on a group of R³ or of the plane, where the last two coordinates are its own; or the
    same body by its moments, expressions of the time."""
    if what != "moments":
        n = int(what[-2])

        def cut(tables):
            return [{k: x[-n:] if isinstance(x, list) else x for k, x in y.items()} for y in tables]

        tables = {key: cut(rocket[key]) for key in ("point", "flow", "potential")}
        return rocket | tables | {"group": what}
    told = [f"({x['mass']})" for x in rocket["point"]]

    def summed(weights):
        return " + ".join(f"{m}*({w})" for m, w in zip(told, weights, strict=True))

    J = [[summed(PLACES[:, i] * PLACES[:, j]) for j in range(3)] for i in range(3)]
    given = {"m": " + ".join(told), "c": [summed(PLACES[:, i]) for i in range(3)], "J": J}
    first, other = rocket["flow"]
    flows = [{"at": rocket["point"][0]["at"]} | first, other | {"at": [0, 1, -1]}]
    flows = [{k: y for k, y in x.items() if k != "on"} for x in flows]
    rest = {k: v for k, v in rocket.items() if k not in ("point", "flow")}
    return rest | {"body": {"given": given}, "flow": flows}


LEAKING = Leaking(PLACES, EXITS, masses, mass_rates, rates, velocities)


@cache
def made(what):
    problem = problem_of(on(what))
    return problem, module_of(problem), library("c", problem) if present("cc") else None


@pytest.mark.parametrize("what", ["SE(3)", "SO(3)", "SE(2)", "SO(2)", "moments"])
def test_momentum_is_lost_with_what_leaves_alone(what):
    """Of a body about a fixed point the reaction there is not known, and the moment alone told."""
    _, m, c = made(what)
    n, d = len(m.BASIS[0]) - ("SO" not in what), len(m.BASIS)
    rng, p = np.random.default_rng(3), arrange(m, {"m0": 10, "b": RATE, "u": SPEED})
    k = m.constants(p)
    for _ in range(5):
        t, velocity = rng.uniform(0, 3), rng.normal(size=d)
        A = np.linalg.qr(rng.normal(size=(n, n)))[0]
        A[:, 0] *= np.linalg.det(A)
        x = np.concatenate([A.ravel(), rng.normal(size=n * ("SO" not in what)), velocity])
        found = m.rhs(t, x, k)
        if c is not None:
            assert relative_error(c.rhs(t, x, c.constants(p)[1]), found) < 1e-12
        left, size = LEAKING.unbalanced_of(t, A, velocity, found[-d:])
        assert np.abs(left).max() < 1e-12 * size


@pytest.mark.parametrize("what", ["SE(3)", "SO(3)", "SE(2)", "SO(2)", "moments"])
def test_the_record_holds(what):
    problem, *_ = made(what)
    record = derive.derive(problem).record
    assert all(v.holds for v in own_verdicts(record))
    labels = {s.label.removeprefix("rocket.") for s in record.steps}
    assert "input" in labels
    assert labels.isdisjoint({"conserved", "by_momenta", "poisson_tensor"})


@pytest.mark.parametrize("group", ["SE(3)", "SO(3)"])
def test_a_motion_ends_before_its_metric_is_singular(group):
    """I_33 = J_11 + J_22 is 0 at t = 15, where there is a mass yet."""
    J = [["3 - t/5", 0, 0], [0, "3 - t/5", 0], [0, 0, "4 - t/10"]]
    body = {"given": {"m": "20 - t/2", "c": [0, 0, 0], "J": J}}
    flow = [{"at": [0, 0, -1], "rate": "-1/2", "velocity": [0, 0, -2]}]
    data = {"name": "test", "group": group, "body": body, "flow": flow}
    assert derive.derive(problem_of(data)).simulate(14.9)["t"][-1] == 14.9
    told = "the mass matrix is singular or not positive at t = 15, and the motion is to go on to"
    with pytest.raises(ValueError, match=told):
        derive.derive(problem_of(data)).simulate(20.0)
    ended = data | {"event": [{"name": "out", "when": "t - 14", "terminal": True}]}
    run = derive.derive(problem_of(ended)).simulate(20.0)
    assert abs(run["t"][-1] - 14) < 1e-9


def test_a_motion_ends_before_its_mass_is_used_up():
    told = "the mass 9 − t of a point is used up at t = 9, and the motion is to go on to t = 12"
    masses = [{"mass": "9 - t", "at": [1, 0]}, {"mass": 2, "at": [0, 1]}]
    flow = [{"on": 1, "rate": -1, "velocity": [1, 0]}]
    data = {"name": "test", "group": "SE(2)", "point": masses, "flow": flow}
    assert derive.derive(problem_of(data)).simulate(8.9)["t"][-1] == 8.9
    with pytest.raises(ValueError, match=told):
        derive.derive(problem_of(data)).simulate(12.0)
    late, early = (
        derive.derive(problem_of(data | {"event": [{"name": "out", "when": x, "terminal": True}]}))
        for x in ("t - 10", "t - 5")
    )
    with pytest.raises(ValueError, match=told):
        late.simulate(12.0)
    assert abs(early.simulate(12.0)["t"][-1] - 5) < 1e-9


BURNING = {
    "name": "burning",
    "parameters": {"a": 9.0, "b": RATE, "J11": 3.0, "J22": 4.0, "J12": 0.5, "c1": 0.4, "c2": 0.3},
    "flow": [{"at": [0.3, -0.2], "rate": "-b", "velocity": [1, -SPEED]}],
}


def burning(what):
    """A body by its moments, of which the first two axes have letters; of R(2), and of a product,
    three points, of which all masses but the first are in the last block."""
    n, (flow,) = int(what[-2]), BURNING["flow"]
    more = [0] * (n - 2)
    J = [["J11 + t", "J12", *more], ["J12", "J22 - t", *more], *[[0, 0, 5]] * (n - 2)]
    given = {"m": "a - b*t", "c": ["c1*(1 + t)", "c2 - t/9", *more], "J": J}
    body = {"body": {"given": given}}
    flow = {k: [*x, *more] if isinstance(x, list) else x for k, x in flow.items()}
    data = BURNING | {"group": what, "flow": [flow]}
    if what[-4] == "R" or "x" in what:
        masses = zip(("a - b*t", "c1", "c2"), ([1, 1], [1, 0], [0, 1]), strict=True)
        points = [{"mass": m, "at": at, "block": 2} for m, at in masses]
        points[0]["block"] = 1
        one = [{k: v for k, v in x.items() if k != "block"} for x in points]
        body = {"point": points if "x" in what else one}
        data |= {"parameters": {k: v for k, v in BURNING["parameters"].items() if k[0] != "J"}}
    return data | body


def least(what, p):
    """The least eigenvalue at t = 0 of twice the kinetic energy as a form of (ω, v), by hand."""
    m, c = p["a"], np.array([p["c1"], p["c2"], 0.0])
    if what == "R(2)":
        return m + c.sum()
    J = np.diag([p["J11"], p["J22"], 5.0 * (what[-2] == "3")])
    J[0, 1] = J[1, 0] = p["J12"]
    first = np.inf
    if "x" in what:
        m, J, first = c.sum(), np.diag(c), 2 * p["a"]
    shift = np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])
    whole = np.block([[np.trace(J) * np.eye(3) - J, shift], [shift.T, m * np.eye(3)]])
    kept = [0, 1, 2, 3, 4, 5] if what[-2] == "3" else [2, 3, 4]
    kept = [k for k in kept if k < 3] if what[:2] + what[-5:-3] == "SOSO" else kept
    return min(first, np.linalg.eigvalsh(whole[np.ix_(kept, kept)]).min())


@pytest.mark.parametrize("what", ["SE(3)", "SO(3)", "SE(2)", "SO(2)", "R(2)", "SO(2) x SE(2)"])
def test_constants_refuses_a_metric_that_is_not_positive_at_first(what):
    """And no other, in every draw; which is refused in each language."""
    problem, rng = problem_of(burning(what)), np.random.default_rng(11)
    builds = ["python", *(ONE_BUILD[y] for y in ("c", "javascript", "rust", "julia"))]
    codes = [library(x, problem) for x in builds if x == "python" or present("cc")]
    seen = set()
    for k in range(30):
        p = {x: rng.normal() * (3 if x[0] != "c" else 1) + 2 for x in module_of(problem).PARAMETERS}
        drawn = {**dict.fromkeys(BURNING["parameters"], 1.0), **p}
        expected = least(what, drawn)
        if abs(expected) < 1e-6:
            continue
        for code in codes if k < 8 else codes[:1]:
            assert (code.constants([*p.values()])[0] in (0, None)) == (expected > 0), (p, code)
        seen.add(expected > 0)
    assert seen == {True, False}


def test_it_is_told_when_a_metric_is_tested():
    """At t = 0: the engine doubts it, as that of a body that loses nothing; in code and a motion it
    is refused."""
    problem = problem_of(burning("SE(3)"))
    bad = replace(problem, parameters={**problem.parameters, "a": Parameter(default=0.01)})
    for given, what in (({}, bad), ({"a": 0.01}, problem)):
        told = [*doubts(what, given)]
        assert len(told) == 1
        assert "no masses have these moments at t = 0: J − c c̄/m must be positive" in told[0]
    assert not [*doubts(problem, {})]
    with pytest.raises(ValueError, match="matrix is singular or not positive at t = 0"):
        derive.derive(problem).simulate(0.1, start={"a": 0.01})
    header = emission(problem, ("c",))[1]["burning.h"]
    assert "a mass matrix that is singular or not positive at t = 0" in header


def test_moments_of_numbers_that_no_masses_have_at_first_are_refused():
    J = [["1", 0, 0], [0, "1 + t", 0], [0, 0, "-3"]]
    body = {"given": {"m": "2 - t", "c": [0, 0, 0], "J": J}}
    flow = [{"at": [0, 0, 0], "rate": -1, "velocity": [0, 0, 0]}]
    with pytest.raises(ValueError, match="no masses have these moments at t = 0"):
        problem_of({"name": "test", "group": "SO(3)", "body": body, "flow": flow})


def test_a_record_with_another_flow_is_seen():
    record = derive.derive(made("SE(3)")[0]).record
    for key, other in (("rate", ["mul", -2, ["par", "b"]]), ("velocity", [0, 0, ["par", "u"]])):
        told = [dict(x) for x in record.problem["flows"]]
        told[0][key] = other
        forged = replace(record, problem={**record.problem, "flows": told})
        assert not stands(forged, "input")


def test_the_linearised_equations_are_the_derivatives():
    """By complex steps, along the group and along the velocity."""
    problem, *_ = made("SE(3)")
    m = module_of(problem, jacobian=("state",))
    k = m.constants(arrange(m, {"m0": 10, "b": RATE, "u": SPEED}))
    rng, step = np.random.default_rng(4), 1e-30
    A = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    T, velocity, t = rng.normal(size=3), rng.normal(size=6), 0.7
    *_, J = m.jacobian(t, np.concatenate([A.ravel(), T, velocity]), k)
    g = np.block([[A, T[:, None]], [np.zeros((1, 3)), np.eye(1)]]).astype(complex)
    for a, E in enumerate(np.array(m.BASIS, float)):
        moved = g + 1j * step * g @ E
        x = np.concatenate([moved[:3, :3].ravel(), moved[:3, 3], velocity])
        slope = m.rhs(t, x, k)[-6:].imag / step
        assert np.abs(J[6:, a] - slope).max() < 1e-11 * max(1, np.abs(slope).max())
        v = velocity + 1j * step * np.eye(6)[a]
        slope = m.rhs(t, np.concatenate([A.ravel(), T, v]), k)[-6:].imag / step
        assert np.abs(J[6:, 6 + a] - slope).max() < 1e-11 * max(1, np.abs(slope).max())


def test_tsiolkovsky():
    """Along its axis a rocket gains u log(m₀/m) − gt."""
    data = ROCKET | {
        "point": [{"mass": m, "at": at} for m, at in (("m0 - b*t", [0, 0, 0]), (1, [1, 0, 0]))],
        "flow": [{"at": [0, 0, -2], "rate": "-b", "velocity": [0, 0, "-u"]}],
    }
    data["point"] += [{"mass": 1, "at": [-1, 0, 0]}, {"mass": 1, "at": [0, 0, 1]}]
    m = module_of(problem_of(data))
    k = m.constants(arrange(m, {"m0": 10, "b": RATE, "u": SPEED}))
    start = np.concatenate([np.eye(3).ravel(), np.zeros(9)])
    run = solve_ivp(m.rhs, (0, 20), start, args=(k,), rtol=1e-11, atol=1e-11)
    expected = SPEED * np.log(13 / (13 - 20 * RATE)) - G * 20
    assert run.y[-1, -1] == pytest.approx(expected, rel=1e-9)


def test_jet_damping():
    """Of a body that turns about a fixed point, whose fuel at the distance r leaves at l: ω falls
    as I to the power (l² − r²)/r² (Thomson)."""
    r, outlet, b = 0.6, 1.5, 0.2
    body = derive.Points(("5 - b*t", ["r", 0]), (2, [0, 1]))
    flow = derive.Flow(["l", 0], "-b", [3, 0])
    problem = derive.Problem(
        "wheel", derive.SO(2), body, [flow], parameters={"b": b, "r": r, "l": outlet}
    )
    m = module_of(problem)
    k = m.constants(arrange(m, {"b": b, "r": r, "l": outlet}))
    run = solve_ivp(m.rhs, (0, 10), [1, 0, 0, 1, 2], args=(k,), rtol=1e-11, atol=1e-12)
    left = (2 + (5 - 10 * b) * r**2) / (2 + 5 * r**2)
    assert run.y[-1, -1] == pytest.approx(2 * left ** ((outlet**2 - r**2) / r**2), rel=1e-9)


def test_mass_that_moves_inside_keeps_the_angular_momentum():
    body = derive.Points(("2 - sin(t)", [2, 0]), ("1 + sin(t)", [1, 0]), (1, [0, 1]))
    problem = derive.Problem("wheel", derive.SO(2), body, [derive.Flow([0, 0], 0, [0, 0])])
    m = module_of(problem)
    run = solve_ivp(m.rhs, (0, 3), [1, 0, 0, 1, 2], args=(m.constants([]),), rtol=1e-11)
    inertia = [(2 - s) * 4 + 1 + s + 1 for s in (0, np.sin(3))]
    assert inertia[1] * run.y[-1, -1] == pytest.approx(inertia[0] * 2, rel=1e-9)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_a_point_that_loses_mass_in_a_flat_space(n):
    """m v̇ = F + ṁ u − ṗ, with p of what flows from the point to the place where it leaves."""
    u, g, there = [-3.0, 0.5, 2.0][:n], [0.2, -9.0, 1.0][:n], [0.3, -0.2, 0.7][:n]
    data = {
        "name": "shot",
        "group": f"R({n})",
        "point": [{"mass": "8 - t - t^2/2", "at": [1, 2, 3][:n]}, {"mass": 2, "at": [1, 0, 1][:n]}],
        "potential": [{"kind": "gravity", "g": g}],
        "flow": [{"at": there, "rate": "-1 - t", "velocity": u}],
    }
    problem = problem_of(data)
    assert all(v.holds for v in own_verdicts(derive.derive(problem).record))
    m, t, x = module_of(problem), 0.7, np.random.default_rng(n).normal(size=2 * n)
    found = np.asarray(m.rhs(t, x, m.constants([])))
    # ċ = ṁ r of the point, p = ṁ (r − r′), and the rate of ṁ is −1
    slack = np.array([1, 2, 3][:n]) - there
    known = np.array(g) + (-(1 + t) * np.array(u) + slack) / (10 - t - t * t / 2)
    assert np.allclose(found, [*x[n:], *known], rtol=0, atol=1e-13)


# -- power ---------------------------------------------------------------------------------------


def read_by_name(what):
    """The problem with the powers of all that acts as outputs, by its emitted Python."""
    told = [{"name": "whole", "kind": "power"}, {"name": "jet_s", "kind": "power", "of": "jet"}]
    return module_of(problem_of(on(what) | {"output": told}))


@pytest.mark.parametrize("what", ["SE(3)", "SO(3)", "SE(2)", "SO(2)", "moments"])
def test_what_acts_changes_the_energy_at_one_time(what):
    """Σ P is the derivative of the energy by the state, along the motion, the masses held."""
    m, rng = read_by_name(what), np.random.default_rng(5)
    k = m.constants(arrange(m, {"m0": 10, "b": RATE, "u": SPEED}))
    n = 3 if "3" in what or what == "moments" else 2
    A = np.linalg.qr(rng.normal(size=(n, n)))[0]
    A[:, 0] *= np.linalg.det(A)
    x = np.concatenate([A.ravel(), rng.normal(size=len(m.STATE) - n * n)])
    t, h = 1.3, 1e-5
    xdot = m.rhs(t, x, k, ())
    ends = [m.energy(t, x + s * h * xdot, k) for s in (-2, -1, 1, 2)]
    wanted = (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * h)
    assert m.outputs(t, x, k, ())[0] == pytest.approx(wanted, rel=1e-8)
    spin, speed = x[n * n + n * ("SE" in what or what == "moments") :], np.zeros(n)
    if "SE" in what or what == "moments":
        spin, speed = spin[:-n], spin[-n:]
    turned = spin if n == 3 else np.array([spin[0], 0, 0])
    at, push = EXITS[0], rates(t)[0] * velocities(t)[0]
    cut = slice(3 - n, 3)
    velocity = np.cross(turned, at * ([1] * 3 if n == 3 else [0, 1, 1]))[cut] + speed
    assert m.outputs(t, x, k, ())[1] == pytest.approx(push[cut] @ velocity, rel=1e-10)


@pytest.mark.parametrize("what", ["SE(3)", "SO(2)", "moments"])
def test_a_forged_rate_of_the_energy_is_refused(what):
    problem = problem_of(on(what))
    record = derive.derive(problem).record
    step = next(s for s in record.steps if s.label == "rocket.power")
    checker = Checker(record.problem, 7)
    assert checker.check(step).holds
    for k, e in enumerate(step.equations):
        terms = e.rhs[1:] if isinstance(e.rhs, tuple) and e.rhs[0] == "add" else (e.rhs,)
        for j in range(len(terms)):
            less = add(*terms[:j], *terms[j + 1 :])
            forged = (*step.equations[:k], replace(e, rhs=less), *step.equations[k + 1 :])
            assert not checker.check(replace(step, equations=forged)).holds, (k, j)


def test_of_one_flow_alone_the_power_is_told_apart():
    """Mass that leaves where it is: nothing flows inside, and ḣ has what its moments make, too."""
    tank = {"mass": "m0 - b*t", "at": [0, 0, 1]}
    more = [{"mass": 2, "at": at} for at in ([1, 0, 0], [0, 1, 0], [-1, -1, 0])]
    data = {
        "name": "tank",
        "group": "SE(3)",
        "parameters": {"m0": 10.0, "b": RATE},
        "point": [tank, *more],
        "flow": [{"name": "jet", "on": 1, "rate": "-b", "velocity": [0, 0, -3]}],
        "output": [
            {"name": "whole", "kind": "power"},
            {"name": "own", "kind": "power", "of": "jet"},
        ],
    }
    problem = problem_of(data)
    record = derive.derive(problem).record
    assert all(v.holds for v in own_verdicts(record))
    m, rng = module_of(problem), np.random.default_rng(8)
    x = np.concatenate([np.eye(3).ravel(), rng.normal(size=9)])
    spin, speed = x[12:15], x[15:]
    push = 3 * RATE * (np.cross(spin, [0, 0, 1]) + speed)[2]
    found = m.outputs(0.4, x, m.constants(arrange(m, data["parameters"])), ())
    assert found == pytest.approx([push, push], rel=1e-12)
