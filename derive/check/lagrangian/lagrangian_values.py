"""The meanings of the names of a record with a Lagrangian of its own, at one exact point.

What a reduction by symmetries speaks of there; that dϖ forces the velocity.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.user_groups import block
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, nodes
from ...record.record import Step
from ..trials.meaning import NameValues, Values
from ..trials.momenta_and_outputs import Observed
from ..trials.phase_point import Form, Nearby, PhasePoint, TangentVector
from ..values.arithmetic import EPS, EPS_PRIME, ETA, EvaluationError, nilpotent, part
from ..values.draws import part_of_velocity
from ..values.evaluate import Environment, evaluate
from .lagrangian_model import PAIRED, WITH_BRACKET, LagrangianModel


def environment(model: LagrangianModel) -> Environment:
    """The environment in which the equations of a record are claims."""
    return Environment(
        model.n,
        NameValues(
            model,
            (
                *(_places, _advected, _derivatives, _momenta_values),
                *(values, _motion),
            ),
        ),
        _families(model),
        _functions(model),
        Observed(model),
        elementary=model.elementary,
        unit=model.unit,
    )


def _places(model: LagrangianModel) -> Values:
    """t, g, Z and their variations; Ȧ."""
    g, velocity = model.varied.g, model.nu
    return {
        **{"π": model.pi, "t": model.t, "δt": model.first.time, "δ′t": model.second.time},
        **{"A": model.g, "δA": part(g, EPS), "δ′A": part(g, EPS_PRIME)},
        **{"α": velocity, "Ȧ": velocity, "Z": model.Z},
        **{"ξ": model.first.xi, "ξ′": model.second.xi},
        **{"δZ": model.first.velocity, "δ′Z": model.second.velocity},
        "ζ": q.column(model.group.nearest(model.Z)),
    } | ({"u": q.column(model.covector)} if model.at.driven else {})


def _advected(model: LagrangianModel) -> Values:
    """Γ, δΓ and Γ̇."""
    if not model.advected or not model.advected.rows:
        return {}
    ahead, _ = model.displaced((nilpotent(EPS), model.Z))
    return {
        "Γ": model.advected.start,
        "δΓ": part(model.advected.at(model.varied.g), EPS),
        "Γ̇": part(model.advected.at(model.ordered(model.g, ahead)), EPS),
    }


def _derivatives(model: LagrangianModel) -> Values:
    """L̃, its energy and its derivatives but those along the motion."""
    later = model.t + nilpotent(EPS)
    return {
        "L̃": model.indices(part(model.lagrangian(model.t, model.g, model.Z), 0), 0),
        "h̃": model.indices(part(model.energy(model.t, model.g, model.Z), 0), PAIRED),
        "∂ₜL̃": model.indices(part(model.lagrangian(later, model.g, model.Z), EPS), 0),
        "Φ": _covector(model, _forces(model)),
    }


def _momenta_values(model: LagrangianModel) -> Values:
    """Π and its variations."""
    t, g, Z, *_ = model.varied
    whole = model.momenta(t, g, Z)
    masks = {"Π": 0, "δΠ": EPS, "δ′Π": EPS_PRIME}
    return {x: _covector(model, [part(y, mask) for y in whole]) for x, mask in masks.items()}


def _motion(model: LagrangianModel) -> Values:
    """What follows from the acceleration of the motion; M and β."""
    values = {"Ż": model.acceleration, "ζ̇": q.column(model.group.nearest(model.acceleration))}
    values["Π̇"] = _covector(model, _rates(model))
    # ⟨Π_o, E⟩ is the momentum along Eg on the left, gE on the right
    t, g, Z, *_ = model.onward
    back = model.undone(model.onward)
    aside = (model.ordered(back, model.ordered(x, g)) for x in model.group.basis)
    found = [model.momentum(t, g, Z, xi) for xi in aside]
    values |= {
        "Π_o": _covector(model, [part(x, 0) for x in found]),
        "Π̇_o": _covector(model, [part(x, EPS) for x in found]),
        "ḣ": model.indices(part(model.energy(t, g, Z), EPS), WITH_BRACKET),
    }
    values |= {"M": model.metric, "β": q.column(model.load)}
    return values if model.generic else values | {"𝕁": model.brackets()}


def _rates(model: LagrangianModel) -> list[Any]:
    """d/dt of ∂ℓ/∂Z along the motion, on the basis."""
    t, g, Z, *_ = model.onward
    return [part(x, EPS) for x in model.momenta(t, g, Z)]


def _forces(model: LagrangianModel) -> list[Any]:
    """The derivative of ℓ along gE, or Eg, at a fixed velocity, for each element of the basis."""
    found = []
    for e in model.group.basis:
        aside, _ = model.displaced((nilpotent(ETA), e))
        moved = model.lagrangian(model.t, model.ordered(model.g, aside), model.Z)
        found.append(part(moved, ETA))
    return found


def _covector(model: LagrangianModel, values: Iterable[Any]) -> Matrix:
    """The covector with these values on the basis, as the letter that the walk has."""
    return model.as_letter(model.group.covector_matrix(values))


def _families(model: LagrangianModel) -> dict[str, dict[tuple[int, ...], Any]]:
    if model.generic:
        return {}
    members = {
        "E": model.group.basis,
        "Π": [part(x, 0) for x in model.momenta(model.t, model.g, model.Z)],
        "Π̇": _rates(model),
        "Φ": _forces(model),
    }
    found: dict[str, dict[tuple[int, ...], Any]] = {
        name: {(a,): x for a, x in enumerate(xs, 1)} for name, xs in members.items()
    }
    listed = here(model).momenta() if model.symmetries else []
    momenta: dict[tuple[int, ...], Any] = {(i,): part(x, 0) for i, x in enumerate(listed, 1)}
    return found | ({"𝒥": momenta} if momenta else {})


def _functions(model: LagrangianModel) -> dict[str, Callable[..., Any]]:
    def form(head: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
        del head
        one, two = (evaluate(x, env) for x in arguments)
        faster = q.plus(model.Z, q.scaled(nilpotent(EPS), one))
        return model.indices(part(model.momentum(model.t, model.g, faster, two), EPS), PAIRED)

    def represented(head: Tree, arguments: tuple[Tree, ...], env: Environment) -> Any:
        del head
        assert model.advected is not None
        return block(evaluate(arguments[0], env), model.advected.rows)

    def rate_of(what: Tree, env: Environment) -> Any:
        if ("call", "ϖ", "δy") not in [*nodes(what)]:
            t, g, Z, *_ = model.onward
            moving = enumerate(model.momenta(t, g, Z), 1)
            momenta: dict[tuple[int, ...], Any] = {(a,): p for a, p in moving}
            place = {"Γ": model.advected.at(g)} if model.advected else {"A": g}
            names: Mapping[str, Any] = ChainMap(place, env.names)  # type: ignore[arg-type]
            ahead = replace(env, names=names, families={**env.families, "Π": momenta})
            return part(evaluate(what, ahead), EPS)
        if model.given[0] is None:
            raise EvaluationError("d/dt of ϖ(δy) is told where δ is a field")
        others = what[2:] if isinstance(what, tuple) and what[0] == "add" else ()
        return model.given[0].rate(model, others)

    def varied(what: Tree, mask: int) -> Any:
        if isinstance(what, tuple):
            return _varied_member(model, what, mask)
        t, g, Z, *_ = model.varied
        if what == "L̃":
            return model.indices(part(model.lagrangian(t, g, Z), mask), PAIRED)
        return model.field_varied(mask)

    def exterior(head: Tree, arguments: tuple[Any, ...], env: Environment) -> Any:
        del head, env
        return model.indices(model.exterior(*map(direction, arguments)), WITH_BRACKET)

    direction = model.direction
    return {
        "ϖ": lambda _, a, env: model.indices(model.cartan(direction(a[0])), PAIRED),
        **dict.fromkeys(("dϖ", "ω"), exterior),
        **({"ρ": represented} if model.advected else {}),
        **functions(model),
        "M̃": form,
        "ξ": lambda _, a, env: direction(a[0]).xi,
        "d/dt": lambda _, a, env: rate_of(a[0], env),
        "δ": lambda _, a, env: varied(a[0], EPS),
        "δ′": lambda _, a, env: varied(a[0], EPS_PRIME),
    }


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


def on_family(model: LagrangianModel, family: Nearby) -> ReducedPoint:
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


def functions(model: LagrangianModel) -> dict[str, Callable[..., Any]]:
    """𝒜, d𝒜, ϖ_h and its derivative."""
    if not model.symmetries:
        return {}
    direction = model.direction

    def connection(head: Any, arguments: Any, env: Environment) -> Any:
        xi = {"ξ": model.first.xi, "ξ′": model.second.xi, "Z": model.Z}[arguments[0]]
        return part(member(here(model).connection(xi), head, env), 0)

    def curvature(head: Any, arguments: Any, env: Environment) -> Any:
        def on(family: Nearby) -> Form:
            at = on_family(model, family)
            return lambda _, xi: member(at.connection(xi), head, env)

        return model.exterior(*map(direction, arguments), on=on)

    def form(head: Any, arguments: Any, env: Environment) -> Any:
        a = direction(arguments[0])
        return part(here(model).routh_form(a.time, a.xi), 0)

    def derived(head: Any, arguments: Any, env: Environment) -> Any:
        one, two = map(direction, arguments)
        return model.exterior(one, two, on=lambda family: on_family(model, family).routh_form)

    return {"𝒜": connection, "d𝒜": curvature, "ϖ_h": form, "dϖ_h": derived}


def _varied_member(model: LagrangianModel, what: Any, mask: int) -> Any:
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


def concludes_velocity(step: Step) -> bool:
    """Does a step conclude a part of the velocity of X, which is then put in?"""
    return any(part_of_velocity(e.lhs, e.rhs) and e in step.given for e in step.equations)


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
