"""U = −Σ m_i ⟨g, r_i⟩, in every block."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.model import Model
from ..trials.point_masses import AppliedForces, Vector

KIND = "gravity"
Data = Mapping[str, Any]


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """The weight of the points that have one."""
    g = at.group.in_every_block(at.vector(p["g"]))
    pairs = zip(masses, r, strict=True)
    return -sum((m * q.dot(g, x) for m, x in pairs if m), Fraction(0))


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """γ, the sum of all."""
    ex = model.applied
    whole = [q.column(model.group.in_every_block(ex.vector(p["g"]))) for p in members]
    total = whole[0]
    for x in whole[1:]:
        total = q.plus(total, x)
    return {"γ": total}
