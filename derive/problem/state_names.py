"""The names of the state in an expression of a Lagrangian, as the emitted code has them."""

from __future__ import annotations

from ..algebra.groups import Group
from ..language.tree import Tree


def coordinates(group: Group) -> list[Tree]:
    """The coordinates ζ_1 … ζ_d of a velocity, as trees."""
    return [("entry", "ζ", a) for a in range(1, group.dimension + 1)]


def state_names(group: Group) -> dict[str, Tree]:
    """Name → what it stands for: t, the entries of g, a matrix that acts on (r, 1), and ζ."""
    found: dict[str, Tree] = {"t": "t"}
    several = len(group.places) > 1
    for k, (offset, factor) in enumerate(group.places, 1):
        mark, span = str(k) if several else "", range(1, factor.n + 1)
        for i in span:
            for j in span:
                found[_indexed(f"A{mark}", i, j)] = ("entry", "A", offset + i, offset + j)
            if factor.affine:
                place = ("entry", "A", offset + i, offset + factor.n + 1)
                found[_indexed(f"T{mark}", i)] = place
    return found | {_indexed("zeta", a): t for a, t in enumerate(coordinates(group), 1)}


def _indexed(name: str, *index: int) -> str:
    digits = "".join(map(str, index)) if max(index) < 10 else "_".join(map(str, index))
    return f"{name}_{digits}"
