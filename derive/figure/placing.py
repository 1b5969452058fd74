"""The placement of labels: beside what they name, free of each other and of the lines."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from .drawing import Box, Dot, Label, Point, Stroke

STEP = 0.6
"""The distance, in millimetres, of the points by which lines are seen."""
WEIGHTS = {"line": 2.2, "dashed": 1.6, "thin": 1.2, "hidden": 0.8, "solid": 3.0, "wash": 0.0}
CROWD = 1000
"""The most points of lines near a label that are looked at; of more, each counts for several."""
OPTIONAL = 14.0
"""The largest cost at which an optional label is placed."""


@dataclass(frozen=True)
class Wish:
    """A label to be placed, the place that it names, how far from that to stay, and in which
    direction to look first.

    ``optional``: may it be left out where it would be in the way?
    """

    label: Label
    at: Point
    gap: float
    towards: Point = (0.0, 0.0)
    optional: bool = False


def placed(
    wishes: Sequence[Wish], strokes: Sequence[Stroke], dots: Sequence[Dot]
) -> tuple[Label, ...]:
    """The labels in order, each at the place of least cost among lines, dots and labels."""
    ink = [(p, WEIGHTS[s.pen]) for s in strokes if WEIGHTS[s.pen] for p in _along(s.points)]
    found: list[Label] = []
    for wish in wishes:
        near = [(p, w) for p, w in ink if math.dist(p, wish.at) < 22]
        step = 1 + len(near) // CROWD
        near = [(p, w * step) for p, w in near[::step]]
        boxes = [label.box for label in found]
        cost, choice = math.inf, wish.label
        for label in _choices(wish):
            least = _distance_cost(label, wish)
            if least < cost:
                least += _overlap_cost(label, dots, boxes)
            if least < cost and (whole := least + _line_cost(label, near)) < cost:
                cost, choice = whole, label
        if not (wish.optional and cost > OPTIONAL):
            found.append(choice)
    return tuple(found)


def _choices(wish: Wish) -> Iterator[Label]:
    """A label at its possible places: sixteen directions, nearest first, so far out at last that
    some place is free."""
    w, h = wish.label.half
    for more in (0.0, 0.9, 2.0, 3.5, 6.0, 9.0, 13.0, 18.0, 26.0, 36.0):
        for k in range(16):
            x, y = math.cos(math.pi * k / 8), math.sin(math.pi * k / 8)
            far = wish.gap + more
            yield replace(
                wish.label, at=(wish.at[0] + x * (far + w), wish.at[1] + y * (far + h * 0.9))
            )
        if more >= 3.5 and wish.optional:
            return


def _distance_cost(label: Label, wish: Wish) -> float:
    """The cost of a label's distance from what it names, and of an unwished direction."""
    dx, dy = label.at[0] - wish.at[0], label.at[1] - wish.at[1]
    w, h = label.half
    cost = 1.8 * math.hypot(max(0.0, abs(dx) - w), max(0.0, abs(dy) - h))
    length = math.hypot(*wish.towards) * math.hypot(dx, dy)
    if length:
        cost += 2.5 * (1 - (dx * wish.towards[0] + dy * wish.towards[1]) / length)
    return cost


def _overlap_cost(label: Label, dots: Sequence[Dot], boxes: Sequence[Box]) -> float:
    """The cost of the dots and labels that a label would cover."""
    box = label.box
    cost = sum(60.0 for d in dots if _contains(box, d.at, d.radius + 0.3))
    return cost + sum(1000.0 for other in boxes if overlap(box, other, 0.4))


def _line_cost(label: Label, ink: Sequence[tuple[Point, float]]) -> float:
    """The cost of the lines that a label would cover."""
    left, bottom, right, top = label.box
    left, bottom, right, top = left - 0.35, bottom - 0.35, right + 0.35, top + 0.35
    return sum(weight for (x, y), weight in ink if left < x < right and bottom < y < top)


def _contains(box: Box, p: Point, margin: float) -> bool:
    left, bottom, right, top = box
    return left - margin < p[0] < right + margin and bottom - margin < p[1] < top + margin


def overlap(a: Box, b: Box, margin: float = 0.0) -> bool:
    """Do two boxes come nearer to each other than ``margin``?"""
    return (
        a[0] < b[2] + margin
        and b[0] < a[2] + margin
        and a[1] < b[3] + margin
        and b[1] < a[3] + margin
    )


def _along(points: Sequence[Point]) -> Iterator[Point]:
    for a, b in pairwise(points):
        n = max(1, math.ceil(math.dist(a, b) / STEP))
        yield from ((a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n) for k in range(n))
    yield from points[-1:]
