"""U of the volume, by the determinant of the axes of the body in space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.model import Model
from ..trials.point_masses import AppliedForces, Vector
from ..values.arithmetic import ETA, Nilpotent, determinant, nilpotent

KIND, OF_BODY_AXES = "volume", True
Data = Mapping[str, Any]


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """U where the axes are the columns of A."""
    del masses
    _, axes = at.body_axes(r)
    return at.value(p["U"], (), A=q.transposed(tuple(axes)))


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """V_A; U_V; p_V by the work where one axis, and with it the volume, grows."""
    at, A = model.applied, model.group.linear_part(model.g)
    grown = (tuple(x * (1 + nilpotent(ETA)) for x in A[0]), *A[1:])
    total = sum((at.value(p["U"], (), A=grown) for p in members), Fraction(0))
    whole = Nilpotent.of(total)
    return {"V_A": determinant(A), "U_V": whole.part(0), "p_V": -whole.part(ETA)}
