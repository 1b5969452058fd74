"""The meanings of the names of a record with a Lagrangian of its own, at one exact point."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

from ...algebra.user_groups import block
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, nodes
from ..trials.meaning import NameValues, Values
from ..trials.output_values import Observed
from ..values.arithmetic import EPS, EPS_PRIME, ETA, EvaluationError, nilpotent, part
from ..values.evaluate import Environment, evaluate
from . import reduced_by_symmetries
from .lagrangian_model import PAIRED, WITH_BRACKET, LagrangianModel


def environment(model: LagrangianModel) -> Environment:
    """The environment in which the equations of a record are claims."""
    return Environment(
        model.n,
        NameValues(
            model,
            (
                *(_places, _advected, _derivatives, _momenta_values),
                *(reduced_by_symmetries.values, _motion),
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
    values |= _other_momentum(model)
    values |= {"M": model.metric, "β": q.column(model.load)}
    return values if model.generic else values | {"𝕁": model.brackets()}


def _rates(model: LagrangianModel) -> list[Any]:
    """d/dt of ∂ℓ/∂Z along the motion, on the basis."""
    t, g, Z, *_ = model.onward
    return [part(x, EPS) for x in model.momenta(t, g, Z)]


def _other_momentum(model: LagrangianModel) -> Values:
    """Π_o with its rate, and ḣ: ⟨Π_o, E⟩ is the momentum along Eg on the left, gE on the right."""
    t, g, Z, *_ = model.onward
    back = model.undone(model.onward)
    aside = (model.ordered(back, model.ordered(x, g)) for x in model.group.basis)
    found = [model.momentum(t, g, Z, xi) for xi in aside]
    return {
        "Π_o": _covector(model, [part(x, 0) for x in found]),
        "Π̇_o": _covector(model, [part(x, EPS) for x in found]),
        "ḣ": model.indices(part(model.energy(t, g, Z), EPS), WITH_BRACKET),
    }


def _rate(model: LagrangianModel, what: Tree, env: Environment) -> Any:
    """d/dt of a function of Π_a and of g along the motion."""
    t, g, Z, *_ = model.onward
    moving = enumerate(model.momenta(t, g, Z), 1)
    momenta: dict[tuple[int, ...], Any] = {(a,): p for a, p in moving}
    place = {"Γ": model.advected.at(g)} if model.advected else {"A": g}
    names: Mapping[str, Any] = ChainMap(place, env.names)  # type: ignore[arg-type]
    ahead = replace(env, names=names, families={**env.families, "Π": momenta})
    return part(evaluate(what, ahead), EPS)


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
    return found | reduced_by_symmetries.families(model)


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
            return _rate(model, what, env)
        if model.given[0] is None:
            raise EvaluationError("d/dt of ϖ(δy) is told where δ is a field")
        others = what[2:] if isinstance(what, tuple) and what[0] == "add" else ()
        return model.given[0].rate(model, others)

    def varied(what: Tree, mask: int) -> Any:
        if isinstance(what, tuple):
            return reduced_by_symmetries.varied(model, what, mask)
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
        **reduced_by_symmetries.functions(model),
        "M̃": form,
        "ξ": lambda _, a, env: direction(a[0]).xi,
        "d/dt": lambda _, a, env: rate_of(a[0], env),
        "δ": lambda _, a, env: varied(a[0], EPS),
        "δ′": lambda _, a, env: varied(a[0], EPS_PRIME),
    }
