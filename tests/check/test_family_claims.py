"""What is said of families of equilibria in letters is tried in numbers: no other inequality, value
or verdict passes."""

from dataclasses import replace
from functools import cache

import pytest

from derive import derive
from derive.check.checker import ClaimChecker
from derive.problem.toml import problem_of
from derive.record.sentence import CLAIMS, Claim
from tests.check.test_equilibrium_claims import exchanged
from tests.check.test_record_claims import FAMILIES, changes, said
from tests.support.walks import SEED

HEAVY = {"L": "(zeta_1^2 + zeta_2^2 + I3*zeta_3^2)/2 - A_33"}
HEAVY = {"name": "heavy", "group": "SO(3)", "parameters": {"I3": 2}, "lagrangian": HEAVY}
SOURCES = {
    **{x: lambda x=x: derive(x) for x in ("euler_top", "lagrange_top", "euler_poisson")},
    "heavy": lambda: derive(problem_of(HEAVY)),
}
RARE = {"family.origin", "family.on_the_leaf_always", "family.unstable_large"}
"""Which no problem makes that is searched within seconds."""
ALWAYS = {f"family.{x}" for x in ("stable_always", "indefinite", "unstable_always", "imaginary")}
"""Verdicts whatever the letters, each the opposite of another one."""


@cache
def record(name):
    return SOURCES[name]().families().record


def made(name):
    """A judge of steps, a step and each of its claims about a family."""
    d = record(name)

    def judge(step):
        steps = tuple(step if x.label == step.label else x for x in d.steps)
        return ClaimChecker(replace(d, steps=steps), SEED).fault(step)

    for step in d.steps:
        for claim in step.claims:
            if claim.kind.startswith(FAMILIES):
                yield judge, step, claim


def test_every_kind_is_made():
    kinds = {claim.kind for name in SOURCES for _, _, claim in made(name)}
    assert kinds == {x for x in CLAIMS if x.startswith(FAMILIES)} - RARE


@pytest.mark.parametrize("name", SOURCES)
def test_claims_hold_and_no_other_value_does(name):
    for judge, step, claim in made(name):
        assert not judge(step)
        for wrong in changes(claim):
            assert judge(said(step, claim, wrong)).startswith("the claim"), wrong


def test_no_other_verdict_holds():
    """Where the letters do not matter: definite for not, imaginary for with a positive part."""
    tried = 0
    for judge, step, claim in made("heavy"):
        for kind in ALWAYS - {claim.kind} if claim.kind in ALWAYS else ():
            if ("polynomial" in dict(claim.values)) is (kind in POLYNOMIAL):
                found = judge(exchanged(step, claim, Claim(kind, claim.values)))
                assert found.startswith("the claim"), (step.label, kind)
                tried += 1
    assert tried >= 4


POLYNOMIAL = {"family.unstable_always", "family.imaginary"}
