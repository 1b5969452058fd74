"""A body at several instants: its points with the edges between them, its solids, its volume."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np

from ..motion.run import Array, Run
from .plot_sheet import COLOURS
from .surfaces import VIEW, attitude, projected

INSTANTS, EDGED = 5, 5
"""How many instants are drawn; the most points of a body between which all edges are."""


def drawn(run: Run) -> dict[str, list[Any]]:
    """``points``, ``solids`` and ``ellipsoids`` of the body, in its frame; of one that is known by
    its inertia alone the ellipsoid of the same axes."""
    body = run.facts.get("body", {})
    found = {x: list(body.get(x, ())) for x in ("points", "solids", "ellipsoids")}
    if not any(found.values()) and "inertia" in body:
        I = np.array(body["inertia"], float)  # noqa: E741
        J = np.trace(I) / 2 * np.eye(3) - I
        values, vectors = np.linalg.eigh(J)
        root = vectors @ np.diag(np.sqrt(np.maximum(values, 0) / values.max()))
        found["ellipsoids"] = [[root.tolist(), [0.0, 0.0, 0.0]]]
    return found


def body(figure: Any, run: Run, word: Any) -> None:
    """The body at some instants, each about where its origin is; paths of its points up to then."""
    A, parts = attitude(run), drawn(run)
    rows = np.linspace(0, len(A) - 1, INSTANTS).round().astype(int)
    panels = figure.subplots(1, len(rows), sharex=True, sharey=True)
    points = np.array(parts["points"], float).reshape(-1, 3)
    edges = [*combinations(range(len(points)), 2)] if len(points) <= EDGED else []
    for panel, k in zip(panels, rows, strict=True):
        for j in range(len(points)):
            x, y = projected(A[: k + 1] @ points[j]).T
            panel.plot(x, y, c=COLOURS[j % len(COLOURS)], lw=0.5, alpha=0.5)
        _faces(panel, A[k] @ points.T)
        for i, j in edges:
            _line(panel, (A[k] @ points[[i, j]].T).T, "#333333")
        for lines in parts["solids"]:
            _solid(panel, [np.array(line, float) @ A[k].T for line in lines])
        for map_, shift in parts["ellipsoids"]:
            _ellipsoid(panel, A[k] @ np.array(map_, float), A[k] @ np.array(shift, float))
        for j, point in enumerate(points):
            x, y = projected(A[k] @ point)
            panel.plot([x], [y], "o", c=COLOURS[j % len(COLOURS)], ms=4)
        if not parts["ellipsoids"]:
            for j in range(3):
                tip = projected(np.stack([np.zeros(3), A[k][:, j]]) * _size(points, parts) / 2)
                panel.plot(*tip.T, c="#bbbbbb", lw=0.6, zorder=0)
        title = f"$t = {run.t[k]:.3g}$"
        if len(points) == 4:
            volume = abs(float(np.linalg.det(A[k] @ (points[1:] - points[0]).T))) / 6
            title += f"\n{word('volume')} {volume:.6g}"
        panel.set_title(title, fontsize=8)
        panel.set_aspect("equal")
        panel.set_axis_off()


def _size(points: Array, parts: dict[str, list[Any]]) -> float:
    edges = (line for lines in parts["solids"] for line in lines)
    every = [*points, *(x for line in edges for x in np.array(line, float))]
    return max((float(np.linalg.norm(x)) for x in every), default=1.0)


def _line(panel: Any, points: Array, colour: str) -> None:
    panel.plot(*projected(points).T, c=colour, lw=0.8)


def _solid(panel: Any, lines: list[Array]) -> None:
    """A convex solid by its edges and rims, with its outline."""
    outline = hull(projected(np.concatenate(lines)))
    panel.fill(*outline.T, facecolor="#f4f4f4", edgecolor="#333333", lw=0.8)
    for line in lines:
        panel.plot(*projected(line).T, c="#777777", lw=0.5)


def hull(points: Array) -> Array:
    """The corners of the convex hull of points of the plane, in turn (Andrew's chain)."""
    ordered = sorted({(float(x), float(y)) for x, y in points})
    halves = []
    for side in (ordered, ordered[::-1]):
        half: list[tuple[float, float]] = []
        for x, y in side:
            while len(half) > 1:
                (a, b), (c, d) = half[-2:]
                if (c - a) * (y - b) - (d - b) * (x - a) > 0:
                    break
                half.pop()
            half.append((x, y))
        halves += half[:-1]
    return np.array(halves)


def _faces(panel: Any, corners: Array) -> None:
    """The faces of a tetrahedron, seen through."""
    if corners.shape[1] == 4:
        for face in combinations(range(4), 3):
            x, y = projected(corners[:, face].T).T
            panel.fill(x, y, facecolor=COLOURS[5], alpha=0.15, lw=0)


def _ellipsoid(panel: Any, map_: Array, shift: Array) -> None:
    """The image of the unit ball: its outline, where normals are across the view, and the images of
    three circles, what is behind thin."""
    turn = np.linspace(0, 2 * np.pi, 121)
    circle = np.stack([np.cos(turn), np.sin(turn)])
    a, b, c = map_.T
    seen = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)]) @ VIEW  # |map| map⁻¹ VIEW
    seen = seen if np.linalg.det(map_) >= 0 else -seen  # 0 of a flat body
    frame = np.linalg.svd(seen[None])[2][1:]
    x, y = projected((map_ @ frame.T @ circle).T + shift).T
    panel.fill(x, y, facecolor="#f4f4f4", edgecolor="#333333", lw=0.8, zorder=0)
    for k in range(3):
        u = np.delete(np.eye(3), k, axis=1) @ circle
        x, y = projected((map_ @ u).T + shift).T
        front = seen @ u >= 0
        panel.plot(x, y, c=COLOURS[k], lw=0.4, alpha=0.4)
        panel.plot(np.where(front, x, np.nan), np.where(front, y, np.nan), c=COLOURS[k], lw=1.1)
