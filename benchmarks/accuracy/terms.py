"""Numbers of 50 digits, many at once, that carry the sum of the magnitudes of their terms.

A ``Terms`` is a value, mpf or an array of them, and a size, floats of the same shape: the sums of
the sizes of sums, the products of those of products.  A solution of M x = b has the size
|M⁻¹| (S(b) + S(M) |x|), which is what x moves by, in units of ε, when every term of M and of b
moves by ε of itself (Skeel 1979; Oettli and Prager 1964; Higham, Accuracy and Stability, 7.2).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np

Array = np.ndarray[Any, np.dtype[np.float64]]
Matrix = tuple[tuple["Terms", ...], ...]
DIGITS = 50
mpmath.mp.dps = DIGITS
EXACT = np.frompyfunc(lambda x: mpmath.mpf(float(x)), 1, 1)
ROOT = np.frompyfunc(mpmath.sqrt, 1, 1)


def magnitude(value: Any) -> Any:
    """|value| in floats."""
    return np.abs(np.asarray(value, dtype=float))


class Terms:
    """A value and the size of its terms; a plain mpf is a number of the equation."""

    __slots__ = ("size", "value")

    def __init__(self, value: Any, size: Any = None):
        self.value, self.size = value, magnitude(value) if size is None else size

    @staticmethod
    def number(x: int | Fraction) -> Terms:
        """A number that an equation states."""
        return Terms(mpmath.mpf(x.numerator) / x.denominator)

    def _is(self, x: int) -> bool:
        return isinstance(self.value, mpmath.mpf) and self.value == x

    @property
    def is_zero(self) -> bool:
        """Is it the number 0?"""
        return self._is(0)

    def __add__(self, other: Terms) -> Terms:
        if self.is_zero or other.is_zero:
            return other if self.is_zero else self
        return Terms(self.value + other.value, self.size + other.size)

    def __neg__(self) -> Terms:
        return Terms(-self.value, self.size)

    def __sub__(self, other: Terms) -> Terms:
        return self + -other

    def __mul__(self, other: Terms) -> Terms:
        for a, b in ((self, other), (other, self)):
            if a.is_zero or b._is(1):
                return a
            if a._is(-1):
                return -b
        return Terms(self.value * other.value, self.size * other.size)

    def inverse(self) -> Terms:
        """1/x, whose terms are those of x over x²."""
        value = 1 / self.value
        return Terms(value, self.size * magnitude(value) ** 2)

    def root(self) -> Terms:
        """√x; half of what moves x, and itself."""
        value = ROOT(self.value)
        return Terms(value, self.size / magnitude(value) / 2 + magnitude(value))


ZERO, ONE = Terms.number(0), Terms.number(1)


def total(terms: Sequence[Terms]) -> Terms:
    """Their sum."""
    found = ZERO
    for x in terms:
        found = found + x
    return found


def times(a: Matrix, b: Matrix) -> Matrix:
    """a b."""
    columns = list(zip(*b, strict=True))
    return tuple(
        tuple(total([x * y for x, y in zip(r, c, strict=True)]) for c in columns) for r in a
    )


def transposed(a: Matrix) -> Matrix:
    """The transpose."""
    return tuple(zip(*a, strict=True))


# ---------------------------------------------------------------- linear systems


def solved(m: Matrix, b: Matrix, *, positive: bool = True) -> Matrix:
    """M⁻¹ b with its size; through M̄M where M is not positive."""
    left, right = _values(m), _values(b)
    if not positive:
        bar = [*zip(*left, strict=True)]
        left, right = _product(bar, left), _product(bar, right)
    x = _eliminated(left, right)
    back = _absolute_inverse(m, positive)
    sizes = _sizes(b) + _sizes(m) @ np.abs(_stacked(x))
    return _with(x, back @ sizes)


def inverted(m: Matrix, *, positive: bool = True) -> Matrix:
    """M⁻¹."""
    n = len(m)
    one = tuple(tuple(ONE if i == j else ZERO for j in range(n)) for i in range(n))
    return solved(m, one, positive=positive)


def _values(m: Matrix) -> list[list[Any]]:
    return [[e.value for e in row] for row in m]


def _product(a: Sequence[Any], b: Sequence[Any]) -> list[list[Any]]:
    columns = [*zip(*b, strict=True)]
    return [[sum(x * y for x, y in zip(r, c, strict=True)) for c in columns] for r in a]


def _eliminated(m: list[list[Any]], x: list[list[Any]]) -> list[list[Any]]:
    """Gauss's elimination; a positive matrix needs no search for pivots."""
    n, x = len(m), [list(row) for row in x]
    for k in range(n):
        for i in range(k + 1, n):
            factor = m[i][k] / m[k][k]
            m[i] = m[i][: k + 1] + [m[i][j] - factor * m[k][j] for j in range(k + 1, n)]
            x[i] = [a - factor * b for a, b in zip(x[i], x[k], strict=True)]
    for k in reversed(range(n)):
        for j in range(k + 1, n):
            x[k] = [a - m[k][j] * b for a, b in zip(x[k], x[j], strict=True)]
        x[k] = [a / m[k][k] for a in x[k]]
    return x


def _absolute_inverse(m: Matrix, positive: bool) -> Array:
    """|M⁻¹|, by doubles; of a positive M in units where its diagonal is 1."""
    values = _stacked(_values(m))
    if not positive:
        return np.abs(np.linalg.inv(values))
    root = np.sqrt(np.einsum("...ii->...i", values))
    scale = root[..., :, None] * root[..., None, :]
    return np.abs(np.linalg.inv(values / scale)) / scale


def _stacked(rows: Sequence[Sequence[Any]]) -> Array:
    """Rows of arrays as one array whose last axes are the matrix's."""
    flat = np.broadcast_arrays(*(np.asarray(x, dtype=float) for row in rows for x in row))
    return np.stack(flat, axis=-1).reshape(*flat[0].shape, len(rows), len(rows[0]))


def _sizes(m: Matrix) -> Array:
    return _stacked([[e.size for e in row] for row in m])


def _with(values: Sequence[Sequence[Any]], sizes: Array) -> Matrix:
    return tuple(
        tuple(Terms(x, sizes[..., i, j]) for j, x in enumerate(row)) for i, row in enumerate(values)
    )
