"""Other forms of a state: without an element, by velocity in space, with a matrix."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..algebra.factor_charts import QUATERNION, FactorChart
from ..algebra.groups import Group
from ..language.reserved import stored_masses, suffixed
from ..language.tree import Tree, add, mul, nodes, replaced, terms
from .graph import Graph, Node
from .options import Options
from .slots import layout, of_rotation
from .state import Component, Named, Seeds, StateSpace

# The state of a program without an element of the group: ζ, then what is carried along.


class ReducedSpace(StateSpace):
    """``values``: ζ, Γ; there is no g."""

    def __init__(self, graph: Graph, group: Group, problem: Mapping[str, Any]):
        self.graph, self.group, self.standard, self.n = graph, group, group, group.n
        self.right, self.held = problem["lagrangian"]["trivialisation"] == "right", ()
        self.stored = {}
        self.held_of_g, self.charts, self.still, self.tangent = [], {}, {}, False
        self.names, self.values = [], {}
        self.coordinates = [self._leaf(suffixed("zeta", a)) for a in self._span(group.dimension)]
        carried = [
            self._leaf(suffixed(x["name"], i))
            for x in problem["advected"]
            for i in self._span(x["size"])
        ]
        self.values["ζ"] = tuple((x,) for x in self.coordinates)
        self.values["Γ"] = tuple((x,) for x in carried)

    @property
    def has_element(self) -> bool:
        """It has none."""
        return False

    @property
    def free(self) -> list[int]:
        """There is no η."""
        return []

    def variations(self) -> dict[str, Seeds]:
        """Its numbers are those of a vector space."""
        return {x: {self.graph.leaf(x, "state"): self.graph.num(1)} for x in self.names}

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
    found = StateSpace(graph, group, options, right=right, held=held)
    found.store(stored_masses(problem))
    return found


def of_plain_variations(count: int) -> str:
    """The same where the state has no element of the group."""
    return f"A variation V of a state has {count} numbers: what those of x change by."


def of_variations(space: StateSpace) -> str:
    """What variations V of a state are, as a sentence."""
    count = len(space.variations())
    if not space.has_element:
        return of_plain_variations(count)
    V = ", ".join(["eta", "delta zeta", *(f"delta {x}" for x in space.stored)])
    told = (
        f"A variation V = ({V}) of a state has {count} numbers: delta g = "
        f"{'eta g' if space.right else 'g eta'}, eta in the basis below, and what is added to the "
        f"velocity{' and to masses' * bool(space.stored)}"
    )
    if not space.null:
        return f"{told}."
    held = ", ".join(str(k) for k in space.held)
    return (
        f"{told}; number {held} is left out of both: the motion is one on a quotient of the group, "
        "and V stands for all variations that differ from it by symmetries."
    )


# Points by their velocity in space, ν = gZ, with ν = (Ȧ, Ṫ).
#
# Where A stretches, Z = g⁻¹ν and C = ĀA lose digits as the square of its condition; what is kept
# is small beside their entries. In ν it is a sum of products of what is seen:
#
# h̃ = ½ Tr ν𝕁ν̄ + Ũ, p̃(δg) = Tr ν𝕁δḡ, 𝕁 = [[J, c], [c̄, m]].

BACK: Tree = ("inv", "A")
IN_SPACE = "ν𝕁ḡ"
"""The matrix p with p̃(Yg) = Tr p Ȳ."""

KINETIC: tuple[tuple[Tree, Tree], ...] = (
    (("tr", ("mul", "Z", "J", ("T", "Z"), "C")), ("tr", ("mul", "ν", "J", ("T", "ν")))),
    (("inner", ("mul", "C", "Z", "c"), "w"), ("inner", ("mul", "ν", "c"), "τ")),
    (("inner", ("mul", "C", "w"), "w"), ("norm2", "τ")),
)
"""What the energy has of Z, w and C = ĀA, and the same by the linear part ν = AZ and τ = Aw."""


def by_velocity(h: Tree, names: tuple[str, str]) -> Tree:
    """The energy h̃ of points by the ``names`` of ν and τ, where it has C; else as it is."""
    for inside, outside in KINETIC:
        for old, new in zip(("ν", "τ"), names, strict=True):
            outside = replaced(outside, old, new)
        h = replaced(h, inside, outside)
    return h


def has_velocity(h: Tree) -> bool:
    """Is the kinetic energy that of points on a group whose C does not drop out?"""
    return replaced(h, KINETIC[0][0], 0) != h


def in_space(quantity: Tree) -> Tree:
    """⟨Π, η⟩ by ⟨ν𝕁ḡ, Y⟩ for the parts A⁻¹YA of η: what is kept, without an inverse."""
    for pairing in nodes(quantity):
        if isinstance(pairing, tuple) and pairing[:2] == ("inner", "Π"):
            quantity = replaced(quantity, pairing, add(*map(_paired, terms(pairing[2]))))
    return quantity


def _paired(eta: Tree) -> Tree:
    """⟨Π, η⟩ of one part of η."""
    match eta:
        case ("mul", back, *Y, "A") if back == BACK:
            return ("inner", IN_SPACE, mul(*Y))
    return ("inner", "Π", eta)


# The door of a state that holds charts: the same state with the matrices in their place.

LABELS = {"rotation": "4 q q̄, from A"}
"""The label of what from_matrix computes, and what stands in a comment before it."""

TO_MATRIX, FROM_MATRIX = "to_matrix", "from_matrix"


@dataclass(frozen=True)
class MatrixState:
    """The state z, with the entries of a block where x has the numbers of its chart; ``names``: of
    its numbers.

    ``outputs``: function → what it computes, from_matrix where charts are quaternions; ``leaves``:
    the numbers of z.
    """

    names: tuple[str, ...]
    outputs: dict[str, list[Node]]
    leaves: tuple[Node, ...]


def matrix_state(x: StateSpace) -> MatrixState | None:
    """The state with matrices in place of charts; ``None`` where there are no charts."""
    if not x.charts:
        return None
    g, z = x.graph, [slot for slot in layout(x.group) if slot not in x.still]
    velocity = x.names[sum(map(len, x.numbers.values())) :]
    names = (*(slot.name for slot in z), *velocity)
    others = [g.leaf(name, "state") for name in velocity]
    found = MatrixState(names, {TO_MATRIX: [*x.entries(x.element, z), *others]}, ())
    if any(chart.kind != QUATERNION for chart in x.charts.values()):
        return found
    leaves = {
        slot: x.numbers[slot][0] if slot in x.numbers else g.leaf(f"R{slot.name[1:]}", "matrix")
        for slot in z
    }
    at = {(slot.row, slot.column): leaf for slot, leaf in leaves.items() if slot.letter == "A"}
    back: list[Node] = []
    for held in x.held_of_g:
        if isinstance(held, FactorChart):
            span = range(held.offset, held.offset + held.size)
            R = tuple(tuple(at[i, j] for j in span) for i in span)
            back += of_rotation(g, R, held.mark)
        else:
            back.append(leaves[held])
    outputs = found.outputs | {FROM_MATRIX: [*back, *others]}
    return MatrixState(names, outputs, (*leaves.values(), *others))
