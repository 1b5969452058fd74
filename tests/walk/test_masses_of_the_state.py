"""Mass that flows at a rate that inputs say, a number of the state: beside the balances of momentum
of a control volume, masses that are expressions of the time, and known solutions."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import derive
from derive.check.checker import Checker, ClaimChecker
from derive.command.cli import main
from derive.language.tree import add, nodes
from derive.problem.toml import doubts, problem_of
from derive.record.as_json import from_json, to_data
from derive.record.prose import message
from derive.record.record import RecordError
from derive.record.sentence import Claim, english
from tests.oracles import relative_error
from tests.oracles.control_volume import Leaking
from tests.support.library import arrange, module_of
from tests.support.walks import own_verdicts, stands
from tests.walk import test_flows as timed

GROUPS = ["SE(3)", "SO(3)", "SE(2)", "SO(2)", "moments"]
NUMBERS = {"b": timed.RATE, "u": timed.SPEED}
TANK = timed.ROCKET | {
    "name": "tank",
    "parameters": {"fuel": 10.0, **NUMBERS},
    "point": [{"mass": "fuel", "at": [0.1, 0.2, 1]}, *timed.ROCKET["point"][1:]],
    "input": [{"name": name, "kind": "scalar"} for name in ("throttle", "gimbal")],
    "flow": [
        {
            "name": "jet",
            "on": 1,
            "mass": "fuel",
            "rate": "-b*throttle*(1 + fuel/20)",
            "velocity": ["gimbal", "gimbal*(1 + t)", "-u"],
        },
        timed.ROCKET["flow"][1],
    ],
}
"""Of the fuel the rate is said by an input, of the mass at the second point by the time."""


def on(what, rocket=TANK):
    """A rocket on a group of R³ or of the plane, or by its moments."""
    if what != "moments":
        n = int(what[-2])
        cut = [
            {k: x[-n:] if isinstance(x, list) else x for k, x in table.items()}
            for table in (*rocket["point"], *rocket["flow"], *rocket["potential"])
        ]
        points, flows = len(rocket["point"]), len(rocket["flow"])
        return rocket | {
            "group": what,
            "point": cut[:points],
            "flow": cut[points : points + flows],
            "potential": cut[points + flows :],
        }
    told = [f"({x['mass']})" for x in rocket["point"]]

    def summed(weights):
        return " + ".join(f"{m}*({w})" for m, w in zip(told, weights, strict=True))

    P = timed.PLACES
    J = [[summed(P[:, i] * P[:, j]) for j in range(3)] for i in range(3)]
    given = {"m": " + ".join(told), "c": [summed(P[:, i]) for i in range(3)], "J": J}
    first, other = rocket["flow"]
    at = first.get("at", rocket["point"][0]["at"])
    flows = [{**x, "at": y} for x, y in ((first, at), (other, [0, 1, -1]))]
    flows = [{k: y for k, y in x.items() if k != "on"} for x in flows]
    rest = {k: v for k, v in rocket.items() if k not in ("point", "flow")}
    return rest | {"body": {"given": given}, "flow": flows}


STEADY = TANK | {
    "flow": [
        {k: x for k, x in y.items() if k != "on"} | {"at": at, "steady": True}
        for y, at in zip(TANK["flow"], timed.EXITS.tolist(), strict=True)
    ]
}
"""Through a nozzle that is away from the tank, as the throttle says: ṗ is neglected."""


@cache
def made(what, steady=False):
    problem = problem_of(on(what, STEADY if steady else TANK))
    return problem, module_of(problem, jacobian="raw")


def drawn(m, what, rng, t):
    """A time's state of the module, and A and the velocity in it."""
    n, d = len(m.BASIS[0]) - ("SO" not in what), len(m.BASIS)
    A = np.linalg.qr(rng.normal(size=(n, n)))[0]
    A[:, 0] *= np.linalg.det(A)
    velocity = rng.normal(size=d)
    place = rng.normal(size=n * ("SO" not in what))
    return np.concatenate([A.ravel(), place, velocity, [rng.uniform(3, 12)]]), A, velocity


