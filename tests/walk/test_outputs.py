"""[[output]]: what is read off a motion is what the points of an oracle do; of bodies of a product
too, powers among it; C and D beside differences of the outputs."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest

import derive
from derive.check.checker import verdicts
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.searches import conserved_without_gravity
from tests.oracles import general, relative_error, sensors
from tests.problems import PROBLEMS
from tests.support import corpus
from tests.support.library import emission, module_of
from tests.support.walks import SEED, own_verdicts, stands

SIZES = {
    "SE(3) x SE(3)": (3, 3),
    "SE(2) x SO(3)": (2, 3),
    "R(2) x SE(2)": (2, 2),
    "SO(2) x SE(3)": (2, 3),
    "SE(2) x R(1) x SE(2)": (2, 1, 2),
    "SL(2) x SE(2)": (2, 2),
}
"""A product → the dimensions of the spaces of its blocks; in the last one things act, and are
read."""
AT, DOWN = [0.3, -0.2, 0.5], [0.4, -0.7, 9.0]


def data_of(group):
    sizes = SIZES[group]
    last, n = len(sizes), sizes[-1]
    corners = [[1, 0.2, -0.3], [0, 1, 0.1], [-0.4, 0.3, 1], [0.2, -0.5, 0.3]]
    points = [
        {"mass": 1 + k + b, "at": x[:size], "block": b}
        for b, size in enumerate(sizes, 1)
        for k, x in enumerate(corners)
    ]
    v = [f"v_{i + 1}" for i in range(n)]
    speed = f"sqrt({' + '.join(f'{x}^2' for x in v)})"
    place = {"at": AT[:n], "block": last}
    inputs = [
        {"name": "pull", "kind": "force", "on": 1, "frame": "space"},
        {"name": "jet", "kind": "force", **place, "frame": "body", "direction": DOWN[:n]},
        {"name": "wheel", "kind": "torque", "block": last, "frame": "body"},
    ]
    kinds = ("velocity", "acceleration", "specific_force", "place")
    read = [{"name": f"{x}_s", "kind": x, **place} for x in kinds]
    read += [
        {"name": "gyro", "kind": "rate", "block": last},
        {
            "name": "compass",
            "kind": "direction",
            "direction": DOWN[:n],
            "block": last,
            "frame": "body",
        },
        {"name": "far", "kind": "distance", **place, "to": [2, 1, -1][:n]},
        {"name": "moved", "kind": "momentum", "block": last},
        {"name": "felt", **place, "y": ["v_1*r_1 + T", f"T*{speed}"]},
        {"name": "whole", "kind": "power"},
        *({"name": f"P{x}", "kind": "power", "of": x} for x in ACTING),
    ]
    return {
        "name": "pair",
        "group": group,
        "parameters": {"c": 0.37, "kappa": 0.21, "T": 0.4},
        "point": points,
        "input": inputs,
        "force": [{"name": "drag", **place, "force": [f"-c*{speed}*{x}" for x in v]}],
        "damping": [{"name": "oil", "coefficient": "kappa", **place}],
        "potential": [{"kind": "gravity", "g": DOWN[:n]}] * (len({*sizes}) == 1),
        "output": read,
    }


ACTING = ("pull", "jet", "wheel", "drag", "oil")


CASES = {x: tomllib.loads(y) for x, y in PROBLEMS.items() if x.endswith(" outputs")}
CASES |= {group: data_of(group) for group in SIZES}
T = 0.4


def module(name):
    """What the emitted Python defines, with all derivatives."""
    return vars(module_of(problem_of(CASES[name]), jacobian=("outputs", "raw")))


@pytest.mark.parametrize("name", CASES)
def test_they_are_what_the_points_do(name):
    data, space = CASES[name], module(name)
    p, basis, rng = general.parameters(data), space["BASIS"], np.random.default_rng(3)
    k = space["constants"]([p[x] for x in space["PARAMETERS"]])
    for _ in range(3):
        x, u = general.random_state(data, basis, rng), rng.normal(size=len(space["INPUTS"]))
        expected = sensors.outputs(data, basis, p, T, x, u)
        assert len(expected) == len(space["OUTPUTS"])
        assert relative_error(space["outputs"](T, x, k, u), expected) < 1e-12


@pytest.mark.parametrize("name", CASES)
def test_their_derivatives_are_those_of_differences(name):
    data, space = CASES[name], module(name)
    p, basis, rng = general.parameters(data), space["BASIS"], np.random.default_rng(3)
    k = space["constants"]([p[x] for x in space["PARAMETERS"]])
    x, u = general.random_state(data, basis, rng), rng.normal(size=len(space["INPUTS"]))
    d, h = len(basis), 1e-5

    def slope(move):
        """The derivative by a number that moves the state and the inputs."""
        ahead, back = (space["outputs"](T, *move(s)) for s in (h, -h))
        return (ahead - back) / (2 * h)

    def along(e):
        """A variation (η, δζ) of the state."""

        def moved(s):
            G, zeta = general.split(data, x, d)
            turned = G @ general.expm(np.tensordot(s * e[:d], basis, 1))
            return general.join(data, turned, zeta + s * e[d:]), k, u

        return moved

    columns = [slope(along(e)) for e in np.eye(2 * d)]
    close = {"rtol": 1e-6, "atol": 1e-6}
    np.testing.assert_allclose(space["jacobian_outputs"](T, x, k, u), np.array(columns).T, **close)
    raw = [slope(lambda s, e=e: (x + s * e, k, u)) for e in np.eye(len(x))]
    np.testing.assert_allclose(space["jacobian_outputs_raw"](T, x, k, u), np.array(raw).T, **close)
    if len(u):
        driven = [slope(lambda s, e=e: (x, k, u + s * e)) for e in np.eye(len(u))]
        found = space["jacobian_outputs_inputs"](T, x, k, u)
        np.testing.assert_allclose(found, np.array(driven).T, **close)


def test_the_checker_finds_them_from_the_points():
    """An output that the problem says otherwise, or of another place, is not that of the step."""
    d = corpus.record("points SE(2) x SO(2) outputs")

    def holds(outputs):
        return stands(replace(d, problem=d.problem | {"outputs": outputs}), "outputs")

    assert holds(stated := d.problem["outputs"])
    for k, change in ((0, {"frame": "body"}), (3, {"on": 1}), (6, {"on": 2}), (8, {"block": 2})):
        assert not holds([x | change if i == k else x for i, x in enumerate(stated)]), change


def test_what_gravity_is_not_left_in_has_no_outputs():
    """A spring is named by its number among all potentials, also where gravity is taken out."""
    text = PROBLEMS["SO(2) outputs"].replace("length = 0.4", "length = 0")
    problem = problem_of(tomllib.loads(text))
    assert "energy" in conserved_without_gravity(replace(problem, damping=()))


ADVECTED = {
    "name": "test",
    "algebra": {"of": "SO(3)"},
    "advected": [{"name": "gamma", "representation": "dual"}],
    "lagrangian": {"L": "zeta_1^2 + zeta_2^2 + 2*zeta_3^2 - gamma_3"},
}
ON_A_GROUP = {
    "name": "test",
    "group": "SE(2)",
    "lagrangian": {"L": "zeta_1^2 + zeta_2^2 + zeta_3^2"},
}
ON_A_QUOTIENT = {
    "name": "test",
    "group": "SO(3)",
    "lagrangian": {"L": "zeta_1^2 + zeta_2^2 - A_33"},
}


@pytest.mark.parametrize(
    ("data", "entry", "of_rates"),
    [
        (ADVECTED, "gamma_1", {"zeta_1": 1}),
        (ON_A_GROUP, "A_11", {"zeta_1": 1}),
        (ON_A_QUOTIENT, "A_33", {"zeta_1": 2, "zeta_2": 2}),
    ],
    ids=["advected", "SE(2)", "quotient"],
)
def test_beside_a_lagrangian_they_are_expressions(data, entry, of_rates):
    """Their derivatives are those by x, and by variations: of ζ and g, or of all numbers."""
    rates = " + ".join(f"{x}^{k}" for x, k in of_rates.items())
    told = [{"name": "y", "y": [f"({rates})*{entry} + t", rates]}]
    problem = problem_of(data | {"output": told})
    record = walk(problem)
    assert all(x.holds for x in verdicts(record, SEED))
    space = vars(module_of(problem, jacobian=("outputs", "raw")))
    x = np.random.default_rng(3).normal(size=len(space["STATE"]))
    of = dict(zip(space["STATE"], x, strict=True))
    assert space["OUTPUTS"] == ("y_1", "y_2")
    value = sum(of[y] ** k for y, k in of_rates.items())
    expected = [value * of[entry] + T, value]
    np.testing.assert_allclose(space["outputs"](T, x, []), expected, rtol=1e-14)
    slopes = np.zeros((2, len(x)))
    for y, k in of_rates.items():
        slope = k * of[y] ** (k - 1)
        slopes[:, space["STATE"].index(y)] = slope * of[entry], slope
    slopes[0, space["STATE"].index(entry)] = value
    np.testing.assert_allclose(space["jacobian_outputs_raw"](T, x, []), slopes, rtol=1e-14)
    moved = [k for k, y in enumerate(space["STATE"]) if y.startswith("zeta_")]
    along = slopes
    if data is not ADVECTED:
        n = 2 if data is ON_A_GROUP else 3
        A, free = x[: n * n].reshape(n, n), space["BASIS"][: len(moved)]
        turned = np.array([(A @ e[:n, :n]).ravel() for e in free])
        along = np.hstack([slopes[:, : n * n] @ turned.T, slopes[:, moved]])
    np.testing.assert_allclose(space["jacobian_outputs"](T, x, []), along, rtol=1e-13, atol=1e-15)


def test_a_unit_ends_no_comment():
    told = [{"name": "y", "y": ["zeta_1"], "unit": "*/ int x /*"}]
    problem = problem_of(ON_A_GROUP | {"output": told})
    _, files = emission(problem, ("c", "javascript"))
    assert all("* / int x / *" in files[x] for x in ("test.h", "test.mjs"))
    assert not any("*/ int x" in x for x in files.values())


@pytest.mark.parametrize("group", SIZES)
def test_the_records_hold(group):
    record = derive.derive(problem_of(CASES[group])).record
    assert all(v.holds for v in own_verdicts(record))
