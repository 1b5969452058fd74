"""The names of the solved equations: rates, the multiplier, the mass matrix and the loads.

All are sums over the points at the exact position of the model, by d'Alembert's principle.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .model import Model
from .point_masses import Vector, outer_sum, scaled_each

Values = dict[str, Any]


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
    def centred_basis(self) -> list[Matrix]:
        """A basis of the linear parts of 𝔤, each element with the translation that keeps the centre
        in place (matrices of the group's size)."""
        count = len(self.group.linear_basis)
        if self.group.centred:
            back = q.minus(q.identity(self.model.n), centre_matrix(self.model))
            return [q.times(e, back) for e in self.group.basis]
        if not self.group.free_translations:
            return list(self.group.basis)
        found = []
        for e in self.group.basis[:count]:
            linear = self.group.linear_part(e)
            shift = q.times(linear, q.column(self.centre))
            found.append(q.bordered(linear, q.scaled(-1, shift), Fraction(0)))
        return found

    def moment_in_body(self, vectors: list[Vector]) -> Matrix:
        """Ā Σ v_i ρ̄_i, the moment in the body of vectors v_i in space with the arms ρ_i."""
        back = q.transposed(self.group.linear_part(self.model.g))
        return q.times(back, outer_sum(vectors, self.arms))

    def moment_of_inertia_forces(self, rate: Matrix) -> Matrix:
        """Ā Σ m_i a_i ρ̄_i, the moment of the accelerations for g⁻¹g̈ = ``rate``."""
        moved = self.model.moved(q.times(self.model.g, rate))
        return self.moment_in_body(scaled_each(self.model.masses, moved))

    @cached_property
    def applied_moment(self) -> Matrix:
        """The moment in the body, about the centre, of all forces, inputs and damping."""
        forces = zip(self.model.forces, self.model.nonpotential_forces, strict=True)
        total = [tuple(x + y for x, y in zip(f, g, strict=True)) for f, g in forces]
        dual = self.group.covector_matrix(self.model.covector)
        linear = q.plus(self.moment_in_body(total), self.group.linear_part(dual))
        if not self.group.affine:
            return linear
        return q.minus(linear, q.times(self.group.translation_part(dual), (self.centre,)))


def centre_matrix(model: Model) -> Matrix:
    """The matrix S of a product of groups H ⋉ Rⁿ: the centre of mass of each factor in the last
    column of its block."""
    total = q.scaled(Fraction(0), q.identity(model.n))
    for offset, factor in model.group.centred:
        corner = offset + factor.n
        inside = [(m, r) for m, r in zip(model.masses, model.points, strict=True) if r[corner] != 0]
        whole = sum((m for m, _ in inside), Fraction(0))
        for i in range(offset, corner):
            place = sum((m * r[i] for m, r in inside), Fraction(0)) / whole
            total = q.plus(total, q.scaled(place, q.unit(model.n, i, corner)))
    return total


def centred_values(model: Model) -> Values:
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
    tangents = [q.times(model.g, e) for e in s.centred_basis]
    values["M"] = model.metric_matrix(tangents)
    convective = q.times(model.g, q.times(Z, Z))
    values["β"] = tuple(
        (load(model, e) - model.pairing(convective, x),)
        for e, x in zip(s.centred_basis, tangents, strict=True)
    )
    if group.centred:
        rate = q.plus(Z_dot, q.times(Z_dot, centre_matrix(model)))
        values["ψ"] = q.column(group.nearest(rate))
    normal = group.normal_space_of_linear_parts
    if len(normal) == 1:
        left = q.minus(s.moment_of_inertia_forces(q.plus(Z_dot, q.times(Z, Z))), s.applied_moment)
        direction = group.normal_direction
        values["Λ"] = direction
        values["θ"] = _trace_product(left, direction) / _trace_product(direction, direction)
    return values


def load(model: Model, e: Matrix) -> Fraction:
    """The work of forces and inputs in the displacement g e."""
    powers = zip(model.input, model.group.nearest(e), strict=True)
    return sum((u * x for u, x in powers), Fraction(0)) - model.work(q.times(model.g, e))


def _trace_product(a: Matrix, b: Matrix) -> Any:
    """Tr a b̄."""
    return q.trace(q.times(a, q.transposed(b)))
