"""Rational numbers by their residues modulo a large random prime.

Two different numbers have the same residue only for primes that divide their difference. Of the
more than 2²⁴⁷ primes of 256 bits these are one for every 255 bits of its numerator: fewer than the
degree of a claim, so that they add nothing to its bound.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from operator import mul
from random import Random
from typing import Any

BITS = 256
ROUNDS = 40
SMALL = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)


def random_prime(random: Random) -> int:
    """A random prime of :data:`BITS` bits."""
    while True:
        n = random.getrandbits(BITS) | 1 | 1 << (BITS - 1)
        if all(n % p for p in SMALL) and all(
            _passes_miller_rabin(n, random) for _ in range(ROUNDS)
        ):
            return n


def _passes_miller_rabin(n: int, random: Random) -> bool:
    """Does n pass Miller and Rabin's test for one random base? A composite does once in four."""
    odd, twos = n - 1, 0
    while not odd & 1:
        odd, twos = odd >> 1, twos + 1
    x = pow(random.randrange(2, n - 1), odd, n)
    return x == 1 or any(pow(x, 1 << k, n) == n - 1 for k in range(twos))


@lru_cache(2**12)
def _quotient(a: int, b: int, p: int) -> int:
    """a/b modulo p; ``ZeroDivisionError`` where p divides b."""
    return a * _inverse(b, p) % p


def _inverse(n: int, p: int) -> int:
    if not n % p:
        raise ZeroDivisionError("division by zero")
    return pow(n, -1, p)


def _residue(x: Any, p: int) -> int:
    """The residue of an integer, a fraction or a residue, as an integer."""
    if type(x) is Residue:
        return x.n
    a, b = x.as_integer_ratio()
    return int(a) if b == 1 else _quotient(a, b, p)


class Residue:
    """The residue n of a rational number modulo a prime p: an element of the field F_p."""

    __slots__ = ("n", "p")

    def __init__(self, n: int, p: int):
        self.n, self.p = n % p, p

    def _other(self, x: Any) -> int | None:
        if isinstance(x, Residue):
            return x.n
        if isinstance(x, int):
            return x
        if not isinstance(x, Fraction):
            return None
        a, b = x.numerator, x.denominator
        return a if b == 1 else _quotient(a, b, self.p)

    @staticmethod
    def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
        """Σ a_i b_i, reduced modulo p once."""
        return Residue.product([a], [b])[0][0]

    @staticmethod
    def product(rows: Sequence[Sequence[Any]], columns: Sequence[Sequence[Any]]) -> Any:
        """Each row times each column, reduced modulo p once."""
        p = next(x.p for m in (rows, columns) for y in m for x in y if isinstance(x, Residue))
        left, right = ([[_residue(x, p) for x in y] for y in m] for m in (rows, columns))
        return tuple(tuple(Residue(sum(map(mul, x, y)), p) for y in right) for x in left)

    def __add__(self, other: Any) -> Any:
        y = other.n if isinstance(other, Residue) else self._other(other)
        return NotImplemented if y is None else Residue(self.n + y, self.p)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        y = other.n if isinstance(other, Residue) else self._other(other)
        return NotImplemented if y is None else Residue(self.n - y, self.p)

    def __rsub__(self, other: Any) -> Any:
        y = self._other(other)
        return NotImplemented if y is None else Residue(y - self.n, self.p)

    def __mul__(self, other: Any) -> Any:
        y = other.n if isinstance(other, Residue) else self._other(other)
        return NotImplemented if y is None else Residue(self.n * y, self.p)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        y = self._other(other)
        return NotImplemented if y is None else Residue(self.n * _inverse(y, self.p), self.p)

    def __rtruediv__(self, other: Any) -> Any:
        y = self._other(other)
        return NotImplemented if y is None else Residue(y * _inverse(self.n, self.p), self.p)

    def __neg__(self) -> Residue:
        return Residue(-self.n, self.p)

    def __pow__(self, n: int) -> Residue:
        return Residue(pow(self.n if n > 0 else _inverse(self.n, self.p), abs(n), self.p), self.p)

    def __eq__(self, other: object) -> bool:
        y = self._other(other)
        return NotImplemented if y is None else self.n == y % self.p

    def __hash__(self) -> int:
        return hash(self.n)


class ResidueSource:
    """A source of residues modulo p in the place of a random one, to draw a model from."""

    def __init__(self, random: Random, p: int):
        self.random, self.p = random, p

    def randint(self, low: int, high: int) -> Residue:
        """The residue of a random integer from low to high."""
        return Residue(self.random.randint(low, high), self.p)
