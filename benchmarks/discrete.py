"""The discrete step: its cost beside a step of Kutta's method, and its energy over a million steps.

python -m benchmarks.discrete [--rounds N]
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np

import derive

from .peers.report import machine, table

GIVEN = {"m": 2.0, "J_11": 1.3, "J_12": 0.1, "J_13": 0.0, "J_22": 0.9, "J_23": 0.05, "J_33": 0.4}
GIVEN |= {"c_1": 0.1, "c_2": 0.2, "c_3": 0.3, "g_1": 0.0, "g_2": 0.0, "g_3": -9.81}
PROBLEMS = ("top", "so3", "se3", "sl3", "saff3", "heisenberg", "sim3", "sp4", "so4")
WITH_ENERGY = ("so3", "sl3", "so4")
ORDERS, SIZE = (2, 4, 6), {2: 0.01, 4: 0.03, 6: 0.06}
STEPS, LONG, EACH = 1_000, 1_000_000, 20


def compiled(name: str, order: int) -> tuple[Any, np.ndarray[Any, Any]]:
    """A problem with its steps, and a state at 1 with a velocity."""
    f = derive.compile(name, step=("discrete", "rk4"), order=order)
    known = derive.derive(name).problem.parameters
    values = {k: known[k].default for k in f.PARAMETERS}
    f.use({k: GIVEN.get(k, 1.0) if x is None else x for k, x in values.items()})
    x = np.array([float(s[0] == "A" and s[2] == s[-1]) for s in f.STATE])
    group = sum(s[0] in "AT" for s in f.STATE)
    x[group:] = 0.5 * np.random.default_rng(2).normal(size=len(x) - group)
    return f, x


def cost(name: str, rounds: int) -> list[str]:
    """Nanoseconds a step of both, the least of many short rounds, interleaved."""
    f, x = compiled(name, 2)
    best = {"rk4": np.inf, "discrete": np.inf}
    for _ in range(rounds):
        for step in best:
            m, start = f.begin(x), time.perf_counter()
            m.move(SIZE[2], STEPS, step)
            best[step] = min(best[step], (time.perf_counter() - start) / STEPS * 1e9)
    ratio = best["discrete"] / best["rk4"]
    return [name, f"{best['rk4']:.0f}", f"{best['discrete']:.0f}", f"{ratio:.1f}"]


def energy(name: str, order: int) -> list[str]:
    """The largest errors of the energy over 10^4 steps and over 10^6, relative to that first."""
    f, x = compiled(name, order)
    m, first = f.begin(x), f.energy(0, x)
    errors = [
        abs(f.energy(0, m.move(SIZE[order], EACH, "discrete").x) / first - 1)
        for _ in range(LONG // EACH)
    ]
    early, late = max(errors[: 10_000 // EACH]), max(errors)
    return [
        name,
        str(order),
        f"{SIZE[order]}",
        f"{early:.1e}",
        f"{late:.1e}",
        f"{late / early:.2f}",
    ]


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=200)
    rounds = parser.parse_args().rounds
    print(machine(0))
    head = ["problem", "rk4, ns", "discrete, ns", "ratio"]
    print(table("a step", head, [cost(name, rounds) for name in PROBLEMS]))
    head = ["problem", "order", "h", "energy, 10^4 steps", "10^6 steps", "ratio"]
    print(table("energy", head, [energy(name, order) for name in WITH_ENERGY for order in ORDERS]))


if __name__ == "__main__":
    main()
