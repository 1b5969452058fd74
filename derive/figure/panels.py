"""One panel of a figure: the part of the body that one factor of the group moves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import TYPE_CHECKING, Any

from .camera import FLAT, Segment, View
from .drawing import Point
from .drawn_body import ORIGIN, UNITS, BodyPart, Numbers, Vector, plus, scaled
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


class Panel:
    """A panel: the part of a body that one factor of the group moves, with its forces.

    First ``look`` at it, then set ``scale`` and ``offset``.
    """

    def __init__(self, part: BodyPart, problem: Mapping[str, Any], value: Numbers) -> None:
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
        self.forces = [i for i in problem["inputs"] if i["kind"] == "force" and i["on"] in self.at]
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
            if frozenset((a, b)) not in taken and not _on_one_axis(a, b)
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


def _on_one_axis(a: Vector, b: Vector) -> bool:
    return any(_on_axis(k, a) and _on_axis(k, b) for k in range(3))


def _on_axis(k: int, p: Vector) -> bool:
    """Is p on the half of axis k that is drawn?"""
    return p[k] >= 0 and not any((*p[:k], *p[k + 1 :]))
