"""What is said of equilibria is computed again: no other value, verdict or point passes."""

from contextlib import suppress
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from functools import cache
from random import Random

import numpy as np
import pytest

from derive import derive
from derive.check.checker import ClaimChecker
from derive.check.claims.enclosure import not_real_and_not_positive
from derive.check.claims.spectra_and_residues import (
    characteristic,
    distinct_roots,
    grows,
    negative_or_zero,
    real_and_not_positive,
    signature,
)
from derive.check.form.hypotheses_checked import IMPOSSIBLE
from derive.command.showing import load_problem
from derive.language import intervals, univariate
from derive.language.intervals import Interval
from derive.language.show import show
from derive.language.tree import add, mul, neg, nodes, replaced
from derive.language.univariate import root
from derive.record.sentence import CLAIMS, Claim, rendered
from derive.search.equilibria import stability
from derive.searches import families
from tests.check.test_record_claims import EQUILIBRIA, changes, said
from tests.support.lagrangians import (
    SPIRAL,
    bent,
    disc,
    every_equilibrium,
    heavy,
    lagrangian,
    squares,
)
from tests.support.walks import SEED

EXACT = ("stable", "stable_beyond", "stable_compact", "on_the_leaf", "point", "undecided")
VERDICTS = {
    *(f"equilibrium.{x}" for x in (*EXACT, "unstable", "unstable_beyond", "open")),
    *(f"enclosure.{x}" for x in ("stable", "unstable", "open")),
}


@cache
def records():
    return [x.record for x in every_equilibrium()]


def made():
    """A judge of steps, a step and each of its claims about an equilibrium."""
    for record in records():
        judge = ClaimChecker(record, SEED).fault
        for step in record.steps:
            for claim in step.claims:
                if claim.kind.startswith(EQUILIBRIA):
                    yield judge, step, claim


def refused(reason):
    """Is a claim refused for what it claims, not for a sentence that is none?"""
    return reason.startswith("the claim") and "sentences say" not in reason


def exchanged(step, old, new):
    """A step with another claim in the place of one, and its sentence."""
    prose, claims = (
        tuple(there if x == here else x for x in found)
        for found, here, there in (
            (step.prose, rendered(old), rendered(new)),
            (step.claims, old, new),
        )
    )
    return replace(step, prose=prose, claims=claims)


def test_every_kind_is_made():
    kinds = {claim.kind for _, _, claim in made()}
    assert kinds == {x for x in CLAIMS if x.startswith(EQUILIBRIA)}


def test_claims_hold():
    assert not any(judge(step) for judge, step, _ in made())


def test_another_value_is_refused():
    seen = set()
    for judge, step, claim in made():
        for wrong in changes(claim):
            assert refused(judge(said(step, claim, wrong))), wrong
            seen.add(claim.kind)
    assert len(seen) == 16


def test_another_verdict_is_refused():
    for judge, step, claim in made():
        label = claim.kind.partition(".")[0]
        for kind in VERDICTS - {claim.kind} if claim.kind in VERDICTS else ():
            if kind.startswith(label):
                told = dict(claim.values).get("polynomial", ("pow", "λ", 2))
                values = (("polynomial", told),) if kind in COUNTED else ()
                assert refused(judge(exchanged(step, claim, Claim(kind, values)))), kind


COUNTED = ("equilibrium.unstable", "equilibrium.unstable_beyond", "equilibrium.open")


def test_a_verdict_is_not_left_out():
    left_out = 0
    for judge, step, claim in made():
        if claim.kind in VERDICTS:
            few = tuple(x for x in step.claims if x.kind in SPOKEN)
            found = judge(replace(step, prose=(*map(rendered, few),), claims=few))
            assert "what follows of the stability" in found or "no step says" in found
            left_out += 1
    assert left_out > 10


SPOKEN = (
    *("equilibrium.at", "equilibrium.origin", "equilibrium.form", "equilibrium.none"),
    *("equilibrium.orbit", "enclosure.within", "enclosure.signs"),
)


