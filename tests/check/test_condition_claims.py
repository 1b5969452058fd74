"""The conditions in sentences of the walk are judged: of masses, of what equations divide by, of
the Lie algebra and of the body; what is said of families of equilibria is tried in numbers: no
other inequality, value or verdict passes."""

import re
from dataclasses import replace
from functools import cache

import pytest

from derive import derive
from derive.check.checker import ClaimChecker
from derive.check.claims import claims_by_ranks
from derive.check.claims.claims_by_ranks import DIVISORS, OF_ROTATIONS
from derive.check.claims.family_claims import ClaimedFamily
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.python.api import Aff, Points, Problem, Spring
from derive.record.as_json import from_json, to_json
from derive.record.prose import message, sentences, unmarked
from derive.record.sentence import CLAIMS, CONDITIONS, SIGNED, Claim, Sentence
from tests.check.test_equilibrium_claims import exchanged
from tests.check.test_record_claims import FAMILIES, changes, said
from tests.support import corpus, walks
from tests.support.cached import on_disk
from tests.support.corpus import SIGNED as BODIES
from tests.support.walks import SEED

THREE = Points((1, [1, 0]), (2, [0, 1]), (3, [0, 0]))
LAYERS = {"solid": "ellipsoid", "density": "2 - s", "semi_axes": [3, 2, 1]}
OWN = {
    "layers": lambda: problem_of({"name": "layers", "group": "SL(3)", "body": LAYERS}),
    "tied": lambda: Problem("tied", Aff(2), THREE, [Spring(1, 2, 1, length=1)]),
}
READY = ("so3", "se3", "sl3", "gl3", "saff3", "heisenberg", "rod", "dirichlet", "affine")
RECORDS = (*READY, *OWN, *(f"signed {x}" for x in BODIES))


@cache
def record(name):
    if name in OWN:
        return walk(OWN[name]())
    return corpus.record(name) if name.startswith("signed ") else walks.record(name)


@on_disk
def made():
    """Kind → a record with it, the step and the claim."""
    found = {}
    for name in RECORDS:
        d = record(name)
        for step in d.steps:
            found |= {x.kind: (d, step, x) for x in step.claims if x.kind in CONDITIONS}
    return found


def judged(d, step):
    """What is wrong with the claims of a step, in the place of the one with its label."""
    steps = tuple(step if x.label == step.label else x for x in d.steps)
    return ClaimChecker(replace(d, steps=steps), SEED).fault(step)


def said_as(step, old, new):
    """A step that makes another claim, and says it."""

    def other(x):
        if x.message == message(old.kind):
            return Sentence(message(new.kind), tuple(new.texts.items()) or x.places)
        places = ((k, y if isinstance(y, str) else other(y)) for k, y in x.places)
        return Sentence(x.message, tuple(places))

    claims = tuple(new if x == old else x for x in step.claims)
    return replace(step, prose=tuple(map(other, step.prose)), claims=claims)


def test_every_condition_is_made_and_judged():
    assert {*made()} == CONDITIONS == {*claims_by_ranks.JUDGES}


@pytest.mark.parametrize("name", RECORDS)
def test_conditions_hold_and_are_read_back(name):
    d = record(name)
    assert not [x for x in map(ClaimChecker(d, SEED).fault, d.steps) if x]
    assert from_json(to_json(d)).steps == d.steps


@pytest.mark.parametrize("kind", sorted(CONDITIONS))
def test_a_sentence_without_its_claim_is_refused(kind):
    d, step, claim = made()[kind]
    without = tuple(x for x in step.claims if x != claim)
    assert "none such" in judged(d, replace(step, claims=without))


@pytest.mark.parametrize("kind", sorted(x for x in CONDITIONS if f"{x}{SIGNED}" in CONDITIONS))
def test_masses_have_the_signs_of_the_problem(kind):
    for old, new in ((kind, f"{kind}{SIGNED}"), (f"{kind}{SIGNED}", kind)):
        d, step, claim = made()[old]
        wrong = said_as(step, claim, replace(claim, kind=new))
        assert "may be negative" in judged(d, wrong)


def test_another_value_is_refused():
    tried = [x for x in made().values() if x[2].values]
    assert len(tried) > 9
    for d, step, claim in tried:
        ((name, value),) = claim.values
        other = value + 1 if isinstance(value, int) else {"J": "J_c", "J_c": "J"}[value]
        assert judged(d, said_as(step, claim, replace(claim, values=((name, other),)))), claim


def put(t, old, new):
    """A tree with another name in the place of one."""
    return new if t == old else tuple(put(x, old, new) for x in t) if isinstance(t, tuple) else t


@pytest.mark.parametrize("kind", sorted(x for x in DIVISORS if DIVISORS[x] not in ("", "m")))
def test_equations_divide_by_what_the_sentence_says(kind):
    d, step, _ = made()[kind]
    old, new = ("inv", DIVISORS[kind]), ("inv", "K")
    equations = tuple(
        replace(e, lhs=put(e.lhs, old, new), rhs=put(e.rhs, old, new)) for e in step.equations
    )
    assert equations != step.equations
    assert "alone" in judged(d, replace(step, equations=equations))


@pytest.mark.parametrize(
    ("kind", "count"), [("motion.rotation", 1), ("motion.displacement", 3), ("motion.maps", 2)]
)
def test_another_number_of_places_is_refused(kind, count, monkeypatch):
    """One place, three, and two that are independent do not tell an inverse from none."""
    d, step, _ = made()[kind]
    monkeypatch.setitem(claims_by_ranks.NEEDED, DIVISORS[kind], count)
    assert "under another condition" in judged(d, step)


