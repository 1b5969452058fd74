"""The layout of a group element in the state: entries, or numbers of a chart; the charts of
factors.

Entries of a block by its numbers, their rates, random ones.  A unit quaternion q, scalar first: r ↦
q r q̄ is the rotation A, and q̇ = ½ q ζ for Ȧ = A j(ζ).  Coordinates x_a: the block is exp X, X = Σ
x_a E_a, and ẋ_a = ζ_a for Ȧ = A Z, as these commute.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import factorial
from typing import Any

from ..algebra.factor_charts import QUATERNION, CoordinateBlock, FactorChart
from ..algebra.groups import Group, constant_entries
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from .graph import Graph, Node


@dataclass(frozen=True)
class StateSlot:
    """One number of the state: entry (row, column), from 0, of the matrix A or the vector T."""

    name: str
    letter: str
    row: int
    column: int = 0


OfElement = StateSlot | FactorChart
"""What a state holds of a group element: entries, and charts that stand for several."""


def order(group: Group, columns: bool, charts: Mapping[int, FactorChart]) -> list[OfElement]:
    """The order in which a state holds a group element, factor after factor: its entries, column by
    column with ``columns``, or the numbers of its chart, and then T."""
    several, found = len(group.places) > 1, list[OfElement]()
    for k, (offset, factor) in enumerate(group.places):
        apart = factor.affine and not group.factors
        slots = _factor(factor, str(k + 1) if several else "", offset, apart, columns)
        if chart := charts.get(k):
            shift = slots[factor.n**2 :] if chart.shifted else []
            found += [chart, *shift]
        else:
            found += slots[factor.n**2 :] if factor.vectors else slots
    return found


def layout(group: Group) -> list[StateSlot]:
    """The slots of a group element kept as matrices."""
    return [x for x in order(group, False, {}) if isinstance(x, StateSlot)]


def _factor(g: Group, mark: str, offset: int, apart: bool, columns: bool) -> list[StateSlot]:
    """The slots of a factor, its block at ``offset``; ``apart``: T is a vector, no column of A."""
    span = range(g.n)
    pairs = [(j, i) if columns else (i, j) for i in span for j in span]
    slots = [
        StateSlot(suffixed(f"A{mark}", i + 1, j + 1), "A", offset + i, offset + j) for i, j in pairs
    ]
    if g.affine:
        slots += [
            StateSlot(suffixed(f"T{mark}", i + 1), "T", i)
            if apart
            else StateSlot(suffixed(f"T{mark}", i + 1), "A", offset + i, offset + g.n)
            for i in span
        ]
    return slots


def fixed_entries(group: Group) -> dict[tuple[int, int], int]:
    """Place → 1: the corners of affine factors, entries of A that are always 1, with R(n) all of
    the diagonal."""
    return {
        (offset + i, offset + i): 1
        for offset, f in group.places
        if group.factors and f.affine
        for i in range(0 if f.vectors else f.n, f.size)
    }


def still_slots(group: Group) -> dict[StateSlot, Fraction]:
    """Slot → the number that it is in all of the group, of those that never vary."""
    known = constant_entries(group)
    places = {x: (x.row, group.n if x.letter == "T" else x.column) for x in layout(group)}
    return {x: known[at] for x, at in places.items() if at in known}


# Unit quaternions, scalar first: r ↦ q r q̄ is the rotation A, and q̇ = ½ q ζ for Ȧ = A j(ζ).

Quaternion = tuple[Any, ...]
ROTATED = 3
"""A quaternion is of the first 3 × 3 entries of a matrix."""


def multiplied(a: Quaternion, b: Quaternion) -> Quaternion:
    """Hamilton's product a b, in any ring."""
    p, x, y, z = a
    s, u, v, w = b
    return (
        p * s - x * u - y * v - z * w,
        p * u + s * x + y * w - z * v,
        p * v + s * y + z * u - x * w,
        p * w + s * z + x * v - y * u,
    )