OPPOSITES = {"along": "against", "lowest": "highest"}
OPPOSITES |= {y: x for x, y in OPPOSITES.items()}


def test_no_body_points_or_hangs_the_other_way():
    seen = set()
    for judge, step, claim in made():
        subject, _, kind = claim.kind.partition(".")
        if subject == "position":
            assert not judge(step)
            word, _, end = kind.partition("_")
            other = Claim(f"position.{OPPOSITES[word]}{end and '_'}{end}", claim.values)
            assert refused(judge(exchanged(step, claim, other))), claim
            seen.add(kind)
    assert seen == {*OPPOSITES, "along_of", "against_of", "lowest_near", "highest_near"}


def test_decimals_are_near_a_position_and_no_other_point_is():
    for judge, step, claim in made():
        if claim.kind.startswith(("position.lowest", "position.highest")):
            near = claim.kind.endswith("_near")
            kind = claim.kind.removesuffix("_near") if near else f"{claim.kind}_near"
            assert "decimals are near" in judge(exchanged(step, claim, Claim(kind)))


def test_no_other_body_of_a_product_points_there():
    """A body's number is told where there are several, and no other one."""
    (own,) = {judge: 0 for judge, step, x in made() if x.kind == "position.along_of"}
    for judge, step, claim in made():
        if judge == own and claim.kind == "position.along_of":
            few = Claim("position.along", claim.values[:2])
            assert "of which body" in judge(exchanged(step, claim, few))


@pytest.mark.parametrize(("potential", "kinds"), [("", 4), ("mgl*A_33", 2), ("A_33 + A_33^2", 2)])
def test_a_body_hangs_where_its_weight_has_a_sign_and_is_linear(potential, kinds):
    """That of the top has π."""
    letters = "mgl" if "mgl" in potential else ""
    problem = heavy("112", potential, letters) if potential else load_problem("top")
    record = families(problem, 4, at_defaults=not potential)[1]
    judge = ClaimChecker(record, SEED)
    made = [(s, x) for s in record.steps for x in s.claims if x.kind.startswith("position.")]
    assert len({x.kind for _, x in made}) == kinds
    for step, claim in made:
        assert not judge.fault(step)
        for kind in ("lowest", "highest"):
            if potential or claim.kind == f"position.{OPPOSITES[kind]}":
                wrong = exchanged(step, claim, Claim(f"position.{kind}"))
                assert refused(judge.fault(wrong)), (claim, kind)


def test_eigenvalues_are_rounded_to_the_nearest():
    """Complex ones, too, as ±0.4908 ±0.4224i."""
    unitary = derive(lagrangian(squares(1, 2, 3, 4) + " - A_11", "U(2)")).equilibria().record
    judge, seen = ClaimChecker(unitary, SEED).fault, 0
    own = [(judge, step, claim) for step in unitary.steps for claim in step.claims]
    for judge, step, claim in (*made(), *own):
        if claim.kind == "equilibrium.eigenvalues":
            assert not judge(step)
            for wrong in shifted(claim):
                assert "nearest" in judge(said(step, claim, wrong)), wrong
                seen += 1
    assert seen == 26


def test_real_eigenvalues_near_a_point_are_not_imaginary():
    for judge, step, claim in made():
        if claim.kind == "enclosure.eigenvalues":
            rows = [("row", im, re) for _, re, im in claim["eigenvalues"][1:]]
            wrong = Claim(claim.kind, (("eigenvalues", ("matrix", *rows)),))
            assert "one is no eigenvalue" in judge(said(step, claim, wrong))


