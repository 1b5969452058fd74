"""The direction from which a body is seen: one in which its points and axes lie well apart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from .drawing import Point, from_segment
from .drawn_body import UNITS, Vector, dot, plus, scaled

Segment = tuple[Vector, Vector]
AZIMUTH, ELEVATION = 30, 21
"""The preferred direction in degrees, from the axis that comes forward."""
ENOUGH = 0.2
"""The clearance, in sizes of the body, above which all views are as good."""
MOST = 14


@dataclass(frozen=True)
class View:
    """A direction of view, by three unit vectors: right and up on the paper, and towards the
    reader; ``flat``: the plane seen as it is."""

    right: Vector
    up: Vector
    towards: Vector
    flat: bool = False

    def __call__(self, p: Vector) -> Point:
        """The place of a point on the paper, before it is scaled."""
        return dot(self.right, p), dot(self.up, p)


FLAT = View(*UNITS, flat=True)


def upright(gravity: Vector) -> tuple[Vector, Vector, Vector]:
    """The axes forward, right and up: the one nearest to gravity goes up, else the third."""
    k = max(range(3), key=lambda i: (abs(gravity[i]), i))
    first, second = UNITS[(k + 1) % 3], UNITS[(k + 2) % 3]
    if gravity[k] > 0:
        return second, first, scaled(-1.0, UNITS[k])
    return first, second, UNITS[k]


def ranked(
    bodies: Sequence[tuple[Sequence[Vector], Sequence[Segment]]],
    size: float,
    gravity: Vector,
) -> list[View]:
    """Views, best first: the farther apart the nearest marks and lines of a body are."""
    axes = upright(gravity)
    thinned = [([*dict.fromkeys(marks)][:MOST], lines[:MOST]) for marks, lines in bodies]

    def score(angles: tuple[int, int]) -> float:
        view = _view(axes, *angles)
        nearest = (min(_distances(view, *body), default=math.inf) for body in thinned)
        clear = min(nearest, default=1.0) / size
        azimuth, elevation = angles
        preference = 0.001 * abs(azimuth - AZIMUTH) + 0.003 * abs(elevation - ELEVATION)
        return min(clear, ENOUGH) - preference

    every = [(a, e) for a in range(14, 77, 4) for e in range(12, 41, 4)]
    return [_view(axes, *angles) for angles in sorted(every, key=score, reverse=True)]


def _view(axes: tuple[Vector, Vector, Vector], azimuth: float, elevation: float) -> View:
    ahead, aside, above = axes
    a, e = math.radians(azimuth), math.radians(elevation)
    level = plus(scaled(math.cos(a), ahead), aside, math.sin(a))
    right = plus(scaled(-math.sin(a), ahead), aside, math.cos(a))
    up = plus(scaled(-math.sin(e), level), above, math.cos(e))
    return View(right, up, plus(scaled(math.cos(e), level), above, math.sin(e)))


def _distances(view: View, marks: Sequence[Vector], lines: Sequence[Segment]) -> Iterator[float]:
    joined = {frozenset(line) for line in lines}
    for a, b in combinations(marks, 2):
        yield math.dist(view(a), view(b)) * (0.6 if frozenset((a, b)) in joined else 1.0)
    for p in marks:
        for a, b in lines:
            if p not in (a, b) and not _between(p, a, b):
                yield 2.2 * from_segment(view(p), view(a), view(b))


def _between(p: Vector, a: Vector, b: Vector) -> bool:
    """Is p on the segment from a to b itself, in space?"""
    return math.dist(a, p) + math.dist(p, b) < (1 + 1e-9) * math.dist(a, b)
