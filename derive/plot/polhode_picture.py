"""The polhode among its neighbours: why a body flips about its middle axis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..motion.run import Array, Run
from .label_places import FONT, beside
from .plot_sheet import COLOURS, PlotError, label
from .surfaces import VIEW, curve, projected, surface

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
        panel.annotate(text, place, (x, y), textcoords="offset points", fontsize=FONT, zorder=5)


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
