"""Polynomials about an exact point, up to the second order, from their trees."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce

from ...language.quadratic import Number, value_of
from ...language.tree import Tree

Matrix = list[list[Number]]
LARGEST_POWER = 64


@dataclass(frozen=True)
class SecondOrder:
    """The ``value`` of a polynomial at a point, its first derivatives (``slope``) and the
    ``second`` ones, both by the numbers of the variables, where they are not 0."""

    value: Number
    slope: Mapping[int, Number] = field(default_factory=dict)
    second: Mapping[tuple[int, int], Number] = field(default_factory=dict)

    def __add__(self, other: SecondOrder) -> SecondOrder:
        slope, second = {**self.slope}, {**self.second}
        for i, x in other.slope.items():
            slope[i] = slope.get(i, Fraction(0)) + x
        for ij, x in other.second.items():
            second[ij] = second.get(ij, Fraction(0)) + x
        return SecondOrder(self.value + other.value, slope, second)

    def __mul__(self, other: SecondOrder) -> SecondOrder:
        slopes = {
            (i, j): x * y for i, x in self.slope.items() for j, y in other.slope.items() if x and y
        }
        both = SecondOrder(
            self.value * other.value,
            second={
                ij: slopes.get(ij, Fraction(0)) + slopes.get(ij[::-1], Fraction(0))
                for ij in {y for x in slopes for y in (x, x[::-1])}
            },
        )
        return both + self._times(other.value) + other._times(self.value)

    def _times(self, c: Number) -> SecondOrder:
        """The derivatives times a number."""
        if not c:
            return SecondOrder(Fraction(0))
        slope, second = ({k: c * x for k, x in y.items()} for y in (self.slope, self.second))
        return SecondOrder(Fraction(0), slope, second)  # type: ignore[arg-type]

    def slopes(self, n: int) -> list[Number]:
        """The first derivatives by n variables."""
        return [self.slope.get(i, Fraction(0)) for i in range(n)]

    def matrix(self, n: int) -> Matrix:
        """The second derivatives by n variables."""
        span = range(n)
        return [[self.second.get((i, j), Fraction(0)) for j in span] for i in span]


At = Mapping[Tree, SecondOrder]


def about(variables: Sequence[Tree], values: Sequence[Number]) -> dict[Tree, SecondOrder]:
    """The variables themselves about a point."""
    pairs = zip(variables, values, strict=True)
    return {x: SecondOrder(y, {k: Fraction(1)}) for k, (x, y) in enumerate(pairs)}


def expansion(t: Tree, at: At) -> SecondOrder:
    """A tree about a point; ``ValueError`` for what is no polynomial of what has an expansion."""
    if isinstance(t, (int, Fraction)):
        return SecondOrder(Fraction(t))
    if t in at:
        return at[t]
    if not isinstance(t, tuple) or t[0] not in ("add", "mul", "div", "pow", "fun"):
        raise ValueError("not a polynomial of the variables")
    if t[0] == "fun":
        return SecondOrder(value_of(t))
    if t[0] == "pow":
        if not isinstance(t[2], int) or not 0 <= t[2] <= LARGEST_POWER:
            raise ValueError(f"an exponent that is no integer up to {LARGEST_POWER}")
        return reduce(SecondOrder.__mul__, [expansion(t[1], at)] * t[2], SecondOrder(Fraction(1)))
    if t[0] == "div":
        below = expansion(t[2], at)
        if below.slope or below.second:
            raise ValueError("a division by a variable")
        return expansion(t[1], at) * SecondOrder(1 / below.value)
    parts = (expansion(x, at) for x in t[1:])
    return reduce(SecondOrder.__add__ if t[0] == "add" else SecondOrder.__mul__, parts)
