"""What of a step's equations gets a number: each by itself, short ones of a family by the row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby

from ..algebra.show import show
from ..record.record import Equation
from .wrap import display_width

TABLE, CELL, ROW = 4, 24, 72
"""More cells than this stand side by side; how wide one is at most, and a row, in letters."""
SIMPLE = ("par", "entry", "matrix", "add", "mul")


@dataclass(frozen=True)
class Entry:
    """Equations under one number; ``first`` is the place of the first of them in the step."""

    first: int
    equations: tuple[Equation, ...]

    @property
    def only(self) -> Equation | None:
        """The equation, where it stands alone."""
        return self.equations[0] if len(self.equations) == 1 else None


def entries(equations: Sequence[Equation]) -> list[Entry]:
    """What is numbered; that a parameter is itself is not said beside other equations."""
    numbered = list(enumerate(equations))
    kept = [(k, e) for k, e in numbered if not _itself(e)] or numbered
    found: list[Entry] = []
    for short, run in groupby(kept, key=lambda x: bool(cell(x[1]))):
        members = [*run]
        size = columns([e for _, e in members]) if short and len(members) > TABLE else 1
        for at in range(0, len(members), size):
            row = members[at : at + size]
            found.append(Entry(row[0][0] if found else 0, tuple(e for _, e in row)))
    return found


def columns(cells: Sequence[Equation]) -> int:
    """How many stand in a row: an even number, for families often come in pairs."""
    return 4 if 4 * max(map(width, cells)) <= ROW else 2


def width(e: Equation) -> int:
    """Letters of a cell; a column vector is as wide as its widest entry."""
    if isinstance(e.rhs, tuple) and e.rhs[0] == "matrix":
        return display_width(f"{show(e.lhs)} = ") + max(display_width(show(x)) for x in e.rhs[1:])
    return display_width(cell(e))


def cell(e: Equation) -> str:
    """An equation that names a number or an entry, as text; empty for others."""
    named = isinstance(e.lhs, tuple) and e.lhs[0] in ("at", "entry")
    simple = isinstance(e.rhs, (str, int, Fraction)) or e.rhs[0] in SIMPLE
    text = f"{show(e.lhs)} = {show(e.rhs)}"
    return text if named and simple and not e.for_all and display_width(text) <= CELL else ""


def _itself(e: Equation) -> bool:
    """m = m, for a parameter m that has the name of what it is."""
    return isinstance(e.rhs, tuple) and e.rhs[0] == "par" and show(e.lhs) == show(e.rhs)
