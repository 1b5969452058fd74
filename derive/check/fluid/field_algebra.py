"""Sums and products of what has a value at the points of a fluid: numbers, functions, fields,
matrices at each place, operators."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from operator import add
from typing import Any

from ..arithmetic import EvaluationError
from .functions import Field, Function, dot
from .operators import Operator, Told, applied

Value = Any


@dataclass(frozen=True)
class Matrix:
    """A matrix at each place."""

    rows: tuple[tuple[Function, ...], ...]


@dataclass(frozen=True)
class Normal:
    """The unit normal of the boundary."""


@dataclass(frozen=True)
class Slope:
    """The gradient of the density, whose products with fields are those at each place."""

    field: Field


@dataclass(frozen=True)
class OnBoundary:
    """A function on the boundary."""

    f: Function


def times(a: Value, b: Value) -> Value:
    """The product of two values, an operator applied to what follows it."""
    if isinstance(a, Operator):
        if isinstance(b, Operator):
            return a.then(b)
        if isinstance(b, Told):
            raise EvaluationError("an operator before a transposed one")
        if not isinstance(b, (tuple, Function)):
            raise EvaluationError("an operator is of fields")
        return applied(a, b, plus, times)
    if isinstance(a, int):
        a = Fraction(a)
    if isinstance(a, (Fraction, Function)):
        if isinstance(a, Function) and not a.is_constant:
            raise EvaluationError("a function is no factor")
        if isinstance(b, tuple):
            return tuple(x * a for x in b)
        if isinstance(b, (Operator, Told)):
            return b.scaled(a)
        if isinstance(b, Function):
            return b * a
        if isinstance(b, OnBoundary):
            return OnBoundary(b.f * a)
        if isinstance(b, Matrix):
            return Matrix(tuple(tuple(x * a for x in row) for row in b.rows))
    if isinstance(a, Matrix) and isinstance(b, Matrix):
        return matrix_product(a, b)
    if isinstance(b, Function) and b.is_constant and not isinstance(a, Function):
        return times(b, a)
    raise EvaluationError("these are not multiplied")


def plus(a: Value, b: Value) -> Value:
    """a + b, of one kind; 0 is of each."""
    for x, y in ((a, b), (b, a)):
        if isinstance(x, Function) and x == 0 and not isinstance(y, Function):
            return y
    if type(a) is not type(b):
        raise EvaluationError("a sum of things of two kinds")
    if isinstance(a, tuple):
        return tuple(x + y for x, y in zip(a, b, strict=True))
    if isinstance(a, OnBoundary):
        return OnBoundary(a.f + b.f)
    if isinstance(a, Matrix):
        rows = zip(a.rows, b.rows, strict=True)
        return Matrix(tuple(tuple(map(add, x, y)) for x, y in rows))
    return a + b


def power(x: Value, n: Any) -> Value:
    """xⁿ, which is the square of a matrix."""
    if not isinstance(x, Matrix) or n != 2:
        raise EvaluationError("a power is the square of a matrix")
    return matrix_product(x, x)


def matrix_product(a: Matrix, b: Matrix) -> Matrix:
    """At each place."""
    columns = [*zip(*b.rows, strict=True)]
    return Matrix(tuple(tuple(dot(row, c) for c in columns) for row in a.rows))


def trace(x: Value) -> Function:
    """Of a matrix, at each place."""
    if not isinstance(x, Matrix):
        raise EvaluationError("the trace is of a matrix")
    found = [row[j] for j, row in enumerate(x.rows)]
    return sum(found[1:], found[0])


def componentwise(change: Callable[[Any], Any], *, on_curve: bool = False) -> Operator:
    """What changes functions, as an operator on functions and fields."""
    return Operator.of(
        lambda c: change(c) if isinstance(c, Function) else tuple(map(change, field_of(c))),
        on_curve=on_curve,
    )


def field_of(x: Value) -> Field:
    """It, if it is a field; else ``EvaluationError``."""
    if not isinstance(x, tuple):
        raise EvaluationError("a field is expected")
    return x
