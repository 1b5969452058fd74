"""Whole-process times of ``derive integrals`` over that of ``import sympy``; and of the search and
the walk as the degree grows, for a heavy top with all moments distinct.

python -m benchmarks.integrals [rounds]
"""

from __future__ import annotations

import statistics
import sys
import time

from derive import SO, Lagrangian, Problem, first_integrals

from .road import seconds

NAMES = ("euler_top", "lagrange_top", "kovalevskaya_top", "manakov", "gyrostat", "kirchhoff")
AIM = 4.0
DEGREES = range(2, 11, 2)
HEAVY = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2)/2 - A_31 - 2*A_33"


def main() -> None:
    """Print the table."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    times: dict[str, list[float]] = {}
    for _ in range(rounds):
        times.setdefault("import sympy", []).append(seconds(["-c", "import sympy"]))
        for name in NAMES:
            command = ["-m", "derive", "integrals", name, "--degree", "4"]
            times.setdefault(name, []).append(seconds(command))
    unit = statistics.median(times["import sympy"])
    print(f"derive integrals, degree 4, over `import sympy` ({unit:.2f} s); aim {AIM:g}")
    for name in NAMES:
        t = statistics.median(times[name])
        print(f"{name:18}{t:7.2f} s{t / unit:7.1f}")
    top = Problem("heavy", SO(3), Lagrangian(HEAVY))
    first_integrals(top, 1)
    for degree in DEGREES:
        start = time.perf_counter()
        first_integrals(top, degree)
        print(f"a heavy top, degree {degree:2}: {time.perf_counter() - start:.2f} s")


if __name__ == "__main__":
    main()
