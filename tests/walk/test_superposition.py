"""What acts on a body twice pulls twice: a table, once more, adds to the rates what it added."""

import numpy as np
import pytest

from derive.problem.toml import problem_of
from tests.support.library import module_of

POINTS = [{"mass": m, "at": r} for m, r in ((1, [1, 0, 0]), (2, [0, 1, 0.5]), (1.5, [0.2, 0, -1]))]
ON = {"on": 2}
TABLES = {
    "damping": ("damping", {"coefficient": 0.3, "on": [2]}),
    "damping of all": ("damping", {"coefficient": 0.3}),
    "gravity": ("potential", {"kind": "gravity", "g": [1, 2, -9]}),
    "spring": ("potential", {"kind": "spring", **ON, "anchor": [2, 1, 1], "stiffness": 3}),
    "spring with a length": (
        "potential",
        {"kind": "spring", **ON, "anchor": [2, 1, 1], "stiffness": 3, "length": 0.5},
    ),
    "spring at a place": (
        "potential",
        {"kind": "spring", "at": [1, 1, 1], "anchor": [2, 0, 1], "stiffness": 3},
    ),
    "attraction": ("potential", {"kind": "attraction", "strength": 2, "centre": [3, 4, 5]}),
    "expression": ("potential", {"kind": "expression", "U": "r2_x^2*r3_y + sin(t)*r1_z"}),
    "force on a point": ("input", {"kind": "force", **ON}),
    "force in the body": ("input", {"kind": "force", **ON, "frame": "body"}),
    "force at a place": ("input", {"kind": "force", "at": [1, 1, 1]}),
}
STATE = [0, -1, 0, 1, 0, 0, 0, 0, 1, 0.5, -0.3, 0.2, 0.7, -0.4, 1.1, 0.3, 0.6, -0.8]


def rates(kind, table, several):
    """dx/dt with so many tables, the same numbers as inputs for each."""
    own = [table | {"name": f"f{k}"} if kind == "input" else table for k in range(several)]
    problem = problem_of({"name": "x", "group": "SE(3)", "point": POINTS, kind: own})
    space = module_of(problem)
    each = len(space.INPUTS) // several
    u = np.tile(np.linspace(1, 2, each), several)
    return space.rhs(0.3, np.array(STATE), space.constants([]), u)


@pytest.mark.parametrize("name", TABLES)
def test_the_second_of_two_adds_what_the_first_adds(name):
    kind, table = TABLES[name]
    one, two, three = (rates(kind, table, several) for several in (1, 2, 3))
    assert np.abs(two - one).max() > 1e-2
    assert np.abs((three - two) - (two - one)).max() < 1e-12
