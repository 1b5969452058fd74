"""A damping with a name is a force of the state by this name, and pulls as without one."""

import numpy as np
import pytest

import derive
from derive.language.show import show
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from tests.support.library import module_of
from tests.support.walks import own_verdicts

MASS, INERTIA, FACTOR = 3.0, np.array([0.3, 0.4, 0.6]), 0.17
AT = np.array([0.2, -0.1, 0.3])
LAWS = {
    "air": ({"at": AT.tolist()}, lambda v, w: (-FACTOR * v, 0)),
    "drag": (
        {"kind": "quadratic", "at": AT.tolist()},
        lambda v, w: (-FACTOR * np.linalg.norm(v) * v, 0),
    ),
    "bearing": ({"kind": "rotational"}, lambda v, w: (0 * v, -FACTOR * w)),
}


def with_damping(name, table):
    return problem_of(
        {
            "name": "damped",
            "group": "SE(3)",
            "body": {
                "given": {"m": MASS, "centre": [0, 0, 0], "I_centre": np.diag(INERTIA).tolist()}
            },
            "damping": [{"name": name, "coefficient": FACTOR, **table}],
        }
    )


@pytest.mark.parametrize("name", LAWS)
def test_it_pulls_by_newton_and_euler(name):
    table, law = LAWS[name]
    problem = with_damping(name, table)
    module = module_of(problem)
    w, v = np.array([0.3, -0.7, 1.1]), np.array([0.9, 0.4, -0.6])
    x = np.concatenate([np.eye(3).ravel(), np.zeros(3), w, v])
    force, moment = law(v + np.cross(w, AT), w)
    turn = (moment + np.cross(AT, force) - np.cross(w, INERTIA * w)) / INERTIA
    expected = np.concatenate([turn, force / MASS - np.cross(w, v)])
    found = module.rhs(0.0, x, module.constants([]))[-6:]
    assert np.allclose(found, expected, rtol=1e-12, atol=1e-13)
    record = derive.derive(problem).record
    assert any(("par", f"{name}_1") == e.lhs for step in record.steps for e in step.equations)
    assert all(x.holds for x in own_verdicts(record))


@pytest.mark.parametrize("acting", ["damping", "input"])
def test_a_moment_alone_turns_a_body_in_the_plane(acting):
    table = {"name": "brake", "kind": {"damping": "rotational", "input": "torque"}[acting]}
    table |= {"coefficient": FACTOR} if acting == "damping" else {}
    body = {"given": {"m": MASS, "centre": [0, 0], "I_centre": 2}}
    data = {"name": "plate", "group": "SE(2)", "body": body, acting: [table]}
    module = module_of(problem_of(data))
    w, *v = 0.7, 0.4, -0.3
    x = np.array([1, 0, 0, 1, 0, 0, w, *v])
    told = [0.9] if acting == "input" else None
    found = module.rhs(0.0, x, module.constants([]), told)[-3:]
    moment = 0.9 if acting == "input" else -FACTOR * w
    assert np.allclose(found, [moment / 2, w * v[1], -w * v[0]], rtol=1e-12, atol=1e-13)


def test_a_name_is_of_one_place_and_of_one_force():
    points = [{"mass": 1, "at": [int(i == k) for k in range(3)]} for i in range(3)]
    data = {"name": "many", "group": "SE(3)", "point": points}
    table = {"name": "air", "coefficient": 1}
    with pytest.raises(ProblemError, match="damping 1, name: it acts on 3 points; give each a"):
        problem_of({**data, "damping": [table]})
    twice = [{**table, "on": [1]}, {**table, "on": [2]}]
    with pytest.raises(ProblemError, match="'air' is a force as well; choose another name"):
        problem_of({**data, "damping": twice})


def test_the_signs_of_a_law_and_of_a_coordinate_are_one():
    """ζ₁ is −Z₁₂ in the plane, so that −500 ζ₁ is 500 Z₁₂."""
    body = {"given": {"m": MASS, "centre": [0, 0], "I_centre": 2}}
    law = {"name": "water", "at": [0, 0], "frame": "body", "moment": ["-500*zeta_1"]}
    record = derive.derive(
        problem_of({"name": "boat", "group": "SE(2)", "body": body, "force": [law]})
    ).record
    (found,) = (e.rhs for s in record.steps for e in s.equations if e.lhs == ("par", "water"))
    assert show(found) == "500 Z₁₂"
