"""The tensor of inertia by which a body turns that is free in space, as the walk tells it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..language import rational as q
from ..language.tree import Tree, replaced
from ..language.values import approximate, value
from ..record.record import Derivation
from ..schema.body_kinds import Body
from .run import Array

UNIT = "1"


def central_inertia(record: Derivation, body: Body, numbers: Mapping[str, float]) -> Array | None:
    """I_c, (3, 3), by the equations of a record for J_c and for it; ``None`` where that has none,
    as on SO(3), and for a body without mass."""
    told = [(x, record.definition(x)) for x in ("J_c", "I_c")]
    if not all(found for _, found in told):
        return None

    def number(t: Tree) -> float | None:
        return approximate(t, numbers, float)

    own = body.moments()
    known = {
        UNIT: q.identity(3),
        "m": number(own.m),
        "c": tuple((number(x),) for x in own.c),
        "J": tuple(tuple(map(number, row)) for row in own.J),
    }
    if not known["m"]:
        return None
    for x, found in told:
        assert found
        known[x] = value(replaced(found[1].rhs, ("one",), UNIT), known, number=float)
    return np.array(known["I_c"], float)
