"""Claims are judged: what a sentence says beside the equations is data that a checker computes
again, and neither a changed value nor a sentence without its claim passes."""

import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from random import Random

import pytest

from derive import derive, first_integrals
from derive.check.checker import JUDGES, OBLIGATORY, ClaimChecker
from derive.check.claims import claims_by_ranks
from derive.check.claims.symmetry_count import SymmetryCount
from derive.check.claims.symmetry_kinds import NAMES
from derive.check.trials.trial_points import group_of
from derive.language.tree import add, mul
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from derive.record.prose import message
from derive.record.sentence import CLAIMS, CONDITIONS, Claim, Sentence
from derive.search.integrals import integral_steps
from tests.problems import PROBLEMS
from tests.support import symmetric, trims, walks
from tests.support.lagrangians import (
    APART,
    LINE,
    LINES,
    every_equilibrium,
    heavy,
    lagrangian,
    squares,
)
from tests.support.walks import SEED

DIVIDED = {
    "name": "divided",
    "group": "SE(3)",
    "lagrangian": {
        "L": "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2 + zeta_4^2 + zeta_5^2 - zeta_6^2)/2 - A_33"
    },
}
"""Whose locked inertia has an inverse also where a pivot of its elimination vanishes."""

LEAKING = {
    "name": "leaking",
    "group": "SE(2)",
    "point": [{"mass": "3 - t - t^2/8", "at": [1, 0]}, {"mass": 1, "at": [0, 1]}],
    "flow": [{"at": [2, 0], "rate": x, "velocity": [0, 1], "steady": True} for x in (-1, "-t/4")],
}
"""Whose flow inside is taken to be steady."""

MOVED = ("ball", "spatial", "driven", "spiral", "landau")
"""Problems whose symmetries together move time, space and bodies in every way that has a name."""


def symmetries_of(name):
    """The record of the symmetries of a problem for tests."""
    return symmetric.found(name).record


def trimmed(name):
    return trims.trim(name).record


RECORDS = {
    "euler_top": lambda: first_integrals("euler_top", 2).record,
    "lagrange_top": lambda: first_integrals("lagrange_top", 2).record,
    "gyrostat": lambda: first_integrals("gyrostat", 2).record,
    "su2": lambda: first_integrals("su2", 2).record,
    "screw": lambda: first_integrals("screw", 2).record,
    "so3": lambda: first_integrals("so3", 1, at_defaults=True).record,
    "line": lambda: first_integrals(lagrangian(squares(1, 2), LINE), 2).record,
    "lines": lambda: first_integrals(lagrangian(squares(1, 2, 3, 5), LINES), 2).record,
    "still": lambda: first_integrals(lagrangian(squares(1, 2), APART), 2).record,
    "a level": lambda: first_integrals(heavy("441", "m*A_31", "m"), 4).record,
    "conditions": lambda: first_integrals("euler_top", 2, conditions=True).record,
    "unsolved": lambda: unsolved(),
    "a condition": lambda: first_integrals("top", 1, conditions=True).record,
    "quadrature": lambda: reduced("0"),
    "elliptic": lambda: reduced("A_33"),
    "hyperelliptic": lambda: reduced("A_33^4"),
    "a square": lambda: scaled("b*A_11^2"),
    "a square, elliptic": lambda: scaled("b*A_11^4"),
    "a square, hyperelliptic": lambda: scaled("b*A_11^6 + A_11"),
    "curved": lambda: derive("euler_top").reduction().record,
    "divided": lambda: derive(problem_of(DIVIDED)).reduction().record,
    "a flat body": lambda: walk(problem_of(tomllib.loads(PROBLEMS["a flat body"]))),
    "a steady flow": lambda: walk(problem_of(LEAKING)),
    "symmetries": lambda: derive("lagrange_top").symmetries().record,
    "a rod": lambda: derive("rod").symmetries().record,
    "a function": lambda: derive("gas_cloud").symmetries().record,
    **{f"symmetries: {x}": partial(symmetries_of, x) for x in MOVED},
    "a nut": lambda: derive("screw").symmetries().record,
    "no symmetries": lambda: derive(heavy("123", "t*A_11 + A_22 + A_12^2", "")).symmetries().record,
    "a tetrahedron": lambda: walks.record("sl3"),
    "a tetrahedron, displaced": lambda: walks.record("saff3"),
    "a trim": partial(trimmed, "kept aside by a torque"),
    "a trim, unstable": partial(trimmed, "what stands"),
    "a trim, steady": partial(trimmed, "drifting aside"),
    "a trim, at a corner": partial(trimmed, "at rest in air"),
    "a trim, found": partial(trimmed, "the speed of a tilt"),
    "a trim, turned": partial(trimmed, "leaning into a wind"),
    "a turn": partial(trimmed, "leaning into a turn"),
    "a turn, enclosed": partial(trimmed, "a helix"),
    "a trim, enclosed": partial(trimmed, "a root of a cubic"),
    "a trim, enclosed, turned": partial(trimmed, "nearly upside down"),
    "a trim, enclosed, on the right": partial(trimmed, "bent in space"),
    "a trim, enclosed, steady": partial(trimmed, "cubic friction"),
    "large": lambda: large("euler_top"),
    "large at defaults": lambda: large("euler_top", at_defaults=True),
}
"""Records that make claims, of every kind at least one."""

