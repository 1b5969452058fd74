"""The mass matrix M, and the bias b: for rates a of the velocity, M a + b is the covector that must
be added to what already acts."""

from __future__ import annotations

from fractions import Fraction

from ..language.reserved import suffixed
from ..record.record import Derivation
from .factor import factored
from .graph import Node
from .lower import Lowering
from .program import LoweringError
from .schedule import of_velocity
from .watched_functions import EmittedQuantities


def refuse(d: Derivation) -> None:
    """``LoweringError`` where the velocity is not determined by the momenta."""
    if d.problem.get("lagrangian", {}).get("held"):
        raise LoweringError(
            f"{d.name}: --dynamics is for motions on the whole group, and these are on a quotient: "
            "leave it out"
        )


def dynamics(lowering: Lowering) -> dict[str, list[Node]]:
    """The functions ``mass_matrix``, ∂Π_a/∂ζ_b by rows, and ``bias``, −M ζ̇ of the motion, in the
    basis of the state."""
    reader, graph = lowering.reader, lowering.graph
    count = reader.group.dimension
    momenta = EmittedQuantities(lowering).momenta
    speeds = of_velocity(reader.space)
    upper = {
        (a, b): graph.value(speeds[b].of(momenta[a]), suffixed("M", a + 1, b + 1), "")
        for a in range(count)
        for b in range(a, count)
    }
    rows = [[upper[min(a, b), max(a, b)] for b in range(count)] for a in range(count)]
    rates = reader.space.velocity(reader.component)
    forces = [graph.sum([graph.product(x) for x in zip(row, rates, strict=True)]) for row in rows]
    bias = [graph.linear([(Fraction(-1), x)]) for x in forces]
    found = {"mass_matrix": [x for row in rows for x in row], "bias": bias}
    return {name: factored(graph, nodes) for name, nodes in found.items()}
