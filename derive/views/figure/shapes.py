"""Solids and meshes for a drawing: the curves to draw, and what they hide."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Any

from .drawn_body import ORIGIN, UNITS, DrawnSolid, Vector, cross, dot, image, plus, scaled

Wall = Callable[[Vector], float]
NEAR = 2e-3
"""Crossings nearer than this, in sizes of the figure, count as those of the curve's own surface."""
ROUND = 64


@dataclass(frozen=True)
class Curve:
    """A curve on a solid, by its points; ``edge``: is it a contour or an edge, or else a line that
    shows roundness?

    ``always``: is it hidden always, being inside the solid?
    """

    points: tuple[Vector, ...]
    edge: bool = True
    always: bool = False


BALL: tuple[Wall, ...] = (lambda u: dot(u, u) - 1,)
CUBE: tuple[Wall, ...] = tuple(
    lambda u, i=i, s=s: s * u[i] - 1  # type: ignore[misc]
    for i in range(3)
    for s in (1, -1)
)
CYLINDER: tuple[Wall, ...] = (lambda u: u[0] ** 2 + u[1] ** 2 - 1, *CUBE[4:])
CONE: tuple[Wall, ...] = (
    lambda u: u[0] ** 2 + u[1] ** 2 - (1 - u[2]) ** 2,
    lambda u: u[2] - 1,
    lambda u: -u[2],
)
SIMPLEX: tuple[Wall, ...] = (
    lambda u: -u[0],
    lambda u: -u[1],
    lambda u: -u[2],
    lambda u: sum(u) - 1,
)
WALLS = {
    "ball": BALL, "ellipsoid": BALL, "hollow_ball": BALL, "box": CUBE, "cylinder": CYLINDER,
    "cone": CONE, "tetrahedron": SIMPLEX,
}  # fmt: skip


class Shape:
    """A solid that is no mesh, seen along ``sight``, a vector as long as the figure is large."""

    def __init__(self, solid: DrawnSolid, sight: Vector) -> None:
        self.kind, self.sizes, self.walls = solid.kind, solid.sizes, WALLS[solid.kind]
        self.columns, self.shift = _affine_map(solid)
        x, y, z = self.columns
        self.cofactors = cross(y, z), cross(z, x), cross(x, y)
        self.volume = dot(x, self.cofactors[0])
        self.sight = self.to_reference(sight)

    def to_body(self, u: Vector) -> Vector:
        """A u + s, the point of the solid with the reference coordinates u."""
        x, y, z = self.columns
        return plus(plus(plus(self.shift, x, u[0]), y, u[1]), z, u[2])

    def to_reference(self, v: Vector) -> Vector:
        """A⁻¹ v, by Cramer's rule; 0 for a solid without volume, which hides nothing."""
        if abs(self.volume) < 1e-300:
            return 0.0, 0.0, 0.0
        x, y, z = (dot(v, c) / self.volume for c in self.cofactors)
        return x, y, z

    def hides(self, points: Sequence[Vector]) -> list[bool]:
        """For each point, whether it is behind the solid, or in it."""
        return [self._behind(self.to_reference(plus(p, self.shift, -1.0))) for p in points]

    def reach(self, direction: Vector) -> float:
        """How far the solid reaches from the origin along a direction, in lengths of that."""
        u, w = self.to_reference(scaled(-1.0, self.shift)), self.to_reference(direction)
        return max((b for _, b in self._chords(u, w, 0.0)), default=0.0)

    def corners(self) -> Iterator[Vector]:
        """Points of the solid that tell about how large it is."""
        return (self.to_body(scaled(s, e)) for e in UNITS for s in (1.0, -1.0))

    def _behind(self, u: Vector) -> bool:
        return any(b - a > NEAR for a, b in self._chords(u, self.sight, NEAR))

    def _chords(self, u: Vector, w: Vector, start: float) -> Iterator[tuple[float, float]]:
        """The intervals of s > start for which u + s w is inside the reference shape."""
        if not any(w):
            return
        cuts = {start} | {s for q in self.walls for s in _roots(q, u, w) if s > start}
        ordered = sorted(cuts)
        for a, b in pairwise(ordered):
            middle = plus(u, w, (a + b) / 2)
            if all(q(middle) <= 0 for q in self.walls):
                yield a, b

    def curves(self) -> Iterator[Curve]:
        """The contours, edges and rims of the solid, by its kind."""
        if self.kind in ("box", "tetrahedron"):
            for a, b in _edges(self.kind):
                yield self._curve(plus(scaled(1 - k / 48, a), b, k / 48) for k in range(49))
        elif self.kind in ("cylinder", "cone"):
            yield from self._surface_of_revolution()
        else:
            yield from self._ellipsoid_curves()

    def _curve(self, points: Iterator[Vector], edge: bool = True, always: bool = False) -> Curve:
        return Curve(tuple(map(self.to_body, points)), edge, always)

    def _ellipsoid_curves(self) -> Iterator[Curve]:
        """The contour of an ellipsoid, where the radius is normal to the line of sight, its
        equator, and a cavity."""
        w = self.sight
        a = cross(w, (0.0, 0.0, 1.0) if abs(w[2]) < 0.9 * math.hypot(*w) else (1.0, 0.0, 0.0))
        b = cross(w, a)
        a, b = (scaled(1 / (math.hypot(*x) or 1.0), x) for x in (a, b))
        contour = [plus(scaled(math.cos(t), a), b, math.sin(t)) for t in _circle()]
        yield self._curve(iter(contour))
        yield self._curve(((math.cos(t), math.sin(t), 0.0) for t in _circle()), edge=False)
        if self.kind == "hollow_ball":
            inner = min(self.sizes["inner"] / self.sizes["outer"], 1.0)
            if inner > 0:
                yield self._curve((scaled(inner, u) for u in contour), always=True)

    def _surface_of_revolution(self) -> Iterator[Curve]:
        """The rims of a cylinder or cone, and the lines where its mantle turns out of sight."""
        x, y, z = self.sight
        cone = self.kind == "cone"
        levels = (0.0,) if cone else (1.0, -1.0)
        for level in levels:
            yield self._curve((math.cos(t), math.sin(t), level) for t in _circle())
        slope = -z / (math.hypot(x, y) or 1e-12) if cone else 0.0
        if abs(slope) >= 1:  # seen from above or below, the mantle has no contour
            return
        for side in (1, -1):
            t = math.atan2(y, x) + side * math.acos(slope)
            foot = (math.cos(t), math.sin(t), 0.0 if cone else -1.0)
            top = (0.0, 0.0, 1.0) if cone else (foot[0], foot[1], 1.0)
            yield self._curve(plus(scaled(1 - k / 48, foot), top, k / 48) for k in range(49))