EQUILIBRIA, FAMILIES = ("equilibrium.", "enclosure.", "position."), ("family.",)
"""Labels of claims that records of equilibria make, in numbers and in letters."""

OPEN = {"degree", "weight"}
"""What may be another number and stay true: a degree up to which there are no more, and by which
variables count."""
TOLD = {"first_integrals.further", "first_integrals.no_further"}
"""Claims up to the degree that another one tells."""
TURN = ("entry", "ζ", 3)
FALSE = {
    ("first_integrals.complete_by_one", "number"): (1, 0),
    ("trim.unique", "inputs"): (("row", ("par", "u"), ("par", "u")),),
    ("trim.isolated", "numbers"): (("row", ("entry", "w", 1), ("entry", "w", 1)),),
    ("trim.isolated_with_turns", "numbers"): (("row", ("entry", "ξ", 1), ("entry", "ξ", 1)),),
    ("trim.isolated_along", "numbers"): (("row", ("entry", "ξ", 1), ("entry", "ξ", 1)),),
    ("trim.isolated_along", "along"): (("matrix",), ("matrix", *(("row", TURN, 1),) * 2)),
}
"""Values that make a claim false where another one does not: the energy of a ball is a Casimir,
fewer inputs are independent, too, and so may be derivatives along another velocity."""
MONOMIALS = 4


def reduced(potential):
    """The record of Routh's reduction of a solid with an axis."""
    return derive(heavy(("1", "1", "2"), potential, "")).reduction().record


def scaled(potential):
    """The record of Routh's reduction on a group of scalings and shifts, u̇² = 2u²(h̃ − …)."""
    basis = [[[1, 0, 0], [0, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0, 1], [0, 0, 0]]]
    L = f"(zeta_1^2 + zeta_2^2)/2 - ({potential})"
    own = {"name": "own", "group": {"name": "Scaled", "basis": basis}, "parameters": {"b": {}}}
    return derive(problem_of({**own, "lagrangian": {"L": L}})).reduction().record


def unsolved():
    """The record of integrals on a condition that is of first order in no parameter."""
    problem = heavy("123", "(k^2 - 2*q^2)*A_31", "k q")
    return first_integrals(problem, 2, conditions=True).record


def large(name, **how):
    """A record whose claims are too large to be computed again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(integral_steps, "MONOMIALS", MONOMIALS)
        return first_integrals(name, 2, **how).record


@pytest.fixture(autouse=True)
def small(request, monkeypatch):
    """The checker's limit, as low as that of what is said to be large."""
    named = getattr(request.node, "callspec", None)
    if named and str(named.params.get("name", "")).startswith("large"):
        monkeypatch.setattr(claims_by_ranks, "MONOMIALS", MONOMIALS)


@cache
def record(name):
    return RECORDS[name]()


def made(name):
    """The steps of a record that make claims, with each claim."""
    return [(step, claim) for step in record(name).steps for claim in step.claims]


def judged(name, step):
    """What is wrong with the claims of a step in the place of the one with its label."""
    d = record(name)
    steps = tuple(step if x.label == step.label else x for x in d.steps)
    return ClaimChecker(replace(d, steps=steps), SEED).fault(step)


def test_every_kind_is_judged_and_made():
    assert set(JUDGES) == CLAIMS
    found = {claim.kind for name in RECORDS for _, claim in made(name)}
    others = {x for x in CLAIMS if x.startswith((*EQUILIBRIA, *FAMILIES))}
    # tests/check/test_condition_claims.py, tests/check/test_equilibrium_claims.py
    assert found - CONDITIONS - others == CLAIMS - CONDITIONS - others


