"""U = −GM Σ m_i (1/R − ⟨n, x_i⟩/R² + (3⟨n, x_i⟩² − ‖x_i‖²)/2R³), x_i from the body's origin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.model import Model
from ..trials.point_masses import AppliedForces, Vector

KIND, OF_BODY_AXES = "far_centre", True
Data = Mapping[str, Any]


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """The sum over the masses."""
    origin, _ = at.body_axes(r)
    T = _seen(at, p, origin)
    R = at.root(q.dot(T, T))
    n = tuple(x / R for x in T)
    total: Any = Fraction(0)
    for m, place in zip(masses, r, strict=True):
        if m:
            x = tuple(a - b for a, b in zip(place, origin, strict=True))
            along = q.dot(n, x)
            second = (3 * along * along - q.dot(x, x)) * Fraction(1, 2)
            total = total + m * (1 / R - along / (R * R) + second / (R * R * R))
    return -at.number(p["strength"]) * total


def _seen(at: AppliedForces, p: Data, origin: Vector) -> Vector:
    centre = at.vector(p["centre"]) or (Fraction(0),) * len(origin)
    return tuple(a - b for a, b in zip(origin, centre, strict=True))


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """T in the body's frame, 1/R and GM/R."""
    at, p = model.applied, members[0]
    T = _seen(at, p, at.body_axes(model.images(model.g))[0])
    R = at.root(q.dot(T, T))
    back = q.transposed(model.group.linear_part(model.g))
    return {"T_b": q.times(back, q.column(T)), "W": 1 / R, "V": at.number(p["strength"]) / R}