def _affine_map(solid: DrawnSolid) -> tuple[list[Vector], Vector]:
    """The affine map u ↦ A u + s from the reference shape to a solid: the columns of A, and s."""
    k, s = solid.kind, solid.sizes
    R, shift = solid.rotation, solid.shift
    if k == "tetrahedron":
        first, *others = (plus(image(R, v), shift) for v in s["vertices"])
        return [plus(v, first, -1.0) for v in others], first
    if "map" in s:
        return s["map"], shift
    sizes = stretches(k, s, lambda x: x / 2)
    return [(x * R[0][i], x * R[1][i], x * R[2][i]) for i, x in enumerate(sizes)], shift


def stretches(kind: str, s: Mapping[str, Any], half: Callable[[Any], Any]) -> Sequence[Any]:
    """By how much the reference shape of a solid is stretched along its axes; ``half``: of a
    size."""
    if kind == "box":
        return [*map(half, s["sides"])]
    if kind == "ellipsoid":
        return s["semi_axes"]  # type: ignore[no-any-return]
    if kind in ("cylinder", "cone"):
        return [s["radius"], s["radius"], half(s["height"]) if kind == "cylinder" else s["height"]]
    return [s["outer" if kind == "hollow_ball" else "radius"]] * 3


def _edges(kind: str) -> Iterator[tuple[Vector, Vector]]:
    """The edges of the reference shape of a box or a tetrahedron, as pairs of corners."""
    if kind == "tetrahedron":
        corners = [ORIGIN, *UNITS]
        yield from ((a, b) for i, a in enumerate(corners) for b in corners[:i])
        return
    for along, (x, y) in product(UNITS, product((-1.0, 1.0), repeat=2)):
        e, f = (u for u in UNITS if u != along)
        middle = plus(scaled(x, e), f, y)
        yield plus(middle, along, -1.0), plus(middle, along)


def _circle() -> Iterator[float]:
    return (2 * math.pi * k / ROUND for k in range(ROUND + 1))


def _roots(q: Wall, u: Vector, w: Vector) -> Iterator[float]:
    """The s at which u + s w meets a wall, where q(u + s w), a quadratic in s, vanishes."""
    c, p, m = q(u), q(plus(u, w)), q(plus(u, w, -1.0))
    a, b = (p + m) / 2 - c, (p - m) / 2
    if abs(a) < 1e-12 * (abs(b) + abs(c) + 1e-300):
        if b:
            yield -c / b
        return
    square = b * b - 4 * a * c
    if square >= 0:
        yield from ((-b + s * math.sqrt(square)) / (2 * a) for s in (1, -1))
