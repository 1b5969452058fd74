"""Residues at all points of the lattice at once: what a sum over it adds, as one array.

A value is u · a, the number u and the array a: of small integers, as coordinates are, or of
residues modulo p.  A number times an array is a product of numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from operator import add, mul
from typing import Any

import numpy as np

from ..arithmetic import EvaluationError
from ..residue import Residue, _quotient, _residue

SMALL = 2**30
"""Products of two integers below it are those of machine integers."""
Numbers = np.ndarray[Any, Any]
NUMBERS = (int, Fraction, Residue)


def is_small(a: Any) -> bool:
    """Are all of these machine integers that may be multiplied?"""
    if isinstance(a, int):
        return abs(a) < SMALL
    return a.dtype == np.int64 and bool(np.abs(a).max(initial=0) < SMALL)


class Residues:
    """An array of residues modulo p, ``unit`` times ``a``."""

    __slots__ = ("a", "p", "unit")

    def __init__(self, a: Numbers, p: int, unit: int = 1):
        self.a, self.p, self.unit = (a if a.dtype == np.int64 else a % p), p, unit % p

    @property
    def whole(self) -> Numbers:
        """The residues themselves."""
        if self.unit == 1:
            return self.a
        return self.a.astype(object) * self.unit % self.p

    def integers(self) -> Numbers:
        """The small integers of which these are the residues; ``EvaluationError`` for others."""
        unit = self.unit if self.unit <= self.p // 2 else self.unit - self.p
        if not (is_small(self.a) and is_small(unit)):
            raise EvaluationError("small integers are expected on the lattice")
        return self.a * unit

    def _combined(self, f: Callable[[Any, Any], Any], a: Any, b: Any, unit: int = 1) -> Residues:
        if not (is_small(a) and is_small(b)):
            a, b = (x if isinstance(x, int) else x.astype(object) for x in (a, b))
        return Residues(f(a, b), self.p, unit)

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Residues):
            return self._combined(mul, self.a, other.a, self.unit * other.unit)
        if not isinstance(other, NUMBERS):
            return NotImplemented
        n = _residue(other, self.p)
        if is_small(n) and is_small(self.a):
            return Residues(self.a * n, self.p, self.unit)
        return Residues(self.a, self.p, self.unit * n)

    __rmul__ = __mul__

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Residues) and self.unit == other.unit:
            return self._combined(add, self.a, other.a, self.unit)
        if isinstance(other, Residues):
            return self._combined(add, self.whole, other.whole)
        if not isinstance(other, NUMBERS):
            return NotImplemented
        return self._combined(add, self.whole, _residue(other, self.p))

    __radd__ = __add__

    def __neg__(self) -> Any:
        return self * -1

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __truediv__(self, other: Any) -> Any:
        return self * (1 / other if isinstance(other, Residues) else Fraction(1) / other)

    def __rtruediv__(self, other: Any) -> Any:
        inverses = [_quotient(1, int(x), self.p) for x in self.a]
        unit = _quotient(1, self.unit, self.p)
        return Residues(np.array(inverses, dtype=object), self.p, unit) * other

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i."""
        return sum(map(mul, a, b), Fraction(0))

    def total(self) -> Residue:
        """The sum of all of them."""
        return Residue(int(self.a.sum()) * self.unit, self.p)
