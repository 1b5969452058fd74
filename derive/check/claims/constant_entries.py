"""The entries that are the same for all elements of a group, as 1 and 0 in the last row of affine
maps."""

from __future__ import annotations

from fractions import Fraction
from random import Random

from ...algebra.groups import Group

SAMPLES = 3
SIZE = 2**64
"""Random integers of this size in random elements differ where entries do."""


def constant_entries(group: Group, random: Random) -> dict[tuple[int, int], Fraction]:
    """Row and column, from 0 → the number that some random elements have in common there."""
    seen = [group.sample(random, SIZE) for _ in range(SAMPLES)]
    span = range(group.size)
    values = {(i, j): {g[i][j] for g in seen} for i in span for j in span}
    return {place: x.pop() for place, x in values.items() if len(x) == 1}
