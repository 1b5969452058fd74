"""Many motions at once, on one core: the emitted ensemble beside heyoka's batches."""

from __future__ import annotations

import ctypes
import time
from contextlib import suppress
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from ..peers.cases import Array, library
from ..peers.native import pointer
from ..peers.report import table
from .cases import MOTIONS, Form
from .curves import Curve, best, interleaved
from .native import BUILDS, built
from .peers import system

COUNT, LANES, SPREAD = 64, 8, 0.01
"""How many motions, how many in a batch, how far apart their velocities begin."""
UNTIL = {"free_top": 1000.0}
"""Where it is not that of one motion."""
GOALS = (1e-6, 1e-9)
TOLERANCES = [10.0**-i for i in range(15, 3, -1)]
OURS = ("ensemble", "gauss, one by one")


def starts(form: Form) -> Array:
    """States beside that of the motion, a row each, on the group; the velocities are the last
    part."""
    rng, x = np.random.default_rng(1), np.tile(form.x, (COUNT, 1))
    last = len(form.parts(form.x)[-1])
    x[:, -last:] *= 1 + SPREAD * rng.normal(size=(COUNT, last))
    return np.asarray(form.module.project(x))


def batches(form: Form, x: Array) -> Any:
    """heyoka, eight motions at a time in the lanes of AVX-512."""
    hy = library("heyoka")
    made: dict[float, Any] = {}

    def run(tol: float) -> tuple[float, Array]:
        if tol not in made:
            made[tol] = hy.taylor_adaptive_batch(
                system(form), x[:LANES].T.copy(), tol=tol, fast_math=True, force_avx512=True
            )
        integrator, end, seconds = made[tol], np.empty_like(x), 0.0
        for i in range(0, COUNT, LANES):
            integrator.set_time(0.0)
            integrator.state[:] = x[i : i + LANES].T
            start = time.perf_counter()
            integrator.propagate_until(form.motion.until)
            seconds += time.perf_counter() - start
            end[i : i + LANES] = integrator.state.T
        return seconds, end

    return run


def ours(form: Form, x: Array, each: int) -> Any:
    """The emitted ensemble, or gauss for one after the other."""
    own = str(form.folder / f"{form.name}.c")
    shared = built(form, "many.c", *BUILDS["native"], own)
    shared.many.restype = ctypes.c_double

    def run(tol: float) -> tuple[float, Array]:
        end = np.empty_like(x)
        until, tolerance = ctypes.c_double(form.motion.until), ctypes.c_double(tol)
        numbers = (pointer(x), pointer(form.k), until, tolerance)
        seconds = shared.many(each, ctypes.c_size_t(COUNT), *numbers, 2, pointer(end))
        return (seconds if seconds > 0 else inf), end

    return run


def many_table(folder: Path, rounds: int) -> str:
    """A row for each motion: µs a motion at an error, heyoka's time over ours."""
    folder.mkdir(exist_ok=True)
    rows = []
    for motion in MOTIONS:
        own = replace(motion, until=UNTIL.get(motion.name, motion.until))
        curves: list[Curve] = []
        for label, options in motion.forms.items():
            form = Form(replace(own, forms={label: (*options, "--ensemble")}), label, folder)
            form.emit()
            x = starts(form)
            _, wanted = ours(form, x, 1)(1e-15)

            def error(found: Array, form: Form = form, wanted: Array = wanted) -> float:
                return max(form.error(a, b) for a, b in zip(found, wanted, strict=True))

            runs = {name: ours(form, x, each) for each, name in enumerate(OURS)}
            with suppress(ImportError):  # said where one motion was timed
                runs["heyoka, batches"] = batches(form, x)
            curves += [Curve(name, label, run, error, TOLERANCES) for name, run in runs.items()]
        interleaved(curves, rounds)
        for goal in GOALS:
            times = [best(curves, [name], goal) for name in (*OURS, "heyoka, batches")]
            shown = [f"{t / COUNT * 1e6:.4g}" for t in times]
            rows.append(
                [motion.name, f"{goal:.0e}", *shown, f"{times[2] / min(times[:2]):.2f}", ""]
            )
    rows.append(["aim", "", "", "", "", "≥ 1.5", "on tops; 2 on the others"])
    head = ["µs a motion", "error", *OURS, "heyoka, batches", "heyoka ÷ ours", ""]
    return table(f"{COUNT} motions at once on one core", head, rows)
