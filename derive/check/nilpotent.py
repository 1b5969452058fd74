"""Numbers with nilpotent parts ε, ε′, η (each squares to zero): exact first and mixed derivatives.

A number is a map  subset of {ε, ε′, η} → fraction,  the subset as a bit mask.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from ..language.rational import Matrix, dot

EPS, EPS_PRIME, ETA = 1, 2, 4


class Nilpotent:
    """Element of Q[ε, ε′, η] / (ε², ε′², η²)."""

    __slots__ = ("parts",)

    def __init__(self, parts: dict[int, Fraction]):
        self.parts = parts

    @staticmethod
    def of(x: Any) -> Nilpotent:
        """The number x as a nilpotent one without nilpotent parts."""
        return (
            x
            if isinstance(x, Nilpotent)
            else Nilpotent({0: Fraction(x) if isinstance(x, int) else x})
        )

    def part(self, mask: int) -> Fraction:
        """The coefficient of the product of nilpotents that a mask stands for."""
        return self.parts.get(mask, Fraction(0))

    @staticmethod
    def dot(a: Iterable[Any], b: Iterable[Any]) -> Nilpotent:
        """Σ a_i b_i, each part of it summed at once."""
        factors: dict[int, tuple[list[Any], list[Any]]] = {}
        for x, y in zip(a, b, strict=True):
            left = x.parts if isinstance(x, Nilpotent) else {0: x}
            right = y.parts if isinstance(y, Nilpotent) else {0: y}
            for m, u in left.items():
                for k, v in right.items():
                    if not m & k:
                        us, vs = factors.setdefault(m | k, ([], []))
                        us.append(u)
                        vs.append(v)
        return Nilpotent({mask: dot(us, vs) for mask, (us, vs) in factors.items()})

    def __add__(self, other: Any) -> Nilpotent:
        if not isinstance(other, Nilpotent):
            if other == 0:
                return self
            other = Nilpotent.of(other)
        parts = dict(self.parts)
        for mask, x in other.parts.items():
            parts[mask] = parts[mask] + x if mask in parts else x
        return Nilpotent(parts)

    __radd__ = __add__

    def __neg__(self) -> Nilpotent:
        return Nilpotent({mask: -x for mask, x in self.parts.items()})

    def __sub__(self, other: Any) -> Nilpotent:
        return self + (-Nilpotent.of(other))

    def __rsub__(self, other: Any) -> Nilpotent:
        return Nilpotent.of(other) - self

    def __mul__(self, other: Any) -> Nilpotent:
        if not isinstance(other, Nilpotent):
            return Nilpotent({mask: x * other for mask, x in self.parts.items()})
        parts: dict[int, Fraction] = {}
        for a, x in self.parts.items():
            for b, y in other.parts.items():
                if not a & b:
                    product, mask = x * y, a | b
                    parts[mask] = parts[mask] + product if mask in parts else product
        return Nilpotent(parts)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Nilpotent:
        return self * (_inverse(other) if isinstance(other, Nilpotent) else Fraction(1) / other)

    def __rtruediv__(self, other: Any) -> Nilpotent:
        return Nilpotent.of(other) * _inverse(self)


def _inverse(x: Nilpotent) -> Nilpotent:
    """1/x by the geometric series, which ends."""
    base = x.part(0)
    small = Nilpotent({k: -v / base for k, v in x.parts.items() if k})
    result = power = Nilpotent({0: 1 / base})
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
    return Nilpotent({mask: Fraction(1)})


def derivative_in(x: Any, mask: int) -> Any:
    """∂x/∂ε for ε the parameter of ``mask``, at ε = 0, as a function of the other parameters."""
    return Nilpotent({k ^ mask: v for k, v in Nilpotent.of(x).parts.items() if k & mask})


def derivative_of(x: Matrix, mask: int) -> Matrix:
    """The same derivative of a matrix, entry by entry."""
    return tuple(tuple(derivative_in(y, mask) for y in row) for row in x)
