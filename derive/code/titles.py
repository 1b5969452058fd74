"""Titles of the numbers of dx/dt: which equation of the record has them on its left side."""

from __future__ import annotations

from ..language.show import show
from .reader import RecordReader
from .state import StateSpace


def titles(reader: RecordReader) -> dict[int, str]:
    """Index in dx/dt at which an equation's left side begins → label and equation."""
    found = {}
    for start, names in _beginnings(reader.space).items():
        known = (reader.record.definition(name) for name in names)
        if at := next(filter(None, known), None):
            step, equation = at
            found[start] = f"{step.key(equation)}: {show(equation.lhs)} = {show(equation.rhs)}"
    return found


def _beginnings(space: StateSpace) -> dict[int, tuple[str, ...]]:
    """Index in dx/dt → the names by which the record may have what begins there."""
    slots = space.entry_slots
    if not space.slots:
        carried = {space.group.dimension: ("Γ̇",)} if space.values["Γ"] else {}
        return {0: ("ζ̇", "Ż"), **carried}
    letters, before = [x.letter for x in slots], 4 if space.quaternion else 0
    first = {x: before + letters.index(x) for x in dict.fromkeys(letters)}
    if space.tangent:
        return {len(slots) + i: ({"A": "α̇", "T": "τ̇"}[x],) for x, i in first.items()}
    found: dict[int, tuple[str, ...]] = {i: ({"A": "Ȧ", "T": "Ṫ"}[x],) for x, i in first.items()}
    found[before + len(slots)] = ("ζ̇", "Ż")
    return found | ({len(space.names) - space.n: ("ẇ",)} if space.group.free_translations else {})
