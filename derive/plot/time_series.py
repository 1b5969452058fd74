"""The state against time, and how well what motions keep was kept."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from textwrap import wrap
from typing import Any

import numpy as np

from ..language.suffixed import by_letter
from ..motion.kept_words import KEPT, in_words
from ..motion.run import Array, Column, Run
from .plot_sheet import COLOURS, label

MOST = 12
"""So many curves a panel: of more, the first are drawn."""

LONG = 14
"""Longer names, which are words and no letters, stand one a line; those of letters four."""

LINE = 30
"""So many letters a line of what stands beside an axis: as much as a panel is high."""

OFTEN, EVEN = 0.25, 1e-6
"""A column that turns back at more than this part of the instants has fewer than eight of them a
period, too few for a curve; unless it is even but for so much of its panel."""


def letters(run: Run) -> list[tuple[str, list[Column]]]:
    """The columns of the state by their letters, of many the first."""
    known = {x.name: x for x in run.columns if x.kind == "state"}
    return [(key, [known[x] for x in names]) for key, names in by_letter(known).items()][:6]


def size_of_state(run: Run) -> tuple[float, float]:
    """Width and height of :func:`state`."""
    return 6.5, 0.6 + 1.7 * len(letters(run))


def state(figure: Any, run: Run, word: Any) -> None:
    """The columns of the state against time, a panel each letter (A, T, ζ, …)."""
    groups = letters(run)
    panels = figure.subplots(len(groups), 1, sharex=True, squeeze=False)[:, 0]
    for panel, (key, members) in zip(panels, groups, strict=True):
        size, fast = max(float(np.abs(run[x.name]).max()) for x in members), []
        for k, x in enumerate(members[:MOST]):
            if _is_too_fast(run[x.name], size):
                fast.append(label(x.name))
                continue
            panel.plot(run.t, run[x.name], **_style(k), label=label(x.name))
        units = {x.unit for x in members}
        panel.set_ylabel(with_unit(label(key), units.pop() if len(units) == 1 else ""))
        _beside(panel, run, _named(f"{word('too few instants:')}\n", fast))
    panels[-1].set_xlabel(time_label(run))


def _is_too_fast(y: Array, size: float) -> bool:
    """Does a column turn back too often for the instants of its run?"""
    if len(y) < 1 / OFTEN or np.ptp(y) <= EVEN * size:
        return False
    steps = np.diff(y)
    return bool((steps[1:] * steps[:-1] < 0).mean() > OFTEN)


def _named(why: str, names: Sequence[str]) -> str:
    """Why some curves are not drawn, and which; empty where all are."""
    each = 1 if max(map(len, names), default=0) > LONG else 4
    lines = [", ".join(names[k : k + each]) for k in range(0, len(names), each)]
    return why + ",\n".join(lines) if names else ""


def _beside(panel: Any, run: Run, others: str) -> None:
    """The legend, and words of what is not drawn, which stand in the panel where nothing is."""
    drawn = len(panel.get_lines())
    if not drawn:
        panel.text(0.5, 0.5, others, transform=panel.transAxes, ha="center", va="center", size=8)
        panel.set(xlim=run.t[[0, -1]], yticks=[])
        panel.spines["left"].set_visible(False)
        return
    if others:
        panel.plot([], [], " ", label=others)
    panel.legend(loc="center left", bbox_to_anchor=(1, 0.5), ncols=1 + (drawn > 6))


def _style(k: int) -> dict[str, str]:
    """The line of curve k, from 0."""
    return {"ls": ("-", "--", ":")[k // len(COLOURS) % 3], "c": COLOURS[k % len(COLOURS)]}


def _curve(panel: Any, t: Array, away: Array, k: int, **more: Any) -> None:
    """Curve k of what is away from its first value, where it is, in powers of ten; a point that
    stands alone is a dot."""
    away[away == 0] = np.nan
    there = np.isfinite([np.nan, *away, np.nan])
    alone = np.flatnonzero(there[1:-1] & ~there[:-2] & ~there[2:]).tolist()
    dots = {"marker": ".", "markevery": alone} if alone else {}
    panel.semilogy(t, away, **_style(k), **dots, **more)


def changes(run: Run) -> dict[str, tuple[Array, float]]:
    """|E − E₀| / |E₀| of the energy and of every conserved quantity, and |E₀|: of a component of a
    vector that of the vector; where it is 0 the difference itself."""
    sizes, kept = norms(run), {**run.of_kind("energy"), **run.of_kind("conserved")}
    scales = {name: sizes.get(vector_of(name), abs(y[0])) for name, y in kept.items()}
    return {x: (np.abs(y - y[0]) / (scales[x] or 1.0), scales[x]) for x, y in kept.items()}


def size_of_energy(run: Run) -> tuple[float, float]:
    """Width and height of :func:`energy`, small where all is exact."""
    return 6.5, 3.4 if any(away.any() for away, _ in changes(run).values()) else 1.2


def energy(figure: Any, run: Run, word: Any) -> None:
    """The :func:`changes`.  What is exact has no place on the axis: it is left out.  They are no
    errors where damping, an input or the time changes what is kept."""
    panel, exact, found = figure.subplots(), [], changes(run)
    for k, (name, (away, scale)) in enumerate(found.items()):
        shown = in_words(name, word)
        if not away.any():
            exact.append(shown)
            continue
        shown += "" if scale else f" ({word('absolute')})"
        _curve(panel, run.t, away, k, label=shown)
    panel.set_xlabel(time_label(run))
    vectors = any(abs(run[x][0]) < scale for x, (_, scale) in found.items())
    told = word("components relative to the length of their vector") if vectors else ""
    error = word("relative change" if run.facts.get("drives") else "relative error")
    panel.set_ylabel("\n".join((error, *wrap(told, LINE))))
    _beside(panel, run, _named(f"{word('exact:')} ", exact))


def energies(figure: Any, runs: Sequence[tuple[str, Run]], word: Any) -> None:
    """|E − E₀| / |E₀| of several runs, each with what it is called and its method; of a run that
    begins with no energy, the difference itself."""
    panel, exact = figure.subplots(), []
    for k, (name, run) in enumerate(runs):
        y = run["energy"]
        away = np.abs(y - y[0]) / (abs(y[0]) or 1.0)
        shown = f"{run.facts.get('method', '?')}\n{name}".replace("$", r"\$")
        shown += "" if y[0] else f" ({word('absolute')})"
        if not away.any():
            exact.append(shown)
            continue
        _curve(panel, run.t, away, k, lw=0.8, label=shown)
    panel.set_xlabel(time_label(runs[0][1]))
    driven = any(run.facts.get("drives") for _, run in runs)
    change, error = "relative change of the energy", "relative error of the energy"
    panel.set_ylabel(word(change if driven else error))
    _beside(panel, runs[0][1], "\n".join(f"{word('exact:')} {shown}" for shown in exact))


def norms(run: Run) -> dict[str, float]:
    """Vector → its norm at first, of the conserved quantities that are vectors."""
    first: dict[str, list[float]] = {}
    for name, y in run.of_kind("conserved").items():
        first.setdefault(vector_of(name), []).append(float(y[0]))
    return {name: math.hypot(*parts) for name, parts in first.items() if name}


def vector_of(name: str) -> str:
    """Of which vector a conserved quantity is a component; empty where of none."""
    base = re.sub(r"_\d+$", "", name)
    return base if base in KEPT else ""


def time_label(run: Run) -> str:
    """t with its unit."""
    return with_unit("$t$", run.columns[0].unit)


def with_unit(shown: str, unit: str) -> str:
    """A label with its unit, if there is one."""
    return f"{shown} [{unit}]" if unit else shown
