"""The meanings of the names of a record with a Lagrangian of its own, at one exact point."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ...algebra.user_groups import block
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, nodes
from ..trials.meaning import NameValues, Values
from ..trials.model import TangentVector
from ..trials.observed import Observed
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
        Observed(model) if model.problem.get("outputs") else model.parameters,
        elementary=model.elementary,
        unit=model.unit,
    )


def _places(model: LagrangianModel) -> Values:
    """t, g, Z and their variations; Ȧ."""
    _, g, *_ = model.varied
    velocity = model.tangent_at(model.g, model.Z)
    return {
        **{"π": model.pi, "t": model.t, "δt": model.first.time, "δ′t": model.second.time},
        **{"A": model.g, "δA": part(g, EPS), "δ′A": part(g, EPS_PRIME)},
        **{"α": velocity, "Ȧ": velocity, "Z": model.Z},
        **{"ξ": model.first.xi, "ξ′": model.second.xi},
        **{"δZ": model.first.velocity, "δ′Z": model.second.velocity},
        "ζ": _column(model.group.nearest(model.Z)),
    } | ({"u": _column(model.covector)} if model.driven else {})


def _advected(model: LagrangianModel) -> Values:
    """Γ, δΓ and Γ̇."""
    if not model.advected or not model.advected.rows:
        return {}
    ahead, _ = model.displaced((nilpotent(EPS), model.Z))
    _, varied, *_ = model.varied
    return {
        "Γ": model.advected.start,
        "δΓ": part(model.advected.at(varied), EPS),
        "Γ̇": part(model.advected.at(model.tangent_at(model.g, ahead)), EPS),
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
    whole = _momenta(model, t, g, Z)
    masks = {"Π": 0, "δΠ": EPS, "δ′Π": EPS_PRIME}
    return {x: _covector(model, [part(y, mask) for y in whole]) for x, mask in masks.items()}


def _motion(model: LagrangianModel) -> Values:
    """What follows from the acceleration of the motion; M and β."""
    values = {"Ż": model.acceleration, "ζ̇": _column(model.group.nearest(model.acceleration))}
    values["Π̇"] = _covector(model, _rates(model))
    values |= _other_momentum(model)
    values |= {"M": model.metric, "β": _column(model.load)}
    return values if model.generic else values | {"𝕁": brackets(model)}


def _rates(model: LagrangianModel) -> list[Any]:
    """d/dt of ∂ℓ/∂Z along the motion, on the basis."""
    e = nilpotent(EPS)
    ahead, _ = model.displaced((e, model.Z))
    faster = q.plus(model.Z, q.scaled(e, model.acceleration))
    found = _momenta(model, model.t + e, model.tangent_at(model.g, ahead), faster)
    return [part(x, EPS) for x in found]


def _other_momentum(model: LagrangianModel) -> Values:
    """Π_o with its rate, and ḣ: ⟨Π_o, E⟩ is the momentum along Eg on the left, gE on the right."""
    e = nilpotent(EPS)
    ahead, _ = model.displaced((e, model.Z))
    t, g = model.t + e, model.tangent_at(model.g, ahead)
    undone = q.inverse(model.g)
    assert undone is not None
    back = model.back_along(undone, EPS)
    faster = q.plus(model.Z, q.scaled(e, model.acceleration))
    found = []
    for x in model.group.basis:
        aside = q.times(x, g) if model.side == "left" else q.times(g, x)
        found.append(model.momentum(t, g, faster, model.trivialised(g, back, aside)))
    return {
        "Π_o": _covector(model, [part(x, 0) for x in found]),
        "Π̇_o": _covector(model, [part(x, EPS) for x in found]),
        "ḣ": model.indices(part(model.energy(t, g, faster), EPS), WITH_BRACKET),
    }


def _rate(model: LagrangianModel, what: Tree, env: Environment) -> Any:
    """d/dt of a function of Π_a and of g along the motion."""
    e = nilpotent(EPS)
    g = model.tangent_at(model.g, model.displaced((e, model.Z))[0])
    now = (part(x, 0) for x in _momenta(model, model.t, model.g, model.Z))
    pairs = enumerate(zip(now, _rates(model), strict=True), 1)
    momenta: dict[tuple[int, ...], Any] = {(a,): p + e * rate for a, (p, rate) in pairs}
    place = {"Γ": model.advected.at(g)} if model.advected else {"A": g}
    names: Mapping[str, Any] = ChainMap(place, env.names)  # type: ignore[arg-type]
    ahead = replace(env, names=names, families={**env.families, "Π": momenta})
    return part(evaluate(what, ahead), EPS)


def _column(entries: Iterable[Any]) -> Matrix:
    return tuple((x,) for x in entries)


def _momenta(model: LagrangianModel, t: Any, g: Matrix, Z: Matrix) -> list[Any]:
    """∂ℓ/∂Z along each element of the basis."""
    return [model.momentum(t, g, Z, e) for e in model.group.basis]


def _forces(model: LagrangianModel) -> list[Any]:
    """The derivative of ℓ along gE, or Eg, at a fixed velocity, for each element of the basis."""
    found = []
    for e in model.group.basis:
        aside, _ = model.displaced((nilpotent(ETA), e))
        found.append(
            part(model.lagrangian(model.t, model.tangent_at(model.g, aside), model.Z), ETA)
        )
    return found


def _covector(model: LagrangianModel, values: Iterable[Any]) -> Matrix:
    """The covector with these values on the basis, as the letter that the walk has."""
    return model.as_letter(model.group.covector_matrix(values))


def _families(model: LagrangianModel) -> dict[str, dict[tuple[int, ...], Any]]:
    if model.generic:
        return {}
    members = {
        "E": model.group.basis,
        "Π": [part(x, 0) for x in _momenta(model, model.t, model.g, model.Z)],
        "Π̇": _rates(model),
        "Φ": _forces(model),
    }
    found: dict[str, dict[tuple[int, ...], Any]] = {
        name: {(a,): x for a, x in enumerate(xs, 1)} for name, xs in members.items()
    }
    return found | reduced_by_symmetries.families(model)


def _functions(model: LagrangianModel) -> dict[str, Callable[..., Any]]:
    first, second = model.first, model.second

    def direction(name: str) -> TangentVector:
        if name == "X":
            return model.motion
        full = second if "′" in name else first
        return replace(full, time=Fraction(0)) if "x" in name else full

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
        other = EPS_PRIME if mask == EPS else EPS
        return part(model.field(model.varied, other), mask)

    return {
        "ϖ": lambda _, a, env: model.cartan(direction(a[0])),
        **dict.fromkeys(("dϖ", "ω"), lambda _, a, env: model.exterior(*(direction(x) for x in a))),
        **({"ρ": represented} if model.advected else {}),
        **reduced_by_symmetries.functions(model, direction),
        "M̃": form,
        "ξ": lambda _, a, env: direction(a[0]).xi,
        "d/dt": lambda _, a, env: rate_of(a[0], env),
        "δ": lambda _, a, env: varied(a[0], EPS),
        "δ′": lambda _, a, env: varied(a[0], EPS_PRIME),
    }


# Poisson brackets of the momenta and of Γ at an exact point, by flows: no structure constant
# used.
#
# {F, Π_b} is the rate of F along the flow of Π_b, which moves g by gE_b (on the right E_bg) and
# takes covectors along: ⟨p, gE_a⟩ at g becomes ⟨p, ghE_ah⁻¹⟩, h = 1 + sE_b.


def brackets(model: LagrangianModel) -> Matrix:
    """The matrix of the brackets of Π_1, …, then the entries of Γ."""
    columns = [_along(model, e) for e in model.group.basis]
    d, size = len(columns), len(columns[0])
    aside = [[-columns[a][i] for i in range(d, size)] for a in range(d)]
    rows = [[*(columns[b][a] for b in range(d)), *aside[a]] for a in range(d)]
    rows += [[*(x[i] for x in columns), *(Fraction(0) for _ in aside[0])] for i in range(d, size)]
    return tuple(map(tuple, rows))


def _along(model: LagrangianModel, e: Matrix) -> list[Any]:
    """The rates of all variables along the flow of the momentum on e."""
    h, back = model.displaced((nilpotent(EPS), e))
    turned = [_conjugated(model, h, back, x) for x in model.group.basis]
    rates = [part(model.momentum(model.t, model.g, model.Z, _rate_by_flow(x)), 0) for x in turned]
    if model.advected and model.advected.rows:
        moved = model.advected.at(model.tangent_at(model.g, h))
        rates += [part(row[0], EPS) for row in moved]
    return rates


def _conjugated(model: LagrangianModel, h: Matrix, back: Matrix, x: Matrix) -> Matrix:
    """hxh⁻¹, where g moves to gh; h⁻¹xh, where it moves to hg."""
    one, two = (h, back) if model.side == "left" else (back, h)
    return q.times(q.times(one, x), two)


def _rate_by_flow(x: Matrix) -> Matrix:
    """The rate of a matrix."""
    return tuple(tuple(part(y, EPS) for y in row) for row in x)
