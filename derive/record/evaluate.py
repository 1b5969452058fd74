"""The value of a tree over any ring: fractions, dual numbers, floats, SymPy expressions.

A value is a scalar, or a matrix as a tuple of rows (a vector is a matrix of one column).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from ..algebra import rational as q
from ..algebra.tree import Tree

Value = Any

LARGEST_POWER, LARGEST_MATRIX, LARGEST_NESTING = 64, 8, 3


class EvaluationError(ValueError):
    """A tree that has no value: an unknown name, or shapes that do not fit."""


@dataclass
class Environment:
    """Values of names, of the members of indexed families, and of functions.

    ``functions[name](arguments, environment)`` receives the argument trees.
    """

    size: int
    names: Mapping[str, Value]
    families: Mapping[str, Mapping[tuple[int, ...], Value]] = field(default_factory=dict)
    functions: Mapping[str, Callable[..., Value]] = field(default_factory=dict)
    parameters: Mapping[str, Value] = field(default_factory=dict)
    indices: Mapping[str, int] = field(default_factory=dict)

    def with_index(self, name: str, value: int) -> Environment:
        """The same with an index bound."""
        return Environment(
            self.size,
            self.names,
            self.families,
            self.functions,
            self.parameters,
            {**self.indices, name: value},
        )


def is_matrix(x: Value) -> bool:
    """Is the value a matrix?"""
    return isinstance(x, tuple)


def evaluate(t: Tree, env: Environment) -> Value:
    """The value of a tree; :class:`EvaluationError` when it has none."""
    if isinstance(t, str):
        if t not in env.names:
            raise EvaluationError(f"no value for {t!r}")
        return env.names[t]
    if isinstance(t, (int, Fraction)):
        return Fraction(t)
    op = t[0]
    try:
        if op in STRUCTURAL:
            return STRUCTURAL[op](t, env)
        return OPERATIONS[op](*(evaluate(x, env) for x in t[1:]), env=env)
    except (IndexError, TypeError, ZeroDivisionError) as error:
        raise EvaluationError(f"{op}: {error}") from error


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
        return a * b
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


def _add(*terms: Value, env: Environment) -> Value:
    del env
    total = terms[0]
    for term in terms[1:]:
        total = plus(total, term)
    return total


def _mul(*factors: Value, env: Environment) -> Value:
    del env
    scalars = [x for x in factors if not is_matrix(x)]
    matrices = [x for x in factors if is_matrix(x)]
    product = matrices[0] if matrices else Fraction(1)
    for x in matrices[1:]:
        product = times(product, x)
    for x in scalars:
        product = times(x, product)
    return product


OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": _add,
    "mul": _mul,
    "div": lambda a, b, env: times(a, 1 / b),
    "T": lambda x, env: transpose(x),
    "tr": lambda x, env: trace(x),
    "det": lambda x, env: determinant(x),
    "inv": lambda x, env: inverse(x),
    "one": lambda env: q.identity(env.size),
    "inner": lambda a, b, env: inner(a, b),
    "metric": lambda m, a, b, env: inner(a, b, m),
    "norm2": lambda *x, env: inner(x[-1], x[-1], x[0] if len(x) == 2 else None),
    "bracket": lambda a, b, env: q.bracket(a, b),
    "wedge": lambda a, b, env: wedge(a, b),
    "hat": lambda a, env: hat(a),
    "row": lambda *x, env: tuple(scalar(v) for v in x),
    "matrix": lambda *rows, env: _matrix(rows),
    "pow": lambda x, n, env: power(x, n),
}


def _matrix(rows: tuple[Any, ...]) -> Value:
    if len({len(row) for row in rows}) != 1:
        raise EvaluationError("the rows of a matrix must be of one length")
    return rows


def _sum(t: tuple[Any, ...], env: Environment) -> Value:
    _, index, body = t
    if index in env.indices or len(env.indices) >= LARGEST_NESTING:
        raise EvaluationError(f"sums nested deeper than {LARGEST_NESTING}, or an index bound twice")
    members = _range(body, index, env)
    total = evaluate(body, env.with_index(index, members[0]))
    for i in members[1:]:
        total = plus(total, evaluate(body, env.with_index(index, i)))
    return total


def _range(body: Tree, index: str, env: Environment) -> list[int]:
    """The values of the index: those of the families it stands in."""
    if isinstance(body, tuple):
        if body[0] == "at" and index in body[2:]:
            family = env.families.get(body[1])
            if not family:
                raise EvaluationError(f"no members of {body[1]!r}")
            return sorted(key[body[2:].index(index)] for key in family)
        for part in body[1:]:
            found = _range(part, index, env)
            if found:
                return found
    return []


def free_indices(t: Tree) -> set[str]:
    """The indices of families that no sum binds: the equation holds for each of their values."""
    if not isinstance(t, tuple):
        return set()
    if t[0] == "at":
        return {i for i in t[2:] if isinstance(i, str)}
    inside: set[str] = set().union(*(free_indices(x) for x in t[1:]))
    return inside - {t[1]} if t[0] == "sum" else inside


def index_values(t: Tree, index: str, env: Environment) -> list[int]:
    """The values that an index takes in a tree."""
    return _range(t, index, env)


def _index(i: Any, env: Environment) -> int:
    if isinstance(i, int):
        return i
    if i not in env.indices:
        raise EvaluationError(f"unbound index {i!r}")
    return env.indices[i]


def _at(t: tuple[Any, ...], env: Environment) -> Value:
    key = tuple(_index(i, env) for i in t[2:])
    try:
        return env.families[t[1]][key]
    except KeyError:
        raise EvaluationError(f"no member {key} of {t[1]!r}") from None


def _entry(t: tuple[Any, ...], env: Environment) -> Value:
    value = evaluate(t[1], env)
    places = [_index(i, env) for i in t[2:]]
    if min(places) < 1 or not is_matrix(value):
        raise EvaluationError("entries of matrices and vectors are counted from 1")
    row = value[places[0] - 1]
    return row[places[1] - 1] if len(t) == 4 else scalar((row,))


def _call(t: tuple[Any, ...], env: Environment) -> Value:
    key = t[1][1] if isinstance(t[1], tuple) else t[1]
    if key not in env.functions:
        raise EvaluationError(f"no function {key!r}")
    return env.functions[key](t[1], t[2:], env)


def _parameter(t: tuple[Any, ...], env: Environment) -> Value:
    if t[1] not in env.parameters:
        raise EvaluationError(f"no parameter {t[1]!r}")
    return env.parameters[t[1]]


STRUCTURAL: dict[str, Callable[[tuple[Any, ...], Environment], Value]] = {
    "sum": _sum,
    "at": _at,
    "entry": _entry,
    "call": _call,
    "par": _parameter,
}
