"""What is read off a motion, in the numbers of the state as it is emitted, and its derivatives."""

from __future__ import annotations

from collections.abc import Iterator

from ..record.record import Derivation, Equation
from .factor import factored
from .graph import Node
from .lower import Lowering
from .options import Options
from .reader import scalar
from .schedule import by_numbers, variations

RULE = "output"
"""That of the step which says the outputs."""


def output_names(d: Derivation) -> tuple[str, ...]:
    """The names of the numbers that a record says to be read off its motion, in their order."""
    return tuple(name for name, _, _ in _entries(d))


def _entries(d: Derivation) -> Iterator[tuple[str, Equation, int]]:
    """Name, equation and which entry of its sides, from 0, of each number."""
    equations = (e for s in d.steps if s.rule == RULE for e in s.equations)
    for e in equations:
        match e.lhs:
            case ("par", name):
                yield name, e, 0
            case ("matrix", *rows):
                yield from ((row[1][1], e, k) for k, row in enumerate(rows))


def outputs(lowering: Lowering, options: Options) -> dict[str, list[Node]]:
    """The function ``outputs`` and the derivatives that are asked for, as name → outputs; nothing
    where the record says none."""
    found = output_nodes(lowering)
    if not found:
        return {}
    graph, reader = lowering.graph, lowering.reader
    wanted = {"outputs": found}
    if "outputs" in options.jacobian:
        wanted["jacobian_outputs"] = [v.of(x) for x in found for v in variations(reader.space)]
        leaves = [reader.leaf(x, "input") for x in reader.inputs]
        if leaves:
            wanted["jacobian_outputs_inputs"] = by_numbers(graph, found, leaves)
        if "raw" in options.jacobian:
            state = [reader.leaf(x, "state") for x in reader.space.names]
            wanted["jacobian_outputs_raw"] = by_numbers(graph, found, state)
    return {name: factored(graph, nodes) for name, nodes in wanted.items()}


def output_nodes(lowering: Lowering) -> list[Node]:
    """The values of the outputs, in their order."""
    return [_value(lowering, e, k) for _, e, k in _entries(lowering.record)]


def _value(lowering: Lowering, e: Equation, k: int) -> Node:
    """Entry k of the right side of an equation, or the number that it is."""
    label = next(s.key(e) for s in lowering.record.steps if e in s.equations)
    reader = lowering.reader
    reader.label = label
    value = lowering.tree(e.rhs)
    return scalar(value if isinstance(value, Node) else value[k][0])
