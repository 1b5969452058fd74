"""Solids and meshes of triangles for a drawing: the curves to draw, and what they hide."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Any, TypeVar

import numpy as np

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
    if k == "box":
        stretch = [x / 2 for x in s["sides"]]
    elif k == "ellipsoid":
        stretch = s["semi_axes"]
    elif k in ("cylinder", "cone"):
        stretch = [s["radius"], s["radius"], s["height"] / (2 if k == "cylinder" else 1)]
    else:
        stretch = [s["outer" if k == "hollow_ball" else "radius"]] * 3
    return [
        (stretch[i] * R[0][i], stretch[i] * R[1][i], stretch[i] * R[2][i]) for i in range(3)
    ], shift


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


FACES = 3000
"""The most faces of a mesh that is drawn as it is; larger ones are simplified."""
SHARP = 0.77
"""Faces whose normals have a smaller cosine (40°) meet in an edge."""
SHARP_WHEN_SIMPLIFIED = 0.4
NEAR_MESH = 0.02
"""Crossings nearer than this count as those of the curve's own face, as in shapes; a polyhedron is
only near the smooth surface that it stands for."""
OUTSIDE = 0.012
SHORT = 0.12
PAIRS = 400_000

Edge = tuple[int, int]
K = TypeVar("K", int, Edge)


class Mesh:
    """A mesh seen from the direction ``sight``, a vector as long as the figure is large."""

    def __init__(self, solid: DrawnSolid, sight: Vector) -> None:
        own = np.array(solid.sizes["vertices"], dtype=float)
        points = own @ np.array(solid.rotation, dtype=float).T + np.array(solid.shift)
        self.points, self.faces = simplified(points, np.array(solid.sizes["faces"], dtype=int))
        self.simplified = len(self.faces) < len(solid.sizes["faces"])
        self.sharp = SHARP_WHEN_SIMPLIFIED if self.simplified else SHARP
        self.sight = np.array(sight)
        a, b, c = (self.points[k] for k in self.faces.T)
        normals = np.cross(b - a, c - a)
        self.normals = normals / (np.linalg.norm(normals, axis=1, keepdims=True) + 1e-300)
        self.areas = np.linalg.norm(normals, axis=1)

    def hides(self, points: Sequence[Vector]) -> list[bool]:
        """For each point, whether it is behind the mesh, or in it."""
        p = np.array(points, dtype=float).reshape(-1, 3)
        step = max(1, PAIRS // len(self.faces))
        runs = [self._crossings(p[k : k + step], self.sight) for k in range(0, len(p), step)]
        return [bool((s > NEAR_MESH).any()) for run in runs for s in run]

    def reach(self, direction: Vector) -> float:
        """How far the mesh reaches from the origin along a direction, in lengths of that."""
        return max(0.0, float(self._crossings(np.zeros((1, 3)), np.array(direction)).max()))

    def corners(self) -> Iterator[Vector]:
        """The vertices of the mesh."""
        return ((float(x), float(y), float(z)) for x, y, z in self.points)

    def _crossings(self, p: Any, v: Any) -> Any:
        """For every point and face the s with p + s v on the face; −1 where there is none."""
        a, b, c = (self.points[k] for k in self.faces.T)
        x, y = b - a, c - a
        h = np.cross(v, y)
        size = np.einsum("fi,fi->f", x, h)
        flat = np.abs(size) < 1e-12 * (self.areas * np.linalg.norm(v) + 1e-300)
        inverse = np.where(flat, 0.0, 1 / np.where(flat, 1.0, size))
        r = p[:, None, :] - a[None]
        u = np.einsum("pfi,fi->pf", r, h) * inverse
        q = np.cross(r, x[None])
        w = (q @ v) * inverse
        s = np.einsum("pfi,fi->pf", q, y) * inverse
        inside = (u >= -1e-9) & (w >= -1e-9) & (u + w <= 1 + 1e-9) & ~flat
        return np.where(inside, s, -1.0)

    def curves(self) -> Iterator[Curve]:
        """The sharp edges, and the contour of what is smooth; hidden ones only if few."""
        lines = [*self._sharp(), *self._contour()]
        few = sum(map(len, lines)) <= 120
        for line in lines:
            n = max(1, (48 if few else 96) // len(line))
            parts = [a + (b - a) * k / n for a, b in pairwise(line) for k in range(n)]
            run = tuple((float(x), float(y), float(z)) for x, y, z in [*parts, line[-1]])
            if few or not all(self.hides(run[1:-1])):
                yield Curve(run)

    def _sharp(self) -> Iterator[list[Any]]:
        """The lines of sharp edges, as lists of points."""
        sides: dict[Edge, list[int]] = defaultdict(list)
        at: dict[int, list[int]] = defaultdict(list)
        for f, (i, j, k) in enumerate(self.faces.tolist()):
            for a, b in ((i, j), (j, k), (k, i)):
                sides[min(a, b), max(a, b)].append(f)
        for (a, b), faces in sorted(sides.items()):
            n = [self.normals[f] for f in faces]
            if len(n) != 2 and self.simplified:
                continue
            if len(n) != 2 or n[0] @ n[1] < self.sharp:
                at[a].append(b)
                at[b].append(a)
        yield from self._without_short([self.points[k] for k in chain] for chain in _chains(at))

    def _without_short(self, lines: Iterable[list[Any]]) -> Iterator[list[Any]]:
        """The lines without short pieces where the mesh was simplified: there they are flaws."""
        least = SHORT * float(np.linalg.norm(self.sight)) if self.simplified else 0.0
        for line in lines:
            if sum(float(np.linalg.norm(b - a)) for a, b in pairwise(line)) > least:
                yield line

    def _contour(self) -> Iterator[list[Any]]:
        """The lines where the normal, interpolated within each face from its corners, is across the
        line of sight.

        They lie a little outside, as the smooth surface does.
        """
        around: dict[int, list[int]] = defaultdict(list)
        at: dict[Edge, list[Edge]] = defaultdict(list)
        for f, face in enumerate(self.faces.tolist()):
            for k in face:
                around[k].append(f)
        size = float(np.linalg.norm(self.sight))
        places: dict[Edge, Any] = {}
        for f, face in enumerate(self.faces.tolist()):
            facing = [self._facing(f, around[k]) for k in face]
            ends = []
            for i, j in ((0, 1), (1, 2), (2, 0)):
                x, y = facing[i], facing[j]
                if (x > 0) != (y > 0):
                    p, q = self.points[face[i]], self.points[face[j]]
                    edge = min(face[i], face[j]), max(face[i], face[j])
                    outside = OUTSIDE * size * self.normals[f]
                    places.setdefault(edge, p + (q - p) * (x / (x - y)) + outside)
                    ends.append(edge)
            if len(ends) == 2:
                at[ends[0]].append(ends[1])
                at[ends[1]].append(ends[0])
        yield from self._without_short([places[edge] for edge in chain] for chain in _chains(at))

    def _facing(self, f: int, around: list[int]) -> float:
        """How much a corner of a face looks at the reader: the mean over the faces around it that
        continue it smoothly."""
        smooth = [g for g in around if self.normals[g] @ self.normals[f] >= self.sharp]
        return float((self.normals[smooth] * self.areas[smooth, None]).sum(axis=0) @ self.sight)


def _chains(at: Mapping[K, Sequence[K]]) -> Iterator[list[K]]:
    """The lines that neighbouring places form, open ones first, each from one end to the other."""
    left = {edge: list(others) for edge, others in at.items()}
    for start in sorted(left, key=lambda edge: (len(at[edge]) != 1, edge)):
        while left[start]:
            chain = [start]
            while left[chain[-1]]:
                following = left[chain[-1]].pop()
                left[following].remove(chain[-1])
                chain.append(following)
            yield chain


def simplified(points: Any, faces: Any) -> tuple[Any, Any]:
    """The mesh with the vertices in each cell of a grid merged, until its faces are few."""
    low, span = points.min(axis=0), float(np.ptp(points, axis=0).max()) or 1.0
    cells = 40
    while len(faces) > FACES and cells > 4:
        keys = np.minimum((points - low) / span * cells, cells - 1).astype(int)
        _, place, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
        place = place.reshape(-1)
        mean = np.zeros((len(count), 3))
        np.add.at(mean, place, points)
        a, b, c = joined = place[faces].T
        kept = joined.T[(a != b) & (b != c) & (c != a)]
        _, first, count_of = np.unique(np.sort(kept), axis=0, return_index=True, return_counts=True)
        kept = kept[np.sort(first[count_of == 1])]  # without folds, faces back to back
        if len(kept) <= FACES or cells <= 6:
            return mean / count[:, None], kept
        cells = int(cells * 0.8)
    return points, faces
