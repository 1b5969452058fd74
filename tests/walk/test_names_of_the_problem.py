"""What a Lagrangian is said to depend on, and where the names that the user typed have gone."""

from dataclasses import replace

import numpy as np
import pytest

from derive.check.checker import Checker
from derive.language.tree import mul, nodes
from derive.pipeline import discrete, walk
from derive.problem.toml import problem_of
from derive.record.sentence import english
from derive.views.language import language
from tests.support.library import emission


def told(d, label):
    return english(d[f"{d.name}.{label}"].prose)


PLACES = ([1, 0, 0], [-1, 0, 0], [0, 2, 0], [0, -2, 0], [0, 0, 3], [0, 0, -3])
INPUTS = [
    {"name": "thrust", "kind": "force", "on": 1, "frame": "body"},
    {"name": "F", "kind": "covector"},
]
TURNED = {
    "name": "Turned",
    "basis": [
        [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
        [[0, -1, 1], [1, 0, 0], [-1, 0, 0]],
        [[0, 0, 0], [0, 0, 2], [0, -2, 0]],
    ],
}


def driven(group):
    points = [{"mass": 1, "at": at} for at in PLACES]
    return problem_of({"name": "driven", "group": group, "point": points, "input": INPUTS})


@pytest.mark.parametrize("group", ["SE(3)", "SO(3)", "SL(3)", TURNED], ids=str)
@pytest.mark.parametrize("road", [walk, discrete])
def test_the_numbers_of_inputs_have_the_names_of_the_file(road, group):
    """f_u₁ was force 1, and the first component of the force of a covector as well; u₄ stood in
    the discrete motion for the latter."""
    d = road(driven(group))
    parts = {x for s in d.steps for e in s.equations for t in (e.lhs, e.rhs) for x in nodes(t)}
    entries = [x for x in parts if isinstance(x, tuple) and x[0] == "entry" and x[2] != "a"]
    assert not [x for x in entries if x[1] in ("u", "f_u")]
    assert not [x for x in parts if isinstance(x, tuple) and x[:2] == ("at", "f_u")]
    size = {"SE(3)": 6, "SL(3)": 8}.get(d.problem["group"], 3)
    given = {f"thrust_{k}" for k in (1, 2, 3)} | {f"F_{k}" for k in range(1, size + 1)}
    named = {x[1] for x in parts if isinstance(x, tuple) and x[0] == "par"}
    assert named
    assert named <= given | {"P_thrust", "P_F"}  # the powers


STATED = {
    "name": "stated",
    "group": "SE(3)",
    "point": [{"mass": m, "at": at} for m, at in zip((1, 2, 1), np.eye(3).tolist(), strict=True)],
    "force": [
        {"name": "drag", "on": 2, "frame": "body"}
        | {"force": ["-v_1", 0, "-v_3"], "moment": [0, "-zeta_2", 0]},
        {"name": "loads", "covector": ["-zeta_1", 0, 0, 0, 0, "-w_3"]},
    ],
}


def test_forces_of_the_state_have_the_names_of_the_file():
    """Their numbers are said once, entries that are 0 have none, and code calls them so too."""
    p = problem_of(STATED)
    d = walk(p)
    step = d["stated.input"]
    told = {
        e.lhs[1]: e.rhs for e in step.equations if isinstance(e.lhs, tuple) and e.lhs[0] == "par"
    }
    assert [*told] == ["drag_1", "drag_3", "drag_5", "loads_1", "loads_6"]
    pulls = next(e for e in step.equations if e.lhs == "F_u")
    assert {x[1] for x in nodes(pulls.rhs) if isinstance(x, tuple) and x[0] == "par"} == {
        *("drag_1", "drag_3", "loads_6")
    }
    assert "‘drag’, what acts at r_2, in the body frame" in english(step.prose)
    assert "a covector of the state, ‘loads’, by" in english(step.prose)
    assert "‘drag’, ce qui agit en r_2" in language("fr").of(step.prose)
    _, texts = emission(p, ("c",))
    assert "drag_1 = " in texts["stated.c"]


def test_a_record_with_another_force_under_the_name_is_seen():
    """The checker has the numbers from the problem, not from the equation that says them."""
    d = walk(problem_of(STATED))
    step = d["stated.input"]
    changed = [
        replace(e, rhs=mul(-1, e.rhs)) if e.lhs == ("par", "drag_5") else e for e in step.equations
    ]
    assert Checker(d.problem, 1).check(step).holds
    assert not Checker(d.problem, 1).check(replace(step, equations=tuple(changed))).holds
