"""What the figures of the lecture are made of: panels beside one another, coordinates in a frame,
a sphere seen from outside; and equations of the text as functions of numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from ..language.tree import Tree
from ..language.values import arithmetic
from ..record.record import Equation
from ..views.figure import drawn_body
from ..views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow
from ..views.figure.drawn_body import UNITS, dot, scaled
from .lecture_text import tree

AXES = ("first", "second", "third")
"""The role of what belongs to each axis of the body, in all figures."""
Vector = tuple[float, ...]
Claims = Mapping[str, Sequence[Equation]]
"""Label of a step → the equations of the display that rests on it."""
TICK, BESIDE = 1.0, 3.4
"""Half a mark of an axis; how far from the axis its numbers are, in millimetres."""
TURN = tuple(2 * math.pi * k / 180 for k in range(181))


def panel(
    size: Point, strokes: Iterable[Stroke], labels: Iterable[Label] = (), dots: Iterable[Dot] = ()
) -> Scene:
    """A figure without words."""
    return Scene(*size, tuple(strokes), tuple(dots), tuple(labels), "", ())


def beside(*panels: Scene, gap: float) -> Scene:
    """Panels from left to right, their middles at one height."""
    height, left = max(x.height for x in panels), 0.0
    strokes: list[Stroke] = []
    dots: list[Dot] = []
    labels: list[Label] = []
    for x in panels:
        by = (left, (height - x.height) / 2)
        strokes += (replace(s, points=tuple(_moved(p, by) for p in s.points)) for s in x.strokes)
        dots += (replace(d, at=_moved(d.at, by)) for d in x.dots)
        labels += (replace(y, at=_moved(y.at, by)) for y in x.labels)
        left += x.width + gap
    return panel((left - gap, height), strokes, labels, dots)


def _moved(p: Point, by: Point) -> Point:
    return p[0] + by[0], p[1] + by[1]


def circle(centre: Point, radius: float) -> Stroke:
    """A thin circle."""
    points = ((radius * math.cos(k), radius * math.sin(k)) for k in TURN)
    return Stroke(tuple(_moved(p, centre) for p in points), "support", "thin")


def numbered(values: Iterable[float]) -> dict[float, str]:
    """Numbers with their texts."""
    return {x: f"{x:g}".replace("-", "−") for x in values}


@dataclass(frozen=True)
class Frame:
    """Coordinates from ``low`` to ``high`` in a rectangle of the sheet, in millimetres."""

    corner: Point
    size: Point
    low: Point = (0.0, 0.0)
    high: Point = (1.0, 1.0)

    def at(self, x: float, y: float) -> Point:
        """Where a point of the coordinates is on the sheet."""
        across = self.size[0] * (x - self.low[0]) / (self.high[0] - self.low[0])
        up = self.size[1] * (y - self.low[1]) / (self.high[1] - self.low[1])
        return self.corner[0] + across, self.corner[1] + up

    def curve(self, points: Iterable[Sequence[float]], role: str, pen: str = "line") -> Stroke:
        """A curve by its points."""
        return Stroke(tuple(self.at(*p) for p in points), role, pen)

    def axes(
        self,
        names: tuple[Label, Label],
        across: Mapping[float, str],
        up: Mapping[float, str],
        level: float | None = None,
    ) -> tuple[list[Stroke], list[Label]]:
        """Both axes, from the lower left corner, with their names at the tips and their marks, and
        a thin line at a ``level``."""
        origin = self.corner
        right, top = origin[0] + self.size[0] + 4, origin[1] + self.size[1] + 3
        strokes = arrow(origin, (right, origin[1]), "axis")
        strokes += arrow(origin, (origin[0], top), "axis")
        labels = [
            replace(names[0], at=(right + 1 + names[0].half[0], origin[1])),
            replace(names[1], at=(origin[0], top + 2.6)),
        ]
        for x, name in across.items():
            place = (self.at(x, 0)[0], origin[1])
            strokes.append(_mark(place, (0, TICK)))
            labels.append(Label(name, at=(place[0], place[1] - BESIDE)))
        for y, name in up.items():
            place = (origin[0], self.at(0, y)[1])
            strokes.append(_mark(place, (TICK, 0)))
            label = Label(name)
            labels.append(replace(label, at=(place[0] - label.half[0] - 1.8, place[1])))
        if level is not None:
            ends = [(self.low[0], level), (self.high[0], level)]
            strokes.append(self.curve(ends, "axis", "thin"))
        return strokes, labels


def _mark(at: Point, half: Point) -> Stroke:
    ends = ((at[0] - half[0], at[1] - half[1]), (at[0] + half[0], at[1] + half[1]))
    return Stroke(ends, "axis", "thin")


@dataclass(frozen=True)
class View:
    """Space seen from far, from a direction in degrees: around the vertical, and above the
    horizon; ``centre``: where the origin is, ``scale``: what 1 is, in millimetres."""

    centre: Point
    scale: float
    azimuth: float
    elevation: float

    @cached_property
    def seen(self) -> drawn_body.View:
        """The same, before it is placed on the sheet."""
        return drawn_body.seen_from(self.azimuth, self.elevation)

    def depth(self, v: Sequence[float]) -> float:
        """How near to the eye a point is."""
        return dot(self.seen.towards, v)

    def at(self, v: Sequence[float]) -> Point:
        """Where a point is on the sheet."""
        along, up = dot(self.seen.right, v), dot(self.seen.up, v)
        return self.centre[0] + self.scale * along, self.centre[1] + self.scale * up

    def outline(self) -> Stroke:
        """The sphere of radius 1."""
        return circle(self.centre, self.scale)

    def named_axes(self) -> tuple[list[Stroke], list[Label]]:
        """The axes of the body outside the sphere, with their names."""
        strokes, labels = list[Stroke](), list[Label]()
        for k, role in enumerate(AXES):
            at, tip, far = (self.at(scaled(s, UNITS[k])) for s in (1.0, 1.4, 1.57))
            strokes += arrow(at, tip, role)
            labels.append(Label("e", str(k + 1), at=far))
        return strokes, labels

    def on_sphere(self, curve: Sequence[Vector], role: str, pen: str = "line") -> list[Stroke]:
        """A curve on the sphere; behind it, it is pale."""
        return self.on_surface(curve, lambda u: u, lambda u: self.depth(u) > 0, role, pen)

    def on_surface(
        self,
        curve: Sequence[Vector],
        image: Callable[[Vector], Vector],
        front: Callable[[Vector], bool],
        role: str,
        pen: str = "line",
    ) -> list[Stroke]:
        """The ``image`` of a curve on the sphere of radius 1, pale where it is not in ``front``."""
        return [
            Stroke(tuple(self.at(image(u)) for u in run), role, pen if ahead else "hidden")
            for run, ahead in _runs(curve, front)
        ]


def _runs(
    curve: Sequence[Vector], front: Callable[[Vector], bool]
) -> Iterable[tuple[list[Vector], bool]]:
    """A curve cut where it passes behind; each run goes to where the next begins."""
    run = [curve[0]]
    for x, y in pairwise(curve):
        run.append(y)
        if front(x) != front(y):
            yield run, front(x)
            run = [y]
    yield run, front(curve[-1])


def value(t: Tree, of: Mapping[Tree, float]) -> float:
    """The value of an expression of numbers, by those ``of`` its letters."""
    if t in of:
        return of[t]
    return float(arithmetic(t, lambda x: value(x, of)) if isinstance(t, tuple) else Fraction(t))


def solved(
    rate: Callable[[Vector], Vector], start: Vector, end: float, steps: int, each: int = 1
) -> list[tuple[float, Vector]]:
    """A motion ẋ = rate(x) at every ``each``th of equal steps of time, by the method of Runge and
    Kutta of order 4."""
    h, x = end / steps, start
    found = [(0.0, x)]

    def moved(k: Vector, by: float) -> Vector:
        return tuple(a + by * b for a, b in zip(x, k, strict=True))

    for step in range(1, steps + 1):
        k1 = rate(x)
        k2 = rate(moved(k1, h / 2))
        k3 = rate(moved(k2, h / 2))
        k4 = rate(moved(k3, h))
        mean = tuple((a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(k1, k2, k3, k4, strict=True))
        x = moved(mean, h)
        if step % each == 0:
            found.append((step * h, x))
    return found


def euler(claims: Claims, moments: Sequence[float]) -> Callable[[Vector], Vector]:
    """The rates of the angular velocity in principal axes, by Euler's equations of the text."""
    known = {tree(f"λ{k}"): x for k, x in zip("₁₂₃", moments, strict=True)}
    rates = [e.rhs for e in claims["free.principal"]]
    letters = [tree(f"ζ{k}") for k in "₁₂₃"]

    def rate(zeta: Vector) -> Vector:
        values = known | dict(zip(letters, zeta, strict=True))
        return tuple(float(value(x, values)) for x in rates)

    return rate
