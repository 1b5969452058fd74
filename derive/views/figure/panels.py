"""Panels of a figure: the part of the body that one factor moves, drawn on a sheet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise
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
from .drawn_body import (
    FLAT,
    ORIGIN,
    UNITS,
    BodyPart,
    ExpressionValues,
    Segment,
    Vector,
    View,
    Wish,
    plus,
    scaled,
)
from .shapes import Curve, Shape

if TYPE_CHECKING:
    from .drawn_body import DrawnSolid
    from .meshes import Mesh


FAR, NEAR, PLACED = 1.9, 0.35, 1.5
"""Distances in sizes of the body: an anchor beyond FAR or within NEAR is drawn at PLACED."""


def _solid(s: DrawnSolid, sight: Vector) -> Shape | Mesh:
    """A solid seen along ``sight``; a mesh alone needs NumPy."""
    if s.kind != "mesh":
        return Shape(s, sight)
    from .meshes import Mesh

    return Mesh(s, sight)


def named_forces(problem: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The forces of the state that a problem of a record has under names, without moments alone."""
    return [x for x in problem.get("forces", ()) if "name" in x and x.get("force")]


class Panel:
    """A panel: the part of a body that one factor of the group moves, with its forces.

    First ``look`` at it, then set ``scale`` and ``offset``.
    """

    def __init__(self, part: BodyPart, problem: Mapping[str, Any], value: ExpressionValues) -> None:
        self.part, self.value = part, value
        self.scale, self.offset = 1.0, (0.0, 0.0)
        self.at: dict[int, Vector] = {i: r for i, (_, r) in part.points.items()} | part.places
        self.size = 1.0
        self.look(FLAT)
        self.size = self._size()
        self.tips = [scaled(self._axis_length(k), UNITS[k]) for k in range(min(part.size, 3))]
        potentials = problem["potentials"]
        self.springs = [p for p in potentials if p["kind"] == "spring"]
        self.attractions = [p for p in potentials if p["kind"] == "attraction"]
        given = [i for i in problem["inputs"] if i["kind"] == "force"]
        self.forces = [i for i in (*given, *named_forces(problem)) if i["on"] in self.at]
        self.inside = [p for p in self.springs if {*p.get("between", [0])} <= {*self.at}]
        self.anchored = [p for p in self.springs if p.get("on") in self.at]
        self.anchors, moved = [], []
        for p in self.anchored:
            place, was = self._drawable_anchor(self.at[p["on"]], value.vector(p["anchor"]))
            self.anchors.append(place)
            moved.append(was)
        self.moved = any(moved)

    def look(self, view: View) -> None:
        """Choose a view, and compute the curves of the solids in it."""
        self.view, sight = view, scaled(self.size, view.towards)
        self.bodies = [_solid(s, sight) for s in self.part.solids]
        self.curves: list[list[Curve]] = []
        if not view.flat:
            self.curves = [list(body.curves()) for body in self.bodies]

    def _size(self) -> float:
        """The size of the body: half the diagonal of the box around the origin and the matter."""
        corners = [ORIGIN, *self.at.values(), *(p for b in self.bodies for p in b.corners())]
        if self.part.moments:
            corners += [
                scaled(s * 1.2 * r, UNITS[0]) for r in [self._radius_of_gyration()] for s in (1, -1)
            ]
        spans = [max(p[i] for p in corners) - min(p[i] for p in corners) for i in range(3)]
        return math.hypot(*spans) / 2 or 1.0

    def _radius_of_gyration(self) -> float:
        """About the largest radius of gyration of a body known by its moments."""
        assert self.part.moments
        m, _, J = self.part.moments
        largest = max((abs(row[i]) for i, row in enumerate(J)), default=1.0)
        return math.sqrt(largest / m) if m > 0 else 1.0

    def _axis_length(self, k: int) -> float:
        """The length of axis k: it ends outside the body, and beyond the points that lie on it."""
        reach = [body.reach(UNITS[k]) for body in self.bodies]
        near = 0.2 * self.size
        reach += [r[k] for r in self.at.values() if math.dist(r, scaled(r[k], UNITS[k])) < near]
        if self.part.moments:
            reach.append(0.95 * self._radius_of_gyration())
        return max(0.5 * self.size, max(reach, default=0.0) + 0.36 * self.size)

    def _drawable_anchor(self, p: Vector, anchor: Vector) -> tuple[Vector, bool]:
        """The place at which an anchor is drawn, and whether that is another than its own."""
        away = plus(anchor, p, -1.0)
        far = math.hypot(*away)
        if NEAR * self.size <= far <= FAR * self.size:
            return anchor, False
        direction = scaled(1 / far, away) if far else UNITS[min(self.part.size, 3) - 1]
        return plus(p, direction, PLACED * self.size), True

    @property
    def ties(self) -> list[Segment]:
        """Pale lines between few points, and to a fixed origin, where no axis or spring is."""
        points = [r for _, r in self.part.points.values()]
        corners = points + ([ORIGIN] if self.part.fixed and len(points) <= 3 else [])
        if len(points) > 4 or self.bodies:
            return []
        taken = {frozenset(self.at[i] for i in p["between"]) for p in self.inside}
        taken |= {
            frozenset((self.at[p["on"]], a))
            for p, a in zip(self.anchored, self.anchors, strict=True)
        }
        return [
            (a, b)
            for a, b in combinations(corners, 2)
            if frozenset((a, b)) not in taken
            and not any(_on_axis(k, a) and _on_axis(k, b) for k in range(3))
        ]

    def springs_on(self, k: int) -> list[tuple[float, float]]:
        """The intervals of axis k along which a spring lies, from the origin outwards."""
        pairs = [(self.at[i], self.at[j]) for i, j in (p["between"] for p in self.inside)]
        along = [sorted((a[k], b[k])) for a, b in pairs if _on_axis(k, a) and _on_axis(k, b)]
        return sorted((a, b) for a, b in along)

    def marks(self) -> tuple[list[Vector], list[Segment]]:
        """The points and the lines that a view should hold apart."""
        lines = [(ORIGIN, tip) for tip in self.tips]
        lines += [(self.at[p["on"]], a) for p, a in zip(self.anchored, self.anchors, strict=True)]
        lines += [(self.at[i], self.at[j]) for i, j in (p["between"] for p in self.inside)]
        lines += self.ties
        points = [ORIGIN, *self.tips, *self.at.values(), *self.anchors]
        centre = self.part.centre
        if centre and all(math.dist(centre, p) > 0.1 * self.size for p in points):
            points.append(centre)
        return points, lines

    def centre_of(self, attraction: Mapping[str, Any]) -> tuple[Vector, bool]:
        """The place at which a centre of attraction is drawn, and whether it is another."""
        home = self.part.centre or ORIGIN
        centre = self.value.vector(attraction["centre"])
        away = plus(centre, home, -1.0)
        far = math.hypot(*away)
        if far > 2.4 * self.size:
            return plus(home, away, 2.2 * self.size / far), True
        if far >= 1.2 * self.size or self.part.fixed:
            return centre, False
        aside = plus(home, self.view.right, -1.75 * self.size)
        return plus(aside, self.view.up, 0.8 * self.size), True

    def extent(self) -> list[Point]:
        """All points that the panel must contain, on paper before it is scaled."""
        space = [ORIGIN, *self.tips, *self.at.values(), *self.anchors]
        space += [self.centre_of(p)[0] for p in self.attractions]
        space += [p for curves in self.curves for curve in curves for p in curve.points]
        return [self.view(p) for p in space] + list(self.outline())

    def to(self, p: Vector) -> Point:
        """The place of a point of the body on paper, in millimetres."""
        x, y = self.view(p)
        return self.offset[0] + self.scale * x, self.offset[1] + self.scale * y

    def to_paper(self, p: Point) -> Point:
        """A point of the view in millimetres on paper."""
        return self.offset[0] + self.scale * p[0], self.offset[1] + self.scale * p[1]

    def outline(self) -> Iterator[Point]:
        """A free form around the centre of mass, as wide as the radii of gyration on paper; nothing
        where the body is more than moments."""
        if self.part.moments is None:
            return
        m, c, J = self.part.moments
        n, m = len(J), m if m > 0 else 1.0
        axes = [self.view.right, self.view.up]
        spread = [[0.0, 0.0], [0.0, 0.0]]
        for i, j in ((a, b) for a in range(2) for b in range(2)):
            for k, h in ((k, h) for k in range(n) for h in range(n)):
                central = J[k][h] / m - c[k] * c[h] / m**2
                spread[i][j] += axes[i][k] * axes[j][h] * central
        (xx, xy), (_, yy) = spread
        root = math.sqrt(max(xx * yy - xy * xy, 0.0))
        both = math.sqrt(max(xx + yy + 2 * root, 0.0))
        if root <= 0 or both <= 0:
            xx = yy = self._radius_of_gyration()  # no matrix of masses: a round form
            xy, root, both = 0.0, 0.0, 1.0
        x, y = self.view(scaled(1 / m, c))
        for k in range(97):
            t = 2 * math.pi * k / 96
            bulge = 1.1 + 0.09 * math.cos(2 * t + 0.9) + 0.06 * math.cos(3 * t - 0.4)
            u, v = bulge * math.cos(t), bulge * math.sin(t)
            yield (
                x + ((xx + root) * u + xy * v) / both,
                y + (xy * u + (yy + root) * v) / both,
            )


