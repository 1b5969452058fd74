"""The worst error of every output of the emitted code against 50 digits, over random states.

python -m benchmarks.accuracy [--states N] [--only so3,se3] [--jobs 2]

N states of each problem, a hundred thousand, are shared out among the forms of its code.  The error
of a number is in units in the last place (2⁻⁵² of it) of the sum of the magnitudes of the terms
that the record's equation has for it; the last column is the worst raw error of an acceleration,
where the terms may cancel.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from functools import cache

from .measure import Worst
from .rows import PROBLEMS, STATES, Row, joined

BODIES = 125
"""In one piece of work."""
OUTPUTS = ("dg", "dζ", "dw", "dv", "energy", "constants")
LABELS = ("dg/dt", "dζ/dt", "dw/dt", "d²g/dt²", "energy", "constants", "raw")


@cache
def row(problem: str, form: str) -> Row:
    """Kept with what was compiled for it."""
    return Row(problem, form)


def piece(problem: str, form: str, seed: int) -> dict[str, Worst]:
    """One measurement."""
    return row(problem, form).measure(BODIES, seed)


def line(problem: str, form: str, states: int, found: dict[str, Worst]) -> str:
    """A row of the table."""
    cells = [f"{found[x].scaled:.2f}" if x in found else "" for x in OUTPUTS]
    raw = max(found[x].raw for x in ("dζ", "dw", "dv") if x in found)
    shown = "".join(f"{x:>11}" for x in (*cells, f"{raw:.0e}"))
    return f"{problem:12}{form:20}{states:8}{shown}"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.accuracy", description=__doc__)
    parser.add_argument("--states", type=int, default=100_000, help="of each problem")
    parser.add_argument("--only", default=",".join(PROBLEMS), help="problems")
    parser.add_argument("--jobs", type=int, default=2, help="processes")
    chosen = parser.parse_args()
    print(f"{'':12}{'':20}{'states':>8}" + "".join(f"{x:>11}" for x in LABELS), flush=True)
    with ProcessPoolExecutor(chosen.jobs) as pool:
        for problem in chosen.only.split(","):
            forms = PROBLEMS[problem]
            pieces = max(1, round(chosen.states / len(forms) / BODIES / STATES))
            work = {
                form: [pool.submit(piece, problem, form, seed) for seed in range(pieces)]
                for form in forms
            }
            for form, futures in work.items():
                found = joined([x.result() for x in futures])
                print(line(problem, form, pieces * BODIES * STATES, found), flush=True)


if __name__ == "__main__":
    main()
