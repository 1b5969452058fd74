"""Code that would be too large for compilers is refused before it is made, with the numbers."""

import pytest

from derive import Gravity, Moments, Problem, derive
from derive.code.program import LoweringError

CHANGES_THE_ENGINE = True


def of(group):
    n = int(group[group.index("(") + 1 : -1])
    return derive(Problem("large", group, Moments(), [Gravity(*[0] * (n - 1), -9)]))


@pytest.mark.parametrize(("group", "entries"), [("Aff(8)", 20736), ("Sim(8)", 5476)])
def test_a_large_matrix_is_refused_at_once(group, entries):
    with pytest.raises(
        LoweringError, match=f"a matrix of {entries} entries .* compilers manage 4000"
    ):
        of(group).emit(None, ("c",), jacobian="state")


def test_too_many_operands_are_refused(monkeypatch):
    monkeypatch.setattr("derive.code.graph.OPERANDS", 500)
    with pytest.raises(LoweringError, match="more than 500 operands, too many for compilers"):
        of("Sim(3)").emit(None, ("c",))
    monkeypatch.undo()
    assert of("Sim(3)").emit(None, ("c",))


def test_a_large_matrix_by_parameters_is_refused_at_once():
    with pytest.raises(LoweringError, match="jacobian parameters is a matrix of 6480"):
        of("Aff(8)").emit(None, ("c",), jacobian="parameters")
    assert of("SE(3)").emit(None, ("c",), jacobian="parameters")
