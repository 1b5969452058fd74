"""The entries of g that a Lagrangian may name, and those that vary in the group."""

from __future__ import annotations

from ..algebra.groups import Group
from ..language.tree import Tree
from ..problem.moved_entries import element


def entries(group: Group) -> dict[Tree, tuple[int, int]]:
    """The entries of g that a Lagrangian may name, with their places from 0."""
    found: dict[Tree, tuple[int, int]] = {}
    for offset, factor in group.places:
        for i in range(offset, offset + factor.n):
            for j in range(offset, offset + factor.size):
                found["entry", "A", i + 1, j + 1] = i, j
    return found


def varying(group: Group) -> dict[Tree, tuple[int, int]]:
    """Those that are not the same number in all of the group."""
    g = element(group)
    return {x: (i, j) for x, (i, j) in entries(group).items() if isinstance(g[i][j], tuple)}
