"""What the templates of explicit Runge–Kutta steps are filled with."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any

from .tableaux import Tableau, rk4, vern9

METHODS: dict[str, tuple[Callable[[], Tableau], str]] = {
    "rk4": (rk4, "Kutta's method of order 4"),
    "vern9": (vern9, "Verner's pair of orders 9 and 8"),
}
"""Name of a step → its method, and what it is called."""

GROWTH, SAFETY = 5.0, 0.9
"""By how much a step may grow, and the part taken of what its error suggests."""


def explicit(names: Iterable[str], number: Callable[[Fraction], str]) -> dict[str, Any] | None:
    """The explicit ones of these steps, and the most stages of any; ``None`` without any."""
    found = [fields_of(name, number) for name in names if name in METHODS]
    if not found:
        return None
    return {
        "methods": found,
        "stages": max(len(method["main"]) for method in found),
        "rows": max(method["rows"] for method in found),
        "extra": any(method["extra"] for method in found),
        "growth": GROWTH,
        "safety": SAFETY,
    }


def fields_of(name: str, number: Callable[[Fraction], str]) -> dict[str, Any]:
    """The numbers of a method as text.  ``main``, ``extra``: for each stage, of the step and of
    dense output alone, its index, c, and the row of a; a row, b, and e = b − b̂ are pairs of an
    index and a number that is not 0; ``rows``: how many there are with those of dense output."""
    make, title = METHODS[name]
    method = make()

    def text(x: Decimal) -> str:
        return number(Fraction(float(x)))

    def terms(numbers: Sequence[Decimal]) -> list[tuple[int, str]]:
        return [(j, text(x)) for j, x in enumerate(numbers) if x]

    rows = [
        (i, text(c), terms(row)) for i, (c, row) in enumerate(zip(method.c, method.a, strict=True))
    ]
    return {
        "name": name,
        "title": title,
        "order": method.order,
        "dense_order": method.dense_order,
        "adaptive": bool(method.embedded),
        "main": rows[: method.stages],
        "extra": rows[method.stages :],
        "b": terms(method.b),
        "e": terms(method.error) if method.embedded else [],
        "rows": len(method.legendre),
    }
