"""Vectors modulo a prime: a number is the residues of its values, one for each point.

A claim about generic points is tried at all of them at once; samplers of groups take
:class:`ResidueSource` as they take a source of integers.  Lists of Python's integers, so that they
are the same where there is no NumPy; matrices are in :mod:`.exact_kernel`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from operator import add, mul
from random import Random
from typing import Any

PRIMES = (2147483647, 2147483587, 2147483579, 2147483563, 2147483543, 2147483423)
"""Primes below 2³¹ that are 3 modulo 4: a square has the root x^((p + 1)/4)."""


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
    """Residues modulo p at some points; ``values``: a list, from 0 to p − 1, one for each point."""

    __slots__ = ("_inverse", "p", "values")

    def __init__(self, values: list[int], p: int):
        self.values, self.p = values, p
        self._inverse: Residues | None = None

    def like(self, values: list[int]) -> Residues:
        """Other residues modulo the same prime."""
        return Residues(values, self.p)

    def at(self, places: Sequence[int]) -> Residues:
        """The same number at some of the points."""
        return self.like([self.values[k] for k in places])

    def __add__(self, other: Any) -> Residues:
        p = self.p
        if isinstance(other, Residues):
            if not (self and other):
                return self if self else other
            pairs = zip(self.values, other.values, strict=True)
            return self.like([(x + y) % p for x, y in pairs])
        c = residue_of(other, p)
        return self.like([(x + c) % p for x in self.values]) if c else self

    __radd__ = __add__

    def __neg__(self) -> Residues:
        return self.like([-x % self.p for x in self.values])

    def __sub__(self, other: Any) -> Residues:
        p = self.p
        if isinstance(other, Residues):
            pairs = zip(self.values, other.values, strict=True)
            return self.like([(x - y) % p for x, y in pairs])
        return self.__add__(-other)

    def __rsub__(self, other: Any) -> Residues:
        return (-self).__add__(other)

    def __mul__(self, other: Any) -> Residues:
        p = self.p
        if isinstance(other, Residues):
            if not (self and other):
                return self.like([0] * len(self.values))
            pairs = zip(self.values, other.values, strict=True)
            return self.like([x * y % p for x, y in pairs])
        c = residue_of(other, p)
        return self.like([x * c % p for x in self.values]) if c != 1 else self

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Residues:
        if isinstance(other, Residues):
            return self * other.inverse()
        return self * pow(residue_of(other, self.p), -1, self.p)

    def __rtruediv__(self, other: Any) -> Residues:
        return self.inverse().__mul__(other)

    def __pow__(self, n: int) -> Residues:
        if n == 2:
            return self * self
        p, base = self.p, self if n >= 0 else self.inverse()
        return self.like([pow(x, abs(n), p) for x in base.values])

    def __eq__(self, other: object) -> bool:
        """Is it the same at every point?"""
        if isinstance(other, Residues):
            return self.values == other.values
        c = residue_of(other, self.p)
        return all(x == c for x in self.values)

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        """Is it other than 0 at some point?"""
        return any(self.values)

    @staticmethod
    def dot(a: Iterable[Any], b: Iterable[Any]) -> Residues:
        """Σ a_i b_i, of which some are rational numbers: what is 0 or 1 costs nothing, and the sum
        alone is reduced."""
        pairs = [*zip(a, b, strict=True)]
        p, count = next((x.p, len(x.values)) for xy in pairs for x in xy if isinstance(x, Residues))
        total, constant = [0] * count, 0
        for x, y in pairs:
            if not isinstance(x, Residues):
                x, y = y, x
            if not (x and y):
                continue
            products: Iterable[int]
            if isinstance(y, Residues):
                products = map(mul, x.values, y.values)
            elif isinstance(x, Residues):
                c = residue_of(y, p)
                products = x.values if c == 1 else (c * v for v in x.values)
            else:
                constant += residue_of(x, p) * residue_of(y, p)
                continue
            total = [*map(add, total, products)]
        return Residues([(x + constant) % p for x in total], p)

    def inverse(self) -> Residues:
        """1/x at each point; 0 where x is 0."""
        if self._inverse is None:
            self._inverse = self.like([pow(x, -1, self.p) if x else 0 for x in self.values])
        return self._inverse

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
        self.p, self.points, self.random = p, points, Random(seed)

    def randint(self, a: int, b: int, /) -> Residues:
        """A random number, one at each point; Python promises the same ``random`` of a seed in
        every version."""
        del a, b
        random, most = self.random.random, self.p - 1
        return Residues([1 + int(random() * most) for _ in range(self.points)], self.p)

    def constant(self, x: Any) -> Residues:
        """A rational number at all points."""
        return Residues([residue_of(x, self.p)] * self.points, self.p)
