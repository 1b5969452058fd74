"""The names of R³ for rotations, Ω, ζ, φ, μ and the tensors of inertia, from the points."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .model import Model
from .point_masses import outer_sum, scaled_each

Values = dict[str, Any]


def rigid_body_values(model: Model) -> Values:
    """The values of Ω, ζ, φ, μ, their variations and rates, and of I, I_c, λ for the rotations and
    displacements of space; none for other groups."""
    if not model.group.turns_space:
        return {}
    basis = model.group.basis
    values: Values = {}
    named = {
        "ζ": model.Z,
        "ζ̇": model.acceleration,
        "Ω": model.first.xi,
        "Ω′": model.second.xi,
        "δζ": model.first.velocity,
        "δ′ζ": model.second.velocity,
    }
    if not model.group.affine:
        named["φ"] = model.gradient
    for name, x in named.items():
        values[name] = axial(x)
    values["μ"] = q.column(-model.work(q.times(model.g, e)) for e in basis[:3])
    if model.at.driven:
        values["u"] = q.column(model.covector[:3])
        values["f_u"] = q.column(model.covector[3:])
    m, c, _ = model.moments
    centre = tuple(x[0] / m for x in c)
    values["I"] = _inertia_tensor(model, (Fraction(0),) * 3)
    values["I_c"] = _inertia_tensor(model, centre)
    if model.at.principal:  # else the diagonal of I is not its eigenvalues
        values["λ"] = q.column(values["I"][i][i] for i in range(3))
    return values


def axial(x: Matrix) -> Matrix:
    """The vector X (3 × 1) of a skew matrix j(X), or of the rotation part of a larger one."""
    return ((x[2][1],), (x[0][2],), (x[1][0],))


def _inertia_tensor(model: Model, origin: tuple[Fraction, ...]) -> Matrix:
    """Σ m_i (|r|² 1 − r r̄) about an origin: the classical tensor of inertia."""
    span = range(3)
    total = [[Fraction(0)] * 3 for _ in span]
    for m, point in zip(model.masses, model.points, strict=True):
        r = [x - o for x, o in zip(point, origin, strict=True)]
        square = sum(x * x for x in r)
        for i in span:
            for j in span:
                total[i][j] += m * ((square if i == j else 0) - r[i] * r[j])
    return q.matrix(total)


def moments_about(model: Model, origin: tuple[Fraction, ...]) -> Matrix:
    """Σ m_i (r_i − o)(r_i − o)‾ about an origin o."""
    arms = [tuple(x - o for x, o in zip(r, origin, strict=True)) for r in model.points]
    return outer_sum(scaled_each(model.masses, arms), arms)
