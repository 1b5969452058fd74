"""A wrong rule of the engine is an error that names the step, or is refused as its record is;
claims that say nothing are refused."""

import re
import sys
from dataclasses import replace
from functools import cache

import pytest

from derive import pipeline
from derive.algebra import calculus
from derive.algebra.words import word
from derive.check.checker import check, checker_of
from derive.command.showing import load_problem
from derive.language.tree import mul, neg
from derive.pipeline import general_road, walk
from derive.problem.problem import ProblemError
from derive.record.record import Equation
from derive.walk.chapter import WalkError, naming_steps
from derive.walk.matrices import rotation
from derive.walk.spine import cartan
from derive.walk.spine.alphabet import Alphabet
from derive.walk.spine.kernel import restrict
from tests.support.walks import SEED, record


@pytest.fixture(autouse=True)
def afresh(monkeypatch):
    """A wrong rule must neither find what the right ones left nor leave anything."""
    monkeypatch.setattr(pipeline, "general_road", pipeline.general_road.__wrapped__)


@cache
def checker(name):
    return checker_of(record(name).problem, SEED)


@pytest.mark.no_cover
def test_a_wrong_scope_is_refused():
    step = record("so3")["so3.exterior"]
    assert not checker("so3").check(replace(step, scope="any group")).holds
    assert not checker("so3").check(replace(step, scope="SL(3)")).holds


@pytest.mark.no_cover
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


# -- records that say something else ------------------------------------------------------------


def equations(*pairs):
    return tuple(Equation(*pair) for pair in pairs)


SENSELESS = [
    ("J", 2, "do not add"),
    (("tr", ("mul", "ζ", ("T", "c"))), 0, "differ"),
    (("tr", "c"), 0, "trace of a matrix that is not square"),
    (("inner", "t", "c"), 0, "inner product of a scalar and a matrix"),
    (("inner", "t", "t"), 0, "numbers have no inner product"),
    (("tr", "m"), "m", "trace of a number"),
    (("T", "m"), "m", "transpose of a number"),
    (("entry", ("T", "c"), "i"), ("T", "c"), "a vector has entries of one index"),
    (("T", "c"), "c", "a 1×3 matrix and a 3×1 matrix"),
    (("add", "Z", ("mul", -1, "Z")), ("add", "t", ("mul", -1, "t")), "a 3×3 matrix and a number"),
    (("mul", "c", "c"), 0, "have no product"),
    (("bracket", "Z", "c"), 0, "have no product"),
    (("div", "t", "c"), 0, "in the place of a number"),
    (("hat", "Z"), 0, "in the place of a vector of space"),
    (("inner", "Z", "c"), 0, "have no inner product"),
    (("matrix", ("row", "c")), 0, "in the place of a number"),
    (("inv", ("matrix", ("row", 1, 1), ("row", 1, 1))), 0, "singular"),
    (("entry", "t", 1), 0, "entries of matrices and vectors"),
    (("at", "q", 1), 0, "no member"),
    (("at", "q", "i"), 0, "no members of"),
    (("call", "q", "t"), 0, "no function"),
    (0, 0, ""),
    ("ζ̇", "ζ̇", ""),
    (("pow", "t", 0), "t", ""),
    (("pow", "t", "5/2"), ("pow", "t", 2), ""),
    (("pow", "t", 10**9), 0, ""),
    (("entry", "ζ", 0), ("entry", "ζ", 3), ""),
    (("det", ("matrix", ("row", 1, 2))), 1, ""),
    (("det", ("matrix", *[("row", *[1] * 13)] * 13)), 0, ""),
    (("matrix", ("row", 1, 2), ("row", 3)), "J", ""),
    (("mul", 0, "u"), 0, ""),
    (("call", "dŨ", "δA", "δA"), ("call", "dŨ", "δA"), ""),
]
"""Two sides, and a reason."""


