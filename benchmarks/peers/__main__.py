"""Ours, an expert's and the peers' code, side by side, on the same random states.

python -m benchmarks.peers [--rounds N] [--only p1,p2] [--peers casadi,numba] [--flags=-ffast-math]
"""

from __future__ import annotations

import argparse
import os
import random
import statistics
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from . import batch, generators, mechanics, native, oracle, ours, python_calls
from .builds import builds_table
from .cases import GROUPS, Array, Case, Emitted, draw, states
from .count import number
from .limits import Limits
from .native import Native
from .report import machine, table

STATES = 64
SIZES = (120, 1_000_000)
SLICE = 60_000
TOLERANCE = 1e-11

PEERS: dict[str, Callable[[Case, Array, Path], Native]] = {
    "casadi": generators.casadi,
    "symforce": generators.symforce,
    "wrenfold": generators.wrenfold,
    "sympy": generators.sympy,
    "casadi_from_l": mechanics.casadi_from_l,
    "kane": mechanics.kane,
    "pinocchio": mechanics.pinocchio,
}


def attempt(
    name: str, make: Callable[[], Native], wanted: Array, folder: Path, refused: dict[str, str]
) -> Native | None:
    """Build an implementation and check it; where that fails, say why."""
    try:
        made = make()
        made.build(folder)
    except ImportError as problem:
        refused[name] = f"not installed ({problem.name})"
    except RuntimeError as problem:
        refused[name] = str(problem)
    except Exception as problem:
        refused[name] = f"{type(problem).__name__}: {str(problem).splitlines()[0][:110]}"
    else:
        made.run(1)
        wrong = native.error(made.out, wanted[:, made.rows] if made.rows else wanted)
        if wrong < TOLERANCE:
            return made
        refused[made.name] = f"wrong: {wrong:.1e}"
    return None


def scalar(natives: list[Native], rounds: int) -> dict[str, tuple[float, float, float]]:
    """In a new order each round: the median, the best, the median of the ratios to the expert."""
    times: dict[str, list[float]] = {made.name: [] for made in natives}
    order = random.Random(1)
    for _ in range(rounds):
        for made in order.sample(natives, len(natives)):
            times[made.name].append(made.nanoseconds(max(1, SLICE // STATES)))
    expert = np.array(times["expert"])
    return {
        name: (statistics.median(t), min(t), float(np.median(np.array(t) / expert)))
        for name, t in times.items()
    }


def scalar_table(title: str, natives: list[Native], refused: dict[str, str], rounds: int) -> str:
    """One state a call."""
    rows = []
    for made, (median, best, ratio) in zip(natives, scalar(natives, rounds).values(), strict=True):
        counts = [str(number(made.operations, n) or "") for n in ("mul", "add", "div")]
        rows.append([made.name, *counts, f"{median:.1f}", f"{best:.1f}", f"{ratio:.2f}", made.note])
    rows += [[name, *[""] * 6, why] for name, why in refused.items()]
    head = ["one state a call", "mul", "add", "div", "ns", "best", "ratio", ""]
    return table(title, head, rows)


def batch_table(
    case: Case, natives: dict[str, Native], emitted: Emitted, limits: Limits, rounds: int
) -> str:
    """Many states a call, against the limits: vector arithmetic; out of cache also a plain copy.

    Additions go through the ports of the multiplications, so both count.  The fraction is that of
    the best times, as the limits are best times: what else runs on the machine slows the median.
    """
    rows, one = [], limits.multiply()
    count = sum(number(natives["expert"].operations, x) for x in ("mul", "add"))
    for size in SIZES:
        x = states(case, size)
        checked = np.asarray(emitted.module.rhs(0.0, x, natives["ours"].constants))
        checked[:1000] = oracle.derivative(case, x[:1000])
        ways, refused = batch.candidates(case, x, natives, emitted)
        refused |= batch.measure(ways, checked, rounds)
        memory = limits.state(case.size, size, rounds)
        compute = count * one
        told = [f"{compute:.2f}", f"{memory:.2f}"]
        rows.append([f"limit: {count} mul and add", str(size), "", told[0], "", "in registers"])
        rows.append([f"limit: {2 * case.size} streams", str(size), "", told[1], "", "copied"])
        bound = compute if size < 10_000 else max(compute, memory)
        for way in ways:
            ns, best = statistics.median(way.times), min(way.times)
            shown = [f"{ns:.2f}", f"{best:.2f}", f"{bound / best:.0%}"]
            rows.append([way.name, str(size), *shown, way.note])
        rows += [[name, str(size), "", "", "", why] for name, why in refused.items()]
    return table(
        f"{case.name}, many states",
        ["structure of arrays", "states", "ns/state", "best", "of limit", ""],
        rows,
    )


def run(name: str, chosen: list[str], rounds: int, folder: Path, limits: Limits) -> None:
    """All the tables of one problem."""
    case = draw(name)
    x = states(case, STATES)
    wanted, refused = oracle.derivative(case, x), dict[str, str]()
    emitted, own = ours.ours(case, x, folder)
    first = attempt("derive (ours)", lambda: own, wanted, folder, refused)
    hand = attempt(
        "expert", lambda: ours.expert(case, x, folder, emitted.parameters), wanted, folder, refused
    )
    if first is None or hand is None:
        raise SystemExit(f"{name}: {refused}")
    made, own_ways = [first, hand], [(first, wanted)]
    for one, there in ours.framed(case, x, wanted, folder):
        checked = attempt(one.name, lambda m=one: m, there, folder, refused)  # type: ignore[misc]
        made += [checked] if checked else []
        own_ways += [(checked, there)] if checked else []
    for peer in chosen:
        maker = PEERS[peer]
        built = attempt(peer, lambda m=maker: m(case, x, folder), first.out, folder, refused)  # type: ignore[misc]
        made += [built] if built else []
    title = f"{name}: {GROUPS[name]}, {case.size} numbers of state"
    print(scalar_table(title, made, refused, rounds), flush=True)
    print(builds_table(name, hand, own_ways, folder, 3 * rounds), flush=True)
    pair = {"ours": first, "expert": hand}
    print(batch_table(case, pair, emitted, limits, max(5, rounds // 3)), flush=True)
    if name == "p1":
        calls = python_calls.measure(case, x[0], wanted[0], emitted, max(5, rounds // 3))
        head = ["one state a call", "time"]
        print(table("p1, from Python", head, [list(pair) for pair in calls.items()]), flush=True)


def main() -> None:
    """Build, check, time and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peers", description=__doc__)
    parser.add_argument("--rounds", type=int, default=31)
    parser.add_argument("--only", default=",".join(GROUPS), help="problems")
    parser.add_argument("--peers", default=",".join(PEERS), help="generators of code")
    parser.add_argument("--flags", default="", help="more flags for both compilers")
    parser.add_argument("--build", type=Path, help="a folder that keeps what is compiled")
    chosen = parser.parse_args()
    native.FLAGS.extend(chosen.flags.split())
    cpu = max(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {cpu})
    print(machine(cpu), flush=True)
    peers = [peer for peer in chosen.peers.split(",") if peer]
    with tempfile.TemporaryDirectory() as temporary:
        folder = chosen.build or Path(temporary)
        limits = Limits(folder)
        for name in chosen.only.split(","):
            run(name, peers, chosen.rounds, folder / name, limits)


if __name__ == "__main__":
    main()
