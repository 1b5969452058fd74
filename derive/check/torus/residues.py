"""Residues at all points of the lattice at once: what a sum over it adds, as one list."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from operator import add, mul
from typing import Any

from ..arithmetic import EvaluationError
from ..residue import Residue, _quotient, _residue

SMALL = 2**30
"""Integers of the lattice are below it; the residue of another number only by a rare chance."""
NUMBERS = (int, Fraction, Residue)


class Residues:
    """Residues ``a`` modulo p, one for each point."""

    __slots__ = ("a", "p")

    def __init__(self, a: Sequence[int], p: int):
        self.a, self.p = a, p

    def integers(self) -> list[int]:
        """The small integers of which these are the residues; ``EvaluationError`` for others."""
        p, half = self.p, self.p // 2
        found = [x if x <= half else x - p for x in self.a]
        if not all(-SMALL < x < SMALL for x in found):
            raise EvaluationError("small integers are expected on the lattice")
        return found

    def _with(self, f: Callable[[int, int], int], other: Any) -> Any:
        p = self.p
        if isinstance(other, Residues):
            return Residues([x % p for x in map(f, self.a, other.a)], p)
        if not isinstance(other, NUMBERS):
            return NotImplemented
        n = _residue(other, p)
        return Residues([f(x, n) % p for x in self.a], p)

    def __mul__(self, other: Any) -> Any:
        return self._with(mul, other)

    __rmul__ = __mul__

    def __add__(self, other: Any) -> Any:
        return self._with(add, other)

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
        return Residues([_quotient(1, x, self.p) for x in self.a], self.p) * other

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i."""
        return sum(map(mul, a, b), Fraction(0))

    def total(self) -> Residue:
        """The sum of all of them."""
        return Residue(sum(self.a), self.p)
