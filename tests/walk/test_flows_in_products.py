"""Mass that flows in bodies of a product: each beside its own balances, and known motions."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.check.checker import Checker
from derive.language.tree import add
from derive.problem.toml import problem_of
from tests.oracles import relative_error
from tests.oracles.control_volume import Leaking
from tests.support.library import ONE_BUILD, arrange, library, module_of
from tests.support.needs import needs
from tests.support.walks import own_verdicts, stands
from tests.walk.test_flows import ROCKET

B, U, STIFF, LENGTH = 0.3, 4.0, 7.0, 0.6
NUMBERS = {"b": B, "u": U, "k": STIFF}
PAIR = {
    "name": "pair",
    "group": "SE(3) x SE(2)",
    "parameters": {**NUMBERS, "fuel": 6.0},
    "input": [{"name": "throttle", "kind": "scalar"}],
    "point": [
        {"mass": "10 - b*t*(1 + t/9)", "at": [0.1, 0.2, 1]},
        {"mass": "2 + sin(t)/4", "at": [1, 0, 0]},
        {"mass": 3, "at": [0, 1, -1]},
        {"mass": 1, "at": [-1, 0.5, -0.3]},
        {"mass": "fuel", "at": [0.4, 0.3], "block": 2},
        {"mass": "3 + sin(2*t)", "at": [-0.7, 1], "block": 2},
        {"mass": 2, "at": [-0.2, -1], "block": 2},
    ],
    "flow": [
        *ROCKET["flow"],
        {
            "name": "valve",
            "on": 5,
            "mass": "fuel",
            "rate": "-b*throttle",
            "velocity": ["throttle", "-u"],
        },
        {"at": [0.5, 0.9], "block": 2, "rate": "2*cos(2*t)", "velocity": [1, "-t"]},
    ],
    "potential": [{"kind": "expression", "U": "k*r1_x^2*r5_y/2"}],
}
"""A body of R³ and one of the plane, pulled at points 1 and 5; an input says a rate of this."""
FIRST = np.array([[0.1, 0.2, 1], [1, 0, 0], [0, 1, -1], [-1, 0.5, -0.3]])
SECOND = np.array([[0, 0.4, 0.3], [0, -0.7, 1], [0, -0.2, -1]])


def bodies(throttle, fuel, at, steady):
    """Both as control volumes, without gravity; ``at``: the time at which there is this fuel;
    ``steady``: does the second lose it away from its tank, by a flow inside whose ṗ is neglected?
    """
    one = Leaking(
        FIRST,
        np.array([[0.3, -0.2, -2], [0, 1, -1]]),
        lambda t: np.array([10 - B * t * (1 + t / 9), 2 + np.sin(t) / 4, 3 + 0 * t, 1 + 0 * t]),
        lambda t: np.array([-B * (1 + 2 * t / 9), np.cos(t) / 4, 0 * t, 0 * t]),
        lambda t: np.array([-B * (1 + 2 * t / 9), np.cos(t) / 4]),
        lambda t: np.array([[0.5, 1 + t, -U], [t, 0, U]]),
        (0, 0, 0),
    )
    lost = -B * throttle
    other = Leaking(
        SECOND,
        np.array([[0, *(AWAY if steady else [0.4, 0.3])], [0, 0.5, 0.9]]),
        lambda t: np.array([fuel + (t - at) * lost, 3 + np.sin(2 * t), 2 + 0 * t]),
        lambda t: np.array([lost + 0 * t, 2 * np.cos(2 * t), 0 * t]),
        lambda t: np.array([lost + 0 * t, 2 * np.cos(2 * t)]),
        lambda t: np.array([[0, throttle, -U], [0, 1, -t]]),
        (0, 0, 0),
        steady,
    )
    return one, other


AWAY = [0.1, -0.6]


@cache
def made(steady=False):
    *first, valve, last = PAIR["flow"]
    valve = {k: x for k, x in valve.items() if k != "on"} | {"at": AWAY, "block": 2}
    second = [x | {"steady": True} for x in (valve, last)]
    return problem_of(PAIR | {"flow": [*first, *second]} if steady else PAIR)


def turned(rng, n):
    A = np.linalg.qr(rng.normal(size=(n, n)))[0]
    A[:, 0] *= np.linalg.det(A)
    return A


def drawn(rng):
    """A, T and the velocity of both, and the state."""
    A1, T1, A2, T2 = turned(rng, 3), rng.normal(size=3), turned(rng, 2), rng.normal(size=2)
    v1, v2, fuel = rng.normal(size=6), rng.normal(size=3), rng.uniform(2, 6)
    x = np.concatenate([A1.ravel(), T1, A2.ravel(), T2, v1, v2, [fuel]])
    return (A1, T1, v1), (A2, T2, v2), fuel, x


@pytest.mark.parametrize("steady", [False, True])
def test_each_body_loses_momentum_with_what_leaves_it_alone(steady):
    """What is left of the balances is what the potential pulls with at its points."""
    m, rng = module_of(made(steady)), np.random.default_rng(3)
    assert m.STATE[-1] == "fuel"
    k = m.constants(arrange(m, NUMBERS))
    for _ in range(5):
        (A1, T1, v1), (A2, T2, v2), fuel, x = drawn(rng)
        t, throttle = rng.uniform(0, 3), rng.uniform(0.2, 2)
        found = m.rhs(t, x, k, [throttle])
        one, other = bodies(throttle, fuel, t, steady)
        r1, r5 = A1 @ FIRST[0] + T1, A2 @ SECOND[0][1:] + T2
        f1 = A1.T @ [-STIFF * r1[0] * r5[1], 0, 0]
        f5 = A2.T @ [0, -STIFF * r1[0] ** 2 / 2]
        left, size = one.unbalanced_of(t, A1, v1, found[-10:-4])
        pulled = np.concatenate([np.cross(FIRST[0], f1), f1])
        assert np.abs(left - pulled).max() < 1e-12 * size
        left, size = other.unbalanced_of(t, A2, v2, found[-4:-1])
        y, z = SECOND[0][1:]
        assert np.abs(left - [y * f5[1] - z * f5[0], *f5]).max() < 1e-12 * size
        assert found[-1] == pytest.approx(-B * throttle, rel=1e-14)


@pytest.mark.parametrize("steady", [False, True])
def test_the_record_holds_and_a_forged_one_does_not(steady):
    record = derive.derive(made(steady)).record
    assert all(v.holds for v in own_verdicts(record))
    for which in (0, 2, 3):
        for key in ("rate", "velocity"):
            told = [dict(x) for x in record.problem["flows"]]
            other = ["mul", 2, told[which]["rate"]]
            told[which][key] = other if key == "rate" else [1, 1, 1][: len(told[which][key])]
            forged = replace(record, problem={**record.problem, "flows": told})
            assert not stands(forged, "input")


@pytest.mark.parametrize("label", ["input", "power"])
def test_a_step_without_one_of_its_terms_is_refused(label):
    record = derive.derive(made()).record
    step, checker = record[label], Checker(record.problem, 7)
    assert checker.check(step).holds
    for k, e in enumerate(step.equations):
        terms = e.rhs[1:] if isinstance(e.rhs, tuple) and e.rhs[0] == "add" else (e.rhs,)
        for j in range(len(terms) if terms != (0,) else 0):
            less = add(*terms[:j], *terms[j + 1 :])
            forged = (*step.equations[:k], replace(e, rhs=less), *step.equations[k + 1 :])
            assert not checker.check(replace(step, equations=forged)).holds, (k, j)


@needs("cc")
def test_the_languages_are_one():
    (_, _, _, x), u, p = drawn(np.random.default_rng(5)), [0.7], [*NUMBERS.values()]
    known = None
    for build in (ONE_BUILD[y] for y in ("c", "python", "javascript", "rust", "julia")):
        code = library(build, made())
        assert code.constants(p)[0] in (0, None)
        found = code.rhs(0.8, x, code.constants(p)[1], u)
        known = found if known is None else known
        assert relative_error(found, known) < 1e-12


def test_a_mass_of_the_state_beside_one_of_time_is_not_used_up_at_once():
    run = derive.derive(made()).simulate(1.0, start={"throttle": 0.5})
    assert run["fuel"][-1] == pytest.approx(6 - 0.5 * B, rel=1e-9)


def test_tsiolkovsky_in_one_block_leaves_the_other_at_rest():
    data = {
        "name": "two",
        "group": "SE(3) x SE(3)",
        "parameters": {"b": B, "u": U},
        "point": [
            {"mass": m, "at": at, "block": block}
            for block, tank in ((1, 4), (2, "10 - b*t"))
            for m, at in ((tank, [0, 0, 0]), (1, [1, 0, 0]), (1, [-1, 0, 0]), (1, [0, 0, 1]))
        ],
        "flow": [{"at": [0, 0, -2], "block": 2, "rate": "-b", "velocity": [0, 0, "-u"]}],
    }
    problem = problem_of(data)
    with pytest.raises(ValueError, match=r"the mass 10 − bt of a point is used up at t = 33\.3"):
        derive.derive(problem).simulate(40.0)
    m = module_of(problem)
    k = m.constants(arrange(m, {"b": B, "u": U}))
    still = np.concatenate([np.eye(3).ravel(), np.zeros(3)])
    start = np.concatenate([still, still, np.zeros(12)])
    run = solve_ivp(m.rhs, (0, 20), start, args=(k,), rtol=1e-11, atol=1e-11)
    last = dict(zip(m.STATE, run.y[:, -1], strict=True))
    assert last["zeta_12"] == pytest.approx(U * np.log(13 / (13 - 20 * B)), rel=1e-9)
    assert [last[f"zeta_{i}"] for i in (4, 5, 6)] == [0, 0, 0]


@pytest.mark.parametrize("group", ["R(3) x R(3)", "SE(3) x R(3)"])
def test_a_spring_pulls_a_rocket_that_loses_mass_and_a_ball(group):
    """On a line m₁ẍ₁ = bu − f, m₂ẍ₂ = f with the spring's f = k(x₁ − x₂ − l): integrated anew."""
    rest = [{"mass": 1, "at": x} for x in ([1, 0, 0], [0, 1, 0], [-1, -1, 0])]
    tank = {"mass": "10 - b*t", "at": [0, 0, 0]}
    data = {
        "name": "tug",
        "group": group,
        "parameters": NUMBERS,
        "point": [tank, *rest, {"mass": 2, "at": [0, 0, 0], "block": 2}],
        "potential": [{"kind": "spring", "between": [1, 5], "stiffness": "k", "length": LENGTH}],
        "flow": [{"name": "jet", "on": 1, "rate": "-b", "velocity": [0, 0, "-u"]}],
        "output": [{"name": "pushed", "kind": "power", "of": "jet"}],
    }
    m = module_of(problem_of(data))
    k = m.constants(arrange(m, NUMBERS))
    first = np.eye(3).ravel() if "SE" in group else []
    start = np.concatenate([first, [0, 0, 1], [0, 0, 0], np.zeros(len(m.BASIS))])
    run = solve_ivp(m.rhs, (0, 6), start, args=(k,), rtol=1e-11, atol=1e-11)

    def known(t, y):
        f = STIFF * (y[0] - y[1] - LENGTH)
        return [y[2], y[3], (B * U - f) / (13 - B * t), f / 2]

    expected = solve_ivp(known, (0, 6), [1, 0, 0, 0], rtol=1e-12, atol=1e-12).y[:, -1]
    last = dict(zip(m.STATE, run.y[:, -1], strict=True))
    speeds = ("zeta_6", "zeta_9") if "SE" in group else ("zeta_3", "zeta_6")
    assert [last[x] for x in ("T1_3", "T2_3", *speeds)] == pytest.approx(expected, rel=1e-8)
    power = m.outputs(6.0, run.y[:, -1], k, ())[0]
    assert power == pytest.approx(B * U * expected[2], rel=1e-8)


