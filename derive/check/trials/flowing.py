"""What flows in a body at one exact point: its thrust, and what the flow inside acts by, from the
moments of the body at two times further on."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, NamedTuple

from ...language import rational as q
from ...language.rational import Matrix
from ...record.as_json import decode
from ..values.arithmetic import EPS, ETA, Nilpotent, nilpotent
from ..values.draws import Draws, at_time
from ..values.evaluate import Environment, evaluate
from .point_masses import Body, Vector, outer_sum, scaled_each


class Flowing(NamedTuple):
    """Forces in the body on its points, by their numbers from 1, and a matrix N of moments."""

    forces: list[tuple[int, Matrix]]
    moments: Matrix


def flowing(model: Body, Z: Matrix) -> Flowing:
    """What flows with the velocity ``Z`` of the body, its linear part.

    A particle of the flow inside has Coriolis' acceleration 2Zv and its own rate; with Σ ρ v = p
    and Σ ρ (v r̄ + r v̄) = Q their moments are ZQ, less what is symmetric: −½ (ZQ + QZ).
    """
    env = at_time(model.expressions, model.t + nilpotent(ETA) + nilpotent(EPS))
    first, second = _moments(model, env)
    push, forces = q.scaled(Fraction(-1), first), []
    for x in model.problem["flows"]:
        rate, place = _value(x["rate"], env), model.points[x["on"] - 1]
        push = q.plus(push, q.scaled(_earlier(rate), q.column(place)))
        second = q.minus(second, q.scaled(_earlier(rate), outer_sum([place], [place])))
        u = q.column(model.group.in_block(1, [_value(y, env) for y in x["velocity"]]))
        forces.append((x["on"], _part(q.scaled(rate, u), 0)))
    p, Q = q.scaled(Fraction(-1), _part(push, ETA)), _part(second, ETA)
    within = q.plus(q.scaled(Fraction(-2), q.times(Z, p)), _part(push, ETA | EPS))
    on = model.problem["flows"][0]["on"]  # carried from the origin to there
    origin = model.group.in_block(1, [0] * model.group.places[0][1].n, 1)
    arm = tuple(x - y for x, y in zip(model.points[on - 1], origin, strict=True))
    back = q.times(within, q.transposed(q.column(arm)))
    turning = q.scaled(Fraction(-1, 2), q.plus(q.times(Z, Q), q.times(Q, Z)))
    if model.group.factors:  # of translations: nothing turns, and C is not 1
        turning = q.scaled(Fraction(0), turning)
        g: Matrix = model.g  # type: ignore[attr-defined]
        back = q.times(q.times(q.transposed(g), g), back)
    return Flowing([*forces, (on, within)], q.minus(turning, back))


def _earlier(rate: Any) -> Any:
    """An integral of the rate, in nilpotent numbers, whose derivatives are it and its own."""
    x = Nilpotent.of(rate)
    return x.part(0) * (nilpotent(ETA) + nilpotent(EPS)) + x.part(ETA) * nilpotent(ETA) * nilpotent(
        EPS
    )


def _moments(model: Draws, env: Environment) -> tuple[Matrix, Matrix]:
    """Σ m r and Σ m r r̄ in an environment, of listed points or as they are given."""
    body: Mapping[str, Any] = model.problem["body"]
    if body["kind"] == "given":
        given = body["given"]
        rows = tuple(tuple(_value(x, env) for x in row) for row in given["J"])
        return q.column(tuple(_value(x, env) for x in given["c"])), rows
    masses = [_value(x["mass"], env) for x in body["points"]]
    places: list[Vector] = model.points[: len(masses)]  # type: ignore[attr-defined]
    weighted = scaled_each(masses, places)
    return outer_sum(weighted, [(Fraction(1),)] * len(masses)), outer_sum(weighted, places)


def _value(tree: Any, env: Environment) -> Any:
    return evaluate(decode(tree, "flow"), env)


def _part(x: Matrix, index: int) -> Matrix:
    return tuple(tuple(Nilpotent.of(y).part(index) for y in row) for row in x)
