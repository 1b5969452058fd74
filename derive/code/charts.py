"""The charts of factors in the code: entries of a block by its numbers, their rates, random ones.

A unit quaternion q, scalar first: r ↦ q r q̄ is the rotation A, and q̇ = ½ q ζ for Ȧ = A j(ζ).
Coordinates x_a: the block is exp X, X = Σ x_a E_a, and ẋ_a = ζ_a for Ȧ = A Z, as these commute.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import factorial
from typing import Any

from ..algebra.factor_charts import QUATERNION, CoordinateBlock, FactorChart
from ..language import rational as q
from ..language.rational import Matrix
from .graph import Graph, Node
from .slots import ROTATED, axis, halves, matrix_of, multiplied

Entries = Mapping[tuple[int, int], Node]
"""Row and column, from 0, in the group's matrices → the entry."""


def entries(g: Graph, chart: FactorChart, x: Sequence[Node]) -> Entries:
    """Those of a factor that its chart tells, by its numbers x."""
    if chart.kind == QUATERNION:
        turn = matrix_of(g, tuple(x), chart.mark)
        start, inside = chart.offset, range(ROTATED)
        return {(start + i, start + j): turn[i][j] for i in inside for j in inside}
    rows = range(chart.offset, chart.offset + chart.size)
    found = {(i, j): g.num(int(i == j)) for i in rows for j in rows}
    for block, own in _by_blocks(chart, x):
        image, span = _exponential(g, block, own), range(len(block.rows))
        found |= {(block.rows[i], block.rows[j]): image[i][j] for i in span for j in span}
    return found


def rates(g: Graph, chart: FactorChart, x: Sequence[Node], Z: Matrix) -> list[Node]:
    """Those of the numbers x along g Z."""
    if chart.kind == QUATERNION:
        span = range(chart.offset, chart.offset + ROTATED)
        zeta = axis(tuple(tuple(Z[i][j] for j in span) for i in span))
        return [*multiplied(tuple(x), (g.num(0), *halves(zeta)))]
    places = (block.terms(k) for block, own in _by_blocks(chart, x) for k in range(len(own)))
    return [g.linear((c, Z[i][j]) for c, i, j in place) for place in places]


def drawn(chart: FactorChart, draw: Callable[[], Any]) -> list[Any]:
    """Random numbers of a chart, in any field: on the sphere, by its stereographic projection, and
    on a line."""
    if chart.kind != QUATERNION:
        return [draw() for _ in chart.names]
    v = [draw() for _ in range(3)]
    square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
    return [(1 - square) / (1 + square), *(2 * x / (1 + square) for x in v)]


def _by_blocks(
    chart: FactorChart, x: Sequence[Node]
) -> list[tuple[CoordinateBlock, Sequence[Node]]]:
    """The blocks, each with its coordinates."""
    found, start = [], 0
    for block in chart.blocks:
        found.append((block, x[start : start + len(block.members)]))
        start += len(block.members)
    return found


def _exponential(g: Graph, block: CoordinateBlock, x: Sequence[Node]) -> Matrix:
    """exp X."""
    span = range(len(block.rows))
    if len(x) > 1:
        terms = [(q.identity(len(block.rows)), g.num(1)), *zip(block.basis, x, strict=True)]
    elif w := block.turn:
        angle, name = x[0] * w, block.names[0]
        cosine = g.value(g.function("cos", angle), f"cos_{name}")
        sine = g.value(g.function("sin", angle), f"sin_{name}")
        terms = [*zip(block.parts_of_turn, (g.num(1), x[0], cosine, sine), strict=True)]
    elif rate := block.growth:
        scale = g.value(g.function("exp", x[0] * rate), f"exp_{block.names[0]}")
        back = g.recip(scale)
        terms = [(P, g.product([scale if n > 0 else back] * abs(n))) for n, P in block.scalings]
    else:
        powers = [g.num(1)]
        while len(powers) < len(block.powers):
            powers.append(powers[-1] * x[0])
        terms = [
            (q.scaled(Fraction(1, factorial(k)), E), power)
            for k, (E, power) in enumerate(zip(block.powers, powers, strict=True))
        ]
    return tuple(
        tuple(g.linear((E[i][j], y) for E, y in terms if E[i][j]) for j in span) for i in span
    )