@pytest.mark.parametrize(("lhs", "rhs", "reason"), SENSELESS, ids=str)
def test_a_claim_without_meaning_is_refused(lhs, rhs, reason):
    sides = ("add", lhs, rhs) if reason == "do not add" else lhs
    wrong = replace(record("so3")["so3.euler"], equations=equations((sides, rhs)))
    verdict = checker("so3").check(wrong)
    assert not verdict.holds
    assert re.search(reason, verdict.reason), verdict.reason
    assert "\n" not in verdict.reason


@pytest.mark.no_cover
def test_a_claim_about_the_points_that_were_drawn_is_refused():
    """They are drawn from a hash of the record, too, which such a claim changes."""
    d = record("so3")
    known = checker("so3")
    before = known.environment(known.groups("SO(3)")[0], d["so3.euler"])
    wrong = replace(d["so3.euler"], equations=equations(("t", before.names["t"])))
    assert known.check(wrong).holds
    changed = replace(d, steps=(*d.steps[:-1], wrong))
    assert not check(changed, SEED)[-1].holds


@pytest.mark.no_cover
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


@pytest.mark.no_cover
def test_translations_that_are_not_free_are_among_the_trial_groups():
    """The equations of an affine group hold jointly, not one for A and one for T."""
    step = record("affine")["affine.kernel"]
    whole = step.equations[-1]
    assert whole.for_all == ("δ′A", "δ′T")
    for part in whole.lhs[1:]:
        assert not checker("affine").check(replace(step, equations=(Equation(part, 0),))).holds


def forgetful(w, k, image):
    """The product rule, that forgets what stands after the letter."""
    return right_product(w[: k + 1], k, image)


right_product = calculus._apply_at
right_rule = cartan.body_rule


def unbarred(a, C):
    """The rule of what g leaves in the body, a bar forgotten."""
    right = right_rule(a, C)

    def rule(left, other):
        image = right(left, other)
        return image.bar if image is not None and left[0] in (a.N, a.F) else image

    return rule


@pytest.mark.parametrize("name", ["linear", "affine", "so3", "sl3"])
def test_a_product_rule_that_forgets_a_factor(name, monkeypatch):
    monkeypatch.setattr(calculus, "_apply_at", forgetful)
    action = "affine" if name == "affine" else "linear"
    where = r"lagrangian\.lagrangian, lagrangian\.velocities: ValueError"
    told(name, rf"step .*{action}\.velocity \(variation\), in {where}")


@pytest.mark.parametrize("name", ["affine", "se3"])
def test_a_body_rule_that_is_not_barred(name, monkeypatch):
    for module in sys.modules.values():
        if getattr(module, "body_rule", None) is right_rule:
            monkeypatch.setattr(module, "body_rule", unbarred)
    where = r"cartan\.trivialise, .*at_identity: V"
    told(name, rf"after the step affine\.trivialisation \(triv.*\), in {where}")


def test_a_letter_without_an_image(monkeypatch):
    """A bare KeyError on the road of one group, in words."""

    def absent(*given):
        return {}["w"]

    monkeypatch.setattr(rotation, "metrics", absent)
    told("so3", r"step so3\.energy \(identification\), in rotation\.energy_step: KeyError: 'w'")


def test_what_is_wrong_with_a_problem_is_no_error_of_the_engine():
    problem = load_problem("so3")
    with pytest.raises(ProblemError):
        failing(problem)


@naming_steps()
def failing(problem):
    raise ProblemError(problem.name)


def test_a_momentum_that_moves_with_the_group_is_not_restricted_in_silence():
    """Its variation would be lost: a gyroscopic term N̄A, say."""
    a = Alphabet("n", affine=False)
    form = general_road(affine=False)["momenta"].form
    values = {a.Pi.momentum: word(a.N).bar * word(a.A.position), a.Pi.force: word(a.N_body)}
    with pytest.raises(ValueError, match=r"Π has [AN], whose variation is not known"):
        restrict(form, values, a)


def told(name, where):
    """The message of a walk that breaks, and what broke it."""
    with pytest.raises(WalkError, match=where) as caught:
        walk(load_problem(name))
    assert isinstance(caught.value.__cause__, (ValueError, KeyError))
