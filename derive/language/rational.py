"""Exact numbers: the operators that every class of them has alike; and exact matrices, just enough
linear algebra over any field of numbers.

A matrix is a tuple of rows.  The entries may be integers, fractions or any type with ``+ − * /``;
pivots are the first nonzero entries, so the elimination is exact for exact entries.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import gcd, isqrt, lcm
from operator import mul
from typing import Any, TypeVar

K = TypeVar("K")


class RingElement:
    """Of numbers with ``+`` and ``*``: ``−``, and the operators with the number on the right.

    These call ``+`` and ``*`` by their names: by the operators two classes that do not know each
    other would ask each other without end.
    """

    __slots__ = ()

    def __radd__(self: Any, other: Any) -> Any:
        return self.__add__(other)

    def __rmul__(self: Any, other: Any) -> Any:
        return self.__mul__(other)

    def __neg__(self: Any) -> Any:
        return self * -1

    def __sub__(self: Any, other: Any) -> Any:
        return self + -other

    def __rsub__(self: Any, other: Any) -> Any:
        return -self + other


class FieldElement(RingElement):
    """The same of numbers with an ``inverse``: quotients and powers as well."""

    __slots__ = ()

    def __truediv__(self: Any, other: Any) -> Any:
        return self * (Fraction(1) / other)

    def __rtruediv__(self: Any, other: Any) -> Any:
        return self.inverse * other

    def __pow__(self: Any, n: int) -> Any:
        base, found = self if n >= 0 else self.inverse, Fraction(1)
        for _ in range(abs(n)):
            found = base * found
        return found


Matrix = tuple[tuple[Any, ...], ...]
EXACT = {int, Fraction}
ZERO = Fraction(0)


def over_one(x: Sequence[Any]) -> tuple[list[int], int] | None:
    """Exact numbers as integers over one denominator, so that not each is reduced; ``None`` for
    others."""
    if not {*map(type, x)} <= EXACT:
        return None
    pairs = [a.as_integer_ratio() for a in x]
    over = lcm(*(d for _, d in pairs))
    return [n if d == over else n * (over // d) for n, d in pairs], over


def root(x: Fraction | int) -> Fraction | None:
    """√x, where that is rational."""
    top, bottom = Fraction(x).as_integer_ratio()
    found = Fraction(isqrt(max(top, 0)), isqrt(bottom))
    return found if found * found == x else None


def summed(terms: Iterable[tuple[K, Any]]) -> dict[K, Any]:
    """Key → the sum of what stands with it, of those that are not 0."""
    total: dict[K, Any] = {}
    for key, x in terms:
        total[key] = total[key] + x if key in total else x
    return {key: x for key, x in total.items() if x}


def dot(a: Iterable[Any], b: Iterable[Any]) -> Any:
    """The sum Σ a_i b_i; ``ValueError`` where the lengths differ.

    Numbers that have a way of their own to it, a static method ``dot``, are asked for it; where
    there are two kinds of them, that whose ``parts`` are of the other.
    """
    a, b = [*a], [*b]
    if len(a) != len(b):
        raise ValueError(f"{len(a)} and {len(b)} numbers")
    kinds = {*map(type, a), *map(type, b)}
    if kinds <= EXACT:
        (x, d), (y, e) = map(over_one, (a, b))  # type: ignore[misc]
        return Fraction(sum(map(mul, x, y)), d * e)
    own: list[Any] = [k for k in kinds if hasattr(k, "dot")]
    return _outer(own).dot(a, b) if own else sum(map(mul, a, b), ZERO)


def _outer(kinds: Sequence[Any]) -> Any:
    """Of two kinds of numbers, that whose ``parts`` are of the other."""
    return kinds[0] if len(kinds) == 1 else next(k for k in kinds if hasattr(k, "parts"))


def matrix(rows: Sequence[Sequence[Any]]) -> Matrix:
    """A matrix from nested sequences."""
    return tuple(tuple(row) for row in rows)


def column(vector: Iterable[Any]) -> Matrix:
    """A vector as a matrix of one column."""
    return tuple((x,) for x in vector)


def identity(n: int) -> Matrix:
    """The n × n identity."""
    return tuple(tuple(Fraction(i == j) for j in range(n)) for i in range(n))


def unit(n: int, i: int, j: int) -> Matrix:
    """The n × n matrix with a single 1, at row i and column j (from 0)."""
    return tuple(tuple(Fraction((r, s) == (i, j)) for s in range(n)) for r in range(n))


def bordered(a: Matrix, last: Matrix, corner: Any) -> Matrix:
    """[[a, last], [0, corner]], for a column ``last``."""
    rows = ((*row, x) for row, (x,) in zip(a, last, strict=True))
    return (*rows, (*(corner * 0,) * len(a), corner))


def plus(a: Matrix, b: Matrix) -> Matrix:
    """The sum a + b of matrices."""
    return tuple(tuple(x + y for x, y in zip(r, s, strict=True)) for r, s in zip(a, b, strict=True))


def scaled(k: Any, a: Matrix) -> Matrix:
    """The matrix k · a."""
    return tuple(tuple(k * x for x in row) for row in a)


def minus(a: Matrix, b: Matrix) -> Matrix:
    """The difference a − b of matrices."""
    return plus(a, scaled(-1, b))


def transposed(a: Sequence[Sequence[Any]]) -> Matrix:
    """The transpose of a matrix."""
    return tuple(zip(*a, strict=True))


def symmetrised(a: Matrix) -> Matrix:
    """A symmetric matrix whose entries below the diagonal are those above it, also as they are
    written."""
    return tuple(tuple(a[min(i, j)][max(i, j)] for j in range(len(row))) for i, row in enumerate(a))


def times(a: Sequence[Sequence[Any]], b: Sequence[Sequence[Any]]) -> Matrix:
    """The product a b of matrices; numbers that have a way of their own to it, a static method
    ``product`` of rows and columns, are asked for it."""
    columns = transposed(b)
    kinds = {type(x) for m in (a, b) for row in m for x in row}
    own: list[Any] = [k for k in kinds if hasattr(k, "product")]
    if own and kinds <= EXACT | {*own} and {*map(len, a)} <= {len(b)}:
        return _outer(own).product(a, columns)  # type: ignore[no-any-return]
    left = [x for row in a if (x := over_one(row))]
    right = [x for col in columns if (x := over_one(col))]
    exact = len(left) == len(a) and len(right) == len(columns)
    if not exact or not {*map(len, a)} <= {len(b)}:
        return tuple(tuple(dot(row, col) for col in columns) for row in a)
    return tuple(tuple(Fraction(sum(map(mul, x, y)), d * e) for y, e in right) for x, d in left)


def trace(a: Matrix) -> Any:
    """The trace of a square matrix."""
    return sum((a[i][i] for i in range(len(a))), Fraction(0))


def contraction(a: Matrix, b: Matrix) -> Any:
    """Tr a b̄ = Σ a_ij b_ij, of matrices of one shape."""
    return dot(flatten(a), flatten(b))


def bracket(a: Matrix, b: Matrix) -> Matrix:
    """The commutator [a, b] = ab − ba of square matrices."""
    return minus(times(a, b), times(b, a))


def flatten(a: Matrix) -> tuple[Any, ...]:
    """The entries of a matrix, row after row."""
    return tuple(x for row in a for x in row)


def combine(weights: Sequence[Any], basis: Sequence[Matrix]) -> Matrix:
    """The linear combination Σ w_a E_a of matrices of one size."""
    n, m = len(basis[0]), len(basis[0][0])
    return tuple(
        tuple(
            sum((w * e[i][j] for w, e in zip(weights, basis, strict=True) if e[i][j]), Fraction(0))
            for j in range(m)
        )
        for i in range(n)
    )


def echelon(a: Matrix) -> tuple[Matrix, tuple[int, ...]]:
    """The reduced row echelon form of a matrix, and its pivot columns, from 0."""
    whole = [over_one(row) for row in a]
    if whole and all(whole):
        return _integer_echelon([x[0] for x in whole if x])
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


def _integer_echelon(rows: list[list[int]]) -> tuple[Matrix, tuple[int, ...]]:
    """The echelon form of integer rows: no row is divided before the end, but by its common
    factor."""
    pivots: list[int] = []
    for col in range(len(rows[0])):
        r = len(pivots)
        pivot = next((i for i in range(r, len(rows)) if rows[i][col]), None)
        if pivot is None:
            continue
        rows[r], rows[pivot] = rows[pivot], rows[r]
        lead = rows[r][col]
        for i, row in enumerate(rows):
            if i != r and (k := row[col]):
                reduced = [lead * x - k * y for x, y in zip(row, rows[r], strict=True)]
                common = gcd(*reduced) or 1
                rows[i] = [x // common for x in reduced]
        pivots.append(col)
        if len(pivots) == len(rows):
            break
    leads = [row[col] for row, col in zip(rows, pivots, strict=False)]
    leads += [1] * (len(rows) - len(pivots))
    reduced_rows = ([Fraction(x, k) for x in row] for row, k in zip(rows, leads, strict=True))
    return matrix([*reduced_rows]), tuple(pivots)


def solve(a: Matrix, b: Matrix) -> Matrix | None:
    """The matrix x with a x = b, for a of full column rank; ``None`` when there is no such x.

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
    """The inverse a⁻¹ of a square matrix, or ``None`` when it is singular."""
    return solve(a, identity(len(a)))


