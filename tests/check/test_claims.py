"""Claims are judged: what a sentence says beside the equations is data that a checker computes
again, and neither a changed value nor a sentence without its claim passes."""

from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from derive import first_integrals
from derive.check.claims.claim_checker import JUDGES, ClaimChecker
from derive.language.tree import add
from derive.record.claims import CLAIMS, Claim, rendered
from derive.record.json_reader import from_json
from derive.record.json_writer import to_json
from tests.support.walks import SEED

RECORDS = {
    "euler_top": lambda: first_integrals("euler_top", 2).record,
    "lagrange_top": lambda: first_integrals("lagrange_top", 2).record,
}
"""Records that make claims, of every kind at least one."""


@cache
def record(name):
    return RECORDS[name]()


def made(name):
    """The steps of a record that make claims, with each claim."""
    return [(step, claim) for step in record(name).steps for claim in step.claims]


def judged(name, step):
    return ClaimChecker(record(name), SEED).fault(step)


def test_every_kind_is_judged_and_made():
    assert set(JUDGES) == CLAIMS
    assert {claim.kind for name in RECORDS for _, claim in made(name)} == CLAIMS


@pytest.mark.parametrize("name", RECORDS)
def test_claims_hold_and_are_read_back(name):
    assert not any(judged(name, step) for step in record(name).steps)
    assert from_json(to_json(record(name))).steps == record(name).steps


def changes(claim):
    """The claim with each value made another."""
    for k, (name, value) in enumerate(claim.values):
        several = isinstance(value, tuple) and value[0] == "row"
        others = [value[:-1], (*value, value[-1])] if several else [_more(value)]
        for other in others:
            values = (*claim.values[:k], (name, other), *claim.values[k + 1 :])
            yield Claim(claim.kind, values)


def _more(value):
    return value + 1 if isinstance(value, (int, Fraction)) else add(value, 1)


def said(step, old, new):
    """A step with another claim in the place of one, and its sentence in the place of the other."""
    old_words, new_words = rendered(old), rendered(new)
    prose = tuple(new_words if x == old_words else x for x in step.prose)
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
