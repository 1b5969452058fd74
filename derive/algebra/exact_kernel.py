"""Exact kernels of large systems: elimination modulo primes, and rational numbers from residues.

Elimination modulo a prime below 2³¹ is done on rows of NumPy, whose products do not overflow; what
comes out is a number of Q where all primes agree on it (Chinese remainders, Wang's reconstruction).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

import numpy as np

from .residue_arrays import Array


def echelon(a: Array, p: int) -> tuple[Array, list[int]]:
    """The reduced row echelon form modulo p of an integer matrix, and its pivot columns."""
    rows = np.array(a % p, np.int64)
    pivots: list[int] = []
    for col in range(rows.shape[1]):
        r = len(pivots)
        if r == len(rows):
            break
        found = np.flatnonzero(rows[r:, col])
        if not len(found):
            continue
        k = r + int(found[0])
        if k != r:
            rows[[r, k]] = rows[[k, r]]
        rows[r, col:] = rows[r, col:] * pow(int(rows[r, col]), -1, p) % p
        others = np.flatnonzero(rows[:, col])
        others = others[others != r]
        product = rows[others, col, None] * rows[r, col:] % p
        rows[others, col:] = (rows[others, col:] - product) % p
        pivots.append(col)
    return rows[: len(pivots)], pivots


def kernel(a: Array, p: int) -> tuple[Array, list[int]]:
    """A basis of {x : a x = 0} modulo p as rows, and the free column of each, where it has 1 and
    the others have 0."""
    reduced, pivots = echelon(a, p)
    width = a.shape[1]
    free = [c for c in range(width) if c not in {*pivots}]
    found = np.zeros((len(free), width), np.int64)
    for k, c in enumerate(free):
        found[k, c] = 1
        found[k, pivots] = -reduced[:, c] % p
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
