"""The record of the symmetries: every step holds, and a symmetry that is none is refused."""

from dataclasses import replace

import pytest

from derive.check.checker import Checker
from derive.language.tree import add, mul
from derive.record.record import Equation
from tests.support.symmetric import found
from tests.support.walks import SEED


def refused(step, **changes):
    """The verdict on a changed step."""
    checker = Checker(found("free").record.problem, SEED)
    assert checker.check(step).holds
    return checker.check(replace(step, **changes))


AN_ENTRY = ("entry", "A", 1, 1)


def boost():
    """The first step of a boost."""
    kinds = [x.kind for x in found("free").found.symmetries]
    return found("free").record[f"conserved_{kinds.index('boost') + 1}"]


def test_another_field_is_refused():
    step = boost()
    time, moved = step.given
    other = Equation("δA", mul(2, moved.rhs))
    assert not refused(step, given=(time, other)).holds
    skew = Equation("δA", mul("A", "A"))
    equations = tuple(skew if e == moved else e for e in step.equations)
    assert "tangent" in refused(step, given=(time, skew), equations=equations).reason


@pytest.mark.parametrize("k", range(2, 5))
def test_another_equation_is_refused(k):
    step = boost()
    e = step.equations[k]
    inside = e.lhs[2] if k == 4 else None
    wrong = replace(e, rhs=add(e.rhs, AN_ENTRY)) if e.rhs != 0 else None
    if wrong is None:
        wrong = replace(e, lhs=("call", "d/dt", add(inside, AN_ENTRY)))
    equations = (*step.equations[:k], wrong, *step.equations[k + 1 :])
    assert not refused(step, equations=equations).holds


def test_the_cocycle_is_refused_where_it_is_another():
    record = found("free").record
    step = next(s for s in record.steps if "_and_" in s.label)
    wrong = replace(step.equations[-1], rhs=mul(2, step.equations[-1].rhs))
    assert not refused(step, equations=(*step.equations[:-1], wrong)).holds


def test_a_field_is_of_t_and_A_alone():
    step = boost()
    time, _ = step.given
    other = Equation("δA", mul("A", "Z"))
    assert "function of t and A" in refused(step, given=(time, other)).reason