def test_no_eigenvalue_near_another_is_left_out():
    """Upright a body of moments 1 and 1.003 has ±1 and ±0.9985, of which neither stands for both,
    nor for what lies between."""
    record = derive(heavy(("1", "1.003", "2"), "A_33", "")).equilibrium_near({"A_33": 1}).record
    judge, step = ClaimChecker(record, SEED).fault, record["enclosure_1"]
    (claim,) = (x for x in step.claims if x.kind == "enclosure.eigenvalues")
    one, other, *zero = claim["eigenvalues"][1:]
    assert not judge(step)
    assert (one, other, *zero) == (real(1), real(Fraction(1997, 2000)), real(0))
    between = real(Fraction(9993, 10**4))
    for rows, reason in (
        *(((x, *zero), "not all") for x in (one, other)),
        *(((x, between, *zero), "no eigenvalue") for x in (one, other)),
        *(((one, other), "not all"), ((one, other, *zero, between), "no eigenvalue")),
    ):
        wrong = Claim(claim.kind, (("eigenvalues", ("matrix", *rows)),))
        assert reason in judge(said(step, claim, wrong)), rows


def real(x):
    """A real eigenvalue, and its opposite."""
    return ("row", x, 0)


def shifted(claim):
    """The claim with a part of an eigenvalue off by one in the last digit."""
    rows = claim["eigenvalues"][1:]
    told = (Decimal(str(float(x))).normalize() for row in rows for x in row[1:])
    digits = max(4, *(len(x.as_tuple().digits) for x in told))
    for k, row in enumerate(rows):
        for j in (1, 2):
            unit = Fraction(10) ** (Decimal(str(float(row[j]))).adjusted() - digits + 1)
            for off in (unit, -unit) if row[j] else ():
                other = (*row[:j], row[j] + off, *row[j + 1 :])
                changed = ("matrix", *rows[:k], other, *rows[k + 1 :])
                yield Claim(claim.kind, (("eigenvalues", changed),))


def test_a_sentence_without_its_claim_is_refused():
    for judge, step, claim in made():
        without = replace(step, claims=tuple(x for x in step.claims if x != claim))
        assert "none such" in judge(without)


def test_the_other_sentence_about_roots():
    """A disc in a fluid, edge-on: of 1, 0, −2/3, 0, 0 a root has a positive real part."""
    record = derive(disc()).equilibria({"Pi_4": 1}).record
    step = record.steps[-1]
    (claim,) = (x for x in step.claims if x.kind == "equilibrium.unstable")
    assert show(claim["polynomial"]) == "λ⁴ − 2/3 λ²"
    false = exchanged(step, claim, Claim("equilibrium.open", claim.values))
    assert "what follows is: unstable" in ClaimChecker(record, SEED).fault(false)


SL2 = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - (A_11^2 + A_12^2)"
ABSENT = {
    "a row that is 0": (lagrangian(SL2, "SL(2)"), {"A_11": 0}),
    "too long a row": ("lagrange_top", {"A_33": 2}),
    "two equal rows": (lagrangian(SL2 + " - A_21^2", "SL(2)"), {"A_11": 0, "A_21": 0}),
}


@pytest.mark.parametrize("name", ABSENT)
def test_a_point_that_no_element_has(name, monkeypatch):
    problem, at = ABSENT[name]
    monkeypatch.setattr("derive.search.equilibria.equilibrium_points.off_the_group", lambda *_: "")
    monkeypatch.setattr(stability, "attained", lambda *_: True)
    record = derive(problem).equilibria(at).record
    reasons = [*map(ClaimChecker(record, SEED).fault, record.steps)]
    assert ["no element of the group has these" in x for x in reasons].count(True) == 1


def form_step():
    record = derive("lagrange_top").equilibria({"Pi_3": 3, "A_33": 1}).record
    return record, record["energy_casimir_1"]


def judged(record, step):
    return ClaimChecker(record, SEED).fault(step)


FORGED = {
    "what is not kept": (lambda e: both_sides(e, ("pow", ("at", "Π", 1), 2)), "is not kept"),
    "twice the energy": (lambda e: both_sides(e, "h̃"), "beside it"),
    "another slope": (
        lambda e: both_sides(e, ("at", "Π", 3)),
        "the derivative does not vanish",
    ),
    "other squares": (
        lambda e: replace(e, rhs=add(e.rhs, SQUARE, neg(SQUARE))),
        "5 and 1 are written",
    ),
}
SQUARE = ("pow", ("at", "Π", 1), 2)


