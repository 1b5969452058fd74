"""A body of fluid: the quadric of its boundary, its pressure, its circulation.

The pressure in the middle is found along one ray, from Euler's equation there.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..record.tree_data import decode
from .evaluate import evaluate
from .model import Model
from .point_masses import outer_sum

Values = dict[str, Any]


def fluid_values(model: Model, r: Matrix) -> Values:
    """Υ and its rate along the motion; of one ellipsoid Q_r, p_0 and p_r, too, at the place r."""
    if model.generic or model.group.affine or "orthogonal" in model.group.relations:
        return {}
    A, nu = model.group.linear_part(model.g), model.group.linear_part(model.nu)
    rate = q.times(A, q.plus(model.acceleration, q.times(model.Z, model.Z)))
    values: Values = {"Υ": _skew(A, nu), "Υ̇": _skew(A, rate)}
    solids = model.problem.get("body", {}).get("solids", ())
    Q = _quadric(model, solids[0]) if len(solids) == 1 else None
    return values if Q is None else values | _pressures(model, solids[0], Q, rate, r)


def _skew(A: Matrix, x: Matrix) -> Matrix:
    """Āx − x̄A."""
    both = q.times(q.transposed(A), x)
    return q.minus(both, q.transposed(both))


def _quadric(model: Model, solid: Any) -> Matrix | None:
    """Q of a ball or an ellipsoid, by its equation at the ends of its axes; ``None`` of others."""
    sizes, n = solid["sizes"], model.n

    def value(x: Any) -> Any:
        return evaluate(decode(x, "body"), model.expressions)

    if "quadric" in sizes:
        return tuple(tuple(map(value, row)) for row in sizes["quadric"])
    if solid["kind"] not in ("ball", "ellipsoid"):
        return None
    axes = sizes["semi_axes"] if "semi_axes" in sizes else [sizes["radius"]] * n
    return tuple(
        tuple(1 / value(x) ** 2 if i == j else Fraction(0) for j in range(n))
        for i, x in enumerate(axes)
    )


def _pressures(model: Model, solid: Any, Q: Matrix, rate: Matrix, r: Matrix) -> Values:
    """p_0 so that ρ⟨r, Ā(α̇ − f)r⟩ = 2 p_0 ⟨r, Q r⟩, f the force per mass, whose moments are those
    of all forces; and p_r."""
    density = evaluate(decode(solid["density"], "body"), model.expressions)
    _, _, J = model.moments
    back = q.inverse(J)
    assert back is not None
    applied = q.times(outer_sum(model.forces, model.points), back)
    left = q.times(q.transposed(model.group.linear_part(model.g)), q.minus(rate, applied))
    middle = density * _form(left, r) / (2 * _form(Q, r))
    return {"Q_r": Q, "p_0": middle, "p_r": pressure_at(r, Q, middle)}


def pressure_at(r: Matrix, Q: Matrix, middle: Any) -> Any:
    """p_r, quadratic, and 0 at the boundary."""
    return middle * (1 - _form(Q, r))


def _form(a: Matrix, r: Matrix) -> Any:
    """⟨r, a r⟩."""
    return q.trace(q.times(q.transposed(r), q.times(a, r)))
