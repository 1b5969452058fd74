"""The record of a reduction: every step holds, and one that is wrong is refused."""

from dataclasses import replace

import pytest

from derive.check.checker import Checker, check
from derive.language.show import show
from derive.language.tree import mul
from derive.record.as_json import from_json, to_json
from derive.record.record import RecordError
from tests.readers.read import PAGES, faults
from tests.support.reduced import reduced
from tests.support.walks import SEED


@pytest.mark.parametrize("kind", PAGES)
@pytest.mark.parametrize("name", ["lagrange_top", "charged_body"])
def test_every_page_says_what_its_record_says(name, kind):
    assert [*faults(reduced(name).record, kind)] == []


def test_what_is_0_by_the_choice_of_horizontal_velocities_does_not_stand_in_the_routhian():
    """b(A₃₁ζ_h₁ + A₃₂ζ_h₂) is 0 where ζ_h is orthogonal to a turn about the vertical."""
    (own,) = [
        s for s in reduced("turned").record.since("momentum_1") if s.label.endswith(".effective")
    ]
    *_, whole = own.equations
    assert show(whole.rhs) == "ζ_h₁² + ζ_h₂² − 𝒱"


def test_other_fields_are_refused():
    own = reduced("lagrange_top").record
    first, second = own.problem["symmetries"]
    for fields in ([second, first], [first], [first, first]):
        wrong = replace(own, problem={**own.problem, "symmetries": fields})
        assert not all(v.holds for v in check(wrong, SEED))


@pytest.mark.parametrize(
    ("fields", "why"),
    [
        ([], "one at least"),
        ("A", "list"),
        ([["mul", "A", "Z"]], ""),
        ([["nothing"]], "symmetries 1"),
        ([0, 0, 0, 0], "one at least"),
    ],
)
def test_fields_of_another_form_are_refused(fields, why):
    own = reduced("lagrange_top").record
    text = to_json(replace(own, problem={**own.problem, "symmetries": fields}))
    if why:
        with pytest.raises(RecordError, match=why):
            from_json(text)
    else:
        assert not all(v.holds for v in check(from_json(text), SEED))


def test_fields_are_of_a_lagrangian():
    from derive.pipeline import walk
    from tests.support.walks import problem

    own = walk(problem("so3"))
    data = {**own.problem, "symmetries": reduced("lagrange_top").record.problem["symmetries"]}
    with pytest.raises(RecordError, match="of a Lagrangian"):
        from_json(to_json(replace(own, problem=data)))


def test_a_false_potential_is_refused():
    own = reduced("gyrostat").record
    step = own["effective"]
    wrong = replace(step.equations[0], rhs=mul(2, step.equations[0].rhs))
    checker = Checker(own.problem, SEED)
    assert all(checker.check(x).holds for x in own.since("momentum_1"))
    assert not checker.check(replace(step, equations=(wrong, *step.equations[1:]))).holds