@pytest.mark.parametrize("steady", [False, True])
@pytest.mark.parametrize("what", GROUPS)
def test_momentum_is_lost_with_what_leaves_alone(what, steady):
    _, m = made(what, steady)
    assert m.STATE[-1] == "fuel"
    assert m.PARAMETERS == ("b", "u")
    rng, k = np.random.default_rng(3), m.constants(arrange(m, NUMBERS))
    for _ in range(5):
        t, (throttle, gimbal) = rng.uniform(0, 3), rng.uniform(0.2, 2, size=2)
        x, A, velocity = drawn(m, what, rng, t)
        found, fuel = m.rhs(t, x, k, [throttle, gimbal]), x[-1]
        lost = -timed.RATE * throttle * (1 + fuel / 20)
        assert found[-1] == pytest.approx(lost, rel=1e-14)

        def masses(s, t=t, fuel=fuel, lost=lost):
            return np.array([fuel + (s - t) * lost, *timed.masses(s)[1:]])

        def mass_rates(s, lost=lost):
            return np.array([lost, *timed.mass_rates(s)[1:]])

        def velocities(s, gimbal=gimbal):
            return np.array([[gimbal, gimbal * (1 + s), -timed.SPEED], [s, 0, timed.SPEED]])

        exits = timed.EXITS if steady else [timed.PLACES[0], timed.EXITS[1]]
        laws = masses, mass_rates, lambda s, own=mass_rates: own(s)[:2], velocities
        body = Leaking(timed.PLACES, exits, *laws, steady=steady)
        rate = found[-1 - len(velocity) : -1]
        left, size = body.unbalanced_of(t, A, velocity, rate)
        assert np.abs(left).max() < 1e-12 * size


@pytest.mark.parametrize("what", [*GROUPS, "R(3)"])
def test_at_a_rate_of_time_it_is_the_mass_that_time_says(what):
    """Also where what flows inside has a momentum, whose rate is known then."""
    first, other = timed.ROCKET["flow"]
    rocket = TANK | {"flow": [first | {"mass": "fuel"}, other], "input": []}
    m, old = (
        module_of(problem_of(on(what, x) if what != "R(3)" else flat(x)))
        for x in (rocket, timed.ROCKET)
    )
    rng, numbers = np.random.default_rng(4), NUMBERS | {"m0": 10.0}
    k, k_old = m.constants(arrange(m, numbers)), old.constants(arrange(old, numbers))
    for _ in range(3):
        t = rng.uniform(0, 3)
        x = rng.normal(size=6) if what == "R(3)" else drawn(m, what, rng, t)[0][:-1]
        fuel = timed.masses(t)[0]
        found = m.rhs(t, [*x, fuel], k)
        assert relative_error(found[:-1], old.rhs(t, x, k_old)) < 1e-13
        assert found[-1] == pytest.approx(timed.mass_rates(t)[0], rel=1e-14)
        assert m.energy(t, [*x, fuel], k) == pytest.approx(old.energy(t, x, k_old), rel=1e-14)


def flat(rocket):
    """The rocket in a space that only shifts it."""
    return rocket | {"group": "R(3)"}


@pytest.mark.parametrize("steady", [False, True])
@pytest.mark.parametrize("what", GROUPS)
def test_the_record_holds_and_a_forged_one_does_not(what, steady):
    record = derive.derive(made(what, steady)[0]).record
    assert all(v.holds for v in own_verdicts(record))
    told = [dict(x) for x in record.problem["flows"]]
    told[0]["rate"] = ["mul", -2, ["par", "b"]]
    forged = replace(record, problem={**record.problem, "flows": told})
    assert not stands(forged, "input")
    step, checker = record["power"], Checker(record.problem, 7)
    assert any(("par", "fuel_dot") in nodes(e.rhs) for e in step.equations)
    for k, e in enumerate(step.equations):
        terms = e.rhs[1:] if isinstance(e.rhs, tuple) and e.rhs[0] == "add" else (e.rhs,)
        for j in range(len(terms)):
            less = add(*terms[:j], *terms[j + 1 :])
            forged = (*step.equations[:k], replace(e, rhs=less), *step.equations[k + 1 :])
            assert not checker.check(replace(step, equations=forged)).holds, (k, j)