def _on_axis(k: int, p: Vector) -> bool:
    """Is p on the half of axis k that is drawn?"""
    return p[k] >= 0 and not any((*p[:k], *p[k + 1 :]))


# Panels drawn on a sheet: their lines and dots, and the labels that are wished for.

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
    heaviest: float = 1.0
    """The mass of a point that has the largest dot."""

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


def heaviest(panels: Sequence[Panel]) -> float:
    """The largest mass of a point, of all panels."""
    return max((m for x in panels for m, _ in x.part.points.values()), default=1.0) or 1.0


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
    shown = [panel.to(ORIGIN), *on_paper.values()]
    middle = sum(x for x, _ in shown) / len(shown), sum(y for _, y in shown) / len(shown)
    if len(panel.part.points) > 2:
        area = hull([on_paper[i] for i in panel.part.points])
        sheet.strokes.append(Stroke(area, "body", "wash"))
    for a, b in panel.ties:
        ends = (_end_on_ring(panel, a, b), _end_on_ring(panel, b, a))
        sheet.strokes.append(Stroke(ends, "body", "thin"))
    for i, at in on_paper.items():
        mass = panel.part.points[i][0] if i in panel.part.points else 0.0
        radius = 1.4 * max(mass / sheet.heaviest, 0.12) ** (1 / 3) if mass > 0 else 0.55
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


def _end_on_ring(panel: Panel, p: Vector, other: Vector) -> Point:
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