def both_sides(e, t):
    return replace(e, lhs=add(e.lhs, t), rhs=add(e.rhs, t))


@pytest.mark.parametrize("name", FORGED)
def test_a_form_that_is_none(name):
    change, reason = FORGED[name]
    record, step = form_step()
    (e,) = step.equations
    assert not judged(record, step)
    assert reason in judged(record, replace(step, equations=(change(e),)))


def test_multiples_with_roots_are_kept():
    at = {"A_31": "sqrt(3)/2", "A_33": "1/2", "Pi_1": "sqrt(3)/2", "Pi_3": 1}
    record = derive(heavy("132", "A_33/2", "")).equilibria(at).record
    step, three = record["energy_casimir_1"], ("fun", "sqrt", 3)
    (e,) = step.equations
    wrong = both_sides(e, mul(three, SQUARE))
    assert "is not kept" in judged(record, replace(step, equations=(wrong,)))


def test_a_form_of_another_point():
    """A form stands for the point of the step that it uses."""
    record = derive("euler_top").equilibria().record
    step = record["energy_casimir_1"]
    uses = tuple(x.replace("equilibrium_1", "equilibrium_2") for x in step.uses)
    assert "does not vanish" in judged(record, replace(step, uses=uses))
    none = tuple(x for x in step.uses if "equilibrium" not in x)
    assert "no one point is told" in judged(record, replace(step, uses=none))


def test_what_is_no_casimir_has_no_level():
    record = bent().equilibrium_near({"A_31": "-0.7", "A_33": "-0.5"}).record
    step = record["enclosure_1"]
    first, *others = step.equations
    false = (both_sides(first, ("at", "Π", 2)), *others)
    assert "is no Casimir" in judged(record, replace(step, equations=false))


def test_other_decimals():
    """What is enclosed is about the decimals of the step that is used."""
    record = bent().equilibrium_near({"A_31": "-0.7", "A_33": "-0.5"}).record
    step = record["enclosure_1"]
    a, there, away = ("entry", "A", 3, 1), Fraction(-83205, 10**5), Fraction(-832051, 10**6)
    (old,) = {x for e in step.equations for x in _sums(e.rhs) if a in x and len(x) == 3}
    assert old[2] == -there
    moved = [replace(e, rhs=replaced(e.rhs, old, add(a, -away))) for e in step.equations]
    assert "not the decimals" in judged(record, replace(step, equations=(*moved,)))


def _sums(t):
    return [x for x in nodes(t) if isinstance(x, tuple) and x[0] == "add"]


# -- the arithmetic -------------------------------------------------------------------------------


def random_matrix(random, n):
    return [[Fraction(random.choice([0, 0, 0, 1, -1, 2, -3])) for _ in range(n)] for _ in range(n)]


def floats(a):
    return np.array([[float(x) for x in row] for row in a]).reshape(len(a), len(a))


def test_spectra_beside_numpy():
    random = Random(3)
    for k in range(200):
        a = random_matrix(random, 1 + k % 5)
        by = root(2) if k % 2 else 1
        a = [[x * by + (j == 0) for j, x in enumerate(row)] for row in a]
        assert np.allclose([*map(float, characteristic(a))], np.poly(floats(a)), atol=1e-6)
        both = [[a[i][j] + a[j][i] for j in range(len(a))] for i in range(len(a))]
        values = np.linalg.eigvalsh(floats(both))
        assert signature(both) == ((values > 1e-9).sum(), (values < -1e-9).sum())
    with pytest.raises(ValueError, match="not symmetric"):
        signature([[0, 1], [2, 0]])


def product_of(f, g):
    found = [Fraction(0)] * (len(f) + len(g) - 1)
    for i, x in enumerate(f):
        for j, y in enumerate(g):
            found[i + j] += x * y
    return found


