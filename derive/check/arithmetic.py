"""Arithmetic of values: scalars of any ring, and matrices of them as tuples of rows."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..algebra import rational as q
from ..limits import DEGREE

Value = Any

LARGEST_POWER, LARGEST_MATRIX = DEGREE + 1, 8
"""The derivative of 1/xⁿ has xⁿ⁺¹, and n is the degree of an expression; rows of a determinant."""


class EvaluationError(ValueError):
    """A tree that has no value: an unknown name, or shapes that do not fit."""


def is_matrix(x: Value) -> bool:
    """Is the value a matrix?"""
    return isinstance(x, tuple)


def _same_kind(a: Value, b: Value) -> None:
    shapes = [(len(x), len(x[0])) if is_matrix(x) else () for x in (a, b)]
    if shapes[0] != shapes[1]:
        raise EvaluationError(f"shapes {shapes[0]} and {shapes[1]} do not add")


def plus(a: Value, b: Value) -> Value:
    """a + b, of one shape."""
    _same_kind(a, b)
    return q.plus(a, b) if is_matrix(a) else a + b


def times(a: Value, b: Value) -> Value:
    """Scalar or matrix product; a 1 × 1 matrix is a scalar."""
    if is_matrix(a) and is_matrix(b):
        if len(a[0]) != len(b):
            raise EvaluationError(f"{len(a)}×{len(a[0])} times {len(b)}×{len(b[0])}")
        return scalar(q.times(a, b))
    if is_matrix(a):
        return q.scaled(b, a)
    return q.scaled(a, b) if is_matrix(b) else a * b


def scalar(x: Value) -> Value:
    """A 1 × 1 matrix as its entry."""
    return x[0][0] if is_matrix(x) and len(x) == 1 == len(x[0]) else x


def transpose(x: Value) -> Value:
    """The transpose; a scalar is its own."""
    return q.transposed(x) if is_matrix(x) else x


def trace(x: Value) -> Value:
    """Tr x."""
    if is_matrix(x) and len(x) != len(x[0]):
        raise EvaluationError("trace of a matrix that is not square")
    return q.trace(x) if is_matrix(x) else x


def inner(a: Value, b: Value, metric: Value | None = None) -> Value:
    """⟨a, b⟩ with a metric: ā M b for vectors, Tr a M b̄ for matrices."""
    if not is_matrix(a) and not is_matrix(b):
        if is_matrix(metric):
            raise EvaluationError("numbers have no inner product of a matrix")
        return a * b if metric is None else a * metric * b
    if not (is_matrix(a) and is_matrix(b)):
        raise EvaluationError("inner product of a scalar and a matrix")
    if len(a[0]) == 1:
        return times(transpose(a), b if metric is None else times(metric, b))
    return trace(times(a if metric is None else times(a, metric), transpose(b)))


def wedge(a: Value, b: Value) -> Value:
    """The vector product in R³."""
    (x,), (y,), (z,) = a
    (u,), (v,), (w,) = b
    return ((y * w - z * v,), (z * u - x * w,), (x * v - y * u,))


def hat(a: Value) -> Value:
    """j(a)."""
    (x,), (y,), (z,) = a
    zero = x * 0
    return ((zero, -z, y), (z, zero, -x), (-y, x, zero))


def inverse(x: Value) -> Value:
    """x⁻¹."""
    if not is_matrix(x):
        return 1 / x
    result = q.inverse(x)
    if result is None:
        raise EvaluationError("inverse of a singular matrix")
    return result


def determinant(x: Value) -> Value:
    """det x, by expansion along the first row."""
    if not is_matrix(x) or any(len(row) != len(x) for row in x) or len(x) > LARGEST_MATRIX:
        raise EvaluationError(f"determinant of a square matrix of size up to {LARGEST_MATRIX} only")
    return _expanded(x)


def _expanded(x: Value) -> Value:
    if len(x) == 1:
        return x[0][0]
    minors = (
        (-1) ** j * x[0][j] * _expanded(tuple(row[:j] + row[j + 1 :] for row in x[1:]))
        for j in range(len(x))
    )
    return sum(minors, Fraction(0))


def power(x: Value, n: Value) -> Value:
    """x to a small integer power that is not zero."""
    if not isinstance(n, Fraction) or n.denominator != 1 or not 0 < abs(n) <= LARGEST_POWER:
        raise EvaluationError(f"the exponent must be an integer up to ±{LARGEST_POWER}, not 0")
    base = inverse(x) if n < 0 else x
    result = base
    for _ in range(abs(int(n)) - 1):
        result = times(result, base)
    return result
