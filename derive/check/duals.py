"""What pairs with 𝔤, as sums over the points: Π and p_b, variations and rates, and Φ.

ℓ_b is the skew part of Π, twice, or its axis for the rotations of space.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ..algebra import rational as q
from ..algebra.rational import Matrix
from .body import Vector
from .model import Model
from .nilpotent import EPS, EPS_PRIME, nilpotent, part
from .spatial import axial

NAMES = (("Π", "δΠ", "δ′Π", "Π̇"), ("p_b", "δp_b", "δ′p_b", "ṗ_b"))
"""Of the linear part and of the translation: the value, its two variations, its rate."""
SPINS = ("ℓ_b", "δℓ_b", "δ′ℓ_b", "ℓ̇_b")


def dual_values(model: Model) -> dict[str, Any]:
    """Π = Σ m Āv r̄ and p_b = Σ m Āv on the families of δ, δ′ and the motion; and Φ."""
    _, g, Z = model.family(model.first, model.second)
    e = nilpotent(EPS)
    along = q.plus(model.g, q.scaled(e, q.times(model.g, model.Z)))
    faster = q.plus(model.Z, q.scaled(e, model.acceleration))
    places = ((g, Z, 0), (g, Z, EPS), (g, Z, EPS_PRIME), (along, faster, EPS))
    units = [(Fraction(1),)] * len(model.points)
    values = {}
    for names, arms in zip(NAMES, (model.points, units), strict=True):
        for name, (at, velocity, mask) in zip(names, places, strict=True):
            values[name] = part(_carried(model, at, _momenta(model, at, velocity), arms), mask)
    for name, Pi in zip(SPINS, NAMES[0], strict=True):
        skew = q.minus(values[Pi], q.transposed(values[Pi]))
        values[name] = axial(skew) if model.group.turns_space else skew
    return values | {"Φ": _push(model)}


def _push(model: Model) -> Matrix:
    """Σ Ā(m v)(g⁻¹v)‾, the variation of the metric, and the forces: CfJ, or Σ ĀF r̄."""
    own = _carried(model, model.g, _momenta(model, model.g, model.Z), model.moved(model.Z))
    if model.group.affine:
        return q.plus(own, _carried(model, model.g, model.forces, model.points))
    A = model.group.linear_part(model.g)
    C = q.times(q.transposed(A), A)
    return q.plus(own, q.times(q.times(C, model.gradient), model.moments[2]))


def _momenta(model: Model, g: Matrix, Z: Matrix) -> list[Vector]:
    """m v."""
    moved = model.moved(q.times(g, Z))
    return [tuple(m * x for x in v) for m, v in zip(model.masses, moved, strict=True)]


def _carried(model: Model, g: Matrix, vectors: Sequence[Vector], arms: Sequence[Vector]) -> Matrix:
    """Σ Āv x̄ for a vector v in space and one x in the body of each point."""
    n = model.n
    total = [[Fraction(0)] * len(arms[0]) for _ in range(n)]
    for v, x in zip(vectors, arms, strict=True):
        for i in range(n):
            for j, y in enumerate(x):
                total[i][j] += v[i] * y
    back = q.transposed(tuple(row[:n] for row in g[:n]))
    return q.times(back, q.matrix(total))
