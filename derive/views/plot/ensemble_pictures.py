"""Pictures of ensembles, and work–precision diagrams."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Mapping, Sequence
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np

from ...language.reserved import did_you_mean, near_name
from ...motion.ensemble import Ensemble
from ...motion.run import MARK, Array, Run, called, read, shown
from .body_pictures import ATTITUDE
from .plot_sheet import COLOURS, PlotError, ending, label, look, sheet, with_unit, written

# Pictures of ensembles: how its motions spread in time, and where they are at the end.

PANELS, WIDE = 12, 3
"""The most panels where no columns are chosen, and how many stand side by side."""

ROWS, ACROSS = 6, 4
"""The most columns of the state against what is varied, and the most of what is varied."""

BANDS = ((0.05, 0.95, 0.2), (0.25, 0.75, 0.35))
"""Quantiles between which a band is drawn, with its strength."""

POINTS = 2000
"""So many motions are drawn as points: of more, every k-th, so that a file can be opened."""

THIRD_AXIS = ("A_13", "A_23", "A_33")
"""Where the third axis of a body points in space."""

TIME = "t"
"""The row of the time of the end."""

SAME = 1e-13
"""A column whose values differ by less, relative to the largest, is the same in all motions."""


def differing(e: Ensemble, chosen: Sequence[str], most: int) -> list[str]:
    """The columns that are drawn: those chosen, or the first of the state that differ from motion
    to motion at the end, of a turn of R³ its last column alone; ``PlotError`` for names that it has
    not."""
    chosen = [called(e.facts, name) for name in chosen]
    for name in chosen:
        if name not in e.names:
            near = did_you_mean(near_name(name, e.names), after=" ")
            raise PlotError(f"no column {name[:40]!r}; {near}there are {', '.join(e.names[:40])}")
    turned = e.facts.get("group") in ("SO(3)", "SE(3)") and {*ATTITUDE} <= {*e.names}
    there = [x for x in e.names if not turned or x not in ATTITUDE or x in THIRD_AXIS]
    return [*chosen] or [x for x in there if _differs(at_end(e, x))][:most] or [*there[:most]]


def named(e: Ensemble, name: str) -> str:
    """A column, what is varied or the time, with its unit."""
    return with_unit(label(shown(e.facts, name)), e.facts.get("units", {}).get(name, ""))


def _differs(end: Array) -> bool:
    there = end[np.isfinite(end)]
    return bool(len(there) and np.ptp(there) > SAME * np.abs(there).max())


def at_end(e: Ensemble, name: str) -> Array:
    """A column at the end of each motion, at its event where it ended at one; no number for one
    that went wrong.  ``t`` is the time of it."""
    j = -1 if name == TIME else e.names.index(name)
    last = np.full(len(e.status), e.t[-1]) if name == TIME else e.states[:, -1, j]
    if not e.at_event.any():
        return np.where(e.status == 0, last, math.nan)
    return np.where(e.at_event, e.end[:, 1 + j], np.where(e.status == 0, last, math.nan))


def fits_spread(e: Ensemble) -> bool:
    """Are there instants between which something spreads?"""
    return len(e.t) > 1 and fits_ends(e)


def fits_ends(e: Ensemble) -> bool:
    """Did any motion reach the end, or an event that ends it?"""
    return bool(((e.status == 0) | e.at_event).any())


def size_of_spread(e: Ensemble, chosen: Sequence[str]) -> tuple[float, float]:
    """Width and height of :func:`spread`."""
    count = len(differing(e, chosen, PANELS))
    return max(4.8, 0.4 + 2.5 * min(count, WIDE)), 0.8 + 1.6 * max(1, math.ceil(count / WIDE))


def spread(figure: Any, e: Ensemble, word: Any, chosen: Sequence[str]) -> None:
    """Each column in time, a panel each: its median, and bands from the 5th percentile to the
    95th and from the 25th to the 75th, over the motions that go on at an instant, up to where
    fewer than half of them do."""
    names = differing(e, chosen, PANELS)
    panels = _panels(figure, len(names))
    cut = False
    for panel, name in zip(panels, names, strict=True):
        levels = [x for low, high, _ in BANDS for x in (low, high)]
        found, are_few = quantiles(e, name, [0.5, *levels])
        cut = cut or are_few
        for k, (*_, strength) in enumerate(BANDS):
            low, high = found[1 + 2 * k], found[2 + 2 * k]
            panel.fill_between(e.t, low, high, color=COLOURS[0], alpha=strength, lw=0)
        panel.plot(e.t, found[0], c=COLOURS[0])
        panel.set_ylabel(named(e, name))
        panel.set_xlim(e.t[0], e.t[-1])
    for panel in panels[-WIDE:]:
        panel.set_xlabel(named(e, TIME))
    told = f"{word('median, bands of 50 % and 90 %')} – {reached(e, word)}"
    told += f"\n{word('drawn while at least half of the motions go on')}" * cut
    figure.suptitle(told, fontsize=8)


def quantiles(e: Ensemble, name: str, levels: Sequence[float]) -> tuple[Array, bool]:
    """Quantiles of a column at each instant, (levels, instants), over the motions that are there,
    NaN where these are fewer than half of the most there are: who is left last is no sample of
    all; and is this so anywhere?  One instant after the other, so that an ensemble on the disk need
    not fit in memory."""
    j, rows, counts = e.names.index(name), [], []
    for i in range(len(e.t)):
        values = np.asarray(e.states[:, i, j], dtype=float)
        values = values[np.isfinite(values)]
        counts.append(len(values))
        rows.append(np.quantile(values, levels) if len(values) else [math.nan] * len(levels))
    few = 2 * np.array(counts) < max(counts)
    return np.where(few, math.nan, np.array(rows).T), bool(few.any())


def _panels(figure: Any, count: int) -> list[Any]:
    """So many panels, side by side, the last row filled from the left."""
    wide = min(count, WIDE)
    grid = figure.subplots(math.ceil(count / wide), wide, sharex=True, squeeze=False).ravel()
    for k, panel in enumerate(grid):
        panel.set_visible(k < count)
        panel.tick_params(labelbottom=k >= count - wide)
    return [*grid[:count]]


def _rows(e: Ensemble, chosen: Sequence[str]) -> list[str]:
    """The rows of :func:`ends`: the time where events end motions, then the columns."""
    first = [TIME] if e.at_event.any() else []
    return [*first, *differing(e, chosen, ROWS)]


def size_of_ends(e: Ensemble, chosen: Sequence[str]) -> tuple[float, float]:
    """Width and height of :func:`ends`."""
    across, rows = len(e.varied_names[:ACROSS]), max(1, len(_rows(e, chosen)))
    if across == 1:
        return max(4.8, 0.4 + 2.5 * min(rows, WIDE)), 0.8 + 1.6 * math.ceil(rows / WIDE)
    return 1.0 + 2.3 * across, 0.8 + 1.5 * rows


def ends(figure: Any, e: Ensemble, word: Any, chosen: Sequence[str]) -> None:
    """The state at the end against what is varied, a point each motion, a row of panels each
    column, or where one thing is varied a panel; of one that ended at an
    event the state there, in another colour, and the time; a mark below stands for one that went
    wrong."""
    names, varied = _rows(e, chosen), e.varied_names[:ACROSS]
    if len(varied) == 1:
        several = _panels(figure, len(names))
        grid, lowest = [[x] for x in several], several[-WIDE:]
    else:
        grid = figure.subplots(len(names), len(varied), sharex="col", sharey="row", squeeze=False)
        lowest = grid[-1]
    events, good = e.at_event, e.status == 0
    groups = [(_thinned(np.flatnonzero(x)), c) for x, c in ((good, 0), (events, 2)) if x.any()]
    lost = _thinned(np.flatnonzero(~(good | events)))
    for row, name in zip(grid, names, strict=True):
        end = at_end(e, name)
        for k, panel in enumerate(row):
            for which, c in groups:
                style = {"c": COLOURS[c], "ms": 2.5, "alpha": 0.6, "mew": 0}
                panel.plot(e.varied[which, k], end[which], ".", **style)
            if len(lost):
                panel.plot(e.varied[lost, k], np.full(len(lost), 0.02), "|", c=COLOURS[1],
                           ms=5, transform=panel.get_xaxis_transform())  # fmt: skip
        row[0].set_ylabel(named(e, name))
    for panel, name in zip(lowest, cycle(varied)):
        panel.set_xlabel(f"{named(e, name)}, {word('varied')}")
    unit = e.facts.get("units", {}).get(TIME, "")
    last = f"$t = {e.t[-1]:g}$ {unit}".strip()
    figure.suptitle(f"{last} – {reached(e, word)}", fontsize=8)


def _thinned(motions: Any) -> Any:
    return motions[:: max(1, math.ceil(len(motions) / POINTS))]


def reached(e: Ensemble, word: Any) -> str:
    """How many motions reached the end, of how many, and how many an event that ended them."""
    ended = int(e.at_event.sum())
    told = f"{int((e.status == 0).sum())}/{len(e.status)} {word('motions to the end')}"
    return f"{told}, {ended} {word('to an event')}" if ended else told


# Work–precision diagrams: of several runs of one motion, or of a table of measurements.
#
# A table is a CSV file with the columns method, work, error, or JSON, a list of objects with
# these.

Series = Mapping[str, Sequence[tuple[float, float]]]
"""Method → (work, error)."""

COLUMNS = ("method", "work", "error")
MARKS = "osD^vPX"


def plot_precision(paths: Sequence[Path], name: str, word: Any = str, mark: str = ".") -> bytes:
    """The bytes of the diagram of runs, or of one table; the ending of ``name`` is the format."""
    ending(name)
    if len(paths) == 1:
        series, work = table(paths[0]), word("work")
    else:
        series, work = of_runs([read(path) for path in paths], word), word("evaluations")
    with look():
        figure = sheet(5.0, 3.6)
        draw(figure, series, work, word)
        return written(figure, name, mark)


def draw(figure: Any, series: Series, work: str, word: Any) -> None:
    """Work against error, both in powers of ten, a line each method."""
    panel = figure.subplots()
    for k, (method, points) in enumerate(series.items()):
        error, cost = np.array(sorted((e, w) for w, e in points)).T
        style = MARKS[k % len(MARKS)] + ("-", "--", ":")[k // len(COLOURS) % 3]
        panel.loglog(error, cost, style, c=COLOURS[k % len(COLOURS)], ms=4, label=method)
    panel.invert_xaxis()
    panel.set(xlabel=word("error"), ylabel=work)
    panel.grid(visible=True, lw=0.3, alpha=0.6)
    panel.legend(loc="center left", bbox_to_anchor=(1, 0.5))


HOW = ("to a tolerance", "with steps of one size")


def of_runs(runs: Sequence[Run], word: Any = str) -> Series:
    """Evaluations and error at the last instant by method, relative to the largest number of the
    state there; against the run of the least tolerance, or else of the shortest steps, which is
    left out."""
    best = min(runs, key=_fineness)
    found: dict[str, list[tuple[float, float]]] = {}
    for run in runs:
        if _motion(run) != _motion(best):
            raise PlotError("precision needs runs of one motion, with one start and one last time")
        if run is not best:
            away = np.abs(run.states[-1] - best.states[-1]).max() / np.abs(best.states[-1]).max()
            chosen, _ = _fineness(run)
            step = str(run.facts["method"]).partition(",")[0]
            method = f"{word(step)}, {word(HOW[chosen])}"
            found.setdefault(method, []).append((_work(run), max(float(away), 1e-17)))
    return found


def _motion(run: Run) -> tuple[Any, ...]:
    """What runs of one motion have in common."""
    told = [run.facts.get(x) for x in ("hash", "parameters", "inputs")]
    return run.names, run.t[-1:].tolist(), told, run.states[:1].tolist()


def _fineness(run: Run) -> tuple[int, float]:
    """0 and the tolerance, or 1 and the size of steps."""
    match = re.search(r"(tol|dt) (\S+)$", str(run.facts.get("method", "")))
    if match is None:
        raise PlotError("precision: a run that does not say its tolerance or the size of its steps")
    return ("tol", "dt").index(match[1]), float(match[2])


def _work(run: Run) -> float:
    try:
        count = float(run.facts["evaluations"])
    except (KeyError, TypeError, ValueError):
        raise PlotError("precision: a run without the number of its evaluations") from None
    if not count > 0:
        raise PlotError(
            "precision: discrete steps evaluate no rate, so that their work is not counted: "
            "leave their runs out, or give a table of method, work, error"
        )
    return count


def table(path: Path) -> Series:
    """The measurements in a file; ``PlotError`` where there are none."""
    try:
        text = path.read_text(encoding="utf-8")
        if "# {" in text[:10_000] and MARK in text[:10_000]:
            raise PlotError("precision needs several runs, or a table of method, work, error")
        rows = json.loads(text) if path.suffix == ".json" else csv.DictReader(io.StringIO(text))
        found: dict[str, list[tuple[float, float]]] = {}
        for row in rows:
            method, work, error = (row[x] for x in COLUMNS)
            found.setdefault(str(method)[:40], []).append((_positive(work), _positive(error)))
    except OSError as error:
        raise PlotError(f"{path}: {error.strerror}") from None
    except (UnicodeDecodeError, ValueError, KeyError, TypeError, csv.Error) as error:
        if isinstance(error, PlotError):
            raise
        raise PlotError(
            f"{path}: no table of method, work, error, the last two above 0; or give several runs"
        ) from None
    if not found:
        raise PlotError(f"{path}: a table without rows")
    return found


def _positive(x: Any) -> float:
    found = float(x)
    if not (math.isfinite(found) and found > 0):
        raise ValueError(x)
    return found
