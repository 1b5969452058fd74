"""Forces, rates, multipliers and integrals of a model, from its points."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property, reduce
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ...record.as_json import decode
from ..form.function_signatures import PER_DENSITY
from ..values.arithmetic import EvaluationError, plus, times
from ..values.evaluate import Environment, evaluate
from .equimomental import LayeredDensity, volume_of
from .model import Model
from .point_masses import Vector, axial, damping_members, outer_sum, scaled_each

# Names of the potentials, inputs and damping of a problem, from its points.

Values = dict[str, Any]


def force_values(model: Model) -> Values:
    """γ, K, U_Q, N_Q, F_Q, N_u, F_u, D and their kin."""
    ex, places = model.applied, model.images(model.g)
    values: Values = {}
    for account, members in ex.members():
        values |= account.values(model, members)
    values["U_Q"] = ex.potential(model.t, places, model.masses, single=True)
    forces = ex.forces(model.t, places, model.masses, single=True)
    values |= _summed(model, forces, "Q", q.scaled(Fraction(0), q.identity(model.n)))
    if model.at.driven:
        values |= _summed(model, model.nonpotential_forces, "u", model.couple)
        values |= _with_covector(model, values)
    return values | _damping(model)


def _summed(model: Model, forces: list[Vector], mark: str, couple: Matrix) -> Values:
    """N = Σ Āf r̄ and a couple, F = Σ Āf, and in R³ μ = Σ r ∧ Āf and its torque."""
    turned = q.times(tuple(forces), model.group.linear_part(model.g))
    N = q.plus(outer_sum(turned, model.points), couple)
    F = outer_sum(turned, model.units)
    mu = axial(q.minus(N, q.transposed(N))) if model.n == 3 else q.column((Fraction(0),) * 3)
    return {f"N_{mark}": N, f"F_{mark}": F, f"μ_{mark}": mu}


def _with_covector(model: Model, values: Values) -> Values:
    """Covectors join N_u and F_u by the rows that read coordinates, μ_u and F_u in R³."""
    dual = model.group.covector_matrix(model.acting_covector)
    found = {"N_u": q.plus(values["N_u"], model.group.linear_part(dual))}
    if model.group.affine:
        found["F_u"] = q.plus(values["F_u"], model.group.translation_part(dual))
    if model.group.turns_space:
        found["μ_u"] = q.plus(values["μ_u"], q.column(model.acting_covector[:3]))
    return found


def _damping(model: Model) -> Values:
    damped = damping_members(model)
    strengths = [damped.get(i, Fraction(0)) for i in range(1, len(model.points) + 1)]
    weighted = scaled_each(strengths, model.points)
    D, first = outer_sum(weighted, model.points), outer_sum(weighted, model.units)
    values: Values = {"D": D, "D_c": first, "D_m": sum(damped.values(), Fraction(0))}
    if model.n == 3:
        values["I_D"] = q.minus(q.scaled(q.trace(D), q.identity(3)), D)
    return values


def _in_body(model: Model, vector: Sequence[Any]) -> Matrix:
    """Ā on a vector of space; empty in a product, whose blocks have spaces of their own."""
    if model.group.factors:
        return ()
    return q.times(q.transposed(model.group.linear_part(model.g)), q.column(vector))


def force_families(model: Model) -> dict[str, dict[tuple[int, ...], Any]]:
    """k, s, d, σ, Q and κ by their indices."""
    families: dict[str, dict[tuple[int, ...], Any]] = {}
    for account, members in model.applied.members():
        if account.families:
            families |= account.families(model, members)
    places = model.images(model.g)
    for e, (d, sigma) in enumerate(model.applied.radial(places, model.masses), 1):
        families.setdefault("d", {})[e,] = q.column(d)
        families.setdefault("χ", {})[e,] = _in_body(model, d)
        families.setdefault("σ", {})[e,] = sigma
    if model.applied.single:
        forces = model.applied.forces(model.t, places, model.masses, single=True)
        families["Q"] = {(i,): q.column(f) for i, f in enumerate(forces, 1)}
        families["P"] = {(i,): _in_body(model, f) for i, f in enumerate(forces, 1)}
    if damped := damping_members(model):
        families["κ"] = {(i,): damped.get(i, Fraction(0)) for i in range(1, len(places) + 1)}
    return families


# The names of the solved equations: rates, the multiplier, the mass matrix and the loads.
#
# All are sums over the points at the exact position of the model, by d'Alembert's principle.


class ForceBalance:
    """The balance of forces at one point of the evolution space, about the centre of mass where the
    group is H ⋉ Rⁿ and about the origin elsewhere."""

    def __init__(self, model: Model):
        self.model, self.group = model, model.group
        m, c, _ = model.moments
        zero = (Fraction(0),) * model.n
        self.centre: Vector = tuple(x / m for (x,) in c) if self.group.free_translations else zero

    @cached_property
    def arms(self) -> list[Vector]:
        """The places of the points relative to the centre, in the body."""
        return [
            tuple(x - s for x, s in zip(r, self.centre, strict=True)) for r in self.model.points
        ]

    @cached_property
    def barycentric_basis(self) -> list[Matrix]:
        """A basis of the linear parts of 𝔤, each element with the translation that keeps the centre
        in place (matrices of the group's size)."""
        count = len(self.group.linear_basis)
        if self.group.barycentric_blocks:
            back = q.minus(q.identity(self.model.n), centre_matrix(self.model))
            return [q.times(e, back) for e in self.group.basis]
        if not self.group.free_translations:
            return list(self.group.basis)
        linear = map(self.group.linear_part, self.group.basis[:count])
        return [*map(self.model.about_centre, linear)]

    def moment_in_body(self, vectors: list[Vector]) -> Matrix:
        """Ā Σ v_i ρ̄_i, the moment in the body of vectors v_i in space with the arms ρ_i."""
        back = q.transposed(self.group.linear_part(self.model.g))
        return q.times(back, outer_sum(vectors, self.arms))

    def moment_of_inertia_forces(self, rate: Matrix) -> Matrix:
        """Ā Σ m_i a_i ρ̄_i, the moment of the accelerations for g⁻¹g̈ = ``rate``."""
        image = self.model.images(q.times(self.model.g, rate))
        return self.moment_in_body(scaled_each(self.model.masses, image))

    @cached_property
    def applied_moment(self) -> Matrix:
        """The moment in the body, about the centre, of all forces, inputs and damping."""
        forces = zip(self.model.forces, self.model.nonpotential_forces, strict=True)
        total = [tuple(x + y for x, y in zip(f, g, strict=True)) for f, g in forces]
        dual = self.group.covector_matrix(self.model.acting_covector)
        linear = q.plus(self.moment_in_body(total), self.group.linear_part(dual))
        linear = q.plus(linear, self.model.couple)
        if not self.group.affine:
            return linear
        return q.minus(linear, q.times(self.group.translation_part(dual), (self.centre,)))


def centre_matrix(model: Model) -> Matrix:
    """The matrix S of a product of groups H ⋉ Rⁿ: the centre of mass of each factor in the last
    column of its block."""
    total = q.scaled(Fraction(0), q.identity(model.n))
    for offset, factor in model.group.barycentric_blocks:
        corner = offset + factor.n
        inside = [(m, r) for m, r in zip(model.masses, model.points, strict=True) if r[corner] != 0]
        whole = sum((m for m, _ in inside), Fraction(0))
        for i in range(offset, corner):
            place = sum((m * r[i] for m, r in inside), Fraction(0)) / whole
            total = q.plus(total, q.scaled(place, q.unit(model.n, i, corner)))
    return total


def barycentric_values(model: Model) -> Values:
    """The values of S and of c_c, J_c, Z_c, moments and velocity about the centres of mass of the
    factors of a product."""
    S = centre_matrix(model)
    back = q.minus(q.identity(model.n), S)
    places = q.times(tuple(model.points), q.transposed(back))
    weighted = scaled_each(model.masses, places)
    first, second = outer_sum(weighted, model.units), outer_sum(weighted, places)
    return {"S": S, "c_c": first, "J_c": second, "Z_c": q.plus(model.Z, q.times(model.Z, S))}


def solution_values(model: Model) -> Values:
    """The values of N_c, r_c, w_c, B, M, β, ψ, Λ and θ, as far as the group has them."""
    group, Z, Z_dot = model.group, model.Z, model.acceleration
    s = ForceBalance(model)
    values: Values = {"N_c": s.applied_moment}
    if group.affine:
        m, c, _ = model.moments
        centre = tuple(x / m for (x,) in c)
        values["r_c"] = q.column(centre)
        values["w_c"] = q.times(Z, model.homogeneous(centre))[: model.n]
    values["B"] = q.minus(s.applied_moment, s.moment_of_inertia_forces(q.times(Z, Z)))
    tangents = [q.times(model.g, e) for e in s.barycentric_basis]
    values["M"] = model.metric_matrix(tangents)
    convective = q.times(model.g, q.times(Z, Z))
    values["β"] = tuple(
        (load(model, e) - model.pairing(convective, x),)
        for e, x in zip(s.barycentric_basis, tangents, strict=True)
    )
    if group.barycentric_blocks:
        rate = q.plus(Z_dot, q.times(Z_dot, centre_matrix(model)))
        values["ψ"] = q.column(group.nearest(rate))
    normal = group.normal_space_of_linear_parts
    if len(normal) == 1:
        left = q.minus(s.moment_of_inertia_forces(q.plus(Z_dot, q.times(Z, Z))), s.applied_moment)
        direction = group.normal_direction
        values["Λ"] = direction
        values["θ"] = q.contraction(left, direction) / q.contraction(direction, direction)
    return values


def load(model: Model, e: Matrix) -> Fraction:
    """The work of forces and inputs in the displacement g e."""
    powers = zip(model.input, model.group.nearest(e), strict=True)
    return sum((u * x for u, x in powers), Fraction(0)) - model.work(q.times(model.g, e))


# A continuous body at its point masses: integrals over it, and functions of a place in it.


def place_values(model: Model) -> dict[str, Any]:
    """The values of r, a random place in the body, of v, its velocity in space (columns), and of
    the pressure there."""
    r = q.column(model.draw() for _ in range(model.n))
    return {"r": r, "v": image(model, model.nu, r)} | fluid_values(model, r)


def image(model: Model, g: Matrix, r: Matrix) -> Matrix:
    """g(r) as a column, for a group element or a tangent matrix g and a column r."""
    return q.times(g, model.homogeneous(q.flatten(r)))[: model.n]


def integral(model: Model, form: Tree, env: Environment) -> Any:
    """∫ of a function of r over the body: a sum over point masses with the same moments, which is
    exact for forms of degree two, or over shells; ``EvaluationError`` where the body is none of
    solids."""
    if model.problem.get("body", {}).get("kind") != "given":
        raise EvaluationError("integrals are over solids")
    if form in PER_DENSITY:
        return over_volume(model, form[1], env.names["p_0"])  # type: ignore[index]
    terms: list[Any] = []
    for m, at in zip(model.masses, model.points, strict=True):
        r = q.column(at)
        here = {"r": r, "v": image(model, model.nu, r)}
        if form == "p_r":  # of a uniform density, quadratic, and 0 at the boundary
            here["p_r"] = env.names["p_0"] * (1 - _form(env.names["Q_r"], r))
        there = replace(env, names=ChainMap(here, env.names))  # type: ignore[arg-type]
        terms.append(times(m, evaluate(form, there)))
    return reduce(plus, terms)


# A body of fluid: the quadric of its boundary, its layers, its pressure, its circulation.
#
# The pressure in the middle is found along one ray, from Euler's equation there.


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
    layers, level = LayeredDensity.of(model, solid), _form(Q, r)
    _, _, J = model.moments
    back = q.inverted(J)
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


def over_volume(model: Model, name: str, middle: Any) -> Any:
    """∫ σ_r dx or ∫ p_r dx of one ellipsoid in layers; p is a multiple of σ, and ``middle`` its
    value in the middle."""
    (solid,) = model.problem["body"]["solids"]
    layers = LayeredDensity.of(model, solid)
    whole = volume_of(model, solid) * layers.mean(layers.above, layers.degree + 1)
    return whole if name == "σ_r" else whole * middle / layers.above(Fraction(0))


def _form(a: Matrix, r: Matrix) -> Any:
    """⟨r, a r⟩."""
    return q.trace(q.times(q.transposed(r), q.times(a, r)))