def inverted(a: Matrix) -> Matrix:
    """The inverse of a matrix that has one, as the elements of a group."""
    found = inverse(a)
    assert found is not None
    return found


def determinant(a: Matrix) -> Any:
    """The determinant of a square matrix, by elimination."""
    rows, value = [list(row) for row in a], Fraction(1)
    for k in range(len(rows)):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k]), None)
        if pivot is None:
            return ZERO
        if pivot != k:
            rows[k], rows[pivot], value = rows[pivot], rows[k], -value
        value *= rows[k][k]
        for row in rows[k + 1 :]:
            ratio = row[k] / rows[k][k]
            row[k:] = [x - ratio * y for x, y in zip(row[k:], rows[k][k:], strict=True)]
    return value


def rank(a: Matrix) -> int:
    """The rank of a matrix."""
    return len(echelon(a)[1])


def nullspace(a: Matrix) -> list[tuple[Any, ...]]:
    """A basis of {x : a x = 0}, vectors of as many entries as a has columns."""
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
    """Is x̄ a x ≥ 0 for every x? By elimination, for a symmetric matrix a."""
    m = [[*row] for row in a]
    for k in range(len(m)):
        if m[k][k] < 0 or (m[k][k] == 0 and any(m[k][k:])):
            return False
        for i in range(k + 1, len(m)):
            factor = m[i][k] / m[k][k] if m[k][k] else Fraction(0)
            m[i] = [x - factor * y for x, y in zip(m[i], m[k], strict=True)]
    return True


def definite(a: Matrix) -> bool:
    """Is x̄ a x > 0 for every x but 0, for a symmetric matrix a?"""
    return semidefinite(a) and rank(a) == len(a)
