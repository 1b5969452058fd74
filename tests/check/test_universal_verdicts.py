"""What held for any group is not tried again, and nothing else is answered from there."""

from dataclasses import replace

import pytest

from derive.check import checker
from derive.check.checker import check
from derive.check.verdict import Verdict
from derive.record.mass_signs import ANY_SIGN
from derive.record.record import ANY_GROUP
from tests.support import corpus
from tests.support.walks import record


@pytest.fixture
def tried(monkeypatch):
    """The labels of the steps that are tried, from nothing known on; what is not in the record of
    so3 or sl3 is refused."""
    labels, true = [], {repr(s) for name in ("so3", "sl3") for s in record(name).steps}

    def judged(_, step):
        labels.append(step.label)
        return Verdict(step.label, repr(step) in true, "", 0.0)

    monkeypatch.setattr(checker, "_UNIVERSAL", {})
    monkeypatch.setattr(checker.Checker, "check", judged)
    monkeypatch.setattr(checker.Checker, "symbols", lambda _, d: Verdict("", True, "", 0.0))
    return labels


def with_left_side(d, label, make):
    """The record whose step has another left side of its first equation."""
    step = d[label]
    first, *rest = step.equations
    forged = replace(step, equations=(replace(first, lhs=make(first.lhs)), *rest))
    return replace(d, steps=tuple(forged if s is step else s for s in d.steps))


def labels_of(d, *, universal):
    return [s.label for s in d.steps if (s.scope == ANY_GROUP) == universal]


def test_a_second_record_is_tried_where_it_has_its_own(tried):
    check(record("so3"))
    tried.clear()
    assert all(v.holds for v in check(record("sl3")))
    again = labels_of(record("so3"), universal=True)
    assert [x for x in tried if x in again] == []
    assert set(labels_of(record("sl3"), universal=False)) <= {*tried}


def test_a_forged_step_is_tried_and_refused_each_time(tried):
    d, label = record("so3"), "linear.distances"
    check(d)
    forged = with_left_side(d, label, lambda x: ("add", x, 1))
    for _ in range(2):
        tried.clear()
        assert [v.label for v in check(forged) if not v.holds] == [label]
        assert [x for x in tried if x in labels_of(d, universal=True)] == [label]


def test_what_python_takes_to_be_equal_is_another_step(tried):
    """1 and True: equal, and of one hash."""
    d, label = record("so3"), "linear.distances"
    check(with_left_side(d, label, lambda x: ("mul", 1, x)))
    tried.clear()
    check(with_left_side(d, label, lambda x: ("mul", True, x)))
    assert label in tried


def test_of_masses_of_any_sign_it_is_tried_again(tried):
    """What supposes positive masses is false there, though it held for another record."""
    check(record("so3"))
    tried.clear()
    signed = replace(record("so3"), problem={**record("so3").problem, "masses": ANY_SIGN})
    check(signed)
    supposing = {s.label for s in signed.steps if s.scope == ANY_GROUP and s.hypotheses}
    assert supposing
    assert supposing <= {*tried}


def test_a_verdict_is_the_same_whichever_record_comes_first(monkeypatch):
    """Its bound too: nothing is in it of what a problem alone has, such as a lattice."""
    torus, other = corpus.record("torus 3"), corpus.record("lagrangian right")
    monkeypatch.setattr(checker, "_UNIVERSAL", {})
    for label in labels_of(torus, universal=True)[:3]:
        first, again = (checker.checker_of(d.problem, 1) for d in (other, torus))
        assert checker._verdict(first, other[label]) == again.check(torus[label])
