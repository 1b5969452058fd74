"""Residues modulo a prime, many at once: a number is an array of residues, one for each point.

A claim about generic points is tried at all of them by one pass of NumPy; samplers of groups take
:class:`ResidueSource` as they take a source of integers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.int64]

PRIMES = (2147483647, 2147483587, 2147483579, 2147483563, 2147483543, 2147483423)
"""Primes below 2³¹ that are 3 modulo 4: a square has the root x^((p + 1)/4), and a product of two
residues is less than 2⁶³."""


def primes_from(p: int) -> Iterator[int]:
    """The primes that are 3 modulo 4, from one of these down."""
    while p > 3:
        if all(_is_strong_prime(p, base) for base in (2, 3, 5, 7)):
            yield p
        p -= 4


def _is_strong_prime(p: int, base: int) -> bool:
    """Miller's test, for p = 3 modulo 4; by the bases 2, 3, 5, 7 a proof below 3·10⁹ (Jaeschke)."""
    return pow(base, p // 2, p) in (1, p - 1)


class Residues:
    """Residues modulo p at some points; ``values``: an array, one for each point."""

    __slots__ = ("p", "values")

    def __init__(self, values: Array, p: int):
        self.values, self.p = values, p

    def like(self, values: Array) -> Residues:
        """Other residues modulo the same prime."""
        return Residues(values, self.p)

    def _of(self, x: Any) -> Any:
        return x.values if isinstance(x, Residues) else residue_of(x, self.p)

    def __add__(self, other: Any) -> Residues:
        return self.like((self.values + self._of(other)) % self.p)

    __radd__ = __add__

    def __neg__(self) -> Residues:
        return self.like(-self.values % self.p)

    def __sub__(self, other: Any) -> Residues:
        return self.like((self.values - self._of(other)) % self.p)

    def __rsub__(self, other: Any) -> Residues:
        return self.like((self._of(other) - self.values) % self.p)

    def __mul__(self, other: Any) -> Residues:
        return self.like(self.values * self._of(other) % self.p)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Residues:
        if isinstance(other, Residues):
            return self * other.inverse()
        return self * pow(residue_of(other, self.p), -1, self.p)

    def __rtruediv__(self, other: Any) -> Residues:
        found: Residues = self.inverse() * other
        return found

    def __pow__(self, n: int) -> Residues:
        base, result = (self if n >= 0 else self.inverse()), self.like(np.ones_like(self.values))
        for bit in bin(abs(n))[2:]:
            result = result * result
            if bit == "1":
                result = result * base
        return result

    def __eq__(self, other: object) -> bool:
        """Is it the same at every point?"""
        return bool(np.all(self.values == self._of(other)))

    __hash__ = None  # type: ignore[assignment]

    def inverse(self) -> Residues:
        """1/x at each point; 0 where x is 0."""
        return self ** (self.p - 2)

    def root(self) -> Residues:
        """A square root at each point that has one, a number of no meaning at the others."""
        return self ** ((self.p + 1) // 4)


def residue_of(x: Any, p: int) -> int:
    """A rational number modulo p; ``ZeroDivisionError`` where p divides its denominator."""
    if isinstance(x, int):
        return x % p
    assert isinstance(x, Fraction)
    if x.denominator % p == 0:
        raise ZeroDivisionError(f"{x} modulo {p}")
    return x.numerator * pow(x.denominator, -1, p) % p


class ResidueSource:
    """A source of random residues at a number of points, from a seed: the whole field whatever the
    range that is asked for."""

    def __init__(self, p: int, points: int, seed: int):
        self.p, self.points, self.random = p, points, np.random.default_rng(seed)

    def randint(self, a: int, b: int, /) -> Residues:
        """A random number, one at each point."""
        del a, b
        return Residues(self.random.integers(1, self.p, self.points, dtype=np.int64), self.p)

    def one_value(self) -> Residues:
        """A random number, the same at all points."""
        return Residues(np.full(self.points, self.random.integers(1, self.p), np.int64), self.p)

    def constant(self, x: Any) -> Residues:
        """A rational number at all points."""
        return Residues(np.full(self.points, residue_of(x, self.p), np.int64), self.p)


Elementary = Callable[[str, Residues], Residues]