@pytest.mark.parametrize("name", RECORDS)
def test_claims_hold_and_are_read_back(name):
    assert not [x for x in map(ClaimChecker(record(name), SEED).fault, record(name).steps) if x]
    assert from_json(to_json(record(name))).steps == record(name).steps


COMMUTING = {"symmetries: spiral", "symmetries: landau", "a nut"}
"""Records on groups that commute, on which what moves space moves the body, too."""


@pytest.mark.parametrize("name", [x for x in RECORDS if "symmetries" in x or x == "a nut"])
def test_a_symmetry_has_no_other_name(name):
    checker = ClaimChecker(record(name), SEED)
    for step in record(name).steps:
        for k, claim in enumerate(step.claims):
            for kind in NAMES if claim.kind in NAMES else ():
                renamed = replace(
                    step, claims=(*step.claims[:k], Claim(kind), *step.claims[k + 1 :])
                )
                both = {claim.kind[-5:], kind[-5:]} == {"space", "_body"}
                if kind == claim.kind or (both and name in COMMUTING):
                    continue
                assert any(checker._fault(renamed, x) for x in renamed.claims if x.kind in NAMES)


def changes(claim):
    """The claim with each value made another."""
    for k, (name, value) in enumerate(claim.values):
        head = value[0] if isinstance(value, tuple) else ""
        several = head in ("row", "matrix")
        others = [value[:-1], (*value, value[-1])] if several else [_more(value)]
        if head == "matrix":
            others += [(*value[:-1], (*value[-1][:-1], _more(value[-1][-1])))]
        others = (
            [] if name in OPEN and claim.kind not in TOLD else FALSE.get((claim.kind, name), others)
        )
        for other in others:
            values = (*claim.values[:k], (name, other), *claim.values[k + 1 :])
            yield Claim(claim.kind, values)


def _more(value):
    return value + 1 if isinstance(value, (int, Fraction)) else add(value, 1)


def said(step, old, new):
    """A step with another claim in the place of one, and its sentence in the place of the other."""

    def rendered_anew(x):
        places = tuple((k, y if isinstance(y, str) else rendered_anew(y)) for k, y in x.places)
        if x.message == message(old.kind) and {**dict(places), **old.texts} == dict(places):
            places = tuple((dict(places) | new.texts).items())
        return Sentence(x.message, places)

    prose = tuple(map(rendered_anew, step.prose))
    claims = tuple(new if x == old else x for x in step.claims)
    return replace(step, prose=prose, claims=claims)


@pytest.mark.parametrize("name", RECORDS)
def test_another_value_is_refused(name):
    for step, claim in made(name):
        for wrong in changes(claim):
            assert judged(name, said(step, claim, wrong)), wrong


@pytest.mark.parametrize("name", RECORDS)
def test_sentences_and_claims_go_together(name):
    for step, claim in made(name):
        without = tuple(x for x in step.claims if x != claim)
        assert "none such" in judged(name, replace(step, claims=without))
        for wrong in changes(claim):
            assert "not what the sentences say" in judged(
                name, replace(step, claims=(*without, wrong))
            )


def test_no_degree_with_more_passes():
    """Kovalevskaya's integral and a Casimir are of degree 4: up to 3 there is nothing else."""
    d = first_integrals("kovalevskaya_top", 3).record
    for step in (d["casimirs"], d["first_integrals"]):
        assert not ClaimChecker(d, SEED).fault(step)
        (claim,) = (x for x in step.claims if x.kind.split(".")[1].startswith("all"))
        wrong = said(step, claim, replace(claim, values=(("degree", 4),)))
        assert "in which the products have the rank" in ClaimChecker(d, SEED).fault(wrong)


@pytest.mark.parametrize(
    ("label", "place"), [("casimirs", 0), ("casimirs", 1), ("first_integrals", 1)]
)
def test_no_integral_or_casimir_is_missing(label, place):
    d = first_integrals("kovalevskaya_top", 4).record
    own = d[label]
    left = tuple(e for k, e in enumerate(own.equations) if k != place)
    claims = tuple(x for x in own.claims if x.kind.split(".")[1].startswith("all"))
    fewer = replace(own, equations=left, claims=claims, prose=())
    changed = replace(d, steps=tuple(fewer if x is own else x for x in d.steps))
    found = JUDGES[claims[0].kind](ClaimChecker(changed, SEED), fewer, claims[0])
    assert "in which the products have the rank" in found


