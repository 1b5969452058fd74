"""The entries of an element of a group, by those that tell them: the affine hull of the group.

Every g in the connected group is 1 + a sum of products of elements of 𝔤, and such products span the
linear parts of that hull: what is linear among entries of these holds among those of g.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache

from ..language import rational as q
from ..language.rational import Matrix
from .groups import Group

Combination = tuple[Fraction, dict[tuple[int, int], Fraction]]
"""A number, and the weights of entries by their places from 0."""


@cache
def told_entries(group: Group) -> tuple[tuple[Combination, ...], ...]:
    """Every entry of g, size × size, as number + Σ weight · entry of the free ones."""
    size = group.size
    start = (Fraction(1), *q.flatten(q.identity(size)))
    rows, pivots = q.echelon((start, *((Fraction(0), *q.flatten(p)) for p in _products(group))))
    places = [divmod(p - 1, size) for p in pivots[1:]]
    return tuple(
        tuple(
            (
                rows[0][1 + size * i + j],
                {
                    place: row[1 + size * i + j]
                    for place, row in zip(places, rows[1:], strict=False)
                    if row[1 + size * i + j]
                },
            )
            for j in range(size)
        )
        for i in range(size)
    )


@cache
def constant_entries(group: Group) -> dict[tuple[int, int], Fraction]:
    """Place, from 0, → the number that an entry of g is in all of the group; of a group of which no
    exact elements are known, the places between blocks and in the last rows of affine ones."""
    span = range(group.size)
    if group.has_inner_samples:
        told = told_entries(group)
        return {(i, j): told[i][j][0] for i in span for j in span if not told[i][j][1]}
    block = {k: offset for offset, f in group.places for k in range(offset, offset + f.size)}
    last = {offset + f.n for offset, f in group.places if f.affine}
    return {
        (i, j): Fraction(int(i == j))
        for i in span
        for j in span
        if i in last or block[i] != block[j]
    }


def _products(group: Group) -> list[Matrix]:
    """Products of elements of the basis, as many as are independent."""
    kept: list[Matrix] = []
    reduced: dict[int, tuple[Fraction, ...]] = {}
    waiting = [*group.basis]
    while waiting:
        e = waiting.pop()
        rest = q.flatten(e)
        for k, row in reduced.items():
            if rest[k]:
                rest = tuple(x - rest[k] * y for x, y in zip(rest, row, strict=True))
        lead = next((k for k, x in enumerate(rest) if x), None)
        if lead is None:
            continue
        reduced[lead] = tuple(x / rest[lead] for x in rest)
        kept.append(e)
        waiting += [q.times(x, e) for x in group.basis]
    return kept
