"""Coordinates in a user's state, of factors that are exp(Σ x_a E_a): an angle, a shift, a scale.

Analytic in these, as all that a state is made of (``user_states.py``).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..algebra.factor_charts import CoordinateBlock, factor_charts
from ..algebra.groups import Group
from ..language.rational import identity
from ..problem.fields import entry_places


@dataclass(frozen=True)
class Coordinates:
    """Those of a ``block`` of a factor; ``entries`` of our state → their places in it; ``still``:
    others of the factor and what they are; ``rates``: the coordinates of ζ that are theirs."""

    block: CoordinateBlock
    entries: Mapping[str, tuple[int, int]]
    still: Mapping[str, float]
    rates: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Those of the coordinates."""
        return self.block.names

    @property
    def covered(self) -> tuple[str, ...]:
        """The entries of our state that they tell."""
        return (*self.entries, *self.still)

    def at(self, x: Any) -> dict[str, Any]:
        """The entries at coordinates (N, members), which may be complex."""
        one, first = np.ones_like(x[:, 0]), x[:, 0]
        block, parts = self.block, list[tuple[Any, Any]]()
        if len(block.basis) > 1:
            parts = [(identity(len(block.rows)), one), *zip(block.basis, x.T, strict=True)]
        elif w := float(block.turn):
            turned = (one, first, np.cos(w * first), np.sin(w * first))
            parts = [*zip(block.parts_of_turn, turned, strict=True)]
        elif block.growth:
            scale = np.exp(float(block.growth) * first)
            parts = [(P, scale**n) for n, P in block.scalings]
        else:
            powers = enumerate(block.powers)
            parts = [(E, first**k / math.factorial(k)) for k, E in powers]
        found = {
            name: sum((float(E[i][j]) * y for E, y in parts if E[i][j]), 0 * one)
            for name, (i, j) in self.entries.items()
        }
        return found | {name: value * one for name, value in self.still.items()}


def own_coordinates(
    group: Group, state: Sequence[str], velocity: Sequence[str]
) -> dict[str, Coordinates]:
    """The coordinates of a group by their names in the code of ``--attitude angle``, of those
    factors that have some, beside T; ``velocity``: the coordinates of ζ that our state holds."""
    places = {place: x for x, place in entry_places(group).items() if x in state}
    found: dict[str, Coordinates] = {}
    if len(velocity) < group.dimension:
        return found
    for chart in factor_charts(group, "angle").values():
        rows = range(chart.offset, chart.offset + chart.size)
        apart = {x: name for x, name in places.items() if x[0] in rows and x[1] in rows}
        own = [{name: x for x, name in apart.items() if {*x} <= {*b.rows}} for b in chart.blocks]
        # no element of the basis moves what is between blocks
        rest = {name: float(i == j) for (i, j), name in apart.items()}
        rest = {name: x for name, x in rest.items() if not any(name in y for y in own)}
        for block, inside in zip(chart.blocks, own, strict=True):
            at = {x: (block.rows.index(i), block.rows.index(j)) for x, (i, j) in inside.items()}
            rates = tuple(velocity[a - 1] for a in block.members)
            found |= dict.fromkeys(block.names, Coordinates(block, at, rest, rates))
            rest = {}
    return found
