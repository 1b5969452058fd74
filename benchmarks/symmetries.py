"""The times in which the symmetries of the ready-made problems are found, medians.

python -m benchmarks.symmetries [rounds]
"""

from __future__ import annotations

import statistics
import sys
import time

from derive.command.showing import derive, ready_made
from derive.problem.problem import ProblemError
from derive.search.symmetries.conditions import tangent_fields
from derive.search.symmetries.found_symmetries import symmetries_of

AIM = 1.0


def seconds(name: str) -> tuple[int, float]:
    """How many symmetries there are, and the time in which they are found, the walk left out."""
    problem, record = derive(name)
    tangent_fields.cache_clear()
    start = time.perf_counter()
    found = symmetries_of(problem, record)
    return found.dimension, time.perf_counter() - start


def main() -> None:
    """Print the table."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    print(f"{'problem':16}{'symmetries':>12}{'median s':>10}   aim {AIM}")
    for name in ready_made():
        try:
            found = [seconds(name) for _ in range(rounds)]
        except ProblemError as error:
            print(f"{name:16}  {error}")
            continue
        print(f"{name:16}{found[0][0]:12}{statistics.median(t for _, t in found):10.3f}")


if __name__ == "__main__":
    main()
