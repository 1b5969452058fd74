"""The state of a program: which entries of the group element it holds, in which order.

A linear group keeps A row by row, an affine one A and then T; a product, factor after factor, the
blocks of one matrix whose other entries are 0, or 1 where an affine factor has its last row.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.groups import Group
from .naming import suffixed


@dataclass(frozen=True)
class Slot:
    """One number of the state: entry (row, column), from 0, of the matrix A or the vector T."""

    name: str
    letter: str
    row: int
    column: int = 0


def layout(group: Group) -> list[Slot]:
    """The slots of a group element."""
    if not group.factors:
        return _factor(group, "", 0, group.affine)
    return [
        slot
        for k, (offset, factor) in enumerate(group.places, 1)
        for slot in _factor(factor, str(k) if len(group.factors) > 1 else "", offset, False)
    ]


def _factor(g: Group, mark: str, offset: int, apart: bool) -> list[Slot]:
    """``apart``: the translation is a vector of its own, not a column of A."""
    span = range(g.n)
    slots = [
        Slot(suffixed(f"A{mark}", i + 1, j + 1), "A", offset + i, offset + j)
        for i in span
        for j in span
    ]
    if g.affine:
        slots += [
            Slot(suffixed(f"T{mark}", i + 1), "T", i)
            if apart
            else Slot(suffixed(f"T{mark}", i + 1), "A", offset + i, offset + g.n)
            for i in span
        ]
    return slots


def fixed_entries(group: Group) -> dict[tuple[int, int], int]:
    """The entries of A that are no part of the state but 1: the corners of affine factors."""
    return {
        (offset + f.n, offset + f.n): 1 for offset, f in group.places if group.factors and f.affine
    }