ELSEWHERE = {
    **dict.fromkeys(OF_ROTATIONS, "sl3"),
    "elimination.linear_parts": "sl3",
    **dict.fromkeys(("quadric.stokes", "quadric.layers", "total.sign"), "sl3"),
    "relation.more": "sl3",
}


@pytest.mark.parametrize("kind", ELSEWHERE)
def test_a_condition_of_one_problem_is_not_that_of_another(kind):
    """Of the group, of its translations, of the body."""
    _, step, claim = made()[kind]
    other = record(ELSEWHERE[kind])
    assert claims_by_ranks.JUDGES[kind](ClaimChecker(other, SEED), step, claim)


def test_layers_are_told_from_a_density_that_is_one():
    for kind, other in (("quadric.stokes", "quadric.layers"), ("quadric.layers", "quadric.stokes")):
        d, step, claim = made()[kind]
        assert "the density" in judged(d, said_as(step, claim, Claim(other)))


# -- no condition goes without --------------------------------------------------------------------

CONDITION = re.compile(
    r"[≠<>≤≥]|\b[Ww]here(?:ver)?\b|\bproducts?\b|left-invariant|dimension|as long"
)
OPEN = {
    "what a letter is, or a word of grammar": (
        "moment_map.left moment_map.right motion.volume lagrangian.fluid force.potential "
        "trivialisation.fluid chain.rule isometry.homogeneous isometry.advected "
        "transport.density second_order.fluid boundary.tangent advection.place relabelling.field "
        "extremal.action errors.both output.place_space output.place_body reduction.curvature "
        "poisson_tensor.reduced"
    ),
    "a theorem, its hypothesis in the sentence": (
        "motion.discrete balance.discrete multiplier.polynomial absorbed.pressure "
        "energy_kept.absorbed circulation.advected level_curve.kept kelvin.advected "
        "extremal.lifts second_order.any_lagrangian second_order.velocity_signed motions.complete "
        "log_linear.both separation.condition poisson_tensor.group momenta.torus forcing.fluid "
        "circulation.force pressure_equation.force"
    ),
    "that nothing is said": "family.roots_large family.open virial.needed",
    "what the step supposes as an equation": "principal.axes",
}
"""Why a condition is no claim of a problem that may be false → the sentences."""


def test_every_condition_is_a_claim_or_says_nothing_that_can_be_false():
    told = {key for key, x in sentences().items() if CONDITION.search(unmarked(x[0]))}
    left = {key for keys in OPEN.values() for key in keys.split()}
    assert told - CLAIMS == left


# -- families of equilibria -------------------------------------------------------------------


HEAVY = {"L": "(zeta_1^2 + zeta_2^2 + I3*zeta_3^2)/2 - A_33"}
HEAVY = {"name": "heavy", "group": "SO(3)", "parameters": {"I3": 2}, "lagrangian": HEAVY}
SOURCES = {
    **{x: lambda x=x: derive(x).families() for x in ("euler_top", "lagrange_top", "euler_poisson")},
    "heavy": lambda: derive(problem_of(HEAVY)).families(),
}
RARE = {"family.origin", "family.on_the_leaf_always", "family.unstable_large"}
RARE |= {"family.stable_beyond", "family.stable_beyond_always"}
"""Which no problem makes that is searched within seconds; tests/equilibria/test_stability.py has
some."""
ALWAYS = {f"family.{x}" for x in ("stable_always", "indefinite", "unstable_always", "imaginary")}
"""Verdicts whatever the letters, each the opposite of another one."""


@cache
def family(name):
    return SOURCES[name]().record


def families(name):
    """A judge of steps, a step and each of its claims about a family."""
    d = family(name)

    def judge(step):
        steps = tuple(step if x.label == step.label else x for x in d.steps)
        return ClaimChecker(replace(d, steps=steps), SEED).fault(step)

    for step in d.steps:
        for claim in step.claims:
            if claim.kind.startswith(FAMILIES):
                yield judge, step, claim


def test_every_kind_is_made():
    kinds = {claim.kind for name in SOURCES for _, _, claim in families(name)}
    assert kinds == {x for x in CLAIMS if x.startswith(FAMILIES)} - RARE


@pytest.mark.parametrize("name", SOURCES)
def test_claims_hold_and_no_other_value_does(name):
    for judge, step, claim in families(name):
        assert not judge(step)
        for wrong in changes(claim):
            assert judge(said(step, claim, wrong)).startswith("the claim"), wrong


def test_points_off_the_group_are_seen_without_integrals():
    """The conditions on entries alone tell them there; to say which one ended in a traceback."""
    names = [[x.names for x in derive("pendulum").families(degree=k).found] for k in (2, 4)]
    assert names[0] == names[1] != []


def test_few_numbers_are_drawn_twice():
    """Of small quotients some were often alike, and the energy had a pole where three letters were:
    a true claim was refused."""
    _, step, _ = next(x for x in families("lagrange_top") if x[2].kind == "family.positive")
    found = ClaimedFamily(ClaimChecker(family("lagrange_top"), SEED).reduced, step)
    sizes = [abs(x) for _ in range(200) for x in found.drawn(fair=False).values()]
    assert len({*sizes}) == len(sizes) > 500


def test_no_other_verdict_holds():
    """Where the letters do not matter: definite for not, imaginary for with a positive part."""
    tried = 0
    for judge, step, claim in families("heavy"):
        for kind in ALWAYS - {claim.kind} if claim.kind in ALWAYS else ():
            if ("polynomial" in dict(claim.values)) is (kind in POLYNOMIAL):
                found = judge(exchanged(step, claim, Claim(kind, claim.values)))
                assert found.startswith("the claim"), (step.label, kind)
                tried += 1
    assert tried >= 4


POLYNOMIAL = {"family.unstable_always", "family.imaginary"}