def test_a_steady_flow_in_a_space_that_only_shifts():
    """m v̇ = F + ṁu."""
    m, rng = module_of(problem_of(flat(STEADY))), np.random.default_rng(9)
    x, t, throttle, gimbal = rng.normal(size=7), 0.7, 0.8, 0.3
    x[-1] = 5
    rates = [-timed.RATE * throttle * (1 + x[-1] / 20), np.cos(t) / 4]
    velocities = np.array([[gimbal, gimbal * (1 + t), -timed.SPEED], [t, 0, timed.SPEED]])
    whole = x[-1] + timed.masses(t)[1:].sum()
    found = m.rhs(t, x, m.constants(arrange(m, NUMBERS)), [throttle, gimbal])
    known = np.array([0, 0, -timed.G]) + rates @ velocities / whole
    assert np.allclose(found, [*x[3:6], *known, rates[0]], rtol=0, atol=1e-13)


@pytest.mark.parametrize("what", ["SE(3)", "moments", "SE(2)"])
def test_what_is_neglected_is_said_and_no_other_record_says_it(what):
    """Neither may the sentence be left out, nor what it says be another; and with ṗ there are
    other equations."""
    record = derive.derive(made(what, True)[0]).record
    step, claims = record["input"], ClaimChecker(record, 7)
    (own,) = step.claims
    assert own == Claim("input.flow_steady", (("flows", ("row", 1, 2)),))
    assert "is taken to be steady" in english(step.prose)
    assert not claims.fault(step)
    silent = tuple(x for x in step.prose if x.message != message(own.kind))
    assert "input.flow_steady" in claims.fault(replace(step, claims=(), prose=silent))
    told = [{k: x for k, x in y.items() if k != "steady"} for y in record.problem["flows"]]
    forged = replace(record, problem={**record.problem, "flows": told})
    assert not stands(forged, "input")
    assert "the problem says so of the flows []" in ClaimChecker(forged, 7).fault(step)
    data = to_data(record)
    data["problem"]["flows"][0]["steady"] = 2
    with pytest.raises(RecordError, match="steady"):
        from_json(json.dumps(data))


@pytest.mark.parametrize("what", ["SE(3)", "SO(2)"])
def test_the_raw_jacobian_is_the_derivative_by_all_numbers(what):
    _, m = made(what)
    rng, k = np.random.default_rng(5), m.constants(arrange(m, NUMBERS))
    x, u = drawn(m, what, rng, 0.7)[0], [0.8, 0.3]
    D = m.jacobian_raw(0.7, x, k, u)
    for i, e in enumerate(np.eye(len(x))):
        slope = m.rhs(0.7, x + 1e-30j * e, k, u).imag / 1e-30
        assert np.abs(D[:, i] - slope).max() < 1e-12 * max(1, np.abs(slope).max())


@pytest.mark.parametrize("what", ["SE(3)", "SO(3)", "SE(2)"])
def test_what_acts_changes_the_energy_at_masses_that_are_held(what):
    told = [{"name": "whole", "kind": "power"}, {"name": "own", "kind": "power", "of": "jet"}]
    m = module_of(problem_of(on(what) | {"output": told}))
    rng, k = np.random.default_rng(6), m.constants(arrange(m, NUMBERS))
    t, h, u = 1.3, 1e-5, [0.8, 0.3]
    x = drawn(m, what, rng, t)[0]
    rates = np.array(m.rhs(t, x, k, u))
    rates[-1] = 0
    ends = [m.energy(t, x + s * h * rates, k) for s in (-2, -1, 1, 2)]
    wanted = (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * h)
    assert m.outputs(t, x, k, u)[0] == pytest.approx(wanted, rel=1e-8)


