"""What a wrong rule of the engine does to a record, and claims that say nothing, are refused."""

from dataclasses import replace
from functools import cache

import pytest

from derive import pipeline
from derive.algebra import calculus, forms, words
from derive.algebra import word_trees as notation
from derive.check.checker import Checker, check, checker_of
from derive.command.showing import load_problem
from derive.language.tree import mul, neg
from derive.pipeline import walk
from derive.record.record import Equation
from derive.walk.chapter import WalkError
from derive.walk.spine import lagrangian
from tests.support.walks import SEED, record

pytestmark = pytest.mark.no_cover


@pytest.fixture(autouse=True)
def afresh(monkeypatch):
    """A wrong rule must neither find what the right ones left nor leave anything."""
    monkeypatch.setattr(pipeline, "general_road", pipeline.general_road.__wrapped__)


@cache
def checker(name):
    return checker_of(record(name).problem, SEED)


def test_a_wrong_scope_is_refused():
    step = record("so3")["so3.exterior"]
    assert not checker("so3").check(replace(step, scope="any group")).holds
    assert not checker("so3").check(replace(step, scope="SL(3)")).holds


@pytest.mark.parametrize("k", [0, 1, 2, 3])
def test_a_name_that_nothing_introduces_is_refused(k):
    """Without Z = j(ζ), say: every equation that is left is true."""
    d = record("so3")
    step = d["so3.hat"]
    name = step.equations[k].rhs[1]
    fewer = replace(step, equations=step.equations[:k] + step.equations[k + 1 :])
    wrong = replace(d, steps=tuple(fewer if s is step else s for s in d.steps))
    first = next(v for v in check(wrong)[1:] if not v.holds)
    assert first.reason.startswith(f"{name} is used, and neither this step nor one before it says")


# -- wrong rules in the engine ------------------------------------------------------------------


def wrong_structure(monkeypatch):
    right = forms.structure_equation
    monkeypatch.setattr(forms, "structure_equation", lambda *a: -right(*a))


def wrong_product_rule(monkeypatch):
    right = calculus.leibniz

    def wrong(w, delta):
        """Leave out the last factor's turn whenever an earlier factor varies."""
        kept = right(w[:-1], delta) if len(w) > 1 else None
        if kept is None:
            return right(w, delta)
        return kept * words.expr_of_word(w[-1:])

    monkeypatch.setattr(calculus, "leibniz", wrong)


def wrong_transpose(monkeypatch):
    right = words.transpose_word

    def wrong(w):
        """Bar each factor of a product of square letters (no j's) without turning the order."""
        sign, turned = right(w)
        square = all(x.rows == x.cols and x.axis is None for x, _ in w)
        return sign, turned[::-1] if square else turned

    for module in (words, calculus, notation, lagrangian):
        if hasattr(module, "transpose_word"):
            monkeypatch.setattr(module, "transpose_word", wrong)


@pytest.mark.parametrize("name", ["linear", "affine", "so3", "se3", "sl3"])
@pytest.mark.parametrize("rule", [wrong_structure, wrong_product_rule, wrong_transpose])
def test_a_wrong_rule_changes_the_equations_and_is_refused(name, rule, monkeypatch):
    right = record(name)
    with monkeypatch.context() as patched:
        rule(patched)
        try:
            wrong = walk(load_problem(name))
        except WalkError:
            return  # the equations became such that no kernel can be read off them
    changed = {
        s.label for s, r in zip(wrong.steps, right.steps, strict=True) if s.equations != r.equations
    }
    assert changed
    assert refused(wrong, changed)


def refused(record, labels):
    """Those of some steps that do not hold."""
    checker = Checker(record.problem, SEED)
    return {x for x in labels if not checker.check(record[x]).holds}


# the steps in which the bracket must be seen: it makes Euler's equations what they are
BRACKETS = {
    "linear": {"linear.structure", "linear.exterior_trivialised"},
    "so3": {"so3.exterior", "so3.hat", "so3.exterior_vector", "so3.kernel", "so3.euler",
            "so3.principal", "so3.motion"},
    "se3": {"se3.exterior", "se3.hat", "se3.exterior_vector", "se3.kernel", "se3.motion"},
}  # fmt: skip


