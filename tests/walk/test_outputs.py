"""[[output]]: what is read off a motion is what the points of an oracle do."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest

from derive.check.checker import verdicts
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.searches import conserved_without_gravity
from tests.oracles import general, relative_error, sensors
from tests.problems import PROBLEMS
from tests.support import corpus
from tests.support.library import emission, module_of
from tests.support.walks import SEED, stands

NAMES = [x for x in PROBLEMS if x.endswith(" outputs")]
T = 0.4


def module(name):
    """What the emitted Python defines, with all derivatives."""
    return vars(module_of(PROBLEMS[name], jacobian=("outputs", "raw")))


@pytest.mark.parametrize("name", NAMES)
def test_they_are_what_the_points_do(name):
    data, space = tomllib.loads(PROBLEMS[name]), module(name)
    p, basis, rng = general.parameters(data), space["BASIS"], np.random.default_rng(3)
    k = space["constants"]([p[x] for x in space["PARAMETERS"]])
    for _ in range(3):
        x, u = general.random_state(data, basis, rng), rng.normal(size=len(space["INPUTS"]))
        expected = sensors.outputs(data, basis, p, T, x, u)
        assert len(expected) == len(space["OUTPUTS"])
        assert relative_error(space["outputs"](T, x, k, u), expected) < 1e-12


@pytest.mark.parametrize("name", NAMES)
def test_their_derivatives_are_those_of_differences(name):
    data, space = tomllib.loads(PROBLEMS[name]), module(name)
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


@pytest.mark.parametrize(
    ("data", "at"), [(ADVECTED, 3), (ON_A_GROUP, 0)], ids=["advected", "SE(2)"]
)
def test_beside_a_lagrangian_they_are_expressions(data, at):
    entry = "gamma_1" if "algebra" in data else "A_11"
    told = [{"name": "y", "y": [f"zeta_1*{entry} + t", "zeta_2^2"]}]
    problem = problem_of(data | {"output": told})
    record = walk(problem)
    assert all(x.holds for x in verdicts(record, SEED))
    jacobian = ("outputs", "raw") if at == 0 else ()  # by η, on a group
    space = vars(module_of(problem, jacobian=jacobian))
    x = np.random.default_rng(3).normal(size=len(space["STATE"]))
    of = dict(zip(space["STATE"], x, strict=True))
    assert space["OUTPUTS"] == ("y_1", "y_2")
    expected = [of["zeta_1"] * of[entry] + T, of["zeta_2"] ** 2]
    np.testing.assert_allclose(space["outputs"](T, x, []), expected, rtol=1e-14)
    if at == 0:
        assert space["jacobian_outputs_raw"](T, x, [])[0, at] == of["zeta_1"]


def test_a_unit_ends_no_comment():
    told = [{"name": "y", "y": ["zeta_1"], "unit": "*/ int x /*"}]
    problem = problem_of(ON_A_GROUP | {"output": told})
    _, files = emission(problem, ("c", "javascript"))
    assert all("* / int x / *" in files[x] for x in ("test.h", "test.mjs"))
    assert not any("*/ int x" in x for x in files.values())
