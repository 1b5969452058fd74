"""The meanings of names: from a model, one exact point, to the values of all names there."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any, Generic, TypeVar

from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ..form.function_signatures import MOVED_PLACE, SHARED
from ..values.arithmetic import (
    EPS,
    EPS_PRIME,
    EvaluationError,
    is_matrix,
    nilpotent,
    part,
    times,
)
from ..values.draws import Draws
from ..values.evaluate import Environment, evaluate, point_index
from .force_balance import (
    barycentric_values,
    force_families,
    force_values,
    image,
    integral,
    place_values,
    solution_values,
)
from .model import Model
from .momenta_and_outputs import (
    ON_TANGENT,
    Observed,
    accelerations,
    action_varied,
    basis_families,
    moments_about,
    momentum_values,
    poisson_values,
    rate,
    rigid_body_values,
    space_values,
)
from .point_masses import axial, listed_count, outer_sum

# The mapping from names to exact values that an environment reads.

Values = dict[str, Any]
M = TypeVar("M")


class NameValues(Mapping[str, Any], Generic[M]):
    """The mapping from names to values at a model; ``groups`` of them are computed in turn when a
    name is first asked for that no earlier group has; an earlier group's value stands."""

    def __init__(self, model: M, groups: Sequence[Callable[[M], Values]]):
        self.model = model
        self.known: Values = {}
        self.pending = [*groups]

    def __getitem__(self, name: str) -> Any:
        while name not in self.known and self.pending:
            self._compute_next()
        return self.known[name]

    def _compute_next(self) -> None:
        self.known = self.pending[0](self.model) | self.known
        del self.pending[0]

    def __iter__(self) -> Iterator[str]:
        while self.pending:
            self._compute_next()
        return iter(self.known)

    def __len__(self) -> int:
        return len([*self])


def environment(model: Model) -> Environment:
    """The environment in which the equations of a record are claims."""
    return Environment(
        model.n,
        NameValues(model, GROUPS),
        _families(model),
        _functions(model),
        Observed(model),
        elementary=model.elementary,
        listed=listed_count(model),
        copies=model.copies,
        unit=model.unit,
    )


def parts_of(model: Draws, linear: str, vector: str, x: Matrix) -> Values:
    """The linear part of a matrix and, in an affine group, its translation, by these names."""
    values: Values = {linear: model.group.linear_part(x)}
    if model.group.affine:
        values[vector] = model.group.translation_part(x)
    return values


def _times(model: Model) -> Values:
    return {"π": model.pi, "t": model.t, "δt": model.first.time, "δ′t": model.second.time}


def _bodies(model: Model) -> Values:
    """The moments m, c, J of the points, and J_c about the centre of mass."""
    m, c, J = model.moments
    values: Values = {"m": m, "c": c, "J": J}
    if model.group.barycentric_blocks and not model.generic:
        return values | barycentric_values(model)
    return values | {"J_c": moments_about(model, tuple(x[0] / m for x in c))}


def _group(model: Model) -> Values:
    """The values of g and ν, and of their variations in space and at the identity."""
    g = model.varied.g
    nu = q.times(g, model.varied.Z)
    values = parts_of(model, "A", "T", model.g) | parts_of(model, "α", "τ", part(nu, 0))
    for mark, mask, direction in (("δ", EPS, model.first), ("δ′", EPS_PRIME, model.second)):
        values |= parts_of(model, mark + "A", mark + "T", part(g, mask))
        values |= parts_of(model, mark + "α", mark + "τ", part(nu, mask))
        prime = mark[1:]
        values |= parts_of(model, "ξ" + prime, "η" + prime, direction.xi)
        values |= parts_of(model, mark + "Z", mark + "w", direction.velocity)
    values |= parts_of(model, "Z", "w", model.Z)
    A = values["A"]
    values["C"] = q.times(q.transposed(A), A)
    if model.group.affine:
        m, c, _ = model.moments
        for name, linear, shift in (("R", "A", "T"), ("Ṙ", "α", "τ")):
            values[name] = q.plus(values[shift], q.scaled(1 / m, q.times(values[linear], c)))
    image = model.group.linear_part(g)
    values["δC"] = part(q.times(q.transposed(image), image), EPS)
    return values


def _forces(model: Model) -> Values:
    """The potential's forces and their moments: F, N = Σ F r̄ in space, and F_b, N_b in the
    body."""
    N, F = outer_sum(model.forces, model.points), outer_sum(model.forces, model.units)
    back = q.transposed(model.group.linear_part(model.g))
    values: Values = {"N": N, "F": F, "N_b": q.times(back, N), "F_b": q.times(back, F)}
    return values if model.generic else values | force_values(model)


def _gradients(model: Model) -> Values:
    """f and F̃ = A f, found by solving with the metric; for linear actions only."""
    if model.group.affine:
        return {}
    return {"f": model.gradient, "F̃": q.times(model.g, model.gradient)}


def _energies(model: Model) -> Values:
    """The values of L, U and h̃ at the point."""
    value = part(model.lagrangian(model.t, model.g, model.Z), 0)
    potential = part(model.potential(model.t, model.images(model.g)), 0)
    energy = part(model.energy(model.t, model.g, model.Z), 0)
    body = model.onward_body
    later = body.potential(model.t + nilpotent(EPS), body.images(model.g))
    own = {"U": potential, "Ũ": potential, "∂ₜŨ": part(later, EPS)}
    return {"L": value, "L̃": value, "h̃": energy, **own}


