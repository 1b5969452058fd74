"""Work–precision diagrams: of several runs of one motion, or of a table of measurements.

A table is a CSV file with the columns method, work, error, or JSON, a list of objects with these.
"""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..motion.run import Run
from ..motion.run_files import MARK, read
from .plot_sheet import COLOURS, PlotError, ending, look, sheet, written

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
        series, work = of_runs([read(path) for path in paths]), word("evaluations")
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


def of_runs(runs: Sequence[Run]) -> Series:
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
            method = f"{step}, {('tol', 'dt')[chosen]}"
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
        return float(run.facts["evaluations"])
    except (KeyError, TypeError, ValueError):
        raise PlotError("precision: a run without the number of its evaluations") from None


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
