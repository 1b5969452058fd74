"""Names of the potentials, inputs and damping of a problem, from its points."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .exerted import SINGLE, Vector, damping_members
from .model import Model
from .solved import Solved

Values = dict[str, Any]


def column(r: Any) -> Matrix:
    """A vector as a matrix of one column."""
    return tuple((x,) for x in r)


def exerted_values(model: Model) -> Values:
    """γ, K, U_Q, N_Q, F_Q, N_u, F_u, D and their kin."""
    ex, places = model.exerted, model.moved(model.g)
    values: Values = {}
    for p in model.problem.get("potentials", []):
        if p["kind"] == "gravity":
            whole = model.group.in_every_block(ex.vector(p["g"]))
            earlier = values.get("γ", column((Fraction(0),) * len(whole)))
            values["γ"] = q.plus(earlier, column(whole))
    if spring_members(model):
        values["K"] = q.scaled(Fraction(0), q.identity(model.n))
        for k, s in spring_members(model):
            values["K"] = q.plus(values["K"], q.scaled(k, q.times(s, q.transposed(s))))
    values["U_Q"] = ex.potential(model.t, places, model.masses, SINGLE)
    pushes = ex.forces(model.t, places, model.masses, SINGLE)
    values |= _summed(model, pushes, "Q")
    if model.driven:
        values |= _summed(model, model.given_forces, "u")
        values |= _with_covector(model, values)
    return values | _damping(model)


def _summed(model: Model, forces: list[Vector], mark: str) -> Values:
    """N = Σ Āf r̄, F = Σ Āf, and in R³ μ = Σ r ∧ Āf."""
    back = q.transposed(model.group.linear_part(model.g))
    turned = [q.times(back, column(f)) for f in forces]
    N = q.scaled(Fraction(0), q.identity(model.n))
    F = column((Fraction(0),) * model.n)
    mu = column((Fraction(0),) * 3)
    for f, r in zip(turned, model.points, strict=True):
        N, F = q.plus(N, q.times(f, (r,))), q.plus(F, f)
        if model.n == 3:
            (x, y, z), (a, b, c) = r, (v for (v,) in f)
            mu = q.plus(mu, column((y * c - z * b, z * a - x * c, x * b - y * a)))
    return {f"N_{mark}": N, f"F_{mark}": F, f"μ_{mark}": mu}


def _with_covector(model: Model, values: Values) -> Values:
    """The covector input joins N_u and F_u by the rows that read coordinates, μ_u and F_u in R³."""
    read = Solved(model).covector_matrix
    found = {"N_u": q.plus(values["N_u"], model.group.linear_part(read))}
    if model.group.affine:
        arm = tuple((read[i][-1],) for i in range(model.n))
        found["F_u"] = q.plus(values["F_u"], arm)
    if model.group.turns_space:
        found["μ_u"] = q.plus(values["μ_u"], column(model.covector[:3]))
    return found


def _damping(model: Model) -> Values:
    D = q.scaled(Fraction(0), q.identity(model.n))
    first, total = column((Fraction(0),) * model.n), Fraction(0)
    for i, kappa in damping_members(model).items():
        r = column(model.points[i - 1])
        D = q.plus(D, q.scaled(kappa, q.times(r, q.transposed(r))))
        first, total = q.plus(first, q.scaled(kappa, r)), total + kappa
    values: Values = {"D": D, "D_c": first, "D_m": total}
    if model.n == 3:
        values["I_D"] = q.minus(q.scaled(q.trace(D), q.identity(3)), D)
    return values


def spring_members(model: Model) -> list[tuple[Fraction, Matrix]]:
    """k_e and s_e of the quadratic springs."""
    members = []
    for x in model.exerted.terms:
        if x.kind != SINGLE and x.data["kind"] == "spring":
            i, j = x.data["between"]
            ends = zip(model.points[i - 1], model.points[j - 1], strict=True)
            members.append(
                (model.exerted.number(x.data["stiffness"]), column(a - b for a, b in ends))
            )
    return members


def _in_body(model: Model, vector: Sequence[Any]) -> Matrix:
    """Ā on a vector of space; empty in a product, whose blocks have spaces of their own."""
    if model.group.factors:
        return ()
    return q.times(q.transposed(model.group.linear_part(model.g)), column(vector))


def exerted_families(model: Model) -> dict[str, dict[tuple[int, ...], Any]]:
    """k, s, d, σ, Q, κ and f_u by their indices."""
    families: dict[str, dict[tuple[int, ...], Any]] = {}
    for e, (k, s) in enumerate(spring_members(model), 1):
        families.setdefault("k", {})[e,] = k
        families.setdefault("s", {})[e,] = s
    places = model.moved(model.g)
    for e, (d, sigma) in enumerate(model.exerted.radial(places, model.masses), 1):
        families.setdefault("d", {})[e,] = column(d)
        families.setdefault("χ", {})[e,] = _in_body(model, d)
        families.setdefault("σ", {})[e,] = sigma
    if any(x.kind == SINGLE for x in model.exerted.terms):
        pushes = model.exerted.forces(model.t, places, model.masses, SINGLE)
        families["Q"] = {(i,): column(f) for i, f in enumerate(pushes, 1)}
        families["P"] = {(i,): _in_body(model, f) for i, f in enumerate(pushes, 1)}
    if damped := damping_members(model):
        families["κ"] = {(i,): damped.get(i, Fraction(0)) for i in range(1, len(places) + 1)}
    for e, (push, data) in enumerate(zip(model.pushes, model.given("force"), strict=True), 1):
        here = model.group.of_block(model.blocks[data["on"] - 1])
        families.setdefault("f_u", {})[e,] = column(push[here])
    return families
