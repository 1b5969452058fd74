"""Names of the potentials, inputs and damping of a problem, from its points."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .applied_forces import Vector, damping_members
from .model import Model
from .point_masses import outer_sum, scaled_each
from .rigid_body import axial

Values = dict[str, Any]


def force_values(model: Model) -> Values:
    """γ, K, U_Q, N_Q, F_Q, N_u, F_u, D and their kin."""
    ex, places = model.applied, model.moved(model.g)
    values: Values = {}
    for account, members in ex.members():
        values |= account.values(model, members)
    values["U_Q"] = ex.potential(model.t, places, model.masses, single=True)
    forces = ex.forces(model.t, places, model.masses, single=True)
    values |= _summed(model, forces, "Q")
    if model.at.driven:
        values |= _summed(model, model.nonpotential_forces, "u")
        values |= _with_covector(model, values)
    return values | _damping(model)


def _summed(model: Model, forces: list[Vector], mark: str) -> Values:
    """N = Σ Āf r̄, F = Σ Āf, and in R³ μ = Σ r ∧ Āf."""
    turned = q.times(tuple(forces), model.group.linear_part(model.g))
    N, F = outer_sum(turned, model.points), outer_sum(turned, model.units)
    mu = axial(q.minus(N, q.transposed(N))) if model.n == 3 else q.column((Fraction(0),) * 3)
    return {f"N_{mark}": N, f"F_{mark}": F, f"μ_{mark}": mu}


def _with_covector(model: Model, values: Values) -> Values:
    """The covector input joins N_u and F_u by the rows that read coordinates, μ_u and F_u in R³."""
    dual = model.group.covector_matrix(model.covector)
    found = {"N_u": q.plus(values["N_u"], model.group.linear_part(dual))}
    if model.group.affine:
        found["F_u"] = q.plus(values["F_u"], model.group.translation_part(dual))
    if model.group.turns_space:
        found["μ_u"] = q.plus(values["μ_u"], q.column(model.covector[:3]))
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
        if hasattr(account, "families"):
            families |= account.families(model, members)
    places = model.moved(model.g)
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
