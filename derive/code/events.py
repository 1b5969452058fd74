"""Events of a motion: what is watched on it, in the numbers of the state as it is emitted."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from typing import Protocol

from ..language.expression import names
from ..language.reserved import did_you_mean, near_name
from ..language.tree import Tree
from ..language.values import value
from .factor import factored
from .graph import Graph, Node
from .lower import Lowering
from .options import Options
from .program import LoweringError, Watched
from .reader import scalar
from .reduced_state import state_of

DIRECTIONS = {"both": 0, "rising": 1, "falling": -1}

UNWATCHED = "gauss_jax"
"""The step whose motions do not stop at events."""


class Event(Protocol):
    """An instant at which the expression ``when`` changes its sign, in a ``direction`` of
    DIRECTIONS."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def when(self) -> Tree:
        """Of the state, the time, inputs and parameters."""

    @property
    def direction(self) -> str:
        """From where 0 is reached."""

    @property
    def terminal(self) -> bool:
        """Does the motion end there?"""


def table(events: Sequence[Event]) -> tuple[Watched, ...]:
    """What a program says of them."""
    return tuple(Watched(x.name, DIRECTIONS[x.direction], x.terminal) for x in events)


def watched(name: str, events: Sequence[Event], chosen: Options) -> Sequence[Event]:
    """The events at which the steps of an emission stop; ``LoweringError`` where none are written
    for its state."""
    if not {*chosen.step} - {UNWATCHED}:
        return ()
    if events and chosen.frame == "principal":
        raise LoweringError(
            f"{name}: [[event]] is of the state in the frame of the parameters: leave out --frame"
        )
    return events


def values(lowering: Lowering, events: Sequence[Event]) -> list[Node]:
    """The expressions of the events; ``LoweringError`` for a name that means nothing.

    Numbers of the state are known by the names that they have as emitted, and by those of the state
    of matrices and velocities in the body.
    """
    own, known = _numbers(lowering), lowering.record.problem["parameters"]
    for event in events:
        _require_known(lowering.record.name, event, [*own, *known])
    reader = lowering.reader
    reader.memo |= {("par", x): node for x, node in own.items()}  # the last that is lowered
    reader.label = ""
    return factored(lowering.graph, [scalar(lowering.tree(x.when)) for x in events])


def values_of(
    problem: str, events: Sequence[Event], graph: Graph, state: Mapping[str, Node]
) -> list[Node]:
    """The same of numbers of the state that have no matrices and no parameters beside them."""
    numbers: dict[str, Node] = {
        "π": graph.num(Fraction(math.pi)), "t": graph.leaf("t", "time")
    }  # fmt: skip
    for event in events:
        _require_known(problem, event, state)
    try:
        found = [value(x.when, numbers, state, graph.function, graph.num) for x in events]
    except (ArithmeticError, ValueError) as error:
        raise LoweringError(f"{problem}: [[event]]: {error}") from None
    return factored(graph, found)


def _require_known(problem: str, event: Event, known: Collection[str]) -> None:
    for name in names(event.when):
        if name not in known:
            near = did_you_mean(near_name(name, [*known]), after=" ").rstrip()
            raise LoweringError(
                f"{problem}: event {event.name}: no {name[:40]!r} in the state, the parameters or "
                f"the inputs{'; ' * bool(near)}{near}"
            )


def _numbers(lowering: Lowering) -> dict[str, Node]:
    """Name → node of what an expression may read besides the time and parameters."""
    reader = lowering.reader
    space, graph = reader.space, lowering.graph
    plain = state_of(reader.record.problem, graph, reader.group, Options())
    velocity = [x for a, x in enumerate(space.coordinates, 1) if a not in space.held]
    if plain.slots:
        found = [*plain.entries(space.element), *velocity]
    else:
        found = [*velocity, *(x for (x,) in space.values["Γ"])]
    return {
        **dict(zip(plain.names, found, strict=True)),
        **{x: reader.leaf(x) for x in space.names},
        **{x: reader.leaf(x, "input") for x in reader.inputs},
    }
