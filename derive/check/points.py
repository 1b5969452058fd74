"""The points of a model: those of the problem, or random ones where it leaves them open."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from ..record.as_json import decode
from .draws import Draws
from .equimomental import equimomental_points, moments_of, remaining_moments
from .evaluate import evaluate

Vector = tuple[Any, ...]
Points = tuple[list[Fraction], list[Vector], list[int]]
"""Masses, places in the body and blocks of the points; places without a mass are among them."""


def points_of(model: Draws) -> Points:
    """The points of a model: those that the problem lists, its other places without mass, and then
    points for what it does not list."""
    body = model.problem.get("body", {})
    listed = [] if model.generic else model.problem.get("places", [])
    places, blocks = _listed_places(model, listed)
    empty = [Fraction(0)] * len(places)
    if body.get("kind") in ("points", "given") and not model.generic:
        listed = body.get("points", [])
        own = [evaluate(decode(p["mass"], "mass"), model.expressions) for p in listed]
        points, first = _listed_places(model, listed)
        masses, rest = (
            _points_with_moments(model, *moments_of(model)) if body["kind"] == "given" else ([], [])
        )
        blocks = first + blocks + [1] * len(rest)
        return own + empty + masses, points + places + rest, blocks
    masses, points = _random_points(model, model.n + 1 + model.spare)
    return empty + masses, places + points, blocks + [1] * len(points)


def listed_count(model: Draws) -> int:
    """How many points the problem lists: they come first, and have numbers in equations."""
    if model.generic:
        return 0
    body = model.problem.get("body", {})
    return len(body.get("points", [])) + len(model.problem.get("places", []))


def principal_points(model: Draws) -> Points:
    """The points of a model with random m, c and diagonal J: as many random points as the problem
    lists, and those that complete the moments."""
    n, count = model.n, len(model.problem.get("body", {}).get("points", []))
    masses, points = _random_points(model, count)
    places, blocks = _listed_places(model, model.problem.get("places", []))
    m, c = model.draw(positive=True), model.place()
    J = q.matrix(
        [[model.draw(slots=2) if i == j else Fraction(0) for j in range(n)] for i in range(n)]
    )
    more, rest = _points_with_moments(model, *remaining_moments(masses, points, m, c, J))
    empty = [Fraction(0)] * len(places)
    return masses + empty + more, points + places + rest, [1] * count + blocks + [1] * len(rest)


def _points_with_moments(
    model: Draws, m: Fraction, c: Vector, J: Matrix
) -> tuple[list[Fraction], list[Vector]]:
    """Points with the moments m, c, J, some at random: no more is known of them."""
    masses, points = _random_points(model, model.spare)
    more, rest = equimomental_points(*remaining_moments(masses, points, m, c, J))
    return masses + more, points + rest


def _random_points(model: Draws, count: int) -> tuple[list[Fraction], list[Vector]]:
    """So many random points: their masses, and their places."""
    masses = [model.draw(positive=True) for _ in range(count)]
    return masses, [model.place() for _ in range(count)]


def _listed_places(model: Draws, listed: list[Mapping[str, Any]]) -> tuple[list[Vector], list[int]]:
    """The places that the problem lists, in the coordinates of a product, and their blocks."""
    places, blocks = [], []
    for data in listed:
        at = tuple(evaluate(decode(x, "at"), model.expressions) for x in data["at"])
        block = data.get("block", 1)
        blocks.append(block)
        at = model.group.in_block(block, at, 1)
        places.append(at)
    return places, blocks
