"""The claims of a reduction, and of the metric that it starts from: what curvature there is, and of
which kind the quadrature is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from random import Random

from ...algebra.groups import Group
from ...language.tree import Tree, operands
from ...record.claims import Claim
from ...record.formulas import stated
from ...record.record import RecordError, Step
from ..residue import random_prime
from .rational_values import value

Judge = Callable[[Group, Random, Step, Claim], str]
LARGEST = 24
"""The largest degree of a right side."""
CURVATURE = "d𝒜"


def _curvature(group: Group, random: Random, step: Step, claim: Claim) -> str:
    """Does the curvature vanish in all equations that give it, or not?"""
    values = [e.rhs for e in step.equations if _head(e.lhs) == CURVATURE]
    if not values or len(values) < len(step.equations):
        return "the equations are none of a curvature"
    flat = all(x == 0 for x in values)
    return "" if flat is (claim.kind == "reduction.flat") else "a curvature vanishes, or does not"


def _head(t: Tree) -> str:
    """The letter of a family of functions, at some arguments."""
    if isinstance(t, tuple) and t[0] == "call" and isinstance(t[1], tuple):
        return str(t[1][1])
    return ""


def _quadrature(group: Group, random: Random, step: Step, claim: Claim) -> str:
    """The right side is a polynomial of the degree in the coordinate, and the kind is that of its
    factors of odd multiplicity."""
    rate, f = step.equations[0].lhs, step.equations[0].rhs
    if not isinstance(rate, tuple) or rate[0] != "pow" or rate[2] != 2:
        raise RecordError("the left side is no square of a rate")
    entry: Tree = ("entry", "A", *rate[1][2:])
    p = random_prime(random)
    c = _interpolated(f, entry, random, p)
    degree, left = len(c) - 1, _odd_degree(c, p)
    kind = "elementary" if left < 3 else "elliptic" if left < 5 else "hyperelliptic"
    told = {"degree": degree}
    if left < degree:
        kind, told = f"{kind}_squared", told | {"left": left}
    true = claim.kind == f"reduction.{kind}" and dict(claim.values) == told
    return "" if true else f"its degree is {degree}, and {left} without squares"


def _odd_degree(c: Sequence[int], p: int) -> int:
    """The degree of the factors of odd multiplicity, each once.

    Divisors with the derivative lower all multiplicities by 1: of these steps every second adds the
    degree of the factors that are left.
    """
    degrees = [len(c) - 1]
    while len(c) > 1:
        c = _divisor(c, [k * x % p for k, x in enumerate(c)][1:], p)
        degrees.append(len(c) - 1)
    steps = (a - b for a, b in pairwise(degrees))
    return sum(x * (-1) ** k for k, x in enumerate(steps))


def _interpolated(f: Tree, x: Tree, random: Random, p: int) -> list[int]:
    """The coefficients of a polynomial in one variable, others being random; ``RecordError`` for
    more than the largest degree, or what is no polynomial."""
    at = {t: random.randrange(1, p) for t in _leaves(f)}
    found: list[int] = []
    base = [1]  # ∏ (x − j), j < k
    for k in range(LARGEST + 3):
        left = value(f, {**at, x: k}, p) - sum(c * k**i for i, c in enumerate(found))
        step = left * pow(sum(c * k**i for i, c in enumerate(base)), -1, p) % p
        found = [(a + step * b) % p for a, b in zip([*found, 0][: k + 1], base, strict=True)]
        base = [(a - k * b) % p for a, b in zip([0, *base], [*base, 0], strict=True)]
    found = _trimmed(found)
    if len(found) > LARGEST + 1:
        raise RecordError("the right side is no polynomial in the coordinate")
    return found


def _leaves(t: Tree) -> list[Tree]:
    """What a function is made of: letters, entries, parameters, and functions of these."""
    if isinstance(t, tuple) and t[0] in ("add", "mul", "div", "pow"):
        return [x for y in operands(t) for x in _leaves(y)]
    return [] if isinstance(t, (int, Fraction)) else [t]


def _trimmed(c: Sequence[int]) -> list[int]:
    """The coefficients up to the last that is not 0."""
    last = max((k for k, x in enumerate(c) if x), default=-1)
    return [*c[: last + 1]]


def _divisor(a: Sequence[int], b: Sequence[int], p: int) -> list[int]:
    """The greatest common divisor of two polynomials."""
    a, b = _trimmed(a), _trimmed(b)
    while b:
        rest = [*a]
        lead = pow(b[-1], -1, p)
        while len(rest) >= len(b):
            factor, shift = rest[-1] * lead, len(rest) - len(b)
            rest = [
                (x - factor * b[k - shift]) % p if k >= shift else x for k, x in enumerate(rest)
            ]
            rest = _trimmed(rest[:-1])
        a, b = b, rest
    return [*a]


def _left_invariant(group: Group, random: Random, step: Step, claim: Claim) -> str:
    """C drops out of the metric of this body, which the equation says, and is not 1."""
    (wanted,) = stated("Tr ξJZ̄C = Tr ξJZ̄")
    if wanted not in step.equations:
        return "the equation that says so is missing"
    return "C is 1" if "orthogonal" in group.relations else ""


JUDGES: dict[str, Judge] = {
    "reduction.flat": _curvature,
    "reduction.curved": _curvature,
    **dict.fromkeys(
        (
            f"reduction.{kind}{squared}"
            for kind in ("elementary", "elliptic", "hyperelliptic")
            for squared in ("", "_squared")
        ),
        _quadrature,
    ),
    "relation.left_invariant": _left_invariant,
}
