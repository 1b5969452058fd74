"""The names of the state in an expression of a Lagrangian, as the emitted code has them."""

from __future__ import annotations

from collections.abc import Mapping

from ..algebra.groups import Group
from ..language.suffixed import suffixed
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
                found[suffixed(f"A{mark}", i, j)] = ("entry", "A", offset + i, offset + j)
            if factor.affine:
                place = ("entry", "A", offset + i, offset + factor.n + 1)
                found[suffixed(f"T{mark}", i)] = place
    return found | {suffixed("zeta", a): t for a, t in enumerate(coordinates(group), 1)}


def meant(t: Tree, names: Mapping[str, Tree]) -> Tree:
    """An expression with its names as what they stand for."""
    if not isinstance(t, tuple):
        return t
    if t[0] == "par":
        return names.get(t[1], t)
    return (t[0], *(meant(x, names) for x in t[1:]))
