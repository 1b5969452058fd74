"""What is said of any group is so for every n: tried for as many as its words need, or refused."""

import re
from dataclasses import replace
from fractions import Fraction

import pytest

from derive.check.checker import Checker
from derive.check.trials import trial_points
from derive.check.trials.trial_points import LEAST
from derive.record.record import Equation, RecordError
from tests.support.walks import SEED, record

N = ("tr", ("one",))


def verdict(action, lhs, rhs):
    """Of one equation about any group."""
    d = record(action)
    step = replace(d[f"{action}.energy"], equations=(Equation(lhs, rhs),))
    return Checker(d.problem, SEED).check(step)


def power_sum(k, x):
    return ("tr", ("pow", x, k)) if k > 1 else ("tr", x)


def symmetric(k, x):
    """e_k of the eigenvalues of x by Newton's identities: it vanishes for all n < k."""
    found = [1]
    for m in range(1, k + 1):
        signs = [Fraction((-1) ** (i - 1), m) for i in range(1, m + 1)]
        terms = [("mul", sign, found[m - i], power_sum(i, x)) for i, sign in enumerate(signs, 1)]
        found.append(("add", *terms) if m > 1 else terms[0])
    return found[k]


def product(*excluded):
    """Π (n − k)."""
    return ("mul", *(("add", N, -k) for k in excluded))


FALSE = {
    "three n": ("linear", product(2, 3, 4), 0, "of n alone"),
    "no dimension": ("affine", N, 4, "of n alone"),
    "axes counted": (
        "linear", ("sum", "i", ("add", 1, ("mul", 0, ("entry", "c", "i")))), N, "of n alone",
    ),
    "three n and a trace": ("linear", ("mul", product(2, 3, 4), ("tr", "Z")), 0, "independent"),
    "two n and a trace": ("linear", ("mul", product(2, 3), ("tr", "Z")), 0, "sides differ"),
    "the n that are tried first": (
        "linear", ("mul", product(2, 3, LEAST), ("tr", "Z")), 0, "independent",
    ),
    "a determinant": ("linear", ("det", "Z"), 0, "of no group but a given one"),
    "an entry by its number": ("linear", ("entry", "c", 1), 0, "of no group but a given one"),
    "an inverse of a sum": (
        "linear", ("inv", ("add", "Z", "ξ")), 0, "of no group but a given one",
    ),
}  # fmt: skip
FALSE |= {f"e{k} of Z, {a}": (a, symmetric(k, "Z"), 0, "sides differ")
          for a in ("linear", "affine") for k in range(2, 9)}  # fmt: skip
FALSE |= {"e9 of Z": ("linear", symmetric(9, "Z"), 0, "degree 9"),
          "e5 of C": ("linear", symmetric(5, "C"), 0, "degree 10")}  # fmt: skip
TRUE = {
    "1": ("linear", ("tr", ("mul", "Z", ("one",))), ("tr", "Z")),
    "n times": ("affine", ("mul", N, ("tr", "Z")), ("mul", ("tr", "Z"), N)),
    "cyclic": (
        "linear", ("tr", ("mul", "Z", "J", "ξ", "C")), ("tr", ("mul", "J", "ξ", "C", "Z")),
    ),
    "an inverse": ("linear", ("mul", ("inv", "C"), ("T", "A")), ("inv", "A")),
}  # fmt: skip


@pytest.mark.parametrize("case", FALSE)
def test_what_is_so_for_some_n_is_refused(case):
    action, lhs, rhs, reason = FALSE[case]
    found = verdict(action, lhs, rhs)
    assert not found.holds
    assert re.search(reason, found.reason), found.reason


@pytest.mark.parametrize("case", TRUE)
def test_what_is_so_for_every_n_holds(case):
    found = verdict(*TRUE[case])
    assert found.holds, found.reason


def test_so_many_n_as_the_degree_and_the_traces_of_one_ask_for():
    assert [*trial_points.sizes(trial_points.Grade(3, 2, 0))] == [LEAST]
    assert [*trial_points.sizes(trial_points.Grade(3, 15, 0))] == [8]
    assert [*trial_points.sizes(trial_points.Grade(3, 2, 2))] == [LEAST, LEAST + 1, LEAST + 2]
    for grade in ((3, 17, 0), (3, 2, 3), (0, 0, 1)):
        with pytest.raises(RecordError):
            trial_points.sizes(trial_points.Grade(*grade))


@pytest.mark.parametrize("forgotten", ["slots", "loops"])
def test_indices_and_traces_that_are_not_counted_let_it_through(monkeypatch, forgotten):
    """The tests above rest on them."""
    action, lhs, rhs, _ = FALSE[
        "e7 of Z, linear" if forgotten == "slots" else "the n that are tried first"
    ]
    whole = trial_points.sizes
    monkeypatch.setattr(
        "derive.check.checker.sizes",
        lambda grade, least: whole(grade._replace(**{forgotten: 0}), least),
    )
    assert verdict(action, lhs, rhs).holds