@pytest.mark.parametrize(("name", "other"), [("curved", "flat"), ("elliptic", "curved")])
def test_no_curvature_is_told_that_is_not_there(name, other):
    step = record(name)["curvature"]
    wrong = Claim(f"reduction.{other}")
    prose = (Sentence(message(wrong.kind)),)
    assert "vanishes, or does not" in judged(name, replace(step, prose=prose, claims=(wrong,)))


@pytest.mark.parametrize("name", ["elliptic", "divided"])
def test_what_is_divided_by_is_said(name):
    """By the step itself; and that det 𝕀 is 0 elsewhere only where it is the product."""
    step = record(name)["effective"]
    (own,) = step.claims
    silent = tuple(x for x in step.prose if x.message != message(own.kind))
    assert "which no claim says" in judged(name, replace(step, prose=silent, claims=()))
    for text in (own.texts["conditions"].replace("≠", ">"), "‘I1’ ≠ 0"):
        places = (("conditions", text),)
        prose = tuple(
            Sentence(x.message, places) if x.message == message(own.kind) else x for x in step.prose
        )
        assert "not what the sentences say" in judged(name, replace(step, prose=prose))
    other = {"isotropy": "divided", "divided": "isotropy"}[own.kind.split(".")[1]]
    found = judged(name, said_as(step, own, f"reduction.{other}"))
    assert ("not the product" in found) == (other == "isotropy")


def said_as(step, old, kind):
    """A step that says the same values by another sentence."""
    new = Claim(kind, old.values)
    prose = tuple(
        Sentence(message(kind), x.places) if x.message == message(old.kind) else x
        for x in step.prose
    )
    return replace(step, prose=prose, claims=(new,))


def test_symmetries_that_leave_a_configuration_are_not_free():
    """Turns on both sides of the axis, an axis that is held."""
    for name in ("elliptic", "spherical_pendulum"):
        d = derive(name).reduction().record if name not in RECORDS else record(name)
        step, free = d["effective"], Claim("reduction.free")
        prose = (*step.prose, Sentence(message(free.kind)))
        wrong = replace(step, prose=prose, claims=(*step.claims, free))
        assert "reduction.free" in ClaimChecker(d, SEED).fault(wrong)


def test_a_reduction_is_by_the_fields_of_its_problem():
    d = record("elliptic")
    step = d["momentum_1"]
    fields = d.problem["symmetries"]
    for listed in (fields[:1], [fields[0], fields[0]], fields[::-1]):
        wrong = replace(d, problem={**d.problem, "symmetries": listed})
        assert "reduction.taken" in ClaimChecker(wrong, SEED).fault(step)
    left = tuple(x for x in d.steps if not x.label.endswith("momentum_1_and_2"))
    assert "momentum_1_and_2" in ClaimChecker(replace(d, steps=left), SEED).fault(step)


@pytest.mark.parametrize("left_out", [0, 1])
def test_no_condition_is_left_out(left_out):
    """Of a top's, I = J and without weight: at some numbers more is found."""
    d = first_integrals(heavy(("I", "J", "K"), "m*A_33", "I J K m"), 2, conditions=True).record
    step = d["first_integrals"]
    (old,) = (x for x in step.claims if x.kind == "first_integrals.further")
    cases = old["conditions"][1:]
    assert not ClaimChecker(d, SEED).fault(step)
    kept = tuple(x for x in cases if x != cases[left_out])
    own = [x.label for x in d.steps if x.label.rpartition(".")[2].startswith("condition")]
    steps = tuple(x for x in d.steps if x.label != own[left_out])
    new = Claim(old.kind, (("degree", old["degree"]), ("conditions", ("row", *kept))))
    wrong = said(step, old, new)
    found = ClaimChecker(replace(d, steps=steps), SEED).fault(wrong)
    assert "there are more where" in found


def test_a_condition_that_is_solved_is_not_undecided():
    step = record("unsolved")["first_integrals"]
    (old,) = (x for x in step.claims if x.kind == "first_integrals.unsolved")
    for f in (("par", "k"), add(("par", "k"), ("par", "q")), 2):
        case = ("row", ("matrix", ("row", f, 0)))
        found = judged("unsolved", said(step, old, Claim(old.kind, (("conditions", case),))))
        assert "of first order in a parameter, or in none" in found


