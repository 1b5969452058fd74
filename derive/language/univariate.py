"""Polynomials in one variable over Q or a quadratic field, and their real roots, counted exactly.

A polynomial is a sequence of its coefficients, the constant one first.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

Coefficients = tuple[Any, ...]


@dataclass(frozen=True)
class RealRoots:
    """How many roots a polynomial has: ``at_zero``, by their multiplicity; of the others, complex
    ones too, ``distinct`` ones, and those of them that are ``negative``."""

    at_zero: int
    negative: int
    distinct: int


def real_roots(f: Sequence[Any]) -> RealRoots:
    """The roots of a polynomial that is not 0, by Sturm: of what is left of it without the powers
    of the variable and without multiple roots."""
    at_zero = next(k for k, x in enumerate(f) if x != 0)
    simple = square_free(trimmed(f[at_zero:]))
    chain = sturm(simple)
    far = [p[-1] * (-1) ** (len(p) - 1) for p in chain]
    negative = _changes(far) - _changes(p[0] for p in chain)
    return RealRoots(at_zero, negative, len(simple) - 1)


def sturm(f: Coefficients) -> list[Coefficients]:
    """Sturm’s chain of a polynomial without multiple roots."""
    chain = [f]
    after = derivative(f)
    while any(after):
        chain.append(after)
        after = tuple(-x for x in division(*chain[-2:])[1])
    return chain


def _changes(values: Iterable[Any]) -> int:
    """How often the sign changes along some numbers, those that are 0 left out."""
    signs = [x > 0 for x in values if x != 0]
    return sum(x != y for x, y in pairwise(signs))


def grows(f: Sequence[Any]) -> bool:
    """Has a polynomial a root with positive real part?

    The roots that come with their opposites are those of the common divisor of f(x) and f(−x),
    xᵃq(x²), where all must be imaginary or 0: q has real roots alone, and none is positive.  Of
    the others Routh's scheme says whether all have negative real parts.
    """
    own = trimmed(f)
    opposite = tuple((-1) ** k * x for k, x in enumerate(own))
    both = common_divisor(own, opposite)
    at_zero = next(k for k, x in enumerate(both) if x != 0)
    squares = real_roots(both[at_zero::2])
    return squares.negative < squares.distinct or not _routh(division(own, both)[0][::-1])


def _routh(f: Coefficients) -> bool:
    """Have all roots of a polynomial, given from the highest power, negative real parts?"""
    first, second = [*f[::2]], [*f[1::2]]
    while second:
        if second[0] * f[0] <= 0:
            return False
        ratio, after = first[0] / second[0], [*second[1:], 0 * f[0]]
        both = zip(first[1:], after, strict=False)
        first, second = second, [x - ratio * y for x, y in both]
    return True


def square_free(f: Coefficients) -> Coefficients:
    """A polynomial without its multiple roots: divided by its common divisor with its
    derivative."""
    return division(f, common_divisor(f, derivative(f)))[0]


def common_divisor(f: Coefficients, g: Coefficients) -> Coefficients:
    """The greatest common divisor of two polynomials."""
    while any(g):
        f, g = g, division(f, g)[1]
    return f


def derivative(f: Coefficients) -> Coefficients:
    """The derivative of a polynomial."""
    return trimmed([k * x for k, x in enumerate(f)][1:] or [0 * f[0]])


def division(f: Coefficients, g: Coefficients) -> tuple[Coefficients, Coefficients]:
    """The quotient of two polynomials, and the rest."""
    zero = 0 * f[0]
    rest, found = list(f), [zero] * max(len(f) - len(g) + 1, 1)
    for k in range(len(f) - len(g), -1, -1):
        c = found[k] = rest[k + len(g) - 1] / g[-1]
        for j, x in enumerate(g):
            rest[k + j] -= c * x
    return trimmed(found), trimmed(rest)


def value(f: Coefficients, x: Any) -> Any:
    """A polynomial at a number."""
    total = 0 * f[0]
    for c in reversed(f):
        total = total * x + c
    return total


def trimmed(f: Sequence[Any]) -> Coefficients:
    """The same without leading coefficients that are 0."""
    last = max((k for k, x in enumerate(f) if x), default=0)
    return tuple(f[: last + 1])
