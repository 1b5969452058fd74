"""Vectors of a space with many zeros, which have simpler functions of the parameters as entries.

A relabelling of a turned ellipsoid, r ↦ r + εWJ⁻¹r with W skew, has a row of zeros where two of the
three numbers of W vanish; the reduced echelon form mixes these.
"""

from __future__ import annotations

from random import Random

from ..algebra.exact_kernel import Rows, echelon, pivots

ORDERS = 200
"""So many orders of the columns are tried."""

MOST = 40
"""So many vectors are tried."""

Columns = tuple[int, ...]
"""Where a vector is 1, then where it is 0: as many as the dimension, which determines it."""


def vector(basis: Rows, columns: Columns, p: int) -> list[int]:
    """The vector of the span of independent rows that is 1 and 0 at these columns."""
    width = len(basis[0])
    order = [*columns, *(c for c in range(width) if c not in columns)]
    reduced, _ = echelon(_permuted(basis, order), width, p)
    return [x for _, x in sorted(zip(order, reduced[0], strict=True))]


def sparse(basis: Rows, p: int) -> list[Columns]:
    """Vectors of the span with many zeros, those with most first: rows of echelon forms."""
    random, width = Random(0), len(basis[0])
    found: dict[frozenset[int], Columns] = {}
    for _ in range(ORDERS):
        order = sorted(range(width), key=lambda _: random.random())
        reduced, leading = echelon(_permuted(basis, order), width, p)
        columns = [order[c] for c in leading]
        for k, row in enumerate(reduced):
            support = frozenset(c for c, x in zip(order, row, strict=True) if x)
            found.setdefault(support, (columns[k], *columns[:k], *columns[k + 1 :]))
    return [found[x] for x in sorted(found, key=lambda x: (len(x), sorted(x)))][:MOST]


def _permuted(basis: Rows, order: list[int]) -> Rows:
    return [[row[c] for c in order] for row in basis]


def independent(basis: Rows, p: int) -> bool:
    """Are rows independent modulo p?"""
    return len(pivots(basis, len(basis[0]), p)) == len(basis)
