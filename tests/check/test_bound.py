"""The bound that is told is true: no more false claims pass, counted with few numbers to draw; its
degree is of what is computed; and what is said of any group is so for every n, tried once for all
records.

The integers are of so few bits that passes happen, and the prime of as many for each of them as
ever.
"""

import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from math import sqrt
from random import Random

import pytest
import sympy

from derive.check import checker
from derive.check.checker import Checker, check
from derive.check.form.hypotheses_checked import Verdict
from derive.check.trials import trial_points
from derive.check.trials.trial_points import LEAST
from derive.check.values import residue
from derive.check.values.arithmetic import scalar
from derive.check.values.residue import Graded
from derive.language.tree import add, mul
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.mass_signs import ANY_SIGN
from derive.record.record import ANY_GROUP, Equation, RecordError
from tests.support import corpus
from tests.support.walks import SEED, record

A, B = ("par", "a"), ("par", "b")
DATA = {"name": "x", "group": "SO(2)", "parameters": {"a": {}, "b": {}}}
RECORD = walk(problem_of(DATA | {"point": [{"mass": "a", "at": ["b", 1]}]}))


def vanishing(x, several):
    """A polynomial in x that is 0 where x is one of the first integers."""
    return mul(*(add(x, -v) for v in range(several)))


FALSE = {  # a step that claims it, the claim, the bits of an integer, how often it is tried
    "many roots": ("x.motion", Equation(vanishing(A, 200), 0), 11, 60),
    "a function at two places that are often one": (
        "x.motion",
        Equation(("fun", "sin", add(vanishing(A, 200), B)), ("fun", "sin", B)),
        *(11, 100),
    ),
    "of any group": ("linear.exterior", Equation(vanishing("m", 300), 0), 32, 4),
}


@pytest.mark.parametrize("name", FALSE)
def test_no_more_pass_than_is_told(name, monkeypatch):
    """But for three standard deviations."""
    label, claim, bits, tried = FALSE[name]
    prime = residue.BITS * bits // (trial_points.SIZE.bit_length() - 1)
    for module in (checker, trial_points):
        monkeypatch.setattr(module, "SIZE", 2**bits)
    monkeypatch.setattr(
        *(trial_points, "random_prime"),
        lambda random: sympy.nextprime(random.randrange(2 ** (prime - 1), 2**prime)),
    )
    step = replace(RECORD[label], equations=(claim,), hypotheses=())
    verdicts = [Checker(RECORD.problem, seed).check(step) for seed in range(tried)]
    told = [v.bound for v in verdicts if v.holds]
    assert all("the sides differ" in v.reason for v in verdicts if not v.holds)
    most = tried * min(1, max(told, default=0))
    assert len(told) <= most + 3 * sqrt(most)


def test_a_prime_has_the_bits_that_the_bound_rests_on():
    p = residue.random_prime(Random(1))
    assert sympy.isprime(p)
    assert p.bit_length() == residue.BITS


BITS = 64
"""Of the random integers: a number of degree d in them has d times as many."""
HEAD = 'name = "large"\ngroup = "{group}"\n[parameters]\na = 1.0\n'
POINTS = """
[[point]]
mass = "{mass}"
at = ["{at}", 1]
[[point]]
mass = 2
at = [0, 1]
[[point]]
mass = 3
at = [1, 3]
"""
PLAIN = POINTS.format(mass=1, at=1)
SPRING = '[[potential]]\nkind = "spring"\n{what}\nanchor = [3, 1]\nstiffness = "{k}"\n'
LARGE = "(a^50)^12"
SOLID = "".join(
    f"[[point]]\nmass = 1\nat = {at}\n" for at in ([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1])
)
PARTS = {
    "body": POINTS.format(mass=LARGE, at=LARGE),
    "potentials": PLAIN + SPRING.format(what="on = 1", k=LARGE),
    "places": PLAIN + SPRING.format(what=f'at = ["{LARGE}", 1]', k=1),
    "damping": f'{PLAIN}[[damping]]\ncoefficient = "{LARGE}"\non = [1]\n',
    "given": '[body]\ngiven = { m = "(a^50)^4", c = ["a", 1], J = [["a", 0], [0, "3*a"]] }',
}