def test_symmetries_that_are_listed_are_independent():
    """Neither one twice, nor a multiple of another."""
    d = derive("lagrange_top").symmetries().record
    summary = d["symmetries"]
    for first, second in ((2, 3), (3, 2)):
        one, two = (d[f"conserved_{k}"] for k in (first, second))
        for other in (one.given, *multiples(one)):
            same = replace(one, label=two.label, given=tuple(other))
            wrong = replace(d, steps=tuple(same if x is two else x for x in d.steps))
            assert "depend on one another" in ClaimChecker(wrong, SEED).fault(summary)


def multiples(one):
    """Twice the field of a symmetry, and its product with a root of a parameter."""
    for factor in (2, ("fun", "sqrt", ("par", "I1"))):
        yield [one.given[0], replace(one.given[1], rhs=mul(factor, one.given[1].rhs))]


@pytest.mark.parametrize("name", ["lagrange_top", "spherical_pendulum", "top"])
def test_that_the_leading_coefficient_is_not_0_is_supposed(name):
    """Of degree 3 the right side is where there is weight; what it divides by is not enough."""
    d = derive(name).reduction().record
    step, judge = d["quadrature"], ClaimChecker(d, SEED).fault
    first, *others = step.hypotheses
    assert not judge(step)
    for supposed in (others, [replace(first, of=add(first.of, 1)), *others]):
        assert "leading coefficient" in judge(replace(step, hypotheses=tuple(supposed)))
    assert judge(replace(step, hypotheses=()))


def test_no_step_is_without_the_claims_of_its_rule():
    """All sentences of a step and all claims left out: no judge would be asked."""
    seen = set()
    for d in (*map(record, RECORDS), *(x.record for x in every_equilibrium())):
        judge = ClaimChecker(d, SEED).fault
        for step in d.steps:
            if step.rule in OBLIGATORY or step.label.endswith(".momentum_1"):
                found = judge(replace(step, prose=(), claims=()))
                assert "makes no claim of its rule" in found
                seen.add(step.label.rpartition(".")[2].rstrip("_123456789"))
    assert seen > {"poisson", "casimirs", "first_integrals", "level", "condition", "quadrature"}
    assert seen > {"momentum", "energy_casimir", "enclosure"}


COUNTED = ("so3", "spherical_pendulum", "comet", "screw", "su2", "gl3", "right", "roots")


@pytest.mark.parametrize("name", COUNTED)
def test_symmetries_are_counted_anew(name):
    """In points, held coordinates, roots, products, on the right, of parameters."""
    problem = {
        "right": lambda: lagrangian(f"{squares(1, 1, 3)} + A_11*A_12", side="right"),
        "roots": lambda: lagrangian(f"{squares(1, 1, 3)} - sqrt(2)*sqrt(k)*A_33", parameters="k"),
    }.get(name, lambda: name)
    d = derive(problem()).symmetries().record
    count = SymmetryCount(d.problem, group_of(d.problem), Random(SEED))
    found = [x.label for x in d.steps if re.search(r"\.conserved_[0-9]+$", x.label)]
    assert count.dimension == len(found) > 0


FREE = {
    "beside": lambda x: (*x, Sentence("They are nevertheless all there are.")),
    "the outer text": lambda x: (replace(x[0], message=OUTER), *x[1:]),
    "nested": lambda x: (replace(x[0], places=(("count", both(x[0], Sentence("more"))),)), *x[1:]),
    "open": lambda x: (*x, Sentence("Whether the equilibrium is stable stays open.")),
}
OUTER = "There are no symmetries of any kind whatever beside these: {count}."


def both(x, other):
    return Sentence("{first} and {second}", (("first", dict(x.places)["count"]), ("second", other)))


@pytest.mark.parametrize("name", FREE)
def test_sentences_are_messages_of_the_program(name):
    step = record("symmetries")["symmetries"]
    false = replace(step, prose=FREE[name](step.prose))
    assert "none of derive's: “" in judged("symmetries", false)


def test_no_words_are_in_the_place_of_a_formula():
    step = record("symmetries")["symmetries"]
    first, *others = step.prose
    words = replace(first, places=(("count", both(first, "no others at all")),))
    assert "“no others at all”" in judged("symmetries", replace(step, prose=(words, *others)))
