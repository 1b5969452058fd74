"""A body at several instants, its polhode, curves on ellipsoids and spheres."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np

from ...motion.run import Array, Run
from .plot_sheet import COLOURS, ON_CURVES, PlotError, at_time, beside, label

# Curves on ellipsoids and spheres: hidden parts thin; tips of axes.

VIEW = np.array([0.75, 0.5, 0.43]) / np.linalg.norm([0.75, 0.5, 0.43])
"""From where the pictures are seen, a unit vector."""
ABOVE = np.array([0.0, 0.0, 1.0])
"""From where a body of the plane is seen."""

FAST, LONG = 0.25, 15.0
"""A tip that moves further than this from instant to instant, on the mean, makes no curve; and one
that goes further than this in all makes a thicket: that of the calmest axis alone is drawn."""


BODY_AXIS = "axis {k} of the body"


def projected(points: Array, view: Array = VIEW) -> Array:
    """Points (…, 3) → (…, 2), along the view, the third axis upwards; from above as they are."""
    if view is ABOVE:
        return points[..., :2]
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
    those that turn too fast for the instants of the run, or too often, unless all do."""
    A = attitude(run)
    panel = figure.subplots()
    surface(panel, np.eye(3))
    ways = paths(A)
    slow = ways < FAST * max(1, len(A) - 1)
    drawn = [k for k in range(3) if slow[k] and (ways[k] < LONG or k == np.argmin(ways))]
    for k in drawn or range(3):
        tip = A[:, :, k]
        name = word(BODY_AXIS).format(k=k + 1)
        curve(panel, tip, tip, COLOURS[k], f"{name}, $A e_{k + 1}$")
    for name, end in zip("xyz", projected(1.07 * np.eye(3)), strict=True):
        panel.text(*end, f"${name}$", ha="center", va="center", **ON_CURVES)
    figure.legend(*panel.get_legend_handles_labels(), loc="outside lower center", ncols=3)


def paths(A: Array) -> Array:
    """How far the tip of each axis goes in all; A at the instants, (instants, n, n)."""
    found: Array = np.nansum(np.linalg.norm(np.diff(A, axis=0), axis=1), axis=0)
    return found


def attitude(run: Run) -> Array:
    """A at the instants, (instants, 3, 3); of a turn of the plane that about the third axis."""
    if not is_flat(run):
        return np.stack([run[x] for x in ATTITUDE], -1).reshape(-1, 3, 3)
    A: Array = np.tile(np.eye(3), (len(run.t), 1, 1))
    A[:, :2, :2] = np.stack([run[x] for x in FLAT], -1).reshape(-1, 2, 2)
    return A


def is_flat(run: Run) -> bool:
    """Is it the motion of a body of the plane?"""
    state = run.of_kind("state")
    return {*FLAT} <= {*state} and not {*ATTITUDE} <= {*state}


