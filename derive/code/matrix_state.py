"""The door of a state that holds a quaternion: the same state with the matrix A in its place."""

from __future__ import annotations

from dataclasses import dataclass

from ..language import rational as q
from ..language.reserved import suffixed
from .graph import Node
from .naming import ClaimedNames
from .quaternion import ROTATED, of_rotation
from .state import StateSpace

LABELS = {"rotation": "4 q q̄, from A"}
"""The label of what from_matrix computes, and what stands in a comment before it."""

TO_MATRIX, FROM_MATRIX = "to_matrix", "from_matrix"


@dataclass(frozen=True)
class MatrixState:
    """The state z = (A row by row, then what follows q in x); ``names``: of its numbers.

    ``outputs``: function → what it computes; ``leaves``: the numbers of z.
    """

    names: tuple[str, ...]
    outputs: dict[str, list[Node]]
    leaves: tuple[Node, ...]

    def places(self, names: ClaimedNames) -> dict[Node, tuple[str, tuple[str, int]]]:
        """Where ``from_matrix`` reads its leaves; what is in x as well keeps its name."""
        return {
            leaf: (names.claim(leaf.data[1], " ".join(leaf.data)), ("z", i))
            for i, leaf in enumerate(self.leaves)
        }


def matrix_state(x: StateSpace) -> MatrixState | None:
    """The state with A in place of the quaternion; ``None`` where there is no quaternion."""
    if not x.quaternion:
        return None
    g, span = x.graph, range(1, 4)
    others = [g.leaf(name, "state") for name in x.names[len(x.q) :]]
    R = tuple(tuple(g.leaf(suffixed("R", i, j), "matrix") for j in span) for i in span)
    return MatrixState(
        (*(suffixed("A", i, j) for i in span for j in span), *x.names[len(x.q) :]),
        {
            TO_MATRIX: [*(y for row in x.values["A"][:ROTATED] for y in row[:ROTATED]), *others],
            FROM_MATRIX: [*of_rotation(g, R), *others],
        },
        (*q.flatten(R), *others),
    )