def _motion(model: Model) -> Values:
    """The rates along the motion, the coordinates, the inputs, and the solved equations."""
    Z, Z_dot = model.Z, model.acceleration
    acceleration = q.times(model.g, q.plus(Z_dot, q.times(Z, Z)))
    values = parts_of(model, "Ż", "ẇ", Z_dot)
    values |= parts_of(model, "α̇", "τ̇", acceleration)
    values |= parts_of(model, "Ȧ", "Ṫ", model.nu)
    values |= space_values(model, acceleration)
    d = len(model.group.linear_basis)
    for name, element in (("ζ", Z), ("ζ̇", Z_dot)):
        values[name] = q.column(model.group.nearest(element)[:d])
    if model.group.user_basis:
        values["z"] = q.column(model.group.in_user_basis.nearest(Z))
    if model.at.driven:
        values["u"] = q.column(model.covector)
    return values | ({} if model.generic else solution_values(model))


def _families(model: Model) -> dict[str, dict[tuple[int, ...], Any]]:
    """The members of families by indices; copies of a point share its mass and force."""
    families: dict[str, dict[tuple[int, ...], Any]] = {
        "m": {(i,): m for i, m in enumerate(model.masses, 1)},
        "r": {(i,): q.column(r) for i, r in enumerate(model.points, 1)},
        "v": {(i,): q.column(v) for i, v in enumerate(model.images(model.nu), 1)},
        "F": {(i,): q.column(f) for i, f in enumerate(model.forces, 1)},
    }
    if model.problem.get("outputs") and not model.generic:
        families["v̇"] = {(i,): q.column(a) for i, a in enumerate(accelerations(model), 1)}
    if not model.generic:
        own = model.group.basis[: len(model.group.linear_basis)]
        families["E"] = {(a,): model.group.linear_part(e) for a, e in enumerate(own, 1)}
        families |= force_families(model) | basis_families(model)
    for name in {*SHARED} & {*families}:
        whole = families[name].items()
        families[name] = {(i,): times(1 / model.copies[i - 1], x) for (i,), x in whole}
    return families


def _functions(model: Model) -> dict[str, Callable[..., Any]]:
    """The functions of the record by their heads, called with arguments of the kinds that
    :mod:`derive.check.form.function_signatures` states."""
    direction = cache(model.direction)

    @cache
    def exterior(*names: str) -> Any:
        return model.exterior(*map(direction, names))

    def tangent(arguments: tuple[Tree, ...], env: Environment) -> Matrix:
        n = model.n
        blocks = [evaluate(x, env) for x in arguments]
        linear = blocks[0] if is_matrix(blocks[0]) else ((Fraction(0),) * n,) * n
        if not model.group.affine:
            return linear
        vector = blocks[1] if is_matrix(blocks[1]) else ((Fraction(0),),) * n
        return q.bordered(linear, vector, Fraction(0))

    def momentum(_: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
        return part(model.pairing(model.nu, tangent(arguments, env)), 0)

    def point(head: Any, _: tuple[Tree, ...], env: Environment) -> Matrix:
        return q.column(model.images(model.g)[point_index(head[2], env) - 1])

    own = (x for x, _ in model.applied.members() if x.functions)
    return {
        **{name: f for account in own for name, f in account.functions(model).items()},
        "dŨ": lambda _, a, env: model.work(tangent(a, env)),
        "p̃": momentum,
        "ϖ": lambda _, a, env: model.cartan(direction(a[0])),
        **dict.fromkeys(("dϖ", "ω"), lambda _, a, env: exterior(*a)),
        "r": point,
        "∫": lambda _, a, env: integral(model, a[0], env),
        "g": lambda _, a, env: image(model, model.g, evaluate(a[0], env)),
        "d/dt": lambda _, a, env: rate(model, a[0], env),
        "δA": lambda _, a, env: model.group.linear_part(q.times(model.g, direction(a[0]).xi)),
        "δT": lambda _, a, env: model.group.translation_part(q.times(model.g, direction(a[0]).xi)),
        "ξ": lambda _, a, env: model.group.linear_part(direction(a[0]).xi),
        "η": lambda _, a, env: model.group.translation_part(direction(a[0]).xi),
        "Ω": lambda _, a, env: _rotation_vector(model, direction(a[0]).xi),
        "δ": lambda _, a, env: _varied(model, a[0], EPS, env),
        "δ′": lambda _, a, env: _varied(model, a[0], EPS_PRIME, env),
    }


def _varied(model: Model, what: Tree, mask: int, env: Environment) -> Any:
    """δ (``mask`` EPS) or δ′ (EPS_PRIME) of what a call varies.

    That is L̃ dt on X, a moved point, or one of the fields ξ, ξ′, η, η′ on the two-parameter family.
    """
    if what == ON_TANGENT:
        return action_varied(model)
    if what == MOVED_PLACE:
        return part(image(model, model.varied.g, evaluate("r", env)), mask)
    if isinstance(what, tuple):
        i = point_index(what[1][2], env)
        return part(q.column(model.varied_places[i - 1]), mask)
    group = model.group
    along = group.linear_part if what in ("ξ", "ξ′") else group.translation_part
    return along(model.field_varied(mask))


def _rotation_vector(model: Model, xi: Matrix) -> Matrix:
    """Ω with ξ = j(Ω); ``EvaluationError`` for groups that are not rotations of space."""
    if not model.group.turns_space:
        raise EvaluationError("Ω is of the rotations of space alone")
    return axial(xi)


GROUPS: tuple[Callable[[Model], Values], ...] = (
    *(_times, _bodies, _group, _forces, _energies, rigid_body_values),
    *(_gradients, _motion, momentum_values, place_values, poisson_values),
)
"""What the names mean, in the order in which it is asked for."""
