"""A body of fluid: the quadric of its boundary, its layers, its pressure, its circulation.

The pressure in the middle is found along one ray, from Euler's equation there.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..record.as_json import decode
from .equimomental import volume_of
from .evaluate import evaluate
from .model import Model
from .point_masses import outer_sum
from .shells import Layers

Values = dict[str, Any]


def fluid_values(model: Model, r: Matrix) -> Values:
    """Υ and its rate along the motion; of one ellipsoid Q_r, p_0 and p_r, too, at the place r, and
    what there is in its layers."""
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
    """Q of a ball or an ellipsoid, by the ends of its axes; ``None`` of others."""
    sizes, n = solid["sizes"], model.n

    def value(x: Any) -> Any:
        return evaluate(decode(x, "body"), model.expressions)

    if "quadric" in sizes:
        return tuple(tuple(map(value, row)) for row in sizes["quadric"])
    if solid["kind"] not in ("ball", "ellipsoid"):
        return None
    axes = sizes["semi_axes"] if "semi_axes" in sizes else [sizes["radius"]] * n
    told = solid.get("rotation")
    R = tuple(tuple(map(value, row)) for row in told) if told else q.identity(n)
    ends = (q.column(value(x) * row[i] for row in R) for i, x in enumerate(axes))
    squares = (q.times(end, q.transposed(end)) for end in ends)
    return q.inverse(reduce(q.plus, squares))


def _pressures(model: Model, solid: Any, Q: Matrix, rate: Matrix, r: Matrix) -> Values:
    """p_0 and p_r by what is pushed along the ray of r, ∫ρ ds times the ⟨r, Ā(α̇ − f)r⟩ over
    2⟨r, Q r⟩ that all its places have, f the force per mass, whose moments are those of all
    forces; the level, the density, that integral and κ_Q."""
    layers, level = Layers.of(model, solid), _form(Q, r)
    _, _, J = model.moments
    back = q.inverse(J)
    assert back is not None
    applied = q.times(outer_sum(model.forces, model.points), back)
    left = q.times(q.transposed(model.group.linear_part(model.g)), q.minus(rate, applied))
    pushed, above = _form(left, r) / (2 * level), layers.above(level)
    return {
        "Q_r": Q,
        "s_r": level,
        "ρ_r": layers.density(level),
        "σ_r": above,
        "κ_Q": q.trace(q.times(Q, J)) * Fraction(1, model.n),
        "p_0": pushed * layers.above(Fraction(0)),
        "p_r": pushed * above,
    }


def pressure_at(r: Matrix, Q: Matrix, middle: Any) -> Any:
    """p_r of a uniform density, quadratic, and 0 at the boundary."""
    return middle * (1 - _form(Q, r))


def over_volume(model: Model, name: str, middle: Any) -> Any:
    """∫ σ_r dx or ∫ p_r dx of one ellipsoid in layers; p is a multiple of σ, and ``middle`` its
    value in the middle."""
    (solid,) = model.problem["body"]["solids"]
    layers = Layers.of(model, solid)
    whole = volume_of(model, solid) * layers.mean(layers.above, layers.degree + 1)
    return whole if name == "σ_r" else whole * middle / layers.above(Fraction(0))


def _form(a: Matrix, r: Matrix) -> Any:
    """⟨r, a r⟩."""
    return q.trace(q.times(q.transposed(r), q.times(a, r)))
