"""The value of a tree, for the engine and the pictures; the checker has an evaluator of its own.

A value is a scalar of any ring, or a matrix as a tuple of rows (a vector is one of one column).
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce
from typing import Any

from . import rational as q
from .derivatives import DERIVATIVES
from .tree import Tree, fold

Value = Any
LARGEST_POWER = 64


def value(
    t: Tree,
    names: Mapping[str, Value],
    parameters: Mapping[str, Value] | None = None,
    elementary: Callable[[str, Value], Value] | None = None,
    number: Callable[[int | Fraction], Value] = Fraction,
) -> Value:
    """The value of a tree without indices, calls and determinants; ``ValueError`` for any other.

    ``names``, ``parameters``: their values; ``elementary(name, x)``: the value of a function;
    ``number``: what a number is; as floats a stranger's powers of powers take no time.
    """

    def at(t: Tree, *parts: Value) -> Value:
        if isinstance(t, (int, Fraction)):
            return number(t)
        if isinstance(t, str):
            return _looked_up(names, t)
        if t[0] == "par":
            return _looked_up(parameters or {}, t[1])
        if t[0] == "fun" and elementary is not None:
            return elementary(t[1], *parts)
        if t[0] == "pow":
            return _power(parts[0], t[2])
        if t[0] not in OPERATIONS:
            raise ValueError(f"no value for the operator {t[0]!r}")
        return OPERATIONS[t[0]](*parts)

    return fold(at)(t)


def arithmetic(t: tuple[Any, ...], of: Callable[[Tree], Value]) -> Value:
    """The value of a sum, a product, a quotient or a power in any ring, by the values ``of`` its
    operands; ``ValueError`` for any other operator."""
    op = t[0]
    if op in ("add", "mul"):
        return reduce(operator.add if op == "add" else operator.mul, map(of, t[1:]))
    if op == "div":
        return of(t[1]) / of(t[2])
    if op == "pow":
        return of(t[1]) ** t[2]
    raise ValueError(f"no value for the operator {op!r}")


def approximate(
    t: Tree,
    parameters: Mapping[str, float],
    number: Callable[[int | Fraction], Value] = Fraction,
) -> float | None:
    """The value of a tree in floats; ``None`` where a parameter is missing, or there is no
    value."""
    try:
        return float(value(t, {"π": math.pi}, parameters, elementary, number))
    except (ArithmeticError, TypeError, ValueError):
        return None


def elementary(name: str, x: float) -> float:
    """The value at x of a function of :data:`DERIVATIVES`; ``ValueError`` for others."""
    if name not in DERIVATIVES:
        raise ValueError(f"no function {name!r}")
    return float(getattr(math, name)(x))


def _looked_up(table: Mapping[str, Value], name: str) -> Value:
    if name not in table:
        raise ValueError(f"no value for {name!r}")
    return table[name]


def _is_matrix(x: Value) -> bool:
    return isinstance(x, tuple)


def _sum(*terms: Value) -> Value:
    total, *rest = terms
    for x in rest:
        total = q.plus(total, x) if _is_matrix(x) else total + x
    return total


def _product(*factors: Value) -> Value:
    total, *rest = factors
    for x in rest:
        total = _times(total, x)
    return total


def _times(a: Value, b: Value) -> Value:
    if _is_matrix(a) and _is_matrix(b):
        found = q.times(a, b)
        return found[0][0] if len(found) == 1 == len(found[0]) else found
    if _is_matrix(a):
        return q.scaled(b, a)
    return q.scaled(a, b) if _is_matrix(b) else a * b


def _power(x: Value, n: Tree) -> Value:
    if not isinstance(n, int) or abs(n) > LARGEST_POWER:
        raise ValueError(f"the exponent is no integer up to {LARGEST_POWER}")
    if not _is_matrix(x):
        return x**n
    return _product(*[_inverse(x) if n < 0 else x] * abs(n)) if n else Fraction(1)


def _inverse(x: Value) -> Value:
    if not _is_matrix(x):
        return 1 / x
    found = q.inverse(x)
    if found is None:
        raise ValueError("inverse of a singular matrix")
    return found


def _inner(a: Value, b: Value, metric: Value | None = None) -> Value:
    """The value ā M b of vectors, Tr a M b̄ of matrices, a b of numbers."""
    if not _is_matrix(a):
        return a * b
    if len(a[0]) == 1:
        return _times(q.transposed(a), b if metric is None else q.times(metric, b))
    return q.contraction(a if metric is None else q.times(a, metric), b)


def wedge(a: Value, b: Value) -> Value:
    """The vector product a ∧ b in R³, 3 × 1."""
    (x,), (y,), (z,) = a
    (u,), (v,), (w,) = b
    return ((y * w - z * v,), (z * u - x * w,), (x * v - y * u,))


def hat(a: Value) -> Value:
    """The matrix j(a) of a vector, 3 × 3."""
    (x,), (y,), (z,) = a
    zero = x * 0
    return ((zero, -z, y), (z, zero, -x), (-y, x, zero))


OPERATIONS: dict[str, Callable[..., Value]] = {
    "add": _sum,
    "mul": _product,
    "div": lambda a, b: _times(a, 1 / b),
    "T": lambda x: q.transposed(x) if _is_matrix(x) else x,
    "tr": q.trace,
    "inv": _inverse,
    "inner": _inner,
    "metric": lambda m, a, b: _inner(a, b, m),
    "norm2": lambda *x: _inner(x[-1], x[-1], *x[:-1]),
    "wedge": wedge,
    "hat": hat,
    "row": lambda *x: x,
    "matrix": lambda *rows: rows,
}
