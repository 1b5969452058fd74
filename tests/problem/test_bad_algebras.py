"""What is wrong in an algebra without a group, or in what it carries: one line that says it."""

import pytest

from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of

TURNING = {"brackets": [[1, 2, 3, 1], [2, 3, 1, 1], [3, 1, 2, 1]]}
SQUARE = {"L": "zeta_1^2 + zeta_2^2 + zeta_3^2"}
GAMMA = {"name": "gamma", "representation": "coadjoint"}
EYE = [[1, 0], [0, 1]]

ALGEBRAS = {
    "nothing": ({}, "algebra: give one of of, basis, brackets"),
    "two": (TURNING | {"of": "SO(3)"}, "algebra: give one of of, basis, brackets"),
    "no table": ("so(3)", "algebra: expected a table of"),
    "another key": (TURNING | {"bracket": 1}, "unknown key 'bracket'; did you mean 'brackets'?"),
    "no group": ({"of": "SO(33)"}, "algebra, of: "),
    "no list": ({"brackets": 1}, "key 'brackets' must be a list"),
    "a short row": ({"brackets": [[1, 2, 3]]}, "row 1: expected [a, b, k, c]"),
    "no number": ({"brackets": [[1, 2, 3, "a"]]}, "row 1: the coefficient must be a rational"),
    "no index": ({"brackets": [[0, 2, 3, 1]]}, "row 1: expected an integer from 1 to"),
    "with itself": ({"brackets": [[1, 1, 2, 1]]}, "[E_1, E_1] must be 0, not 1 E_2"),
    "two rows": (
        {"brackets": [[1, 2, 3, 1], [2, 1, 3, 1]]},
        "not antisymmetric: [E_2, E_1] has 1 E_3, and by another row -1 E_3",
    ),
    "Jacobi": (
        {"brackets": [[1, 2, 3, 1], [2, 3, 2, 1], [3, 1, 2, 1]]},
        "Jacobi's identity fails for E_1, E_2, E_3",
    ),
    "too small": (TURNING | {"dimension": 2}, "brackets: E_3, of 2 elements"),
    "too large": (TURNING | {"dimension": 101}, "from 1 to 100"),
    "no dimension": (TURNING | {"dimension": 0}, "dimension: expected an integer from 1"),
    "a dimension beside": ({"of": "SO(3)", "dimension": 3}, "it goes with 'brackets'"),
    "open": ({"basis": [[[0, 1], [0, 0]], [[0, 0], [1, 0]]]}, "algebra, basis: not a Lie algebra"),
}


@pytest.mark.parametrize("name", ALGEBRAS)
def test_algebra(name):
    table, said = ALGEBRAS[name]
    with pytest.raises(ProblemError) as error:
        problem_of({"name": "test", "algebra": table, "lagrangian": SQUARE})
    assert said in str(error.value)
    assert "\n" not in str(error.value)


ADVECTED = {
    "no table": (["gamma"], "must be tables [[advected]]"),
    "no name": ([{"representation": "adjoint"}], "advected 1: key 'name' is missing"),
    "a taken name": ([GAMMA | {"name": "zeta"}], "'zeta' names something else"),
    "twice": ([GAMMA, GAMMA], "advected 2: 'gamma' names something else"),
    "no standard": ([{"name": "gamma"}], "an algebra by brackets has no 'standard'"),
    "unknown": ([GAMMA | {"representation": "trivial"}], "must be one of standard, dual, adjoint"),
    "two matrices": ([GAMMA | {"representation": [EYE, EYE]}], "a list of 3 matrices"),
    "no square": ([GAMMA | {"representation": [EYE, EYE, [[1, 0]]]}], "matrix 3: expected a 2 × 2"),
    "none": (
        [GAMMA | {"representation": [EYE, EYE, EYE]}],
        "no representation: the commutator of the matrices of E_1 and E_2",
    ),
}


@pytest.mark.parametrize("name", ADVECTED)
def test_advected(name):
    tables, said = ADVECTED[name]
    data = {"name": "test", "algebra": TURNING, "lagrangian": SQUARE, "advected": tables}
    with pytest.raises(ProblemError) as error:
        problem_of(data)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


OTHERS = {
    "a group beside": ({"group": "SO(3)"}, "give either 'group' or [algebra]"),
    "no Lagrangian": ({"lagrangian": None}, "an algebra moves no points: give a [lagrangian]"),
    "an entry of g": (
        {"lagrangian": {"L": SQUARE["L"] + " - A_33"}},
        "the state of this algebra has no A_33; its entries are",
    ),
    "points": ({"point": [{"mass": 1, "at": [1, 0, 0]}]}, "key 'point'"),
    "a parameter": ({"parameters": {"gamma_1": 1}}, "parameter 'gamma_1': an entry of the state"),
    "an entry outside": ({"lagrangian": {"L": SQUARE["L"] + " - gamma_4"}}, "'gamma_4' is not"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_beside(name):
    more, said = OTHERS[name]
    data = {"name": "test", "algebra": TURNING, "advected": [GAMMA], "lagrangian": SQUARE} | more
    with pytest.raises(ProblemError) as error:
        problem_of({k: x for k, x in data.items() if x is not None})
    assert said in str(error.value)


def test_advected_without_an_algebra():
    with pytest.raises(ProblemError, match=r"goes with \[algebra\]"):
        problem_of({"name": "t", "group": "SO(3)", "advected": [GAMMA], "lagrangian": SQUARE})
