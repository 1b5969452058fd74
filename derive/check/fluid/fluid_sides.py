"""The sides of an equation about a fluid at a point: the numbers that must agree."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from ...record.record import Equation
from ..arithmetic import EvaluationError
from .edges import Edges
from .field_algebra import Matrix, OnBoundary, Value, times
from .field_values import FluidValues
from .functions import Exponents, Function
from .operators import Operator, Told


def pairs(equation: Equation, values: FluidValues) -> Iterator[tuple[Any, Any]]:
    """The numbers that must agree, two by two; ``EvaluationError`` for sides of two kinds."""
    for both in zip(*map(functions, sides(equation, values)), strict=True):
        yield from (pair for _, pair in coefficients(*both))


def sides(equation: Equation, values: FluidValues) -> tuple[Value, Value]:
    """The values of both sides: of operators, of what they do to a random field; of what is told by
    its products, of that with one. ``EvaluationError`` for two kinds."""
    left, right = values.of(equation.lhs), values.of(equation.rhs)
    model = values.model
    written = 0 in (equation.lhs, equation.rhs)  # a 0 of any kind
    for x, y in ((left, right), (right, left)):
        if written and isinstance(x, Function) and x == 0 and not isinstance(y, Function):
            left, right = y, times(Fraction(0), y)
    if isinstance(left, Operator) and isinstance(right, Operator):
        b = model.space.any_field(model.draw)
        on_curve = {x.on_curve for x in (left, right)}
        if on_curve == {True}:
            b = tuple(map(model.curve.of_space, b))
        left, right = (times(x, b) for x in (left, right))
    if isinstance(left, Told) or isinstance(right, Told):
        like = next((x for x in (left, right) if not isinstance(x, Told)), ())
        if isinstance(like, Function):
            raise EvaluationError("the sides differ: a field and a number")
        if like and like[0].space is model.curve:
            test = tuple(map(model.curve.of_space, model.space.any_field(model.draw)))
        else:
            test = model.space.tangent(model.draw, like)
        left, right = (values.pair(x, test) for x in (left, right))
    if type(left) is not type(right):
        raise EvaluationError("the sides are of two kinds")
    for x, y in zip(functions(left), functions(right), strict=True):
        if x.space is not y.space and not (x.is_constant or y.is_constant):
            raise EvaluationError("one side is over the points, the other in space")
    return left, right


def coefficients(x: Function, y: Function) -> Iterator[tuple[Exponents, tuple[Any, Any]]]:
    """Those of two functions, by their exponents; on a polygon of each edge."""
    for m in {**x.terms, **y.terms}:
        for pair in entries(x.terms.get(m, Fraction(0)), y.terms.get(m, Fraction(0))):
            yield m, pair


def entries(x: Any, y: Any) -> Iterator[tuple[Any, Any]]:
    """Two numbers, or those of each edge."""
    if not isinstance(x, Edges) and not isinstance(y, Edges):
        yield x, y
        return
    size = len(x.each if isinstance(x, Edges) else y.each)
    each = (z.each if isinstance(z, Edges) else (z,) * size for z in (x, y))
    yield from zip(*each, strict=True)


def functions(x: Value) -> tuple[Function, ...]:
    """The functions that a value is made of."""
    if isinstance(x, Matrix):
        return tuple(f for row in x.rows for f in row)
    if isinstance(x, OnBoundary):
        return (x.f,)
    return x if isinstance(x, tuple) else (x,)


def kind_of(x: Value) -> str:
    """The type of a value, as a record has it."""
    if isinstance(x, Function):
        return "scalar" if x.is_constant else "scalar field"
    if isinstance(x, OnBoundary):
        return "scalar field"
    if isinstance(x, Matrix):
        return "tensor field"
    return "operator" if isinstance(x, Operator) else "vector field"
