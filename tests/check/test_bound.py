"""The bound that is told is true: no more false claims pass, counted with few numbers to draw.

The integers are of so few bits that passes happen, and the prime of as many for each of them as
ever.
"""

from dataclasses import replace
from math import sqrt
from random import Random

import pytest
import sympy

from derive.check import checker
from derive.check.checker import Checker
from derive.check.trials import trial_points
from derive.check.values import residue
from derive.language.tree import add, mul
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.record import Equation

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
