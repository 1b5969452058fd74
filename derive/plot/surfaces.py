"""Curves on ellipsoids and spheres: hidden parts thin; tips of axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..motion.run import Array, Run
from .plot_sheet import COLOURS

VIEW = np.array([0.75, 0.5, 0.43]) / np.linalg.norm([0.75, 0.5, 0.43])
"""From where the pictures are seen, a unit vector."""

FAST = 0.25
"""A tip that moves further than this from instant to instant, on the mean, makes no curve."""


def projected(points: Array, view: Array = VIEW) -> Array:
    """Points (…, 3) → (…, 2), along the view, the third axis upwards."""
    right = np.cross([0.0, 0.0, 1.0], view)
    right /= np.linalg.norm(right)
    return np.stack([points @ right, points @ np.cross(view, right)], -1)


def curve(panel: Any, points: Array, normals: Array, colour: str, name: str = "") -> None:
    """A curve on a closed surface, whole and thin, then what is seen of it in front."""
    x, y = projected(points).T
    front = normals @ VIEW >= 0
    panel.plot(x, y, c=colour, lw=0.4, alpha=0.6)
    panel.plot(np.where(front, x, np.nan), np.where(front, y, np.nan), c=colour, label=name)
    panel.plot(x[:1], y[:1], "o", c=colour, ms=3)


def surface(panel: Any, root: Array, axes: Array | None = None) -> None:
    """The ellipsoid {root u : |u| = 1}, root symmetric: its outline, and its sections by the planes
    of ``axes``, columns, without them those of the coordinates."""
    turn = np.linspace(0, 2 * np.pi, 241)
    circle = np.stack([np.cos(turn), np.sin(turn)])
    seen = np.linalg.solve(root, VIEW)  # the outline: normal ⟂ view
    right = np.cross([0.0, 0.0, 1.0], seen)
    frame = np.stack([x / np.linalg.norm(x) for x in (right, np.cross(seen, right))])
    x, y = projected(circle.T @ frame @ root).T
    panel.fill(x, y, facecolor="#f4f4f4", edgecolor="#555555", lw=0.8, zorder=0)
    for k in range(3):
        u = circle.T @ np.delete(np.eye(3) if axes is None else axes.T, k, axis=0)
        x, y = projected(u @ root).T
        front = u @ seen >= 0
        panel.plot(np.where(front, x, np.nan), np.where(front, y, np.nan), c="#bbbbbb", lw=0.5)
    panel.set_aspect("equal")
    panel.set_axis_off()


def axes(figure: Any, run: Run, word: Any) -> None:
    """The tips of the body's axes on the unit sphere of space: precession and nutation; without
    those that turn too fast for the instants of the run, unless all do."""
    A = attitude(run)
    panel = figure.subplots()
    surface(panel, np.eye(3))
    steps = np.linalg.norm(np.diff(A, axis=0), axis=1).mean(axis=0) if len(A) > 1 else np.zeros(3)
    for k in [k for k in range(3) if steps[k] < FAST] or range(3):
        tip = A[:, :, k]
        curve(panel, tip, tip, COLOURS[k], f"$A e_{k + 1}$")
    figure.legend(*panel.get_legend_handles_labels(), loc="outside lower center", ncols=3)


def attitude(run: Run) -> Array:
    """A at the instants, (instants, 3, 3)."""
    return np.stack([run[x] for x in ATTITUDE], -1).reshape(-1, 3, 3)


ATTITUDE = tuple(f"A_{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))
