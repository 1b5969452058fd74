"""A fluid that stays an ellipsoid: its semi-axes, its pressure, and its section, in time."""

from __future__ import annotations

from itertools import permutations
from typing import Any

import numpy as np

from ..motion.run import Array, Run
from .plot_sheet import COLOURS, label
from .surfaces import attitude
from .time_series import time_label, with_unit

SECTIONS = 6
PRESSURE = "#7a4b00"
"""The colour of its axis, its curve, and of when it is negative."""


def is_ellipsoid(run: Run) -> bool:
    """Is the body one ellipsoid about the origin?"""
    body = run.facts.get("body", {})
    ellipsoids, others = body.get("ellipsoids", ()), body.get("points") or body.get("solids")
    return len(ellipsoids) == 1 and not others


def maps(run: Run) -> Array:
    """The maps of the unit ball to the ellipsoid, (instants, 3, 3)."""
    (map_, _), *_ = run.facts["body"]["ellipsoids"]
    found: Array = attitude(run) @ np.array(map_, float)
    return found


def spheroid(figure: Any, run: Run, word: Any) -> None:
    """Semi-axes, integral of the pressure, and sections by the plane y = 0 of space."""
    M = maps(run)
    left, right = figure.subplots(1, 2, width_ratios=(1.5, 1))
    axes = followed(np.asarray(np.linalg.svd(M, compute_uv=False), dtype=float))
    for k in range(3):
        left.plot(run.t, axes[:, k], ("-", "--", ":")[k], c=COLOURS[k], label=f"$a_{k + 1}$")
    (column,) = (x for x in run.columns if x.kind == "multiplier")
    length = "m" if column.unit else ""  # a run is in SI or has no units
    left.set(ylabel=with_unit(word("semi-axes"), length))
    below, theta = left.twinx(), run[column.name]
    below.plot(run.t, theta, "-.", c=PRESSURE, label=word("integral of the pressure"))
    below.axhline(0, c=PRESSURE, lw=0.5)
    where = below.get_xaxis_transform()
    below.fill_between(
        run.t, 0, 1, where=theta < 0, transform=where, color=PRESSURE, alpha=0.12, lw=0
    )
    below.set_ylabel(with_unit(word("integral of the pressure"), column.unit), color=PRESSURE)
    below.tick_params(axis="y", colors=PRESSURE)
    below.spines["right"].set(visible=True, color=PRESSURE)
    left.set_xlabel(time_label(run))
    handles, labels = left.get_legend_handles_labels()
    handles += below.get_legend_handles_labels()[0]
    labels += below.get_legend_handles_labels()[1]
    figure.legend(handles, labels, loc="outside lower left", ncols=4)
    rows = np.linspace(0, len(M) - 1, SECTIONS).round().astype(int)
    for shade, k in zip(np.linspace(0.25, 1, SECTIONS), rows, strict=True):
        right.plot(*section(M[k]), c=COLOURS[0], alpha=shade, label=f"$t = {run.t[k]:.3g}$")
    right.set(aspect="equal", title=word("section y = 0 (space)"))
    right.set(xlabel=with_unit(label("x"), length), ylabel=with_unit(label("z"), length))
    right.legend(loc="center left", bbox_to_anchor=(1, 0.5))


def followed(sizes: Array) -> Array:
    """Sizes by instants, (instants, 3), in such an order at each that the curves go on straight."""
    found = sizes.copy()
    for k in range(2, len(found)):
        ahead = 2 * found[k - 1] - found[k - 2]
        found[k] = min(permutations(sizes[k]), key=lambda x: float(np.abs(x - ahead).sum()))
    return found


def section(M: Array) -> Array:
    """The section of {M u : |u| ≤ 1} with the plane of the first and third axes of space, (2,
    places): ⟨r, (M M̄)⁻¹ r⟩ = 1."""
    Q = np.linalg.inv(M @ M.T)[np.ix_([0, 2], [0, 2])]
    turn = np.linspace(0, 2 * np.pi, 181)
    found: Array = np.linalg.inv(np.linalg.cholesky(Q)).T @ np.stack([np.cos(turn), np.sin(turn)])
    return found
