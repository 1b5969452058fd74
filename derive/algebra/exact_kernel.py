"""Exact kernels of large systems: vectors modulo primes, and rational numbers from residues."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache
from math import isqrt
from operator import add, mul
from random import Random
from struct import Struct
from typing import Any

from ..language.rational import RingElement

Row = Sequence[int]
"""Residues."""
Rows = list[list[int]]

SIZE = 10
"""Bytes of a digit: sums of 2¹⁸ products of two residues fit."""
BITS = 8 * SIZE
DIGIT = (1 << BITS) - 1


@cache
def _format(width: int, digit: str) -> Struct:
    return Struct("<" + digit * width)


def _packed(row: Row) -> int:
    """Residues as the digits of one number, the first the lowest."""
    return int.from_bytes(_format(len(row), "Qxx").pack(*row), "little")


def _residues(row: int, width: int, p: int) -> list[int]:
    """The digits of a number modulo p."""
    parts = _format(width, "QH").unpack(row.to_bytes(SIZE * width, "little"))
    pairs = zip(parts[::2], parts[1::2], strict=True)
    return [(low + (high << 64)) % p for low, high in pairs]


def _leading(rows: Iterable[Row], width: int, p: int) -> dict[int, list[int]]:
    """Rows of a (not reduced) echelon form, from their first entries, which are 1, on: by the
    columns of these, in order."""
    packed: dict[int, int] = {}
    found: dict[int, list[int]] = {}
    for row in rows:
        left, col = _packed(row), 0
        while left:
            first = left & DIGIT
            if not first:
                zeros = ((left & -left).bit_length() - 1) // BITS
                left >>= BITS * zeros
                col += zeros
                first = left & DIGIT
            first %= p
            if first and col not in packed:
                inverse = pow(first, -1, p)
                found[col] = [x * inverse % p for x in _residues(left, width - col, p)]
                packed[col] = _packed(found[col])
                break
            if first:
                left += (p - first) * packed[col]
            left >>= BITS
            col += 1
        if len(found) == width:
            break
    return dict(sorted(found.items()))


def pivots(rows: Iterable[Row], width: int, p: int) -> list[int]:
    """The columns of a matrix that depend modulo p on no earlier ones."""
    return [*_leading(rows, width, p)]


def _reduced(rows: Iterable[Row], width: int, p: int) -> tuple[dict[int, list[int]], list[int]]:
    """The reduced row echelon form modulo p: pivot column → the entries at the free columns, and
    these columns."""
    leading = _leading(rows, width, p)
    free = [c for c in range(width) if c not in leading]
    packed: dict[int, int] = {}
    found: dict[int, list[int]] = {}
    for col, row in reversed(leading.items()):
        left = _packed([row[c - col] if c > col else 0 for c in free])
        for other, known in packed.items():
            if x := row[other - col]:
                left += (p - x) * known
        found[col] = _residues(left, len(free), p)
        packed[col] = _packed(found[col])
    return dict(sorted(found.items())), free


def echelon(rows: Iterable[Row], width: int, p: int) -> tuple[Rows, list[int]]:
    """The reduced row echelon form modulo p of a matrix of ``width`` columns, and its
    pivot columns."""
    reduced, free = _reduced(rows, width, p)
    found = []
    for col, entries in reduced.items():
        row = [0] * width
        row[col] = 1
        for c, x in zip(free, entries, strict=True):
            row[c] = x
        found.append(row)
    return found, [*reduced]


def kernel(rows: Iterable[Row], width: int, p: int) -> tuple[Rows, list[int]]:
    """A basis of {x : a x = 0} modulo p as rows, for a matrix a of ``width`` columns, and the free
    column of each, where it has 1 and the others have 0."""
    reduced, free = _reduced(rows, width, p)
    found = []
    for k, c in enumerate(free):
        x = [0] * width
        x[c] = 1
        for col, entries in reduced.items():
            x[col] = -entries[k] % p
        found.append(x)
    return found, free


def fraction_of(x: int, modulus: int) -> Fraction | None:
    """The fraction n/d with |n|, d ≤ √(modulus/2) that is x modulo ``modulus``; ``None`` where
    there is none."""
    bound = isqrt(modulus // 2)
    r, s, u, v = modulus, x % modulus, 0, 1
    while s > bound:
        k = r // s
        r, s, u, v = s, r - k * s, v, u - k * v
    if not v or abs(v) > bound:
        return None
    return Fraction(s, v)


def combined(residues: Sequence[int], primes: Sequence[int]) -> tuple[int, int]:
    """The residue modulo the product of primes that has these residues, and that product."""
    x, modulus = residues[0], primes[0]
    for r, p in zip(residues[1:], primes[1:], strict=True):
        x += modulus * ((r - x) * pow(modulus, -1, p) % p)
        modulus *= p
    return x, modulus


def rational(residues: Sequence[int], primes: Sequence[int]) -> Fraction | None:
    """The fraction that residues modulo some primes come from, the last prime left for a test of
    it; ``None`` where that fails."""
    x = fraction_of(*combined(residues[:-1], primes[:-1]))
    p = primes[-1]
    if x is None or x.denominator % p == 0:
        return None
    return x if (x.numerator - residues[-1] * x.denominator) % p == 0 else None


# Vectors modulo a prime: a number is the residues of its values, one for each point.
#
# A claim about generic points is tried at all of them at once; samplers of groups take
# ResidueSource as they take a source of integers. Lists of Python's integers, so that they are
# the same where there is no NumPy; matrices are in exact_kernel.

PRIMES = (2147483647, 2147483587, 2147483579, 2147483563, 2147483543, 2147483423)
"""Primes below 2³¹ that are 3 modulo 4: a square has the root x^((p + 1)/4)."""


def primes_from(p: int) -> Iterator[int]:
    """The primes that are 3 modulo 4, from one of these down, by Miller's test: for the bases 2, 3,
    5, 7 a proof below 3·10⁹ (Jaeschke)."""
    while p > 3:
        if all(pow(base, p // 2, p) in (1, p - 1) for base in (2, 3, 5, 7)):
            yield p
        p -= 4


class ResidueVector(RingElement):
    """Residues modulo p at some points; ``values``: a list, from 0 to p − 1, one for each point."""

    __slots__ = ("_inverse", "p", "values")

    def __init__(self, values: list[int], p: int):
        self.values, self.p = values, p
        self._inverse: ResidueVector | None = None

    def like(self, values: list[int]) -> ResidueVector:
        """Other residues modulo the same prime."""
        return ResidueVector(values, self.p)

    def at(self, places: Sequence[int]) -> ResidueVector:
        """The same number at some of the points."""
        return self.like([self.values[k] for k in places])

    def __add__(self, other: Any) -> ResidueVector:
        p = self.p
        if isinstance(other, ResidueVector):
            if not (self and other):
                return self if self else other
            pairs = zip(self.values, other.values, strict=True)
            return self.like([(x + y) % p for x, y in pairs])
        c = residue_of(other, p)
        return self.like([(x + c) % p for x in self.values]) if c else self

    def __neg__(self) -> ResidueVector:
        return self.like([-x % self.p for x in self.values])

    def __sub__(self, other: Any) -> ResidueVector:
        p = self.p
        if isinstance(other, ResidueVector):
            pairs = zip(self.values, other.values, strict=True)
            return self.like([(x - y) % p for x, y in pairs])
        return self.__add__(-other)

    def __mul__(self, other: Any) -> ResidueVector:
        p = self.p
        if isinstance(other, ResidueVector):
            if not (self and other):
                return self.like([0] * len(self.values))
            pairs = zip(self.values, other.values, strict=True)
            return self.like([x * y % p for x, y in pairs])
        c = residue_of(other, p)
        return self.like([x * c % p for x in self.values]) if c != 1 else self

    def __truediv__(self, other: Any) -> ResidueVector:
        if isinstance(other, ResidueVector):
            return self * other.inverse()
        return self * pow(residue_of(other, self.p), -1, self.p)

    def __rtruediv__(self, other: Any) -> ResidueVector:
        return self.inverse().__mul__(other)

    def __pow__(self, n: int) -> ResidueVector:
        if n == 2:
            return self * self
        p, base = self.p, self if n >= 0 else self.inverse()
        return self.like([pow(x, abs(n), p) for x in base.values])

    def __eq__(self, other: object) -> bool:
        """Is it the same at every point?"""
        if isinstance(other, ResidueVector):
            return self.values == other.values
        c = residue_of(other, self.p)
        return all(x == c for x in self.values)

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        """Is it other than 0 at some point?"""
        return any(self.values)

    @staticmethod
    def dot(a: Iterable[Any], b: Iterable[Any]) -> ResidueVector:
        """Σ a_i b_i, of which some are rational numbers: what is 0 or 1 costs nothing, and the sum
        alone is reduced."""
        pairs = [*zip(a, b, strict=True)]
        p, count = next(
            (x.p, len(x.values)) for xy in pairs for x in xy if isinstance(x, ResidueVector)
        )
        total, constant = [0] * count, 0
        for x, y in pairs:
            if not isinstance(x, ResidueVector):
                x, y = y, x
            if not (x and y):
                continue
            products: Iterable[int]
            if isinstance(y, ResidueVector):
                products = map(mul, x.values, y.values)
            elif isinstance(x, ResidueVector):
                c = residue_of(y, p)
                products = x.values if c == 1 else (c * v for v in x.values)
            else:
                constant += residue_of(x, p) * residue_of(y, p)
                continue
            total = [*map(add, total, products)]
        return ResidueVector([(x + constant) % p for x in total], p)

    def inverse(self) -> ResidueVector:
        """1/x at each point; 0 where x is 0."""
        if self._inverse is None:
            self._inverse = self.like([pow(x, -1, self.p) if x else 0 for x in self.values])
        return self._inverse

    def root(self) -> ResidueVector:
        """A square root at each point that has one, a number of no meaning at the others."""
        return self ** ((self.p + 1) // 4)


def residue_of(x: Any, p: int) -> int:
    """A rational number, or a residue of one, modulo p, as an integer; ``ZeroDivisionError`` where
    p divides its denominator."""
    if isinstance(x, int):
        return x % p
    if x.denominator % p == 0:
        raise ZeroDivisionError(f"{x} modulo {p}")
    return int(x.numerator * pow(x.denominator, -1, p) % p)


class ResidueVectorSource:
    """A source of random residues at a number of points, from a seed: the whole field whatever the
    range that is asked for."""

    def __init__(self, p: int, points: int, seed: int):
        self.p, self.points, self.random = p, points, Random(seed)

    def randint(self, a: int, b: int, /) -> ResidueVector:
        """A random number, one at each point; Python promises the same ``random`` of a seed in
        every version."""
        del a, b
        random, most = self.random.random, self.p - 1
        return ResidueVector([1 + int(random() * most) for _ in range(self.points)], self.p)

    def constant(self, x: Any) -> ResidueVector:
        """A rational number at all points."""
        return ResidueVector([residue_of(x, self.p)] * self.points, self.p)
