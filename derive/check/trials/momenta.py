"""The momenta of a model as sums over its points, its names of R³, and its lifts."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..values.arithmetic import EPS, EPS_PRIME, EvaluationError, derivative_in, part
from ..values.evaluate import Environment, point_index
from .model import Model
from .point_masses import Vector, axial, outer_sum, scaled_each

# The names of R³ for rotations, Ω, ζ, φ, μ and the tensors of inertia, from the points.

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


# The momenta Π, p_b, their variations and rates, and the force Φ, as sums over the points.
#
# ℓ_b is the skew part of Π, twice, or its axis for the rotations of space; ℓ and p are momenta in
# space.

NAMES = (("Π", "δΠ", "δ′Π", "Π̇"), ("p_b", "δp_b", "δ′p_b", "ṗ_b"))
"""The names of the linear part of the momentum and of its translation part: the value, its two
variations, its rate."""
SPINS = ("ℓ_b", "δℓ_b", "δ′ℓ_b", "ℓ̇_b")


def momentum_values(model: Model) -> dict[str, Any]:
    """Π = Σ m Āv r̄ and p_b = Σ m Āv on the families of δ, δ′ and the motion; and Φ."""
    varied = model.varied
    places = ((varied, 0), (varied, EPS), (varied, EPS_PRIME), (model.onward, EPS))
    values = {}
    for names, arms in zip(NAMES, (model.points, model.units), strict=True):
        for name, (at, mask) in zip(names, places, strict=True):
            moving = _moment_in_body(model, at.g, _momenta(model, at.g, at.Z), arms)
            values[name] = part(moving, mask)
    for name, Pi in zip(SPINS, NAMES[0], strict=True):
        skew = q.minus(values[Pi], q.transposed(values[Pi]))
        values[name] = axial(skew) if model.group.turns_space else skew
    return values | {"Φ": _force_on_algebra(model)}


def basis_families(model: Model) -> dict[str, dict[tuple[int, ...], Any]]:
    """Π_a = p̃(gE_a) on the linear parts of the basis, and Π̇_a, its rate along the motion."""
    t, g, Z, *_ = model.onward
    moving = model.momenta(t, g, Z)[: len(model.group.linear_basis)]
    return {
        name: {(a,): part(x, mask) for a, x in enumerate(moving, 1)}
        for name, mask in (("Π", 0), ("Π̇", EPS))
    }


def poisson_values(model: Model) -> dict[str, Any]:
    """𝕁, the brackets of the momenta on the linear parts of the basis, and in R³ turned about those
    of all; Π_g."""
    if model.generic:
        return {}
    whole, group = model.brackets(), model.group
    d = group.dimension if group.turns_space else len(group.linear_basis)
    shadow = group.covector_matrix(model.momenta(model.t, model.g, model.Z))
    return {"𝕁": tuple(row[:d] for row in whole[:d]), "Π_g": group.linear_part(shadow)}


def _force_on_algebra(model: Model) -> Matrix:
    """Φ = Σ Ā(m v)(g⁻¹v)‾, the variation of the metric, and CfJ or Σ ĀF r̄, the forces."""
    own = _moment_in_body(model, model.g, _momenta(model, model.g, model.Z), model.images(model.Z))
    if model.group.affine:
        return q.plus(own, _moment_in_body(model, model.g, model.forces, model.points))
    A = model.group.linear_part(model.g)
    C = q.times(q.transposed(A), A)
    return q.plus(own, q.times(q.times(C, model.gradient), model.moments[2]))


def _momenta(model: Model, g: Matrix, Z: Matrix) -> list[Vector]:
    """The momenta m_i v_i of the points in space, v = g Z r."""
    return scaled_each(model.masses, model.images(q.times(g, Z)))


def _moment_in_body(
    model: Model, g: Matrix, vectors: Sequence[Vector], arms: Sequence[Vector]
) -> Matrix:
    """Σ Āv x̄, n × k, over vectors v in space and arms x of k numbers in the body."""
    back = q.transposed(model.group.linear_part(g))
    return q.times(back, outer_sum(vectors, arms))


def space_values(model: Model, acceleration: Matrix) -> dict[str, Any]:
    """ℓ = Σ m r ∧ v and p = Σ m v in space, as sums over the points; rates along the motion.

    ℓ is a vector in R³ turned about, else the matrix Σ m (v r̄ − r v̄).
    """
    places, speeds = model.images(model.g), model.images(model.nu)
    forces = model.images(acceleration)
    t, g, Z, *_ = model.onward
    return {
        "ℓ": _angular_momentum(model, places, speeds),
        "ℓ̇": _angular_momentum(model, places, forces),
        "p": _resultant(model, speeds),
        "ṗ": _resultant(model, forces),
        "ḣ": part(model.onward_body.energy(t, g, Z), EPS),
    }


def _angular_momentum(model: Model, places: list[Vector], vectors: list[Vector]) -> Matrix:
    """Σ m (v r̄ − r v̄), or in R³ turned about its axis Σ m r ∧ v."""
    half = outer_sum(scaled_each(model.masses, vectors), places)
    whole = q.minus(half, q.transposed(half))
    return axial(whole) if model.group.turns_space else whole


def _resultant(model: Model, vectors: list[Vector]) -> Matrix:
    """Σ m v, as a column."""
    return outer_sum(scaled_each(model.masses, vectors), model.units)


# The principle on one jet of a curve: X is the tangent of a lift, δ varies it through lifts.
#
# The curve and those it is varied through are one two-parameter family in the group; d/dt is its
# second parameter.

ON_TANGENT: Tree = ("call", "ϖ", "X")
ON_VARIATION: Tree = ("call", "ϖ", "δy")


def action_varied(model: Model) -> Any:
    """δ[L̃ dt(X)] = δ[ϖ(X)], by the Lagrangian alone: on each curve of the family the velocity is
    its own. ``EvaluationError`` where X is not the tangent of a lift."""
    if model.motion.xi != model.Z:
        raise EvaluationError("ϖ(X) is varied where X is the tangent of a lift")
    family = model.family(model.first, model.motion)
    passing = derivative_in(family.t, EPS_PRIME)
    Z = q.scaled(1 / passing, model.field(family, EPS_PRIME))
    return part(model.lagrangian(family.t, family.g, Z) * passing, EPS)


def rate(model: Model, what: Tree, env: Environment) -> Any:
    """d/dt along the motion of ϖ(δy), or of the place r_i(t) or the velocity v_i of a point;
    ``EvaluationError`` for any other."""
    family = model.family(model.first, model.motion)
    t, g, Z, *_ = family
    match what:
        case ("call", ("at", "r", i), "t"):
            return part(q.column(model.images(g)[point_index(i, env) - 1]), EPS_PRIME)
        case ("at", "v", i):
            moving = model.images(q.times(g, Z))
            return part(q.column(moving[point_index(i, env) - 1]), EPS_PRIME)
    if what != ON_VARIATION:
        raise EvaluationError("d/dt is of ϖ(δy), r_i(t) and v_i, where points give the Lagrangian")
    pushed = model.momentum(t, g, Z, model.field(family, EPS))
    return part(pushed - model.energy(t, g, Z) * derivative_in(t, EPS), EPS_PRIME)
