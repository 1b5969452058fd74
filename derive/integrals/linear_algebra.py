"""Exact kernels of sparse systems: modulo a prime, and over a field, of few unknowns.

The prime finds what there may be; the field proves it.  A kernel modulo p is at least as large as
the true one, so what is found modulo p and proved over the field is all there is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from ..algebra.exact_kernel import kernel, pivots

PRIMES = (2**31 - 1, 2**31 - 19, 2**31 - 61)
"""Primes below 2³¹: a product of two residues fits into 63 bits."""

Row = Mapping[int, Any]
"""A sparse row, column → entry."""


def kernel_modulo(rows: Iterable[Row], width: int, p: int) -> list[list[int]]:
    """A basis of {x : Σ_j a_j x_j = 0 for every row} modulo p, vectors of ``width`` residues."""
    return kernel(_distinct(rows, width, p), width, p)[0]


def _distinct(rows: Iterable[Row], width: int, p: int) -> Iterator[list[int]]:
    """The rows that are not the same, in order, with their zeros."""
    for row in sorted({tuple(sorted((j, x % p) for j, x in row.items() if x % p)) for row in rows}):
        found = [0] * width
        for j, x in row:
            found[j] = int(x)
        yield found


def rank_modulo(rows: Sequence[Sequence[int]], p: int) -> int:
    """The rank of a dense matrix modulo p."""
    width = len(rows[0]) if rows else 0
    return len(pivots(([int(x % p) for x in row] for row in rows), width, p))


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
