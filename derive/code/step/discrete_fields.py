"""What the templates of the discrete step are filled with."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import Any

from .discrete_step import BASIS, DiscreteStep, Terms
from .explicit_fields import METHODS

Number = Callable[[Fraction], str]


def written_step(d: DiscreteStep, number: Number, steps: Sequence[str]) -> dict[str, Any]:
    """The numbers of a step and its sums as text: ``hat``, the rows of Z in zeta; ``read``, zeta in
    Z; where 𝔤 is any, ``on_basis``, what B has on E_a, and ``metric``, what G E_b J has on it, a by
    rows.  ``group``: how many numbers of the state tell g; ``number``: that of the step among those
    of a motion."""
    span, size = range(len(d.basis)), range(d.size)
    entries: list[list[list[tuple[Fraction, str]]]] = [[[] for _ in size] for _ in size]
    for a in span:
        for c, i, j in d.basis[a]:
            entries[i][j].append((c, f"zeta[{a}]"))

    def total(terms: Iterable[tuple[Fraction, str]]) -> str:
        return linear(terms, number)

    def metric(a: int, b: int) -> str:
        return total(
            (x * y, f"G[{i}][{k}]*J[{m}][{j}]") for x, i, j in d.basis[a] for y, k, m in d.basis[b]
        )

    return {
        "kind": d.kind,
        "n": d.n,
        "size": d.size,
        "inside": d.inside,
        "centred": d.centred,
        "damped": d.damped,
        "places": d.places,
        "fixed": d.fixed,
        "group": len(d.places),
        "order": d.order,
        "weights": [number(Fraction(x)) for x in d.weights],
        "hat": [[total(x) for x in row] for row in entries],
        "read": [total((c, f"Z[{i}][{j}]") for c, i, j in row) for row in d.read],
        "read_rows": [[number(x) for x in dense(row, d.size)] for row in d.read],
        "on_basis": [total((c, f"B[{i}][{j}]") for c, i, j in row) for row in d.basis],
        "metric": [metric(a, b) for a in span for b in span] if d.kind == BASIS else [],
        "number": 1 + sum(x in METHODS for x in steps),
    }


def dense(terms: Terms, size: int) -> list[Fraction]:
    """The entries of a sparse matrix, by rows."""
    found = [Fraction(0)] * size**2
    for c, i, j in terms:
        found[i * size + j] += c
    return found


def linear(terms: Iterable[tuple[Fraction, str]], number: Number) -> str:
    """The sum of multiples of what is written, 0 without any."""
    found = ""
    for c, text in terms:
        size = text if abs(c) == 1 else f"{number(abs(c))}*{text}"
        found += f" {'-' if c < 0 else '+'} {size}" if found else f"{'-' * (c < 0)}{size}"
    return found or "0"
