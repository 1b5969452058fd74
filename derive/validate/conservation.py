"""The test of ``conserved``: along the exact rates its numbers do not change, elsewhere each does.

The rates are those of ``rhs``, which has been found equal to the record, without inputs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ..check.values.arithmetic import EPS, part
from .chart import EPSILON
from .declarations import DiffersError
from .emitted_file import Machine
from .exact_points import Point
from .terms import Array

Numbers = Sequence[Any]


def compare_conserved(
    machine: Machine,
    point: Point,
    x: Numbers,
    k: Numbers,
    draw: Callable[[], Fraction],
    count: int,
) -> str:
    """The name of the function that was found right at a state x; ``DiffersError`` where one of its
    ``count`` numbers is not kept, or is none."""
    at = {**point.arguments, "x": x}

    def run(name: str, changed: Mapping[str, Any], **size: int) -> list[Any]:
        arrays: dict[str, Any] = {"x": x, "k": k, "u": [Fraction(0)] * len(at["u"]), **changed}
        t = arrays.pop("t", at["t"])
        arguments = {x: Array(values, x) for x, values in arrays.items()}
        return [
            y for found in machine.call(name, {"t": t, **arguments}, **size).values() for y in found
        ]

    rates = run("rhs", {}, dx=len(x))
    later = {"x": [y + EPSILON * v for y, v in zip(x, rates, strict=True)]}
    kept = run("conserved", later | {"t": at["t"] + EPSILON}, out=count)
    beside = run("conserved", {"x": [y + EPSILON * draw() for y in x]}, out=count)
    for i, (along, off) in enumerate(zip(kept, beside, strict=True)):
        if part(along, EPS):
            raise DiffersError(f"conserved: number {i} of it is not kept")
        if not part(off, EPS):
            raise DiffersError(f"conserved: number {i} of it says nothing of the state")
    return "conserved"
