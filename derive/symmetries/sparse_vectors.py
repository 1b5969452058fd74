"""Vectors of a space with many zeros, which have simpler functions of the parameters as entries.

A relabelling of a turned ellipsoid, r ↦ r + εWJ⁻¹r with W skew, has a row of zeros where two of the
three numbers of W vanish; the reduced echelon form mixes these.
"""

from __future__ import annotations

import numpy as np

from ..algebra.exact_kernel import echelon
from ..algebra.residue_arrays import Array

ORDERS = 60
"""So many orders of the columns are tried."""

MOST = 40
"""So many vectors are tried."""

Columns = tuple[int, ...]
"""Where a vector is 1, then where it is 0: as many as the dimension, which determines it."""


def vector(basis: Array, columns: Columns, p: int) -> Array:
    """The vector of the span of independent rows that is 1 and 0 at these columns."""
    order = [*columns, *(c for c in range(basis.shape[1]) if c not in columns)]
    reduced, _ = echelon(basis[:, order], p)
    found = np.zeros(basis.shape[1], np.int64)
    found[order] = reduced[0]
    return found


def sparse(basis: Array, p: int) -> list[Columns]:
    """Vectors of the span with many zeros, those with most first: rows of echelon forms."""
    random, width = np.random.default_rng(0), basis.shape[1]
    found: dict[bytes, tuple[int, Columns]] = {}
    for _ in range(ORDERS):
        order = random.permutation(width)
        reduced, pivots = echelon(basis[:, order], p)
        columns = [int(order[c]) for c in pivots]
        for k, row in enumerate(reduced):
            x = np.zeros(width, bool)
            x[order] = row != 0
            shape = (columns[k], *columns[:k], *columns[k + 1 :])
            found.setdefault(x.tobytes(), (int(x.sum()), shape))
    return [shape for _, shape in sorted(found.values(), key=lambda entry: entry[0])][:MOST]


def independent(basis: Array, p: int) -> bool:
    """Are rows independent modulo p?"""
    return len(echelon(basis, p)[1]) == len(basis)
