"""The points of a model: those of the problem, or any where it leaves them open."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from ..algebra import rational as q
from .evaluate import evaluate
from .realised import points_with, realised
from .record import decode

if TYPE_CHECKING:
    from .model import Model

Vector = tuple[Any, ...]
Points = tuple[list[Fraction], list[Vector], list[int]]
"""Masses, places in the body, blocks; the places without a mass are among them."""


def points_of(model: Model) -> Points:
    """Masses and points of the problem, then its other places."""
    body = model.problem.get("body", {})
    listed = [] if model.opaque else model.problem.get("places", [])
    places, blocks = _placed(model, listed)
    empty = [Fraction(0)] * len(places)
    if body.get("kind") in ("points", "given") and not model.opaque:
        listed = body.get("points", [])
        own = [evaluate(decode(p["mass"], "mass"), model.expressions) for p in listed]
        points, first = _placed(model, listed)
        masses, rest = realised(model) if body["kind"] == "given" else ([], [])
        blocks = first + blocks + [1] * len(rest)
        return own + empty + masses, points + places + rest, blocks
    count = model.n + 1
    masses = [model.draw(positive=True) for _ in range(count)]
    points = [tuple(model.draw() for _ in range(model.n)) for _ in range(count)]
    return empty + masses, places + points, blocks + [1] * count


def principal_points(model: Model) -> Points:
    """As many points anywhere and what makes J diagonal, and m and c any."""
    n, count = model.n, len(model.problem.get("body", {}).get("points", []))
    masses = [model.draw(positive=True) for _ in range(count)]
    points: list[Vector] = [tuple(model.draw() for _ in range(n)) for _ in range(count)]
    places, blocks = _placed(model, model.problem.get("places", []))
    m, c = model.draw(positive=True), [model.draw() for _ in range(n)]
    J = [[model.draw() if i == j else Fraction(0) for j in range(n)] for i in range(n)]
    for mass, r in zip(masses, points, strict=True):
        m -= mass
        c = [x - mass * y for x, y in zip(c, r, strict=True)]
        J = [
            [x - mass * a * b for x, b in zip(row, r, strict=True)]
            for row, a in zip(J, r, strict=True)
        ]
    more, rest = points_with(m, tuple(c), q.matrix(J))
    empty = [Fraction(0)] * len(places)
    return masses + empty + more, points + places + rest, [1] * count + blocks + [1] * len(rest)


def _placed(model: Model, listed: list[Mapping[str, Any]]) -> tuple[list[Vector], list[int]]:
    """Places of the problem, each in its block of a product."""
    places, blocks = [], []
    for data in listed:
        at = tuple(evaluate(decode(x, "at"), model.expressions) for x in data["at"])
        block = data.get("block", 1)
        blocks.append(block)
        at = model.group.in_block(block, at, 1)
        places.append(at)
    return places, blocks