@pytest.mark.parametrize("name", BRACKETS)
def test_the_bracket_comes_from_the_structure_equation(name, monkeypatch):
    with monkeypatch.context() as patched:
        wrong_structure(patched)
        wrong = walk(load_problem(name))
    assert refused(wrong, BRACKETS[name]) == BRACKETS[name]


def test_a_wrong_work_of_the_forces_is_seen(monkeypatch):
    right = lagrangian._gradient

    def turned(*given):
        work, step = right(*given)
        return -work, step

    with monkeypatch.context() as patched:
        patched.setattr(lagrangian, "_gradient", turned)
        wrong = walk(load_problem("so3"))
    seen = {"linear.exterior", "linear.kernel", "so3.exterior", "so3.kernel"}
    assert refused(wrong, seen) == seen


# -- records that say something else ------------------------------------------------------------


def equations(*pairs):
    return tuple(Equation(*pair) for pair in pairs)


EMPTY = {
    "nothing": ((0, 0),),
    "itself": (("ζ̇", "ζ̇"),),
    "zeroth power": ((("pow", "t", 0), "t"),),
    "half power": ((("pow", "t", "5/2"), ("pow", "t", 2)),),
    "a great power": ((("pow", "t", 10**9), 0),),
    "entry zero": ((("entry", "ζ", 0), ("entry", "ζ", 3)),),
    "not square": ((("det", ("matrix", ("row", 1, 2))), 1),),
    "a large determinant": ((("det", ("matrix", *[("row", *[1] * 13)] * 13)), 0),),
    "ragged": ((("matrix", ("row", 1, 2), ("row", 3)), "J"),),
    "an input that is not there": ((("mul", 0, "u"), 0),),
    "a tangent vector too long": ((("call", "dŨ", "δA", "δA"), ("call", "dŨ", "δA")),),
}  # fmt: skip


@pytest.mark.parametrize("case", EMPTY)
def test_meaningless_claims_are_refused(case):
    wrong = replace(record("so3")["so3.euler"], equations=equations(*EMPTY[case]))
    verdict = checker("so3").check(wrong)
    assert not verdict.holds
    assert "\n" not in verdict.reason


def test_a_claim_about_the_points_that_were_drawn_is_refused():
    """They are drawn from a hash of the record, too, which such a claim changes."""
    d = record("so3")
    known = checker("so3")
    before = known.environment(known.groups("SO(3)")[0], d["so3.euler"])
    wrong = replace(d["so3.euler"], equations=equations(("t", before.names["t"])))
    assert known.check(wrong).holds
    changed = replace(d, steps=(*d.steps[:-1], wrong))
    assert not check(changed, SEED)[-1].holds


def test_the_input_cannot_be_dropped_with_its_assumption():
    d = record("so3")
    step = replace(d["so3.motion"], driven=False)
    assert not checker("so3").check(step).holds


@pytest.mark.parametrize("dimension", [2, 3])
def test_identities_of_small_matrices_are_no_claims_about_any_group(dimension):
    """Cayley–Hamilton for 2 × 2 and 3 × 3 matrices is false for some group."""
    square = ("pow", "Z", 2)
    trace, half = ("tr", "Z"), ("div", ("add", ("pow", ("tr", "Z"), 2), neg(("tr", square))), 2)
    small = ("add", mul(trace, "Z"), neg(mul(half, ("one",))))
    large = ("add", mul(trace, square), neg(mul(half, "Z")), mul(("det", "Z"), ("one",)))
    claim = Equation(*((square, small) if dimension == 2 else (("pow", "Z", 3), large)))
    step = replace(record("linear")["linear.kernel"], equations=(claim,))
    assert not checker("linear").check(step).holds


def test_translations_that_are_not_free_are_among_the_trial_groups():
    """The equations of an affine group hold jointly, not one for A and one for T."""
    step = record("affine")["affine.kernel"]
    whole = step.equations[-1]
    assert whole.for_all == ("δ′A", "δ′T")
    for part in whole.lhs[1:]:
        assert not checker("affine").check(replace(step, equations=(Equation(part, 0),))).holds