def test_roots_are_counted():
    random, seen = Random(5), set()
    for k in range(200):
        roots = [Fraction(random.randint(-3, 1 + k % 2)) for _ in range(random.randint(0, 4))]
        pairs = [
            (random.randint(-2, 2), random.randint(1, 2)) for _ in range(random.choice((0, 1)))
        ]
        real_parts = [*roots, *(re for re, _ in pairs)]
        f = [Fraction(1)]
        for x in roots:
            f = product_of(f, [1, -x])
        for re, im in pairs:
            f = product_of(f, [1, -2 * re, re * re + im * im])
        assert distinct_roots(f) == len({*roots}) + 2 * len({*pairs})
        assert real_and_not_positive(f) == (not pairs and all(x <= 0 for x in roots))
        assert negative_or_zero(f) == any(x <= 0 for x in roots)
        assert grows(f) == univariate.grows(f[::-1]) == any(x > 0 for x in real_parts)
        seen.add((real_and_not_positive(f), negative_or_zero(f)))
    assert len(seen) == 4


def test_roots_with_their_opposites():
    """±1 ± i, ±i twice, and ±i beside −1, 1 and −1 ± i."""
    quartic, twice = [1, 0, 0, 0, 4], [1, 0, 2, 0, 1]
    cases = [(quartic, True), (twice, False), ([1, 0, 0], False), ([1], False)]
    cases += [(product_of([1, 0, 1], f), f[1] < 0) for f in ([1, 1], [1, -1], [1, 2, 2])]
    for f, expected in cases:
        exact = [Fraction(x) for x in f]
        assert grows(exact) == univariate.grows(exact[::-1]) == expected


def test_a_spiral_away_from_a_leaf_is_unstable():
    """The leaf is a point, of whose eigenvalues a pair is complex; of its opposite they decay."""
    found = [derive(lagrangian(squares(1, 1, 1), SPIRAL)).equilibria({"Pi_1": x}) for x in (1, -1)]
    assert [x.found[0].verdict for x in found] == ["unstable", "open"]


def test_coefficients_are_within_their_bounds():
    random = np.random.default_rng(2)
    for size in (1e-6, 0.3):
        a = random.integers(-5, 6, size=(4, 4))
        off = Fraction(size)
        bounds = intervals.characteristic(
            [[Interval.about(Fraction(x), off) for x in row] for row in a.tolist()]
        )
        for _ in range(50):
            found = np.poly(a + random.uniform(-size, size, size=(4, 4)))
            assert all(
                abs(x - float(y)) <= float((y - y.middle).size) + 1e-9
                for x, y in zip(found, bounds, strict=True)
            )


def test_what_coefficients_prove():
    """Of polynomials with real roots that are not positive nothing, whatever the errors."""
    random = Random(4)
    for _ in range(200):
        f = [Fraction(1)]
        for _ in range(random.randint(1, 4)):
            f = product_of(f, [1, Fraction(random.randint(0, 5))])
        errors = [Fraction(random.randint(0, 3), 2) for _ in f]
        moved = [x + e * random.choice((-1, 0, 1)) for x, e in zip(f, errors, strict=True)]
        assert not not_real_and_not_positive([*map(Interval.about, moved, errors)])
    for f in ([1, 0, 1], [1, 1, 1], [1, 3, -1], [1, 2, 3, 1]):
        assert not_real_and_not_positive(
            [Interval.about(Fraction(x), Fraction(1, 1000)) for x in f]
        )


SENSELESS = (1, "x", ("matrix", 1), ("matrix", ("row", 1)), ("row", "x"), ("par", "x"))
SENSELESS += (("pow", ("pow", ("pow", 10, 64), 64), 64), ("div", 1, 0), ("matrix", ("row", 1, "x")))


def test_what_makes_no_sense_is_refused():
    for judge, step, claim in made():
        for name, own in claim.values:
            for x in SENSELESS:
                values = tuple((k, x if k == name else y) for k, y in claim.values)
                claims = tuple(replace(y, values=values) if y == claim else y for y in step.claims)
                assert x == own or judge(replace(step, claims=claims)), values
                with suppress(*IMPOSSIBLE):  # of which there is no sentence
                    false = said(step, claim, Claim(claim.kind, values))
                    assert x == own or judge(false), values
