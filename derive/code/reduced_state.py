"""The state of a program without an element of the group: ζ, then what is carried along."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..algebra.groups import Group
from ..language.reserved import suffixed
from .graph import Graph, Node
from .options import Options
from .state import Component, Named, StateSpace


class ReducedSpace(StateSpace):
    """``values``: ζ, Γ; it has no slots, for there is no g."""

    def __init__(self, graph: Graph, group: Group, problem: Mapping[str, Any]):
        self.graph, self.group, self.standard, self.n = graph, group, group, group.n
        self.right, self.held = problem["lagrangian"]["trivialisation"] == "right", ()
        self.slots, self.still, self.quaternion, self.tangent = [], {}, False, False
        self.names, self.values = [], {}
        self.coordinates = [self._leaf(suffixed("zeta", a)) for a in self._span(group.dimension)]
        carried = [
            self._leaf(suffixed(x["name"], i))
            for x in problem["advected"]
            for i in self._span(x["size"])
        ]
        self.values["ζ"] = tuple((x,) for x in self.coordinates)
        self.values["Γ"] = tuple((x,) for x in carried)

    def velocity(self, component: Component) -> list[Node]:
        """The accelerations ζ̇."""
        return [component("ζ̇", a) for a in self._span(self.group.dimension)]

    def rates(self, name: Named, component: Component, *, in_space: bool = False) -> list[Node]:
        """ζ̇ and Γ̇."""
        del in_space
        carried = name("Γ̇") if self.values["Γ"] else ()
        return [*self.velocity(component), *(x for (x,) in carried)]


def state_of(
    problem: Mapping[str, Any], graph: Graph, group: Group, options: Options
) -> StateSpace:
    """The state of a record's problem."""
    if "advected" in problem:
        return ReducedSpace(graph, group, problem)
    own = problem.get("lagrangian", {})
    right, held = own.get("trivialisation") == "right", own.get("held", ())
    return StateSpace(graph, group, options, right=right, held=held)