ATTITUDE = tuple(f"A_{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))
FLAT = tuple(f"A_{i}{j}" for i in (1, 2) for j in (1, 2))


# A body at several instants: its points with the edges between them, its solids, its volume.

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
    A, parts, view = attitude(run), drawn(run), ABOVE if is_flat(run) else VIEW
    rows = np.linspace(0, len(A) - 1, INSTANTS).round().astype(int)
    panels = figure.subplots(1, len(rows), sharex=True, sharey=True)
    points = np.array(parts["points"], float).reshape(-1, 3)
    edges = [*combinations(range(len(points)), 2)] if len(points) <= EDGED else []
    for panel, k in zip(panels, rows, strict=True):
        for j in range(len(points)):
            x, y = projected(A[: k + 1] @ points[j], view).T
            panel.plot(x, y, c=COLOURS[j % len(COLOURS)], lw=0.5, alpha=0.5)
        if view is VIEW:
            _faces(panel, A[k] @ points.T)
        for i, j in edges:
            _line(panel, (A[k] @ points[[i, j]].T).T, view)
        for lines in parts["solids"]:
            _solid(panel, [np.array(line, float) @ A[k].T for line in lines], view)
        for map_, shift in parts["ellipsoids"]:
            _ellipsoid(panel, A[k] @ np.array(map_, float), A[k] @ np.array(shift, float), view)
        if len(points) == 1:
            _line(panel, np.stack([np.zeros(3), A[k] @ points[0]]), view)
        for j, point in enumerate(points):
            x, y = projected(A[k] @ point, view)
            panel.plot([x], [y], "o", c=COLOURS[j % len(COLOURS)], ms=4)
        if not parts["ellipsoids"]:
            for j in range(3 if view is VIEW else 2):
                tip = np.stack([np.zeros(3), A[k][:, j]]) * _size(points, parts) / 2
                panel.plot(*projected(tip, view).T, c="#bbbbbb", lw=0.6, zorder=0)
        title = at_time(run, k)
        if len(points) == 4 and view is VIEW:
            volume = abs(float(np.linalg.det(A[k] @ (points[1:] - points[0]).T))) / 6
            title += f"\n{word('volume')} {volume:.6g}"
        panel.set_title(title, fontsize=8)
        panel.set_aspect("equal")
        panel.set_axis_off()


def _size(points: Array, parts: dict[str, list[Any]]) -> float:
    edges = (line for lines in parts["solids"] for line in lines)
    every = [*points, *(x for line in edges for x in np.array(line, float))]
    return max((float(np.linalg.norm(x)) for x in every), default=1.0)


def _line(panel: Any, points: Array, view: Array) -> None:
    panel.plot(*projected(points, view).T, c="#333333", lw=0.8)


def _solid(panel: Any, lines: list[Array], view: Array) -> None:
    """A convex solid by its edges and rims, with its outline."""
    outline = hull(projected(np.concatenate(lines), view))
    panel.fill(*outline.T, facecolor="#f4f4f4", edgecolor="#333333", lw=0.8)
    for line in lines:
        panel.plot(*projected(line, view).T, c="#777777", lw=0.5)


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


def _ellipsoid(panel: Any, map_: Array, shift: Array, view: Array = VIEW) -> None:
    """The image of the unit ball: its outline, where normals are across the view, and the images of
    three circles, what is behind thin."""
    turn = np.linspace(0, 2 * np.pi, 121)
    circle = np.stack([np.cos(turn), np.sin(turn)])
    a, b, c = map_.T
    seen = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)]) @ view  # |map| map⁻¹ VIEW
    seen = seen if np.linalg.det(map_) >= 0 else -seen  # 0 of a flat body
    frame = np.linalg.svd(seen[None])[2][1:]
    x, y = projected((map_ @ frame.T @ circle).T + shift, view).T
    panel.fill(x, y, facecolor="#f4f4f4", edgecolor="#333333", lw=0.8, zorder=0)
    for k in range(3):
        u = np.delete(np.eye(3), k, axis=1) @ circle
        x, y = projected((map_ @ u).T + shift, view).T
        front = seen @ u >= 0
        panel.plot(x, y, c=COLOURS[k], lw=0.4, alpha=0.4)
        panel.plot(np.where(front, x, np.nan), np.where(front, y, np.nan), c=COLOURS[k], lw=1.1)


# The polhode among its neighbours: why a body flips about its middle axis.

VELOCITY = ("zeta_1", "zeta_2", "zeta_3")

NEIGHBOURS = (0.25, 0.5, 0.75)
"""How far from an axis to the separatrix other polhodes are drawn."""

STABLE, UNSTABLE, SEPARATRIX = "stable axis", "unstable axis", "separatrix"
AXIS = "principal axis"
"""What is marked, as the legend says it."""

SIZE = 230
"""About how wide a panel is, in points."""

EQUAL = 1e-9
"""Moments whose relative difference is less are one."""
KEPT = 1e-3
"""A relative change that is not seen: where energy and momentum change by less, no torque acts."""


def polhode(figure: Any, run: Run, word: Any) -> None:
    """The velocity on the ellipsoid of inertia ⟨ζ, Iζ⟩ = 2T of the first instant, and the momentum
    M = Iζ on the sphere of its length; on both other motions, faint, and the principal axes.

    Where a torque acts these leave the surfaces, and other motions, free ones, are left out."""
    inertia, zeta = inertia_of(run), np.stack([run[x] for x in VELOCITY], -1)
    momentum = zeta @ inertia
    moments, axes = np.linalg.eigh(inertia)
    twice, length = float(zeta[0] @ momentum[0]), float(np.linalg.norm(momentum[0]))
    root = axes @ np.diag(np.sqrt(twice / moments)) @ axes.T
    free = _kept(np.sum(zeta * momentum, axis=1)) and _kept(np.linalg.norm(momentum, axis=1))
    left, right = figure.subplots(1, 2)
    sphere, late = length * np.eye(3), "" if free else f"\n{word('at first: a torque acts')}"
    for panel, map_, d, along, colour in (
        (left, root, moments, zeta, COLOURS[0]),
        (right, sphere, 1 / moments, momentum, COLOURS[1]),
    ):
        surface(panel, map_, axes)
        if free:
            _family(panel, map_, axes, d)
        curve(panel, along, momentum, colour)
        _square(panel, map_, along)
        _marks(panel, map_, axes, moments, free)
    left.set_title(f"{label('zeta')}, {word('ellipsoid of inertia')}{late}")
    right.set_title(f"$M$, {word('sphere of angular momentum')}{late}")
    _legend(figure, left, word)


def _kept(x: Array) -> bool:
    return bool(np.ptp(x) <= KEPT * abs(x[0]))


