"""The entries of g as trees: those that vary in the group, and the numbers that others are."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from random import Random

from ..algebra.groups import Group
from ..language.tree import Tree

Rows = tuple[tuple[Tree, ...], ...]
"""A matrix of expressions."""

SIZE = 2**20
"""Of the random integers of two elements in which an entry is the same where it is constant."""


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


@cache
def element(group: Group) -> Rows:
    """The entries of g, as numbers where they are constant."""
    one, two = (group.sample_inside(Random(k), SIZE) for k in (1, 2))
    span = range(group.size)
    return tuple(
        tuple(
            _number(one[i][j]) if one[i][j] == two[i][j] else ("entry", "A", i + 1, j + 1)
            for j in span
        )
        for i in span
    )


def _number(x: Fraction) -> Tree:
    return int(x) if x == int(x) else x
