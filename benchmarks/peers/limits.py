"""The machine's limits, measured in the same run: vector multiplications, memory."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable
from pathlib import Path

from .cases import HERE
from .native import aligned, compile_shared, copy, pointer

ROUNDS = 200_000
CHAINS = 12


def nanoseconds(action: Callable[[], object]) -> float:
    """The time of one action."""
    start = time.perf_counter_ns()
    action()
    return float(time.perf_counter_ns() - start)


class Limits:
    """Times of one multiplication and of one byte, best of the ways to do it."""

    def __init__(self, folder: Path) -> None:
        self.library = compile_shared([copy(HERE / "limits.c", folder)], [], folder)
        for name in ("multiply_narrow", "multiply_wide"):
            getattr(self.library, name).restype = ctypes.c_double

    def multiply(self) -> float:
        """Nanoseconds of a multiplication among independent ones, in registers."""
        count, factor = ctypes.c_size_t(ROUNDS), ctypes.c_double(1.0)

        def each(name: str, lanes: int) -> float:
            run = getattr(self.library, name)
            times = [nanoseconds(lambda: run(count, factor)) for _ in range(15)]
            return min(times) / (ROUNDS * CHAINS * lanes)

        return min(each("multiply_narrow", 4), each("multiply_wide", 8))

    def state(self, rows: int, states: int, rounds: int) -> float:
        """Nanoseconds to read and write the numbers of a state, each row a stream of its own."""
        source, target = aligned(rows * states), aligned(rows * states)
        source += 1.0
        size, factor = ctypes.c_size_t(states), ctypes.c_double(0.5)
        repeat = max(1, 100_000 // states)
        again, many = ctypes.c_size_t(repeat), ctypes.c_size_t(rows)
        arguments = (again, many, size, factor, pointer(source), pointer(target))

        def several() -> None:
            self.library.stream_rows(*arguments)

        several()
        return min(nanoseconds(several) for _ in range(rounds)) / (repeat * states)
