"""The state against time, and how well what motions keep was kept."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..language.suffixed import by_letter
from ..motion.kept_words import KEPT, in_words
from ..motion.run import Column, Run
from .plot_sheet import COLOURS, label

MOST = 12
"""So many curves a panel: of more, the first are drawn."""


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
        for k, x in enumerate(members[:MOST]):
            style = ("-", "--", ":")[k // len(COLOURS) % 3]
            panel.plot(run.t, run[x.name], style, c=COLOURS[k % len(COLOURS)], label=label(x.name))
        units = {x.unit for x in members}
        panel.set_ylabel(with_unit(label(key), units.pop() if len(units) == 1 else ""))
        panel.legend(loc="center left", bbox_to_anchor=(1, 0.5), ncols=1 + (len(members) > 6))
    panels[-1].set_xlabel(time_label(run))


def energy(figure: Any, run: Run, word: Any) -> None:
    """|E − E₀| / |E₀| of the energy and of every conserved quantity, of a component of a vector by
    that of the vector; of what begins at 0, the difference itself.  What is exact has no place on
    the axis: it is left out.  It is no error where damping, an input or the time changes them."""
    panel, exact, sizes = figure.subplots(), [], norms(run)
    kept = {**run.of_kind("energy"), **run.of_kind("conserved")}.items()
    for k, (name, y) in enumerate(kept):
        scale = sizes.get(vector_of(name), abs(y[0]))
        away = np.abs(y - y[0]) / (scale or 1.0)
        shown = in_words(name, word)
        if not away.any():
            exact.append(shown)
            continue
        shown += "" if scale else f" ({word('absolute')})"
        style = ("-", "--", ":")[k // len(COLOURS) % 3]
        away[away == 0] = np.nan
        panel.semilogy(run.t, away, style, c=COLOURS[k % len(COLOURS)], label=shown)
    if exact:
        panel.plot([], [], " ", label=f"{word('exact:')} {', '.join(exact)}")
    panel.set_xlabel(time_label(run))
    vectors = any(abs(y[0]) < sizes.get(vector_of(x), 0) for x, y in kept)
    told = word("components relative to the length of their vector") if vectors else ""
    error = word("relative change" if run.facts.get("drives") else "relative error")
    panel.set_ylabel(f"{error}\n{told}".strip())
    panel.legend(loc="center left", bbox_to_anchor=(1, 0.5))


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
        style = ("-", "--", ":")[k // len(COLOURS) % 3]
        away[away == 0] = np.nan
        panel.semilogy(run.t, away, style, c=COLOURS[k % len(COLOURS)], lw=0.8, label=shown)
    for shown in exact:
        panel.plot([], [], " ", label=f"{word('exact:')} {shown}")
    panel.set_xlabel(time_label(runs[0][1]))
    driven = any(run.facts.get("drives") for _, run in runs)
    change, error = "relative change of the energy", "relative error of the energy"
    panel.set_ylabel(word(change if driven else error))
    panel.legend(loc="center left", bbox_to_anchor=(1, 0.5))


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
