"""The mass matrix M, and the bias b: for rates a of the velocity, M a + b is the covector that must
be added to what already acts; without inputs, that which they must supply."""

from __future__ import annotations

from ..language.limits import tell
from ..language.reserved import suffixed
from ..record.record import Derivation
from .factor import factored
from .graph import Node, reachable, remade, rewritten
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


def wanted_rates(lowering: Lowering) -> list[Node]:
    """What ``inverse`` takes: the rates that the velocity is to have, in the basis of the state."""
    span = range(1, lowering.reader.group.dimension + 1)
    return [lowering.graph.leaf(suffixed("dzeta", a), "state") for a in span]


def dynamics(lowering: Lowering) -> dict[str, list[Node]]:
    """The functions ``mass_matrix``, ∂Π_a/∂ζ_b by rows, ``bias``, −M ζ̇ of the motion, and
    ``inverse``, M (a − ζ̇) by rates a and the motion without inputs, where there is such a motion;
    in the basis of the state."""
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
    found = {
        "mass_matrix": [x for row in rows for x in row],
        "bias": [-Node.dot(row, rates) for row in rows],
        "inverse": _supplied(lowering, rows, rates),
    }
    return {name: factored(graph, nodes) for name, nodes in found.items() if nodes}


def _supplied(lowering: Lowering, rows: list[list[Node]], rates: list[Node]) -> list[Node]:
    """M on what the rates without inputs lack; none where an input is divided by."""
    reader, graph = lowering.reader, lowering.graph
    still = {reader.leaf(x, "input"): graph.num(0) for x in reader.inputs}
    try:
        unforced = rewritten(rates, reachable(rates), remade, still)
    except ZeroDivisionError:
        tell(f"{lowering.record.name}: no inverse is written, as an input is divided by")
        return []
    pairs = enumerate(zip(wanted_rates(lowering), unforced, strict=True), 1)
    lacking = [graph.value(a - x, suffixed("lacking", i), "") for i, (a, x) in pairs]
    return [Node.dot(row, lacking) for row in rows]
