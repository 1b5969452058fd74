"""Panels drawn on a sheet: their lines and dots, and the labels that are wished for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from .drawing import (
    Dot,
    Label,
    Point,
    Stroke,
    arrow,
    from_segment,
    hull,
    quadrants,
    support,
    zigzag,
)
from .drawn_body import ORIGIN, Vector, scaled
from .panels import Panel
from .placing import Wish
from .shapes import Shape

if TYPE_CHECKING:
    from .meshes import Mesh

APART = 2.7
"""Marks on paper nearer than this, in millimetres, are drawn as one."""
NAMED = 12
"""The most points of which all are named; of more the first two and the last."""
HIDDEN_OF = 4
"""The most solids whose hidden lines are drawn."""
RING = 1.15


@dataclass
class Sheet:
    """The whole figure while it is drawn: lines, dots and wishes for labels, in millimetres."""

    strokes: list[Stroke] = field(default_factory=list)
    dots: list[Dot] = field(default_factory=list)
    wishes: list[Wish] = field(default_factory=list)

    def spring(self, a: Point, b: Point, stiffness: Any, named: bool) -> None:
        """Draw a spring, and name its stiffness where that is a parameter."""
        if math.dist(a, b) < 4:
            return
        self.strokes.append(Stroke(tuple(zigzag(a, b)), "spring"))
        if named and isinstance(stiffness, (list, tuple)) and stiffness[0] == "par":
            middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
            self.wishes.append(Wish(Label(stiffness[1], name=True), middle, 1.9, optional=True))


def draw(panel: Panel, sheet: Sheet, named: bool) -> None:
    """Draw a panel but for what ties it to others; ``named``: do springs bear their names?"""
    _solids(panel, sheet)
    _matter(panel, sheet)
    _axes(panel, sheet)
    for p in panel.inside:
        a, b = (panel.at[i] for i in p["between"])
        sheet.spring(panel.to(a), panel.to(b), p["stiffness"], named)
    for p, anchor in zip(panel.anchored, panel.anchors, strict=True):
        start, end = panel.to(panel.at[p["on"]]), panel.to(anchor)
        sheet.spring(start, end, p["stiffness"], named)
        sheet.strokes += support(end, start)
    for p in panel.attractions:
        _attraction(panel, sheet, p)
    for i in panel.forces:
        _force(panel, sheet, i)


def _solids(panel: Panel, sheet: Sheet) -> None:
    for body, curves in zip(panel.bodies, panel.curves, strict=True):
        if isinstance(body, Shape):
            area = hull([panel.to(p) for curve in curves for p in curve.points])
            sheet.strokes.append(Stroke(area, "body", "wash"))
        for curve in curves:
            for hidden, run in _runs(curve.points, [] if curve.always else panel.bodies):
                line = tuple(map(panel.to, run))
                if hidden or curve.always:
                    if len(panel.bodies) <= HIDDEN_OF:
                        sheet.strokes.append(Stroke(line, "body", "hidden"))
                else:
                    sheet.strokes.append(Stroke(line, "body", "line" if curve.edge else "thin"))


def _matter(panel: Panel, sheet: Sheet) -> None:
    """Draw the points, the outline of a body of moments, and the centre of mass."""
    outline = tuple(map(panel.to_paper, panel.outline()))
    if outline:
        sheet.strokes += [Stroke(outline, "body", pen) for pen in ("wash", "line")]
    on_paper = {i: panel.to(r) for i, r in panel.at.items()}
    middle = _mean([panel.to(ORIGIN), *on_paper.values()])
    if len(panel.part.points) > 2:
        area = hull([on_paper[i] for i in panel.part.points])
        sheet.strokes.append(Stroke(area, "body", "wash"))
    for a, b in panel.ties:
        ends = (_beside(panel, a, b), _beside(panel, b, a))
        sheet.strokes.append(Stroke(ends, "body", "thin"))
    heaviest = max((m for m, _ in panel.part.points.values()), default=1.0) or 1.0
    for i, at in on_paper.items():
        mass = panel.part.points[i][0] if i in panel.part.points else 0.0
        radius = 1.4 * max(mass / heaviest, 0.12) ** (1 / 3) if mass > 0 else 0.55
        sheet.dots.append(Dot(at, radius, "body"))
        if len(on_paper) <= NAMED or i in (1, 2, len(on_paper)):
            away = at[0] - middle[0], at[1] - middle[1]
            sheet.wishes.append(Wish(Label("r", str(i)), at, radius + 0.5, away))
    if shows_centre(panel):
        assert panel.part.centre
        at = panel.to(panel.part.centre)
        sheet.dots.append(Dot(at, 1.2, "body", ring=True))
        sheet.strokes += quadrants(at, 1.2)
        sheet.wishes.append(Wish(Label("r", "c"), at, 1.7))


def _beside(panel: Panel, p: Vector, other: Vector) -> Point:
    """The end p of a line towards another point, on the ring of the origin if p is that."""
    a, b = panel.to(p), panel.to(other)
    long = math.dist(a, b)
    if p != ORIGIN or not panel.part.fixed or long < RING:
        return a
    return a[0] + (b[0] - a[0]) * RING / long, a[1] + (b[1] - a[1]) * RING / long


def shows_centre(panel: Panel) -> bool:
    """Is the centre of mass apart from the origin and the points, on paper?"""
    centre = panel.part.centre
    if centre is None:
        return False
    others = (ORIGIN, *panel.at.values())
    return all(math.dist(panel.to(centre), panel.to(p)) >= APART for p in others)


def _axes(panel: Panel, sheet: Sheet) -> None:
    origin = panel.to(ORIGIN)
    ring = _ring(panel, sheet) if panel.part.fixed else 0.0
    for k, tip in enumerate(panel.tips):
        end = panel.to(tip)
        long = max(math.dist(origin, end), 1e-9)
        start = min(ring / long, 1.0)
        for a, b in panel.springs_on(k):  # there the spring is the line
            start = max(start, b / tip[k] if a / tip[k] <= start + 1e-9 else start)
        points = [scaled(start + (1 - start) * j / 60, tip) for j in range(61)]
        *before, (_, last) = _runs(points, panel.bodies)
        for hidden, run in before:
            pen = "hidden" if hidden else "line"
            sheet.strokes.append(Stroke((panel.to(run[0]), panel.to(run[-1])), "axis", pen))
        sheet.strokes += arrow(panel.to(last[0]), end, "axis")
        away = end[0] - origin[0], end[1] - origin[1]
        sheet.wishes.append(Wish(Label("e", str(k + 1)), end, 0.8, away))


def _ring(panel: Panel, sheet: Sheet) -> float:
    """Draw the mark of a fixed origin, around a dot that is there; its radius."""
    origin = panel.to(ORIGIN)
    inside = [d.radius + 0.6 for d in sheet.dots if math.dist(d.at, origin) < 0.3]
    sheet.dots.append(Dot(origin, max([RING, *inside]), "axis", ring=True))
    return sheet.dots[-1].radius


def _attraction(panel: Panel, sheet: Sheet, p: Mapping[str, Any]) -> None:
    at = panel.to(panel.centre_of(p)[0])
    attracted = [i for i, _ in p["on"] if i in panel.at] if "on" in p else list(panel.part.points)
    for i in attracted:
        line = (panel.to(panel.at[i]), at)
        sheet.strokes.append(Stroke(line, "attraction", "dashed"))
    sheet.dots += [Dot(at, 0.7, "attraction"), Dot(at, 1.7, "attraction", ring=True)]


def _force(panel: Panel, sheet: Sheet, force: Mapping[str, Any]) -> None:
    """Draw a force input as an arrow outwards, turned to where there is room."""
    at = panel.to(panel.at[force["on"]])
    home = panel.to(panel.part.centre or ORIGIN)
    out = math.atan2(at[1] - home[1], at[0] - home[0]) if math.dist(at, home) > 0.5 else 0.6
    others = [s for s in sheet.strokes if s.pen in ("line", "dashed")]

    def end(angle: float) -> Point:
        return at[0] + 11 * math.cos(angle), at[1] + 11 * math.sin(angle)

    def score(turned: float) -> float:
        tip = end(out + turned)
        rooms = (from_segment(tip, a, b) for s in others for a, b in pairwise(s.points))
        return min(min(rooms, default=9.0), 6.0) - 1.5 * abs(turned)

    tip = end(out + max((math.pi * k / 12 for k in range(-8, 9)), key=score))
    sheet.strokes += arrow(at, tip, "force")
    away = tip[0] - at[0], tip[1] - at[1]
    sheet.wishes.append(Wish(Label(force["name"], name=True), tip, 0.8, away))


def _runs(
    points: Sequence[Vector], bodies: Sequence[Shape | Mesh]
) -> Iterator[tuple[bool, Sequence[Vector]]]:
    """A curve cut where it goes out of sight or comes back: (hidden, points) for each piece."""
    hidden = [body.hides(points) for body in bodies]
    flags = [any(row[k] for row in hidden) for k in range(len(points))]
    start = 0
    for k in range(1, len(points) + 1):
        if k == len(points) or flags[k] != flags[k - 1]:
            if len(run := points[start : k + 1]) > 1:
                yield flags[k - 1], run
            start = k


def _mean(points: Sequence[Point]) -> Point:
    return sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points)
