"""U = ½ Σ m_i ⟨r_i, W r_i⟩."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.model import Model
from ..trials.point_masses import AppliedForces, Vector

KIND = "harmonic"
Data = Mapping[str, Any]


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """The sum over the masses, row by row of W."""
    rows = [at.vector(row) for row in p["W"]]
    pairs = [(m, x) for m, x in zip(masses, r, strict=True) if m]
    work = (m * y * q.dot(row, x) for m, x in pairs for y, row in zip(x, rows, strict=True))
    return sum(work, Fraction(0)) * Fraction(1, 2)


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """W_r, the sum of all."""
    total = q.scaled(Fraction(0), q.identity(model.n))
    for p in members:
        total = q.plus(total, tuple(model.applied.vector(row) for row in p["W"]))
    return {"W_r": total}