def conjugate(a: Quaternion) -> Quaternion:
    """The conjugate (p, −x, −y, −z) of (p, x, y, z)."""
    p, x, y, z = a
    return (p, -x, -y, -z)


def matrix_of(g: Graph, q: tuple[Node, ...], mark: str = "") -> Matrix:
    """The rotation A of a unit quaternion q, A e = q e q̄, 3 × 3, entries named with the ``mark`` of
    a factor; q q̄ = 1 takes the square of the scalar out of the diagonal."""
    p, x, y, z = q
    unit = multiplied((p, x, y, z), conjugate((p, x, y, z)))[0]
    zero = g.num(0)
    columns = []
    for k in range(3):
        e = tuple(g.num(int(i == k)) for i in range(3))
        image = multiplied(multiplied((p, x, y, z), (zero, *e)), conjugate((p, x, y, z)))[1:]
        column = list(image)
        column[k] = column[k] - unit + 1
        columns.append(column)
    span = range(3)
    return tuple(
        tuple(g.value(columns[j][i], f"A{mark}_{i + 1}{j + 1}") for j in span) for i in span
    )


def horn(R: Matrix) -> Matrix:
    """The symmetric 4 × 4 matrix of a rotation R whose eigenvalue 3, the largest, is at its
    quaternion, scalar first (Horn 1987): 4 q q̄ − 1, for q as a column."""
    (a, b, c), (d, e, f), (g, h, i) = R
    return (
        (a + e + i, h - f, c - g, d - b),
        (h - f, a - e - i, b + d, c + g),
        (c - g, b + d, e - a - i, f + h),
        (d - b, c + g, f + h, i - a - e),
    )


def of_rotation(g: Graph, R: Matrix, mark: str = "") -> list[Node]:
    """The unit quaternion of a rotation R, its scalar not negative, without a branch; ``mark``:
    that of the factor, for names.

    Column i of 4 q q̄ is 4 q_i q. Added with the sign of q_i, up to one sign of them all, the
    columns make 4 Σ |q_i| q, which is never small: half turns are turns like others.
    """
    columns = [
        tuple(
            g.value(x + int(i == j), suffixed(f"N{mark}", i, j), "rotation")
            for j, x in enumerate(row)
        )
        for i, row in enumerate(horn(R))
    ]

    def joined(a: Quaternion, b: Quaternion, product: Node, name: str) -> Quaternion:
        """a ± b by the sign of the product of their factors."""
        sign = _sign(g, g.value(product, f"{name}{mark}_product", "rotation"))
        sign = g.value(sign, f"{name}{mark}_sign", "rotation")
        return tuple(
            g.value(x + sign * y, suffixed(f"{name}{mark}", i), "rotation")
            for i, (x, y) in enumerate(zip(a, b, strict=True))
        )

    first = joined(columns[0], columns[1], columns[0][1], "first")
    second = joined(columns[2], columns[3], columns[2][3], "second")
    whole = joined(first, second, Node.dot(first, second), "whole")
    square = g.value(Node.dot(whole, whole), f"square{mark}", "rotation")
    scale = _sign(g, whole[0]) * g.recip(g.function("sqrt", square))
    scale = g.value(scale, f"scale{mark}", "rotation")
    return [x * scale for x in whole]


def _sign(g: Graph, x: Node) -> Node:
    """1 where x ≥ 0, else −1."""
    none = g.none(x)
    return (x + none) * g.recip(g.absolute(x) + none)


def axis(Z: Matrix) -> Matrix:
    """The column ζ of a matrix that begins with j(ζ)."""
    return ((Z[2][1],), (Z[0][2],), (Z[1][0],))


def halves(column: Matrix) -> list[Node]:
    """The entries of ½ ζ, for a column ζ."""
    return [x * Fraction(1, 2) for (x,) in column]


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
