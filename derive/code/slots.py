"""The layout of a group element in the state: which of its entries are numbers of it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra.groups import Group, constant_entries
from ..language.reserved import suffixed


@dataclass(frozen=True)
class Slot:
    """One number of the state: entry (row, column), from 0, of the matrix A or the vector T."""

    name: str
    letter: str
    row: int
    column: int = 0


def layout(group: Group, columns: bool = False) -> list[Slot]:
    """The slots of a group element kept as matrices; ``columns``: column by column."""
    if not group.factors:
        return _factor(group, "", 0, group.affine, columns)
    several = len(group.factors) > 1
    return [
        slot
        for k, (offset, factor) in enumerate(group.places, 1)
        for slot in _factor(factor, str(k) if several else "", offset, False, columns)
    ]


def _factor(g: Group, mark: str, offset: int, apart: bool, columns: bool) -> list[Slot]:
    """The slots of a factor, its block at ``offset``; ``apart``: T is a vector, no column of A."""
    span = range(g.n)
    pairs = [(j, i) if columns else (i, j) for i in span for j in span]
    slots = [
        Slot(suffixed(f"A{mark}", i + 1, j + 1), "A", offset + i, offset + j) for i, j in pairs
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
    """Place → 1: the corners of affine factors, entries of A that are always 1."""
    return {
        (offset + f.n, offset + f.n): 1 for offset, f in group.places if group.factors and f.affine
    }


def still_slots(group: Group) -> dict[Slot, Fraction]:
    """Slot → the number that it is in all of the group, of those that never vary."""
    known = constant_entries(group)
    places = {x: (x.row, group.n if x.letter == "T" else x.column) for x in layout(group)}
    return {x: known[at] for x, at in places.items() if at in known}
