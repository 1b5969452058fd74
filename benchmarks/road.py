"""Whole-process times of the commands over that of ``import sympy``, interleaved, medians.

python -m benchmarks.road [rounds]
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time

COMMANDS = {
    "import sympy": ["-c", "import sympy"],
    "walk so3": ["-m", "derive", "walk", "so3"],
    "walk se3": ["-m", "derive", "walk", "se3"],
    "walk sl3": ["-m", "derive", "walk", "sl3"],
    "emit so3": ["-m", "derive", "emit", "so3", "--out", "{out}"],
    "emit sl3": ["-m", "derive", "emit", "sl3", "--out", "{out}"],
    "notes .tex": ["-m", "derive", "notes", "so3", "se3", "sl3", "--out", "{out}/notes.tex"],
    "notes .html": ["-m", "derive", "notes", "so3", "se3", "sl3", "--out", "{out}/notes.html"],
}
TARGET, NOTES = 2.0, 4.0


def seconds(arguments: list[str]) -> float:
    """The wall time of one process."""
    start = time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
    return time.perf_counter() - start


def measure(rounds: int) -> dict[str, list[float]]:
    """Every command once a round, so that a slow moment falls on all of them."""
    times: dict[str, list[float]] = {name: [] for name in COMMANDS}
    with tempfile.TemporaryDirectory() as out:
        for _ in range(rounds + 1):
            for name, arguments in COMMANDS.items():
                times[name].append(seconds([a.format(out=out) for a in arguments]))
    return {name: t[1:] for name, t in times.items()}


def main() -> None:
    """Print the table."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    times = measure(rounds)
    unit = statistics.median(times["import sympy"])
    print(f"{'command':16}{'median s':>10}{'ratio':>8}   aim {TARGET}, notes {NOTES}")
    for name, t in times.items():
        print(f"{name:16}{statistics.median(t):10.3f}{statistics.median(t) / unit:8.2f}")


if __name__ == "__main__":
    main()
