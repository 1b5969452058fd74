"""Exact kernels of sparse systems: modulo a prime, and over a field, of few unknowns.

The prime finds what there may be; the field proves it.  A kernel modulo p is at least as large as
the true one, so what is found modulo p and proved over the field is all there is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

PRIMES = (2**31 - 1, 2**31 - 19, 2**31 - 61)
"""Primes below 2³¹: a product of two residues fits into 63 bits."""

Row = Mapping[int, Any]
"""A sparse row, column → entry."""


def kernel_modulo(rows: Iterable[Row], width: int, p: int) -> list[list[int]]:
    """A basis of {x : Σ_j a_j x_j = 0 for every row} modulo p, vectors of ``width`` residues."""
    reduced, pivots = echelon_modulo(rows, width, p)
    basis = []
    for free in (j for j in range(width) if j not in pivots):
        x = [0] * width
        x[free] = 1
        for r, j in enumerate(pivots):
            x[j] = -int(reduced[r, free]) % p
        basis.append(x)
    return basis


def echelon_modulo(rows: Iterable[Row], width: int, p: int) -> tuple[Any, list[int]]:
    """The reduced echelon form modulo p, as an array, and its pivot columns."""
    import numpy as np

    distinct = {tuple(sorted((j, x % p) for j, x in row.items() if x % p)) for row in rows}
    a = np.zeros((len(distinct), width), dtype=np.int64)
    for i, row in enumerate(sorted(distinct)):
        for j, x in row:
            a[i, j] = x
    pivots: list[int] = []
    for j in range(width):
        r = len(pivots)
        below = np.flatnonzero(a[r:, j])
        if not below.size:
            continue
        k = r + int(below[0])
        if k != r:
            a[[r, k]] = a[[k, r]]
        a[r] = a[r] * pow(int(a[r, j]), -1, p) % p
        others = np.flatnonzero(a[:, j])
        others = others[others != r]
        if others.size:
            active = np.flatnonzero(a[r])
            block = np.ix_(others, active)
            a[block] = (a[block] - a[others, j][:, None] * a[r, active]) % p
        pivots.append(j)
    return a, pivots


def rank_modulo(rows: Sequence[Sequence[int]], p: int) -> int:
    """The rank of a dense matrix modulo p."""
    if not rows:
        return 0
    sparse = [{j: x for j, x in enumerate(row) if x % p} for row in rows]
    return len(echelon_modulo(sparse, len(rows[0]), p)[1])


def kernel_vector(rows: Sequence[Row], width: int, field: Any) -> list[Any] | None:
    """The vector that spans {x : Σ_j a_j x_j = 0 for every row} over a field of SymPy; ``None``
    where that is not of dimension 1."""
    from sympy.polys.matrices import DomainMatrix

    entries = {i: {j: x for j, x in row.items() if x} for i, row in enumerate(rows)}
    found = DomainMatrix({i: r for i, r in entries.items() if r}, (len(rows), width), field)
    basis = found.nullspace().to_sdm() if rows else None
    if basis is None or basis.shape[0] != 1:
        return None
    (vector,) = basis.values()
    return [vector.get(j, field.zero) for j in range(width)]
