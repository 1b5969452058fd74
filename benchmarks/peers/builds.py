"""Our code and the expert's by several compilers and levels, each with the same flags."""

from __future__ import annotations

import random
import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from .cases import Array
from .native import Build, Native, error
from .report import table

LEVELS = (("-O3", "-march=native"), ("-O2", "-march=native"), ("-O3",), ("-O2",))
BUILDS = tuple(Build(compiler, level) for compiler in ("gcc", "clang") for level in LEVELS)
QUANTILE = 0.1
"""Of the times of a function: what else runs on the machine makes others longer."""
EVALUATIONS, TOLERANCE = 30_000, 1e-11


def builds_table(
    name: str, expert: Native, ours: Sequence[tuple[Native, Array]], folder: Path, rounds: int
) -> str:
    """Nanoseconds of the expert's code; those of each of ours with the ratio to it.

    ``ours``: with what is right of each.
    """
    rows = []
    for build in BUILDS:
        if shutil.which(build.compiler) is None:
            rows.append([str(build), *[""] * (len(ours) + 1), "not installed"])
            continue
        made = [replace(one) for one in (expert, *(one for one, _ in ours))]
        for one in made:
            one.build(folder, build)
            one.run(1)
        for one, (_, wanted) in zip(made[1:], ours, strict=True):
            if not error(one.out, wanted) < TOLERANCE:
                raise RuntimeError(f"{one.name} by {build} is wrong")
        hand, *others = quantiles(made, rounds)
        shown = [f"{ns:.1f} ({ns / hand:.2f})" for ns in others]
        rows.append([str(build), f"{hand:.1f}", *shown, ""])
    head = ["flags", "expert", *(one.name for one, _ in ours), ""]
    return table(f"{name}, by each compiler: ns, and the ratio to the expert's code", head, rows)


def quantiles(natives: Sequence[Native], rounds: int) -> list[float]:
    """The low quantile of the times of each, taken in a new order each round."""
    times = np.zeros((rounds, len(natives)))
    order = random.Random(1)
    for row in times:
        for i in order.sample(range(len(natives)), len(natives)):
            row[i] = natives[i].nanoseconds(max(1, EVALUATIONS // len(natives[i].states)))
    return [float(x) for x in np.quantile(times, QUANTILE, axis=0)]
