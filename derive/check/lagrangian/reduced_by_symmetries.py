"""What a reduction by symmetries speaks of, at an exact point; that dϖ forces the velocity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...record.record import Equation, Step
from ..trials.phase_point import Family, PhasePoint, TangentVector
from ..values.arithmetic import EPS, EPS_PRIME, EvaluationError, derivative_in, part
from ..values.draws import part_of_velocity
from ..values.evaluate import Environment
from .lagrangian_model import LagrangianModel

# What a reduction by symmetries speaks of, at an exact point, by the fields that the record has.
#
# Momenta are derivatives of ℓ, 𝕀 and 𝒜 are made of them at the velocities of the fields and at
# rest, energies are taken at the horizontal velocity and at what is left; derivatives come from
# nilpotent numbers on a family in the group.


@dataclass(frozen=True)
class ReducedPoint:
    """A time, an element, its inverse and a velocity, which may all be nilpotent, and what the
    fields are there."""

    model: LagrangianModel
    t: Any
    g: Matrix
    back: Matrix
    Z: Matrix

    @cached_property
    def fields(self) -> list[Matrix]:
        """η_i, the fields carried to 𝔤."""
        m = self.model
        return [x.trivialised(m, self.t, self.g, self.back)[1] for x in m.symmetries]

    def pushed(self, Z: Matrix, xi: Matrix) -> Any:
        """The momentum of a velocity on ξ."""
        return self.model.momentum(self.t, self.g, Z, xi)

    def metric(self, one: Matrix, two: Matrix) -> Any:
        """⟨ξ, ξ′⟩: the momentum of ξ, less that at rest, on ξ′."""
        return self.pushed(one, two) - self.pushed(q.scaled(0, one), two)

    @cached_property
    def locked(self) -> Matrix:
        """𝕀."""
        return tuple(tuple(self.metric(x, y) for y in self.fields) for x in self.fields)

    def momenta(self) -> list[Any]:
        """𝒥_i."""
        return [self.pushed(self.Z, x) for x in self.fields]

    @cached_property
    def _inverse(self) -> Matrix:
        found = q.inverse(part(self.locked, 0))
        if found is None:
            raise EvaluationError("𝕀 has no inverse at this point")
        return found

    def connection(self, xi: Matrix) -> list[Any]:
        """𝒜(ξ): 𝕀x = (⟨η_i, ξ⟩), by as many steps as there are nilpotents to a product."""
        wanted = tuple((self.metric(x, xi),) for x in self.fields)
        small = q.minus(self.locked, part(self.locked, 0))
        found = q.times(self._inverse, wanted)
        for _ in range(2):
            found = q.times(self._inverse, q.minus(wanted, q.times(small, found)))
        return [row[0] for row in found]

    def horizontal(self, xi: Matrix) -> Matrix:
        """ξ − Σ 𝒜_i(ξ) η_i."""
        for weight, eta in zip(self.connection(xi), self.fields, strict=True):
            xi = q.minus(xi, q.scaled(weight, eta))
        return xi

    def routh_form(self, time: Any, xi: Matrix) -> Any:
        """The momentum of the horizontal velocity on what is horizontal of ξ, less h̃ δt."""
        pushed = self.pushed(self.horizontal(self.Z), self.horizontal(xi))
        return pushed - self.model.energy(self.t, self.g, self.Z) * time


def here(model: LagrangianModel) -> ReducedPoint:
    """The point of a model."""
    return ReducedPoint(model, model.t, model.g, q.inverted(model.g), model.Z)


def on_family(model: LagrangianModel, family: Family) -> ReducedPoint:
    """The points of a family."""
    return ReducedPoint(model, family.t, family.g, model.undone(family), family.Z)


def values(model: LagrangianModel) -> dict[str, Any]:
    """The values of names."""
    if not model.symmetries:
        return {}
    at = here(model)
    Z = at.horizontal(model.Z)
    spent = sum(
        (x * y for x, y in zip(at.momenta(), at.connection(model.Z), strict=True)),
        start=Fraction(0),
    )
    return {
        "𝕀": part(at.locked, 0),
        "ζ_h": tuple((part(x, 0),) for x in model.group.nearest(Z)),
        "𝒱": part(model.energy(model.t, model.g, q.minus(model.Z, Z)), 0),
        "ℛ": part(model.lagrangian(model.t, model.g, model.Z) - spent, 0),
    }


def families(model: LagrangianModel) -> dict[str, dict[tuple[int, ...], Any]]:
    """𝒥_i."""
    listed = here(model).momenta() if model.symmetries else []
    found: dict[tuple[int, ...], Any] = {(i,): part(x, 0) for i, x in enumerate(listed, 1)}
    return {"𝒥": found} if found else {}


def functions(model: LagrangianModel) -> dict[str, Callable[..., Any]]:
    """𝒜, d𝒜, ϖ_h and its derivative."""
    if not model.symmetries:
        return {}
    direction = model.direction

    def connection(head: Any, arguments: Any, env: Environment) -> Any:
        xi = {"ξ": model.first.xi, "ξ′": model.second.xi, "Z": model.Z}[arguments[0]]
        return part(member(here(model).connection(xi), head, env), 0)

    def curvature(head: Any, arguments: Any, env: Environment) -> Any:
        one, two = map(direction, arguments)
        return exterior(model, one, two, lambda at, _, xi: member(at.connection(xi), head, env))

    def form(head: Any, arguments: Any, env: Environment) -> Any:
        a = direction(arguments[0])
        return part(here(model).routh_form(a.time, a.xi), 0)

    def derived(head: Any, arguments: Any, env: Environment) -> Any:
        one, two = map(direction, arguments)
        return exterior(model, one, two, ReducedPoint.routh_form)

    return {"𝒜": connection, "d𝒜": curvature, "ϖ_h": form, "dϖ_h": derived}


def exterior(
    model: LagrangianModel,
    a: TangentVector,
    b: TangentVector,
    form: Callable[[ReducedPoint, Any, Matrix], Any],
) -> Any:
    """δ[form(δ′)] − δ′[form(δ)] on a family; ``form``: of δt and ξ at its points."""
    family = model.family(a, b)
    at = on_family(model, family)

    def on(mask: int) -> Any:
        return form(at, derivative_in(family[0], mask), model.field(family, mask))

    return part(on(EPS_PRIME), EPS) - part(on(EPS), EPS_PRIME)


def varied(model: LagrangianModel, what: Any, mask: int) -> Any:
    """δ or δ′ of 𝒥_i, or of 𝒜_i of the other field."""
    at = on_family(model, model.varied)
    if what[0] == "at":
        return part(member(at.momenta(), what), mask)
    other = EPS_PRIME if mask == EPS else EPS
    return part(member(at.connection(model.field(model.varied, other)), what[1]), mask)


def member(found: list[Any], head: Any, env: Environment | None = None) -> Any:
    """The one of this number, or of what an index is bound to."""
    i = env.indices.get(head[2], head[2]) if env else head[2]
    if not isinstance(i, int) or not 1 <= i <= len(found):
        raise EvaluationError(f"no symmetry {i!r}")
    return found[i - 1]


# That dϖ forces the velocity of X: variations of the velocity alone pair with ξ(X) − Z by the
# metric, so that the kernel of this pairing is {ξ(X) = Z} where the metric is not degenerate.


def states_velocity(equation: Equation) -> bool:
    """Does the equation say what part of the velocity of X is, as δA(X) = α?"""
    return bool(part_of_velocity(equation.lhs, equation.rhs))


def concludes_velocity(step: Step) -> bool:
    """Does a step conclude a part of the velocity of X, which is then put in?"""
    return any(states_velocity(e) and e in step.given for e in step.equations)


def unforced_velocity(model: PhasePoint) -> str:
    """Why dϖ(X, δ′) = 0 for every δ′ with δ′t = 0 and δ′g = 0 does not force ξ(X) = Z at a point,
    in words; "" where it does.

    dϖ(X, δ′) = −⟨ξ(X) − Z, δ′Z⟩ is tried for random ξ(X) and δ′Z in 𝔤, and the rank of the metric
    taken.
    """
    x, y = model.mixed.xi, model.second.velocity
    nothing = q.scaled(Fraction(0), y)
    moving = TangentVector(Fraction(1), q.plus(model.Z, x), model.first.velocity)
    paired = model.exterior(moving, TangentVector(Fraction(0), nothing, y))
    row, column = (q.column(model.group.nearest(z)) for z in (x, y))
    ((metric,),) = q.times(q.times(q.transposed(row), model.metric), column)
    if paired != -metric:
        return "variations of the velocity do not pair with that of X by the metric"
    singular = q.rank(model.metric) < model.group.dimension
    return "other velocities of X are in the kernel of dϖ, too" if singular else ""
