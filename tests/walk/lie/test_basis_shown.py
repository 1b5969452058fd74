"""The matrices of the basis stand beside its brackets, where the problem has them."""

import pytest

from derive.algebra.families import group
from derive.language import rational as q
from derive.pipeline import walk
from derive.problem.toml import problem_of
from tests.support.lagrangians import squares

HEISENBERG = [q.unit(3, *at) for at in ((0, 1), (1, 2), (0, 2))]
LISTS = [[[int(x) for x in row] for row in e] for e in HEISENBERG]
L = {"lagrangian": {"L": squares(1, 2, 3)}}
GIVEN = {
    "a family": ({"group": "SL(2)"}, group("SL(2)").basis),
    "its algebra": ({"algebra": {"of": "SL(2)"}}, group("SL(2)").basis),
    "rotations": ({"algebra": {"of": "SO(3)"}}, group("SO(3)").basis),
    "a basis": ({"group": {"name": "H", "basis": LISTS}}, HEISENBERG),
    "its algebra by a basis": ({"algebra": {"basis": LISTS}}, HEISENBERG),
    "brackets": ({"algebra": {"brackets": [[1, 2, 3, 1]]}}, []),
    "what is carried": ({"algebra": {"of": "SL(2)"}, "advected": [{"name": "v"}]}, []),
}


@pytest.mark.parametrize("name", GIVEN)
def test_as_matrices(name):
    data, basis = GIVEN[name]
    d = walk(problem_of({"name": "x", **data, **L}))
    shown = {e.lhs[2]: e.rhs for e in d["x.algebra"].equations if e.lhs[0] == "at"}
    matrices = {a: tuple(tuple(row[1:]) for row in rhs[1:]) for a, rhs in shown.items()}
    assert matrices == dict(enumerate(map(q.matrix, basis), 1))
