"""Steps in time beside other integrators, at equal error against quad precision.

python -m benchmarks.motion [--rounds N] [--only free_top,p2] [--peers heyoka] [--curves FOLDER]
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Iterable, Sequence
from math import exp, inf, isfinite, log
from pathlib import Path

import numpy as np

from ..peers.report import machine, table
from .cases import MOTIONS, Form, Motion
from .curves import Curve, best, interleaved
from .kept import kept_table
from .many import many_table
from .native import BUILDS, CC, compiled, reference
from .peers import FAST, PEERS

ANGLES = [0.4 * 2 ** (i / 4) for i in range(18)]
"""Fixed steps by their turn at the fastest rate."""
TOLERANCES = [10.0**-i for i in range(16, 3, -1)]
COARSE = [10.0**-i for i in (14, 12, 10, 8, 6)]
OWN = {"gauss": ANGLES, "gauss_to": TOLERANCES, "vern9": ANGLES, "vern9_to": TOLERANCES}


def counts(motion: Motion, angles: Iterable[float]) -> list[float]:
    """Numbers of steps by their angles."""
    return [float(int(motion.until * motion.rate / a) + 1) for a in angles]


def own(form: Form, wanted: np.ndarray) -> list[Curve]:
    """The curves of our own steps, by each build."""
    found = []
    for build in BUILDS:
        steps = compiled(form, build)
        for method, sweep in OWN.items():
            if build == "plain" and not method.startswith("gauss"):
                continue
            parameters = sweep if method.endswith("_to") else counts(form.motion, sweep)

            def run(p: float, steps=steps, method=method):  # type: ignore[no-untyped-def]
                return steps.run(method, p, 3)

            found.append(
                Curve(
                    f"{method} {build}",
                    form.label,
                    run,
                    lambda x: form.error(x, wanted),
                    parameters,
                )
            )
    return found


def others(form: Form, wanted: np.ndarray, names: Sequence[str], first: bool) -> list[Curve]:
    """The curves of the peers; the slow ones in the first form alone."""
    found = []
    for name in names:
        if name not in FAST and not first:
            continue
        try:
            run = PEERS[name](form, compiled(form, "native"))
        except ImportError as problem:
            print(f"left out: {name}: no {problem.name}", file=sys.stderr)
            continue
        sweep = TOLERANCES if name in FAST else COARSE
        found.append(
            Curve(name, form.label, run, lambda x: form.error(x, wanted), sweep, name not in FAST)
        )
    return found


def measured(motion: Motion, folder: Path, peers: Sequence[str], rounds: int) -> list[Curve]:
    """All curves of a motion."""
    curves = []
    for i, label in enumerate(motion.forms):
        form = Form(motion, label, folder)
        form.emit()
        wanted = reference(form)
        curves += own(form, wanted) + others(form, wanted, peers, i == len(motion.forms) - 1)
    interleaved(curves, rounds)
    return curves


GAUSS = {build: [f"gauss {build}", f"gauss_to {build}"] for build in BUILDS}
"""Our step, by its size or by a tolerance, whichever is faster."""


def shown(seconds: float) -> str:
    """A time in µs."""
    return f"{seconds * 1e6:.4g}" if isfinite(seconds) else "–"


def times_table(motion: Motion, curves: Sequence[Curve]) -> str:
    """The time of each method for each error, in its best form, with the ratio to gauss."""
    rows = []
    base = [best(curves, GAUSS["native"], goal) for goal in motion.goals]
    for name in dict.fromkeys(c.method for c in curves):
        own = [c for c in curves if c.method == name]
        found = [best(own, [name], goal) for goal in motion.goals]
        ratios = [f"{t / b:.2f}" if isfinite(t) else "–" for t, b in zip(found, base, strict=True)]
        forms = {min(own, key=lambda c: c.at(goal)).form for goal in motion.goals}
        rows.append([name, *map(shown, found), *ratios, "/".join(sorted(forms))])
    goals = [f"{goal:.0e}" for goal in motion.goals]
    head = ["µs at an error of", *goals, *(f"÷ gauss, {g}" for g in goals), "form"]
    return table(f"{motion.name}, to t = {motion.until:g}", head, rows)


def mean(ratios: Sequence[float]) -> str:
    """The geometric mean, and the least."""
    known = [r for r in ratios if isfinite(r)]
    if not known:
        return "–"
    left_out = f" ({len(ratios) - len(known)} never)" if len(known) < len(ratios) else ""
    return f"{exp(sum(map(log, known)) / len(known)):.2f}, least {min(known):.2f}{left_out}"


Curves = dict[Motion, list[Curve]]


def ratios(all_curves: Curves, over: Sequence[str], under: Sequence[str], i: int) -> list[float]:
    """Of each motion, the time of the best of some methods over that of the best of others."""
    found = []
    for motion, curves in all_curves.items():
        goal = motion.goals[i]
        least = best(curves, under, goal)
        found.append(best(curves, over, goal) / least if isfinite(least) else inf)
    return found


def aims_table(all_curves: Curves) -> str:
    """The aims, and what is measured: geometric means over the motions."""
    verner = ["vern9 {0}", "vern9_to {0}"]
    slow = [name for name in PEERS if name not in FAST]
    rows = []

    def row(label: str, aims: str, over: Sequence[str], under: Sequence[str]) -> None:
        cells = [mean(ratios(all_curves, over, under, i)) for i in range(3)]
        rows.append([label, *cells, aims])

    for build, aims in (("native", "≥ 4, 5, 6.5, least 2"), ("AVX2", "≥ 3, 3.5, 3.5")):
        row(f"heyoka ÷ gauss, {build}", aims, ["heyoka"], GAUSS[build])
    for build, aims in (("native", "≥ 2.5, 3, 4.5"), ("AVX2", "≥ 1.8, 2.2, 2.7")):
        better = ["heyoka", *(name.format(build) for name in verner)]
        row(f"better of heyoka and Verner ÷ gauss, {build}", aims, better, GAUSS[build])
    row("heyoka ÷ gauss by a tolerance", "≥ 2.5", ["heyoka"], ["gauss_to native"])
    for name in slow:
        row(f"{name} ÷ gauss", "≥ 100", [name], GAUSS["native"])
    row("diffrax ÷ gauss in JAX", "≥ 2", ["diffrax"], ["gauss in JAX"])
    row("gauss, AVX2 ÷ native", "≤ 2.5", GAUSS["AVX2"], GAUSS["native"])
    row("gauss, plain loops ÷ native", "≤ 6", GAUSS["plain"], GAUSS["native"])
    head = ["geometric mean over the motions", "coarse", "middle", "fine", "aim"]
    return table("at equal error", head, rows)


def tolerance_table(all_curves: Curves) -> str:
    """The error of the adaptive steps over the tolerance that they are given."""
    rows = []
    for motion, curves in all_curves.items():
        for curve in curves:
            if curve.method in ("gauss_to native", "vern9_to native"):
                points = dict(zip(curve.parameters, curve.errors, strict=True))
                cells = [f"{points[tol] / tol:.2g}" for tol in (1e-6, 1e-9, 1e-12)]
                rows.append([motion.name, curve.form, curve.method, *cells, "≤ 20"])
    head = ["motion", "form", "method", "1e-6", "1e-9", "1e-12", "aim"]
    return table("error at the end ÷ tolerance", head, rows)


def main(argv: Sequence[str] | None = None) -> int:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.motion", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", default=",".join(m.name for m in MOTIONS))
    parser.add_argument("--peers", default=",".join(PEERS))
    parser.add_argument("--curves", type=Path, help="a folder for all points, for derive plot")
    given = parser.parse_args(argv)
    peers = [name for name in given.peers.split(",") if name]
    print(machine(0), end="")
    for build, flags in BUILDS.items():
        print(f"{build:10} {CC} {' '.join(flags).format(name='NAME')}")
    print()
    all_curves: Curves = {}
    with tempfile.TemporaryDirectory() as name:
        for motion in MOTIONS:
            if motion.name in given.only.split(","):
                all_curves[motion] = measured(motion, Path(name), peers, given.rounds)
                print(times_table(motion, all_curves[motion]), flush=True)
        print(aims_table(all_curves))
        print(tolerance_table(all_curves))
        print(kept_table(Path(name, "kept")))
        print(many_table(Path(name, "many"), given.rounds))
    for motion, curves in all_curves.items() if given.curves else ():
        given.curves.mkdir(parents=True, exist_ok=True)
        points = json.dumps([x for c in curves for x in c.record], indent=1)
        (given.curves / f"{motion.name}.json").write_text(points + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
