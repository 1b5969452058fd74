"""Matrices of which most entries are 0, as place → entry: those of a basis of a Lie algebra."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..language.rational import Matrix

Sparse = Mapping[tuple[int, int], Any]


def sparse(m: Matrix) -> Sparse:
    """The entries that are not 0."""
    return {(i, j): x for i, row in enumerate(m) for j, x in enumerate(row) if x}


def commutator(a: Sparse, b: Sparse) -> Sparse:
    """ab − ba."""
    return _sum([*_product(a, b), *((at, -x) for at, x in _product(b, a))])


def combined(weights: Sequence[Any], basis: Sequence[Sparse]) -> Sparse:
    """Σ w_a E_a."""
    pairs = zip(weights, basis, strict=True)
    return _sum((at, w * x) for w, e in pairs if w for at, x in e.items())


def _product(a: Sparse, b: Sparse) -> Iterable[tuple[tuple[int, int], Any]]:
    rows: dict[int, list[tuple[int, Any]]] = {}
    for (i, j), x in b.items():
        rows.setdefault(i, []).append((j, x))
    for (i, k), x in a.items():
        for j, y in rows.get(k, ()):
            yield (i, j), x * y


def _sum(terms: Iterable[tuple[tuple[int, int], Any]]) -> Sparse:
    total: dict[tuple[int, int], Any] = {}
    for at, x in terms:
        total[at] = total.get(at, 0) + x
    return {at: x for at, x in total.items() if x}
