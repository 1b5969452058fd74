"""The two sides of an equation at a point: how they differ, and of what degree the claim is."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from ..language.rational import flatten
from ..language.tree import Tree
from ..record.record import Equation
from .arithmetic import EvaluationError, describe_shapes, is_matrix, shape
from .evaluate import Environment, evaluate, free_indices, index_values
from .function_signatures import LATTICE
from .grades import ZERO_GRADE, Degree, Grade, common_degree, degrees

MOST_INDICES = 2


def index_bindings(t: Tree, env: Environment, *, at_once: bool = False) -> Iterator[Environment]:
    """The environment with the free indices of a tree bound, once for each of their values;
    ``at_once``: the last of those of a lattice to all of its points, where that has a value."""
    free = sorted(free_indices(t))
    if len(free) > MOST_INDICES:
        raise EvaluationError("more than two free indices")
    every = [index_values(t, index, env) for index in free]
    if at_once and env.at_once is not None and {*free} <= {*LATTICE}:
        every[-1:] = [[0]] * len(free[-1:])
    for numbers in itertools.product(*every):
        bound = env
        for index, number in zip(free, numbers, strict=True):
            bound = bound.with_index(index, number)
        yield bound


def difference(equation: Equation, env: Environment) -> str:
    """How the sides of an equation differ, for some value of a free index; "" if they agree."""
    if equation.lhs == equation.rhs:
        return "both sides are the same tree: it claims nothing"
    try:
        found = (_difference(*both) for both in _sides(equation, env))
        return next(filter(None, found), "")
    except EvaluationError as error:
        return str(error)


def _sides(equation: Equation, env: Environment) -> Iterator[tuple[Any, Any]]:
    """The values of both sides for each value of the free indices, of one shape, or one side the
    number 0; ``EvaluationError`` for other shapes."""
    trees = (equation.lhs, equation.rhs)
    for there in index_bindings(("add", *trees), env, at_once=True):
        left, right = values = [evaluate(x, there) for x in trees]
        if shape(left) != shape(right) and 0 not in trees:
            raise EvaluationError(f"the sides differ: {describe_shapes(*map(shape, values))}")
        yield left, right


def _entries(x: Any) -> tuple[Any, ...]:
    """Those of a matrix; a number, or what is one for each of many points, is its own."""
    return flatten(x) if isinstance(x, tuple) else (x,)


def _difference(a: Any, b: Any) -> str:
    """The first entry in which two values differ, in words; "" if they are equal."""
    whole = a if is_matrix(a) else b
    alike, both = shape(a) == shape(b), (_entries(a), _entries(b))
    for k, (x, y) in enumerate(zip(*both, strict=True) if alike else itertools.product(*both)):
        if x != y:
            row, column = divmod(k, len(whole[0])) if isinstance(whole, tuple) else (0, 0)
            where = f" in entry ({row + 1}, {column + 1})" if isinstance(whole, tuple) else ""
            numbers = isinstance(x, (int, Fraction)) and isinstance(y, (int, Fraction))
            return f"the sides differ{where}" + (
                f": {as_text(x)} and {as_text(y)}" if numbers else ""
            )
    return ""


def as_text(x: Any) -> str:
    """A rational number as short text for a message: exact if that is short, else to six digits."""
    if Fraction(x).denominator < 10**6 and abs(x) < 10**9:
        return str(x)
    return f"{float(x):.6g}" if abs(x) < Fraction(10) ** 300 else "a large number"


def claim_grade(equation: Equation, env: Environment) -> tuple[int, Grade]:
    """At a point in graded numbers: the degree of an equation, of numerators and denominators
    together, and the grade of its numerators, open indices closed in pairs."""
    whole, top = 0, ZERO_GRADE
    for a, b in _sides(equation, env):
        pairs = zip(_entries(a), _entries(b), strict=True)
        if shape(a) != shape(b):
            pairs = itertools.product(_entries(a), _entries(b))  # type: ignore[assignment]
        open_ = sum(k > 1 for k in max(shape(a), shape(b)))
        open_ += len(free_indices(("add", equation.lhs, equation.rhs)))
        for x in map(common_degree, pairs):
            g = x.numerator
            whole = max(whole, x.total_degree)
            top = Grade(*map(max, top, (g.degree, g.slots + open_, g.loops)))
    return whole, top


def largest_degree(t: Tree, env: Environment) -> int:
    """The largest degree of a value of a tree at a point in graded numbers."""
    values = (evaluate(t, there) for there in index_bindings(t, env))
    found: Iterator[Degree] = (d for x in values for d in degrees(_entries(x)))
    return max((d.total_degree for d in found), default=0)
