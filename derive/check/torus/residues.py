"""Numbers at all points of the lattice at once: residues, and multiples of whole numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import repeat
from operator import add, mul, neg
from typing import Any

from ..residue import Residue, _inverse, _residue

NUMBERS = (int, Fraction, Residue)


class Residues:
    """Residues ``a`` modulo p, one for each point, of which products alone are reduced."""

    __slots__ = ("a", "p")

    def __init__(self, a: Sequence[int], p: int):
        self.a, self.p = a, p

    def _each(self, other: Any) -> Iterable[int] | None:
        """Another number at each point."""
        if isinstance(other, Multiples):
            other = other.residues
        if isinstance(other, Residues):
            return other.a
        return repeat(_residue(other, self.p)) if isinstance(other, NUMBERS) else None

    def __mul__(self, other: Any) -> Any:
        p, each = self.p, self._each(other)
        return (
            NotImplemented if each is None else Residues([x % p for x in map(mul, self.a, each)], p)
        )

    __rmul__ = __mul__

    def __add__(self, other: Any) -> Any:
        each = self._each(other)
        return NotImplemented if each is None else Residues([*map(add, self.a, each)], self.p)

    __radd__ = __add__

    def __neg__(self) -> Any:
        return Residues([*map(neg, self.a)], self.p)

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    @property
    def inverse(self) -> Residues:
        """1 over each; ``ZeroDivisionError`` where one is 0."""
        return Residues([_inverse(x, self.p) for x in self.a], self.p)

    def __truediv__(self, other: Any) -> Any:
        many = isinstance(other, (Residues, Multiples))
        return self * (other.inverse if many else Fraction(1) / other)

    def __rtruediv__(self, other: Any) -> Any:
        return self.inverse * other

    def __eq__(self, other: object) -> bool:
        """The same at all points?"""
        rest = self - other
        return rest is not NotImplemented and not any(x % self.p for x in rest.a)

    __hash__ = None  # type: ignore[assignment]

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i."""
        return sum(map(mul, a, b), Fraction(0))

    def total(self) -> Residue:
        """The sum of all of them."""
        return Residue(sum(self.a), self.p)


class Multiples:
    """Whole numbers ``k``, one for each point, times a ``unit``, modulo p."""

    __slots__ = ("k", "p", "unit")

    def __init__(self, k: Sequence[int], p: int, unit: Any = 1):
        if unit != 1 and isinstance(unit, (int, Fraction)) and unit.denominator == 1:
            n = int(unit)
            k, unit = [x * n for x in k], 1
        self.k, self.p, self.unit = k, p, unit

    @property
    def residues(self) -> Residues:
        """The same, each as one number."""
        n, p = _residue(self.unit, self.p), self.p
        return Residues([x * n % p for x in self.k], p)

    @property
    def inverse(self) -> Residues:
        """1 over each; ``ZeroDivisionError`` where one is 0."""
        return self.residues.inverse

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Multiples):
            unit = self.unit * other.unit
            return Multiples([*map(mul, self.k, other.k)], self.p, unit)
        if isinstance(other, NUMBERS):
            return Multiples(self.k, self.p, self.unit * other)
        return NotImplemented

    __rmul__ = __mul__

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Multiples) and self.unit == other.unit:
            return Multiples([*map(add, self.k, other.k)], self.p, self.unit)
        if isinstance(other, (int, Fraction)) and other.denominator == self.unit == 1:
            n = int(other)
            return Multiples([x + n for x in self.k], self.p)
        return self.residues + other

    __radd__ = __add__

    def __neg__(self) -> Any:
        return self * -1

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __truediv__(self, other: Any) -> Any:
        many = isinstance(other, (Residues, Multiples))
        return self * (other.inverse if many else Fraction(1) / other)

    def __rtruediv__(self, other: Any) -> Any:
        return self.inverse * other

    def __eq__(self, other: object) -> bool:
        """The same at all points?"""
        return self.residues == other

    __hash__ = None  # type: ignore[assignment]

    dot = Residues.dot

    def total(self) -> Any:
        """The sum of all of them."""
        return self.unit * sum(self.k)
