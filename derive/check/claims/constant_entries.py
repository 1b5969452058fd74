"""The entries that are the same for all elements of a group, as 1 and 0 in the last row of affine
maps: g is 1 and a sum of products of elements of 𝔤, all of which are 0 there."""

from __future__ import annotations

from fractions import Fraction

from ...algebra.groups import Group
from ...language import rational as q


def constant_entries(group: Group) -> dict[tuple[int, int], Fraction]:
    """Row and column, from 0 → the number that all elements have in common there."""
    span = range(group.size)
    rows = [_rows(group, i) for i in span]
    return {(i, j): Fraction(i == j) for i in span for j in span if not any(v[j] for v in rows[i])}


def _rows(group: Group, i: int) -> list[tuple[Fraction, ...]]:
    """A basis of the rows i of the products."""
    found: list[tuple[Fraction, ...]] = []
    waiting = [q.identity(group.size)[i]]
    while waiting:
        row = (waiting.pop(),)
        for (x,) in (q.times(row, e) for e in group.basis):
            if q.rank((*found, x)) > len(found):
                found.append(x)
                waiting.append(x)
    return found
