"""The density of an ellipsoid as a polynomial in the level s = ⟨r, Q r⟩ of a place r in it: 0 in
the middle, 1 at the boundary."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from .tree import Tree, names, replaced

LEVEL = "s_r"
WRITTEN: Tree = ("par", "s")
"""How a problem file writes it."""
TRIED = 64
"""A density is tried at so many levels, and in the middle, for its sign."""


def is_layered(density: Tree) -> bool:
    """Is it a function of the level?"""
    return LEVEL in names(density)


def degree_in_level(t: Tree) -> int | None:
    """The degree of a polynomial in the level, if nothing cancels; ``None`` for what is none."""
    if not isinstance(t, tuple) or not is_layered(t):
        return int(t == LEVEL)
    parts = [degree_in_level(x) for x in t[1:] if t[0] in ("add", "mul", "div", "pow")]
    found = [x for x in parts if x is not None]
    if not found or len(found) < len(parts):
        return None
    if t[0] == "pow":
        return found[0] * t[2] if t[2] > 0 else None
    if t[0] == "div":
        return None if is_layered(t[2]) else found[0]
    return max(found) if t[0] == "add" else sum(found)


def at_levels(density: Tree) -> Iterator[tuple[Fraction, Tree]]:
    """Levels from the middle to the boundary, each with the density there; one for all, where it is
    the same."""
    for k in range(TRIED + 1 if is_layered(density) else 1):
        yield Fraction(k, TRIED), replaced(density, LEVEL, Fraction(k, TRIED))
