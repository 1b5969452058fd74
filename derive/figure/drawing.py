"""The elements of a figure: lines, dots and labels in the plane, whatever prints them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ..printing.letters import parameter
from ..printing.line_breaking import display_width
from ..printing.signs import SYMBOLS
from ..record.sentence import Prose

Point = tuple[float, float]
Box = tuple[float, float, float, float]
"""A rectangle by its left, bottom, right and top, in millimetres."""

SIZE, SMALL = 3.7, 2.6
"""Heights of type in millimetres: letters and their indices."""
INDEXED = re.compile(r"([A-Za-z][A-Za-z0-9]*)_([A-Za-z0-9]{1,3})|([A-Za-z]+)([0-9]{1,3})")
"""A name that ends in an index, as in :func:`parameter`."""
LONGEST = 24
"""The most letters of a name; longer ones are cut."""
HEAD, HALF_HEAD = 2.3, 0.75
"""The length and half the width of the head of an arrow, in millimetres."""


@dataclass(frozen=True)
class Stroke:
    """A line through points, or the outline of an area; ``role``: what it draws, ``pen``: how."""

    points: tuple[Point, ...]
    role: str
    pen: str = "line"


@dataclass(frozen=True)
class Dot:
    """A disc, or a ``ring`` with an empty middle; ``role``: what it draws."""

    at: Point
    radius: float
    role: str
    ring: bool = False


@dataclass(frozen=True)
class Label:
    """A letter with an index; or, where ``name``, an upright name that a user gave."""

    base: str
    index: str = ""
    name: bool = False
    at: Point = (0.0, 0.0)

    @property
    def latex(self) -> str:
        """The label in LaTeX, without dollars."""
        if self.name:
            return parameter(shortened(self.base)).tex.replace(r"\text{", r"\mbox{")  # no amsmath
        base = SYMBOLS.get(self.base, self.base)
        return f"{base}_{{{self.index}}}" if self.index else base

    @property
    def parts(self) -> tuple[str, str]:
        """The text on the line, and the index below it."""
        if not self.name:
            return self.base, self.index
        name = shortened(self.base)
        match = INDEXED.fullmatch(name)
        base, index = (x for x in match.groups() if x) if match else (name, "")
        return base, index

    @property
    def box(self) -> Box:
        """The rectangle that the label covers, about."""
        w, h = self.half
        return self.at[0] - w, self.at[1] - h, self.at[0] + w, self.at[1] + h

    @property
    def half(self) -> Point:
        """Half the width and half the height of the label in millimetres, about."""
        base, index = self.parts
        width = 0.56 * (SIZE * display_width(base) + SMALL * display_width(index))
        return width / 2, (SIZE * 0.42 if self.name else SIZE * (0.46 if index else 0.38))


@dataclass(frozen=True)
class Scene:
    """A figure in millimetres, from its lower left corner; ``caption``: sentences below it."""

    width: float
    height: float
    strokes: tuple[Stroke, ...]
    dots: tuple[Dot, ...]
    labels: tuple[Label, ...]
    title: str
    caption: Prose


def shortened(name: str) -> str:
    """A name cut to LONGEST letters, the last of them then an ellipsis."""
    return name if len(name) <= LONGEST else name[: LONGEST - 1] + "…"


def arrow(a: Point, b: Point, role: str) -> list[Stroke]:
    """The strokes of an arrow from a to b."""
    length = max(math.dist(a, b), 1e-9)
    x, y = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    neck = (b[0] - HEAD * x, b[1] - HEAD * y)
    wings = [(neck[0] - s * HALF_HEAD * y, neck[1] + s * HALF_HEAD * x) for s in (1, -1)]
    notch = (b[0] - 0.75 * HEAD * x, b[1] - 0.75 * HEAD * y)
    return [Stroke((a, notch), role), Stroke((b, wings[0], notch, wings[1]), role, "solid")]


def zigzag(a: Point, b: Point) -> Iterator[Point]:
    """The points of a spring's zigzag from a to b."""
    length = max(math.dist(a, b), 1e-9)
    x, y = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    coil = min(0.72 * length, 26.0)
    teeth = max(3, round(coil / 2.3))
    yield a
    for k in range(2 * teeth + 1):
        along = (length - coil) / 2 + coil * k / (2 * teeth)
        aside = 0.0 if k in (0, 2 * teeth) else (0.9 if k % 2 else -0.9)
        yield a[0] + along * x - aside * y, a[1] + along * y + aside * x
    yield b


def support(at: Point, towards: Point) -> list[Stroke]:
    """The strokes of a hatched support at ``at``; what hangs from it lies ``towards``."""
    dx, dy = towards[0] - at[0], towards[1] - at[1]
    level = abs(dy) >= abs(dx)
    back = -math.copysign(1.6, dy if level else dx)

    def line(u0: float, v0: float, u1: float, v1: float, pen: str) -> Stroke:
        ends = ((u0, v0), (u1, v1)) if level else ((v0, u0), (v1, u1))
        return Stroke(tuple((at[0] + x, at[1] + y) for x, y in ends), "support", pen)

    hatches = (line(u, 0.0, u + 1.3, back, "thin") for u in (1.5 * k - 4.2 for k in range(6)))
    return [line(-4.5, 0.0, 4.5, 0.0, "line"), *hatches]


def quadrants(at: Point, radius: float) -> list[Stroke]:
    """The two full quarters of the mark of a centre of mass."""
    return [
        Stroke((at, *_arc(at, radius, start, start + math.pi / 2)), "body", "solid")
        for start in (0.0, math.pi)
    ]


def _arc(at: Point, radius: float, start: float, end: float) -> Iterator[Point]:
    for k in range(9):
        angle = start + (end - start) * k / 8
        yield at[0] + radius * math.cos(angle), at[1] + radius * math.sin(angle)


def hull(points: Sequence[Point]) -> tuple[Point, ...]:
    """The vertices of the convex hull of points, counterclockwise."""
    ordered = sorted({(round(x, 9), round(y, 9)) for x, y in points})
    if len(ordered) < 3:
        return tuple(ordered)
    sides: list[list[Point]] = []
    for run in (ordered, ordered[::-1]):
        side: list[Point] = []
        for p in run:
            while len(side) > 1 and turn(side[-2], side[-1], p) <= 0:
                side.pop()
            side.append(p)
        sides.append(side[:-1])
    return tuple(sides[0] + sides[1])


def turn(a: Point, b: Point, c: Point) -> float:
    """Twice the signed area of the triangle a b c, positive where it turns left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def from_segment(p: Point, a: Point, b: Point) -> float:
    """The distance of the point p from the segment a b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square if square else 0.0
    t = min(1.0, max(0.0, t))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)
