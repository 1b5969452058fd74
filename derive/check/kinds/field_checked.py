"""U = −Σ q_i ⟨E(t), r_i⟩."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.point_masses import AppliedForces, Vector

KIND = "field"


def energy(
    at: AppliedForces, p: Mapping[str, Any], r: Sequence[Vector], masses: Sequence[Any]
) -> Any:
    """Over the points that the problem lists, the first of all."""
    del masses
    E = tuple(at.value(x, r) for x in p["E"])
    pairs = enumerate(at.vector(p["charges"]), 1)
    return -sum((charge * q.dot(E, at.place(r, i)) for i, charge in pairs), Fraction(0))