FORMS = ["", "--attitude quaternion", "--velocity tangent", "--layout col", "--dynamics"]


@pytest.mark.parametrize("steady", [False, True])
@pytest.mark.parametrize("form", FORMS)
def test_every_form_and_language_is_read_back(form, steady, tmp_path):
    path = tmp_path / "rocket.toml"
    text = ROCKET.replace("on = 1", "at = [0, 0, -2]\nsteady = true") if steady else ROCKET
    path.write_text(text, encoding="utf-8")
    words = ["emit", str(path), *form.split(), "--validate", "--out", str(tmp_path)]
    languages = ("python", "c", "rust", "julia", "javascript") if not form else ("c",)
    assert main([*words, *(x for name in languages for x in ("--lang", name))]) == 0


ROCKET = """
name = "rocket"
group = "SE(3)"
parameters = { fuel = 60.0, b = 1.5, u = 2500.0 }
potential = [{ kind = "gravity", g = [0, 0, -9.81] }]
input = [{ name = "throttle", kind = "scalar" }]
[[point]]
mass = "fuel"
at = [0, 0, 0]
[[point]]
mass = 20
at = [0.3, 0, 0]
[[point]]
mass = 20
at = [-0.3, 0, 0]
[[point]]
mass = 20
at = [0, 0, 2]
[[flow]]
name = "jet"
on = 1
mass = "fuel"
rate = "-b*throttle"
velocity = [0, 0, "-u"]
"""


def followed(text, tmp_path, duration, **options):
    """The motion of a problem file, and its problem."""
    path = tmp_path / "rocket.toml"
    path.write_text(text, encoding="utf-8")
    return derive.derive(path).simulate(duration, **options)


def test_tsiolkovsky_whatever_the_throttle(tmp_path):
    """Along its axis it gains u log(m₀/m) − gt, until the fuel is left that an event says."""
    signal = '[[signal]]\ninput = "throttle"\nu = "1 + sin(3*t)/2"\n'
    event = '[[event]]\nname = "empty"\nwhen = "fuel - 20"\nterminal = true\n'
    told = '[[output]]\nname = "left"\ny = ["fuel"]\n'
    run = followed(ROCKET + signal + event + told, tmp_path, 60)
    fuel, t = run["fuel"], run.t
    left = 60 - 1.5 * (t + (1 - np.cos(3 * t)) / 6)
    assert np.abs(fuel - left).max() < 1e-7
    assert (run["left"] == fuel).all()
    assert fuel[-1] == pytest.approx(20, abs=1e-8)
    assert run["w_3"][-1] == pytest.approx(2500 * np.log(120 / 80) - 9.81 * t[-1], rel=1e-8)
    path = tmp_path / "rocket.toml"
    from_less = derive.derive(path).simulate(5, start={"fuel": 40.0})
    assert from_less["fuel"][0] == 40


def test_a_mass_that_is_used_up_is_told(tmp_path):
    with pytest.raises(ValueError, match=r"the mass fuel of a point is used up before t = 40\.1"):
        followed(ROCKET, tmp_path, 50, start={"throttle": 1.0})


GIVEN = """
[body]
given = { m = "60 + fuel", c = [0, 0, "-fuel/2"], J = [[9, 0, 0], [0, 9, 0], [0, 0, 9]] }
"""


def test_a_mass_of_a_given_body_is_used_up_too(tmp_path):
    head, _, flow = ROCKET.partition("[[flow]]")
    text = head.partition("[[point]]")[0] + GIVEN + "[[flow]]" + flow
    with pytest.raises(ValueError, match=r"the mass fuel is used up before t = 40\.1"):
        followed(text.replace("on = 1", "at = [0, 0, -0.5]"), tmp_path, 50, start={"throttle": 1.0})