def walked(text, group="SE(2)"):
    return walk(problem_of(tomllib.loads(HEAD.format(group=group) + text)))


def claims(env):
    """Every name that has a value, every member of a family: that it is zero; and its values."""
    for name, value in env.names.items():
        yield Equation(name, 0), [value]
    for name, members in env.families.items():
        indices = ("i", "j")[: len(next(iter(members)))]
        yield Equation(("at", name, *indices), 0), members.values()


def height(value):
    """The least degree in the random integers that an exact number can be of, its numerator."""
    value = scalar(value)
    entries = [x for row in value for x in row] if isinstance(value, tuple) else [value]
    return max(Fraction(x).numerator.bit_length() // (BITS + 1) for x in entries)


def exceeding(d, **supposed):
    """The false claims whose degree is beyond what the checker's bound rests on."""
    checker = Checker(d.problem)
    step = replace(d["large.motion"], **{"driven": False, "hypotheses": (), **supposed})
    (group,) = checker.groups(step.scope, driven=step.driven)
    env = checker.environment(group, step, 2**BITS)
    for claim, values in claims(env):
        if max(map(height, values)) > checker.bound(replace(step, equations=(claim,))):
            yield claim.lhs


def forgetful(self, other):
    """A product that forgets the degree of a factor."""
    return self if other else Fraction(0)


@pytest.mark.parametrize("part", PARTS)
def test_no_degree_is_larger_than_that_of_the_bound(part, monkeypatch):
    """And it would be, for some name, if a product forgot a factor."""
    d, driven = walked(PARTS[part]), part == "damping"
    assert [*exceeding(d, driven=driven)] == []
    monkeypatch.setattr(Graded, "__mul__", forgetful)
    assert [*exceeding(d, driven=driven)]


def test_the_degree_of_a_body_in_principal_axes_counts(monkeypatch):
    """Points that make J diagonal are quotients of large degree."""
    d = walked(SOLID.replace("mass = 1", 'mass = "a"'), "SO(3)")
    given = d["large.principal"].given
    assert [*exceeding(d, given=given)] == []
    monkeypatch.setattr(Graded, "__mul__", forgetful)
    assert ("at", "m", "i") in [*exceeding(d, given=given)]


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


FALSE_OF_SOME_N = {
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
FALSE_OF_SOME_N |= {f"e{k} of Z, {a}": (a, symmetric(k, "Z"), 0, "sides differ")
          for a in ("linear", "affine") for k in range(2, 9)}  # fmt: skip
FALSE_OF_SOME_N |= {"e9 of Z": ("linear", symmetric(9, "Z"), 0, "degree 9"),
          "e5 of C": ("linear", symmetric(5, "C"), 0, "degree 10")}  # fmt: skip
TRUE_OF_EVERY_N = {
    "1": ("linear", ("tr", ("mul", "Z", ("one",))), ("tr", "Z")),
    "n times": ("affine", ("mul", N, ("tr", "Z")), ("mul", ("tr", "Z"), N)),
    "cyclic": (
        "linear", ("tr", ("mul", "Z", "J", "ξ", "C")), ("tr", ("mul", "J", "ξ", "C", "Z")),
    ),
    "an inverse": ("linear", ("mul", ("inv", "C"), ("T", "A")), ("inv", "A")),
}  # fmt: skip


@pytest.mark.parametrize("case", FALSE_OF_SOME_N)
def test_what_is_so_for_some_n_is_refused(case):
    action, lhs, rhs, reason = FALSE_OF_SOME_N[case]
    found = verdict(action, lhs, rhs)
    assert not found.holds
    assert re.search(reason, found.reason), found.reason


@pytest.mark.parametrize("case", TRUE_OF_EVERY_N)
def test_what_is_so_for_every_n_holds(case):
    found = verdict(*TRUE_OF_EVERY_N[case])
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
    action, lhs, rhs, _ = FALSE_OF_SOME_N[
        "e7 of Z, linear" if forgotten == "slots" else "the n that are tried first"
    ]
    whole = trial_points.sizes
    monkeypatch.setattr(
        "derive.check.checker.sizes",
        lambda grade, least: whole(grade._replace(**{forgotten: 0}), least),
    )
    assert verdict(action, lhs, rhs).holds


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
