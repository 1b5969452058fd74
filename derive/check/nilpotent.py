"""Numbers with nilpotent parts ε, ε′, η (each squares to zero): exact first and mixed derivatives.

A number is a map  subset of {ε, ε′, η} → integer,  the subset as a bit mask, over one denominator:
a product reduces it once, and not each of its parts.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from ..algebra.rational import EXACT, Matrix

EPS, EPS_PRIME, ETA = 1, 2, 4


class Nilpotent:
    """Element of Q[ε, ε′, η] / (ε², ε′², η²)."""

    __slots__ = ("over", "tops")

    def __init__(self, tops: dict[int, int], over: int = 1):
        self.tops, self.over = tops, over

    @staticmethod
    def of(x: Any) -> Nilpotent:
        """A plain number as a nilpotent one."""
        if isinstance(x, Nilpotent):
            return x
        if type(x) not in EXACT:
            raise TypeError(f"{type(x).__name__}: no exact number")
        top, over = x.as_integer_ratio()
        return Nilpotent({0: top} if top else {}, over)

    def part(self, mask: int) -> Fraction:
        """The coefficient of a product of nilpotents."""
        return Fraction(self.tops.get(mask, 0), self.over)

    def small(self) -> Nilpotent:
        """Without the number."""
        return Nilpotent({mask: x for mask, x in self.tops.items() if mask}, self.over)

    def derivative(self, mask: int) -> Nilpotent:
        """In one parameter, at zero, as a function of the others."""
        return Nilpotent({k ^ mask: x for k, x in self.tops.items() if k & mask}, self.over)

    @staticmethod
    def dot(a: Iterable[Any], b: Iterable[Any]) -> Nilpotent:
        """Σ a_i b_i, whose parts are reduced once."""
        total: dict[int, int] = {}
        over = 1
        for x, y in zip(map(Nilpotent.of, a), map(Nilpotent.of, b), strict=True):
            if not (x.tops and y.tops):
                continue
            whole = x.over * y.over
            more = 1
            if whole != over:
                common = lcm(over, whole)
                if common != over:
                    total = {mask: z * (common // over) for mask, z in total.items()}
                over, more = common, common // whole
            for m, top in x.tops.items():
                top *= more
                for k, other in y.tops.items():
                    if not m & k:
                        total[m | k] = total.get(m | k, 0) + top * other
        common = gcd(over, *total.values())
        if common == 1:
            return Nilpotent(total, over)
        return Nilpotent({mask: x // common for mask, x in total.items()}, over // common)

    def __add__(self, other: Any) -> Nilpotent:
        other = Nilpotent.of(other)
        over = lcm(self.over, other.over)
        mine, its = over // self.over, over // other.over
        tops = {mask: x * mine for mask, x in self.tops.items()}
        for mask, x in other.tops.items():
            tops[mask] = tops.get(mask, 0) + x * its
        return Nilpotent(tops, over)

    __radd__ = __add__

    def __neg__(self) -> Nilpotent:
        return Nilpotent({mask: -x for mask, x in self.tops.items()}, self.over)

    def __sub__(self, other: Any) -> Nilpotent:
        return self + (-Nilpotent.of(other))

    def __rsub__(self, other: Any) -> Nilpotent:
        return Nilpotent.of(other) - self

    def __mul__(self, other: Any) -> Nilpotent:
        return Nilpotent.dot((self,), (other,))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Nilpotent:
        return self * (_inverse(other) if isinstance(other, Nilpotent) else 1 / Fraction(other))

    def __rtruediv__(self, other: Any) -> Nilpotent:
        return Nilpotent.of(other) * _inverse(self)


def _inverse(x: Nilpotent) -> Nilpotent:
    """1/x by the geometric series, which ends."""
    base = 1 / x.part(0)
    small = x.small() * -base
    result = power = Nilpotent.of(base)
    for _ in range(3):
        power = power * small
        result = result + power
    return result


def part(x: Any, mask: int) -> Any:
    """The coefficient of ``mask`` in a scalar or, entry by entry, in a matrix."""
    if isinstance(x, tuple):
        return tuple(tuple(part(y, mask) for y in row) for row in x)
    return x.part(mask) if isinstance(x, Nilpotent) else (x if mask == 0 else Fraction(0))


def nilpotent(mask: int) -> Nilpotent:
    """ε, ε′ or η itself."""
    return Nilpotent({mask: 1})


def derivative_in(x: Any, mask: int) -> Any:
    """The derivative in one parameter, at zero, as a function of the others."""
    return Nilpotent.of(x).derivative(mask)


def derivative_of(x: Matrix, mask: int) -> Matrix:
    """The same of a matrix."""
    return tuple(tuple(derivative_in(y, mask) for y in row) for row in x)