GRAIN = {
    "name": "grain",
    "group": "SE(3)",
    "parameters": {"fuel": 6.0, "b": 0.3},
    "body": {
        "given": {
            "m": "8 + fuel",
            "c": [0, 0, "-fuel/2"],
            "J": [["2 + fuel^2/9", 0, 0], [0, "3 + fuel^3/90", 0], [0, 0, "4 + sqrt(1 + fuel)"]],
        }
    },
    "input": [{"name": "throttle", "kind": "scalar"}],
    "flow": [{"at": [0, 0, -0.5], "mass": "fuel", "rate": "-b*throttle", "velocity": [0, 0, -9]}],
}
"""It burns from its surface: J is no linear function of what is left."""


def test_the_metric_is_tested_at_the_masses_of_the_start():
    """Which constants does not know: it takes those by default, and the header says so; a motion
    those that it starts with. About the third axis the moment is fuel − 2."""
    J = [["fuel - 3", 0, 0], [0, 1, 0], [0, 0, 4]]
    body = {"given": {"m": "8 + fuel", "c": [0, 0, "-fuel/2"], "J": J}}
    problem = problem_of(GRAIN | {"body": body})
    made = derive.derive(problem)
    assert made.simulate(0.1)["fuel"][0] == 6
    told = "grain: the mass matrix is singular or not positive at the start, with fuel = 1"
    with pytest.raises(ValueError, match=told):
        made.simulate(0.1, start={"fuel": 1.0})
    m = module_of(problem)
    assert "it tests the mass matrix at t = 0 with fuel = 6.0" in " ".join(m.__doc__.split())
    m.constants([0.3])
    little = problem_of(GRAIN | {"body": body, "parameters": {"fuel": 1.0, "b": 0.3}})
    with pytest.raises(ValueError, match="singular or not positive at t = 0"):
        module_of(little).constants([0.3])
    assert any("no masses have these moments" in x for x in doubts(problem, {"fuel": 1.0}))


def test_a_second_moment_may_be_any_function_of_the_fuel():
    """The balances of a control volume, of which c and J are known: d(m v + ω × c)/dt = ṁ(v + ω × r
    + u), and that of Iω + c × v with the moments of these at r, along axes that turn."""
    problem = problem_of(GRAIN)
    assert all(v.holds for v in own_verdicts(derive.derive(problem).record))
    m, rng = module_of(problem), np.random.default_rng(7)
    x, _, velocity = drawn(m, "SE(3)", rng, 0)
    w, v, fuel, lost = velocity[:3], velocity[3:], x[-1], -0.3 * 0.7
    found = m.rhs(0.0, x, m.constants([0.3]), [0.7])
    dw, dv = found[-7:-4], found[-4:-1]
    r, u, h = np.array([0, 0, -0.5]), np.array([0, 0, -9]), 1e-30

    def momenta(s):
        left, spin, speed = fuel + s * lost, w + s * dw, v + s * dv
        J = np.diag([2 + left**2 / 9, 3 + left**3 / 90, 4 + np.sqrt(1 + left)])
        c = np.array([0, 0, -left / 2])
        inside = (np.trace(J) * np.eye(3) - J) @ spin + np.cross(c, speed)
        return np.array([inside, (8 + left) * speed + np.cross(spin, c)])

    (H, P), (dH, dP) = momenta(0), momenta(1j * h).imag / h
    leaving = lost * (v + np.cross(w, r) + u)
    assert dP + np.cross(w, P) == pytest.approx(leaving, rel=1e-11)
    assert dH + np.cross(w, H) + np.cross(v, P) == pytest.approx(np.cross(r, leaving), rel=1e-11)


