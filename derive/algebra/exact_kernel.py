"""Exact kernels of large systems: elimination modulo primes, and rational numbers from residues.

Modulo a prime below 2³¹ a row of residues is one long integer, with digits so long that sums of
products of residues do not overflow into the next: to take a multiple of one row from another is
one multiplication and one sum.  What comes out is a number of Q where all primes agree on it
(Chinese remainders, Wang's reconstruction).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cache
from math import isqrt
from struct import Struct

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
