"""What an expression will cost: how deep it is, its degree, and how long its derivatives are."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from .tree import Tree, fold

FUNCTION = 8
"""The degree of a function and its first three derivatives, as the checker bounds it."""


class Weight(NamedTuple):
    """What an expression costs: leaves; operands of all its first derivatives; degree."""

    leaves: int
    slope: int
    degree: int


def depth(tree: Tree) -> int:
    """The number of operations of a tree that are in one another; without recursion, which this
    bounds."""
    level, inside = 0, [tree]
    while inside := [x for t in inside if isinstance(t, tuple) for x in t[1:]]:
        level += 1
    return level


@fold
def weight(t: Tree, *parts: Weight) -> Weight:
    """The weight of a tree that is not too deep."""
    if isinstance(t, (int, Fraction)):
        return Weight(1, 0, 0)
    if isinstance(t, str) or t[0] == "par":
        return Weight(1, 1, 1)
    if t[0] == "pow":
        (base,), n = parts, abs(int(t[2]))
        return Weight(base.leaves + 1, base.slope + base.leaves + 1, n * base.degree)
    if t[0] == "fun":
        (inside,) = parts
        return Weight(inside.leaves + 1, inside.slope + inside.leaves, FUNCTION + inside.degree)
    leaves = sum(x.leaves for x in parts)
    if t[0] == "add":  # a derivative has those of its terms; in a product all factors stay
        return Weight(leaves, sum(x.slope for x in parts), max(x.degree for x in parts))
    slope = sum(x.slope + leaves - x.leaves for x in parts if x.slope)
    return Weight(leaves, slope, sum(x.degree for x in parts))