def test_at_a_rate_of_time_so_may_the_first():
    text = json.dumps(GRAIN | {"input": []})
    text = text.replace("-fuel/2", "-fuel^2/9").replace("-b*throttle", "-b*(1 + t)")
    by_state = json.loads(text)
    timed = text.replace("fuel^", "(6 - b*(t + t^2/2))^").replace("fuel)", "6 - b*(t + t^2/2))")
    timed = json.loads(timed.replace("8 + fuel", "14 - b*(t + t^2/2)"))
    timed["parameters"], timed["flow"][0] = {"b": 0.3}, timed["flow"][0] | {"mass": None}
    timed["flow"][0] = {k: y for k, y in timed["flow"][0].items() if y is not None}
    m, old = module_of(problem_of(by_state)), module_of(problem_of(timed))
    x, t = drawn(m, "SE(3)", np.random.default_rng(8), 0)[0][:-1], 0.9
    left = 6 - 0.3 * (t + t**2 / 2)
    found = m.rhs(t, [*x, left], m.constants([0.3]))
    assert relative_error(found[:-1], old.rhs(t, x, old.constants([0.3]))) < 1e-13


WRONG = {
    'mass = "fuel"\nrate -> rate': "flow 1, rate: 'throttle' is an input, so that the mass",
    'mass = "fuel"\nrate -> mass = "fule"\nrate': "flow 1, mass: 'fule' is not declared",
    "on = 1\nmass -> at = [0, 0, -2]\nmass": "by steady = true in its [[flow]]",
    "on = 1 -> on = 1\nsteady = 1": "flow 1: key 'steady' must be true or false",
    "[[flow]] -> [[flow]]\non=2\nsteady=true\nrate=0\nvelocity=[0,0,0]\n[[flow]]": "say alike",
    "fuel = 60.0 -> fuel = 60.0, fuel_dot = 1.0": "parameter 'fuel_dot': the rate of a mass",
    '-9.81] -> "-fuel"]': "potential 1: 'fuel' is a mass, a number of the state",
    'at = [0, 0, 0] -> at = [0, 0, "fuel"]': "point 1, at: fuel: a place of the body does not move",
    "-b*throttle -> -b*w_3": "'w_3' is of the state",
    'mass = "fuel"\nat -> mass = "2*fuel"\nat': "the rates of all [[flow]] tables must add up",
}


@pytest.mark.parametrize("change", WRONG)
def test_it_is_refused_in_one_line(change, tmp_path, capsys):
    old, new = change.split(" -> ")
    path = tmp_path / "rocket.toml"
    path.write_text(ROCKET.replace(old, new), encoding="utf-8")
    assert main(["walk", str(path)]) == 2
    (told,) = capsys.readouterr().err.splitlines()
    assert WRONG[change] in told


def test_momenta_are_refused(tmp_path, capsys):
    path = tmp_path / "rocket.toml"
    path.write_text(ROCKET, encoding="utf-8")
    assert main(["emit", str(path), "--momenta", "--out", str(tmp_path)]) == 2
    assert "mass flows" in capsys.readouterr().err.splitlines()[-1]


def test_a_trim_says_what_is_refused_and_leads_nowhere_else(tmp_path, capsys):
    path = tmp_path / "rocket.toml"
    path.write_text(ROCKET, encoding="utf-8")
    assert main(["trim", str(path)]) == 2
    (told,) = capsys.readouterr().err.splitlines()
    assert "this state has the mass fuel, too; leave out its [[flow]]" in told
    # what it says to do
    pushed = ROCKET[: ROCKET.index("[[flow]]")].replace(
        'kind = "scalar"', 'kind = "force", at = [0, 0, 0], frame = "body", direction = [0, 0, 1]'
    )
    path.write_text(pushed.replace(", b = 1.5, u = 2500.0", ""), encoding="utf-8")
    assert main(["trim", str(path)]) == 0
    assert "throttle = 5886/5" in capsys.readouterr().out


def test_a_record_whose_mass_is_no_parameter_is_none():
    record = derive.derive(problem_of(on("SO(2)"))).record
    data = to_data(record)
    assert from_json(json.dumps(data)).steps == record.steps
    data["problem"]["flows"][0]["mass"] = "other"
    with pytest.raises(RecordError, match="the mass 'other' is no parameter"):
        from_json(json.dumps(data))
