"""Exact matrices: just enough linear algebra over any field of numbers.

A matrix is a tuple of rows.  The entries may be integers, fractions or any type with ``+ − * /``;
pivots are the first nonzero entries, so the elimination is exact for exact entries.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from operator import mul
from typing import Any

Matrix = tuple[tuple[Any, ...], ...]
ZERO = Fraction(0)


def matrix(rows: Sequence[Sequence[Any]]) -> Matrix:
    """A matrix from nested sequences."""
    return tuple(tuple(row) for row in rows)


def identity(n: int) -> Matrix:
    """The n × n identity."""
    return tuple(tuple(Fraction(i == j) for j in range(n)) for i in range(n))


def unit(n: int, i: int, j: int) -> Matrix:
    """The n × n matrix with a single 1, at row i and column j (from 0)."""
    return tuple(tuple(Fraction((r, s) == (i, j)) for s in range(n)) for r in range(n))


def plus(a: Matrix, b: Matrix) -> Matrix:
    """a + b."""
    return tuple(tuple(x + y for x, y in zip(r, s, strict=True)) for r, s in zip(a, b, strict=True))


def scaled(k: Any, a: Matrix) -> Matrix:
    """k · a."""
    return tuple(tuple(k * x for x in row) for row in a)


def minus(a: Matrix, b: Matrix) -> Matrix:
    """a − b."""
    return plus(a, scaled(-1, b))


def transposed(a: Matrix) -> Matrix:
    """The transpose."""
    return tuple(zip(*a, strict=True))


def times(a: Matrix, b: Matrix) -> Matrix:
    """a b."""
    columns = transposed(b)
    if any(len(row) != len(b) for row in a):
        raise ValueError("matrices that have no product")
    return tuple(tuple(sum(map(mul, row, col), ZERO) for col in columns) for row in a)


def trace(a: Matrix) -> Any:
    """Tr a."""
    return sum((a[i][i] for i in range(len(a))), Fraction(0))


def bracket(a: Matrix, b: Matrix) -> Matrix:
    """[a, b] = ab − ba."""
    return minus(times(a, b), times(b, a))


def flatten(a: Matrix) -> tuple[Any, ...]:
    """The entries, row after row."""
    return tuple(x for row in a for x in row)


def combine(weights: Sequence[Any], basis: Sequence[Matrix]) -> Matrix:
    """Σ w_a E_a."""
    n, m = len(basis[0]), len(basis[0][0])
    return tuple(
        tuple(
            sum((w * e[i][j] for w, e in zip(weights, basis, strict=True) if e[i][j]), Fraction(0))
            for j in range(m)
        )
        for i in range(n)
    )


def echelon(a: Matrix) -> tuple[Matrix, tuple[int, ...]]:
    """Reduced row echelon form and its pivot columns."""
    rows = [list(row) for row in a]
    pivots: list[int] = []
    width = len(rows[0]) if rows else 0
    for col in range(width):
        r = len(pivots)
        pivot = next((i for i in range(r, len(rows)) if rows[i][col] != 0), None)
        if pivot is None:
            continue
        rows[r], rows[pivot] = rows[pivot], rows[r]
        lead = rows[r][col]
        rows[r] = [x / lead for x in rows[r]]
        for i, row in enumerate(rows):
            if i != r and row[col] != 0:
                k = row[col]
                rows[i] = [x - k * y for x, y in zip(row, rows[r], strict=True)]
        pivots.append(col)
        if len(pivots) == len(rows):
            break
    return matrix(rows), tuple(pivots)


def solve(a: Matrix, b: Matrix) -> Matrix | None:
    """x with a x = b for a of full column rank; ``None`` when there is no such x.

    Numbers that have a way of their own to it, a static method ``solved``, are asked for it.
    """
    for own in (getattr(type(x), "solved", None) for row in a for x in row):
        if own is not None:
            found: Matrix = own(a, b)
            return found
    width = len(a[0])
    reduced, pivots = echelon(tuple((*r, *s) for r, s in zip(a, b, strict=True)))
    if pivots != tuple(range(width)):
        return None
    return tuple(row[width:] for row in reduced[:width])


def inverse(a: Matrix) -> Matrix | None:
    """a⁻¹, or ``None`` when a is singular."""
    return solve(a, identity(len(a)))


def rank(a: Matrix) -> int:
    """The rank."""
    return len(echelon(a)[1])


def nullspace(a: Matrix) -> list[tuple[Any, ...]]:
    """A basis of {x : a x = 0}."""
    reduced, pivots = echelon(a)
    width = len(a[0])
    basis = []
    for free in (c for c in range(width) if c not in pivots):
        x = [Fraction(0)] * width
        x[free] = Fraction(1)
        for r, col in enumerate(pivots):
            x[col] = -reduced[r][free]
        basis.append(tuple(x))
    return basis


def semidefinite(a: Sequence[Sequence[Any]]) -> bool:
    """Is x̄ a x ≥ 0 for every x?  By elimination, for a symmetric a."""
    m = [[*row] for row in a]
    for k in range(len(m)):
        if m[k][k] < 0 or (m[k][k] == 0 and any(m[k][k:])):
            return False
        for i in range(k + 1, len(m)):
            factor = m[i][k] / m[k][k] if m[k][k] else Fraction(0)
            m[i] = [x - factor * y for x, y in zip(m[i], m[k], strict=True)]
    return True


def definite(a: Matrix) -> bool:
    """Is x̄ a x > 0 for every x but 0?"""
    return semidefinite(a) and rank(a) == len(a)
