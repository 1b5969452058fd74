"""A mesh of triangles for a drawing: the curves to draw, and what it hides."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np

from .drawn_body import DrawnSolid, Vector
from .shapes import Curve

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