def test_in_a_group_by_a_basis_whose_linear_parts_turn():
    """Of a screw about the third axis the moment and the force along it are balanced together."""
    screw = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]]
    data = {
        "name": "screw",
        "group": {"name": "Screw", "action": "affine", "basis": [screw]},
        "point": [{"mass": "5 - t", "at": [1, 0, 0]}, {"mass": 2, "at": [0, 1, 0.5]}],
        "flow": [{"at": [0.5, 0.2, 1], "rate": -1, "velocity": [0, 1, "-3*t"]}],
    }
    problem = problem_of(data)
    assert all(v.holds for v in own_verdicts(derive.derive(problem).record))
    m = module_of(problem)
    body = Leaking(
        np.array([[1, 0, 0], [0, 1, 0.5]]),
        np.array([[0.5, 0.2, 1]]),
        lambda t: np.array([5 - t, 2 + 0 * t]),
        lambda t: np.array([-1 + 0 * t, 0 * t]),
        lambda t: np.array([-1 + 0 * t]),
        lambda t: np.array([[0, 1, -3 * t]]),
        (0, 0, 0),
    )
    t, turn, speed, along = 0.7, 0.4, 1.3, np.array([0, 0, 1.0])
    A = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    rate = m.rhs(t, [*A.ravel(), 0, 0, turn, speed], m.constants([]))[-1]
    left, size = body.unbalanced(t, A, speed * along, speed * along, rate * along, rate * along)
    assert abs(left[2] + left[5]) < 1e-12 * size


WRONG = {
    "no point": ({"block": 3, "on": None, "at": [0], "velocity": [1]}, "flow 1: in block 3 no"),
    "rate": (
        {"rate": "-2*b"},
        "flow 1, rate: the rates of all [[flow]] tables must add up to dm/dt"
        " of the body, of block 2; give",
    ),
    "elsewhere": ({"on": 2}, "flow 1: mass flows in a body that turns in the plane"),
}


@pytest.mark.parametrize("what", WRONG)
def test_it_is_refused_in_one_line(what):
    change, told = WRONG[what]
    flow = {"on": 1, "rate": "-b", "velocity": [0, 1]} | change
    data = {
        "name": "bad",
        "group": "SL(2) x SE(2) x R(1)",
        "parameters": {"b": 1.0},
        "point": [
            {"mass": "9 - b" if what == "no point" else "9 - b*t", "at": [0, 0], "block": 2},
            *({"mass": 1, "at": x, "block": 1} for x in ([1, 0], [0, 1], [1, 1])),
            {"mass": 1, "at": [1, 0], "block": 2},
        ],
        "flow": [{k: x for k, x in flow.items() if x is not None}],
    }
    with pytest.raises(derive.ProblemError) as error:
        problem_of(data)
    assert told in str(error.value)