def levels(d: Array) -> Iterator[tuple[Array, bool]]:
    """The curves Σ d_a u_a² = constant on the unit sphere, (places, 3) each, about the axes of the
    least and of the largest d, on both sides; is it the separatrix, through the axis of the middle
    d?  Where two of the d are equal the curves are circles about the third axis: none parts them.
    """
    turn = np.linspace(0, 2 * np.pi, 181)
    least, middle, most = np.argsort(d)
    for end, far in ((least, most), (most, least)):
        if _equal(d[end], d[middle]):
            continue
        parts = end == least and not _equal(d[far], d[middle])
        for s in (*NEIGHBOURS, 1.0) if parts else NEIGHBOURS:
            u = np.empty((len(turn), 3))
            u[:, middle] = s * np.cos(turn)
            u[:, far] = s * np.sin(turn) * np.sqrt((d[end] - d[middle]) / (d[end] - d[far]))
            u[:, end] = np.sqrt(np.maximum(0, 1 - u[:, middle] ** 2 - u[:, far] ** 2))
            for side in (1, -1):
                yield u * np.where(np.arange(3) == end, side, 1), s == 1


def unstable(moments: Array) -> int | None:
    """The axis of the middle moment, of three in order; ``None`` where two are equal."""
    low, middle, high = moments
    return None if _equal(low, middle) or _equal(middle, high) else 1


def _equal(x: float, y: float) -> bool:
    return bool(abs(x - y) <= EQUAL * max(abs(x), abs(y)))


def _family(panel: Any, root: Array, axes: Array, d: Array) -> None:
    """The curves of :func:`levels` on the ellipsoid {root u : |u| = 1}, as seen."""
    seen = np.linalg.solve(root, VIEW)
    for u, parts in levels(d):
        u = u @ axes.T
        x, y = projected(u @ root).T
        front = u @ seen >= 0
        style: dict[str, Any] = {"c": "#8fa8bb", "lw": 0.5}
        if parts:
            style = {"c": "#444444", "ls": "--", "lw": 0.8, "label": SEPARATRIX}
        panel.plot(np.where(front, x, np.nan), np.where(front, y, np.nan), zorder=1, **style)


def _marks(panel: Any, root: Array, axes: Array, moments: Array, free: bool) -> None:
    """The ends of the axes, that are seen, with their numbers: a dot for a stable one, a cross for
    the unstable one, where no torque acts; of equal moments no axis is marked."""
    seen = np.linalg.solve(root, VIEW)
    marked = [
        k for k in range(3) if not any(_equal(moments[k], moments[j]) for j in range(3) if j != k)
    ]
    ends = [axes[:, k] * (1 if axes[:, k] @ seen >= 0 else -1) for k in marked]
    places = np.array([projected(root @ end) for end in ends]).reshape(-1, 2)
    labels = [f"$I = {in_math(moments[k])}$" for k in marked]
    offsets = beside(places, labels, root @ projected(np.eye(3)), SIZE / np.ptp(panel.get_xlim()))
    for k, place, text, (x, y) in zip(marked, places, labels, offsets, strict=True):
        style: dict[str, Any] = {"marker": "o", "label": STABLE if free else AXIS}
        if free and k == unstable(moments):
            style = {"marker": "x", "mew": 1.4, "label": UNSTABLE}
        panel.plot(*place[:, None], c="#000000", ms=4.5, ls="", zorder=4, **style)
        panel.annotate(text, place, (x, y), textcoords="offset points", **ON_CURVES)


def in_math(x: float) -> str:
    """A number to three digits: of 1e-05 the e would be set as a letter."""
    digits, _, power = f"{x:.3g}".partition("e")
    return digits + (rf" \cdot 10^{{{int(power)}}}" if power else "")


def _square(panel: Any, root: Array, along: Array) -> None:
    """Limits as wide as they are high about the ellipsoid and what is drawn over it: so the titles
    stand at one height."""
    reach = np.linalg.norm(root @ projected(np.eye(3)), axis=0).max()
    most = 1.04 * max(float(reach), float(np.abs(projected(along)).max()))
    panel.set(xlim=(-most, most), ylim=(-most, most))


def _legend(figure: Any, panel: Any, word: Any) -> None:
    """What dots, crosses and dashes are, of those that are there."""
    named = {x.get_label(): x for x in panel.get_lines()}
    shown = {x: named[x] for x in (STABLE, UNSTABLE, SEPARATRIX, AXIS) if x in named}
    if shown:
        names = [word(x) for x in shown]
        figure.legend([*shown.values()], names, loc="outside lower center", ncols=3)


def inertia_of(run: Run) -> Array:
    """The inertia tensor of the facts; ``PlotError`` for none."""
    try:
        found = np.array(run.facts["body"]["inertia"], float)
        good = found.shape == (3, 3) and np.array_equal(found, found.T)
        good = good and bool((np.linalg.eigvalsh(found) > 0).all())
    except (KeyError, TypeError, ValueError):
        good = False
    if not good:
        raise PlotError(
            "polhode: the facts of this run have no body.inertia, three rows of a positive tensor"
        )
    return found
