"""Matrices of expressions: g, its conjugates of other matrices, sums and products."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from ..algebra.groups import Group
from ..language.tree import Tree, add, mul, neg
from ..problem.moved_entries import Rows, element
from .scalar_lagrangian import by_state

Entries = Sequence[Sequence[Tree]]
"""A matrix of expressions."""


def conjugated(m: Rows, group: Group, *, inward: bool) -> Rows | None:
    """The entries of g⁻¹mg (``inward``) or gmg⁻¹, factor by factor, where the linear parts are
    rotations; ``None`` elsewhere."""
    g = element(group)
    rows: list[list[Tree]] = [[0] * group.size for _ in range(group.size)]
    seen = 0
    for offset, factor in group.places:
        if "orthogonal" not in factor.relations:
            return None
        span, last = range(offset, offset + factor.n), offset + factor.n
        linear, A = ([[x[i][j] for j in span] for i in span] for x in (m, g))
        turned = _turned(linear, transposed(A) if inward else A)
        T, b = ([[x[i][last]] for i in span] if factor.affine else [] for x in (g, m))
        if factor.affine and inward:  # Ā(mT + b)
            shift = times(transposed(A), plus(times(linear, T), b))
        elif factor.affine:  # Ab − A m Ā T
            shift = plus(times(A, b), negative(times(turned, T)))
        for i, row in zip(span, turned, strict=True):
            rows[i][offset : offset + factor.n] = row
            if factor.affine:
                rows[i][last] = shift[i - offset][0]
        here = range(offset, offset + factor.size)
        seen += sum(m[i][j] != 0 for i in here for j in here)
    return tuple(map(tuple, rows)) if seen == sum(x != 0 for row in m for x in row) else None


def _turned(m: Entries, by: Entries) -> Entries:
    """R m R̄ for a rotation R; of R³ by R j(x) R̄ = j(Rx)."""
    n = len(m)
    if n != 3:
        return times(times(by, m), transposed(by))
    half = Fraction(1, 2)
    skew = [[mul(half, add(m[i][j], neg(m[j][i]))) for j in range(n)] for i in range(n)]
    even = [[mul(half, add(m[i][j], m[j][i])) for j in range(n)] for i in range(n)]
    axis = [[by_state(skew[2][1])], [by_state(skew[0][2])], [by_state(skew[1][0])]]
    (x,), (y,), (z,) = times(by, axis)
    hat: Entries = [[0, neg(z), y], [z, 0, neg(x)], [neg(y), x, 0]]
    rest = [[by_state(x) for x in row] for row in even]
    return plus(hat, times(times(by, rest), transposed(by))) if full(rest) else hat


def times(a: Entries, b: Entries) -> Rows:
    """The product of matrices of expressions."""
    columns = transposed(b)
    return tuple(
        tuple(
            add(*(mul(x, y) for x, y in zip(row, col, strict=True) if x != 0 and y != 0))
            for col in columns
        )
        for row in a
    )


def transposed(a: Entries) -> Rows:
    """The transpose of a matrix of expressions."""
    return tuple(zip(*a, strict=True))


def plus(a: Entries, b: Entries) -> Rows:
    """The sum of matrices of expressions."""
    pairs = zip(a, b, strict=True)
    return tuple(tuple(add(x, y) for x, y in zip(*rows, strict=True)) for rows in pairs)


def negative(a: Entries) -> Rows:
    """The opposite of a matrix of expressions."""
    return tuple(tuple(map(neg, row)) for row in a)


def matrix(m: Entries) -> Tree:
    """A matrix as a tree."""
    return ("matrix", *(("row", *row) for row in m))


def full(m: Entries) -> bool:
    """Has a matrix an entry that is not 0?"""
    return any(x != 0 for row in m for x in row)
