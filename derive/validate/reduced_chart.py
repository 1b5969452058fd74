"""The numbers of a state without an element of the group: ζ, then what is carried along."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.rational import Matrix
from .chart import Chart, Numbers, StateChart, named


@dataclass(frozen=True)
class ReducedChart(StateChart):
    """The chart of a problem with the key ``advected``: names and sizes of what it says."""

    advected: tuple[tuple[str, int], ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """ζ, then the entries of each quantity in order."""
        turns = (named("zeta", a) for a in range(self.group.dimension))
        return (*turns, *(named(x, i) for x, size in self.advected for i in range(size)))

    def with_carried(self, Z: Matrix, carried: Any) -> Numbers:
        """The numbers of the state at Z and Γ; or the rates, from Ż and Γ̇."""
        return (*self.group.nearest(Z), *(q.flatten(carried) if self.advected else ()))


def chart_of(group: Group, chart: Chart, problem: Mapping[str, Any]) -> StateChart:
    """The chart of a record's problem."""
    if "advected" not in problem:
        own = problem.get("lagrangian", {})
        held = tuple(own.get("held", ()))
        return StateChart(group, chart, own.get("trivialisation") == "right", held)
    carried = tuple((x["name"], x["size"]) for x in problem["advected"])
    return ReducedChart(group, chart, advected=carried)
