"""Values of expressions of numbers, vectors and square matrices, for the figures of the course."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache, reduce
from operator import itemgetter, truediv
from typing import Any, TypeVar

import numpy as np

from derive.language.tree import Tree

State = TypeVar("State", bound=tuple[Any, ...])


def nearest(run: Sequence[State], times: Iterable[float]) -> list[State]:
    """The states of a motion, each with its time first, that are nearest to some times."""
    return [min(run, key=lambda x: abs(x[0] - t)) for t in times]


def value(t: Tree, of: Mapping[Tree, Any]) -> Any:
    """The value of an expression of numbers, vectors and square matrices, by those ``of`` its
    letters; ``⟨a, b⟩`` is the sum of the products of the components of both."""
    return _function(t, frozenset(of))(of)


@lru_cache(maxsize=256)
def _function(t: Tree, letters: frozenset[Tree]) -> Callable[[Mapping[Tree, Any]], Any]:
    """Letters → the value of an expression: a motion asks for it thousands of times."""
    if t in letters:
        return itemgetter(t)
    if not isinstance(t, tuple):
        number = float(t)
        return lambda of: number
    if t[0] == "pow":
        base, exponent = _function(t[1], letters), t[2]
        return lambda of: _power(base(of), exponent)
    if t[0] not in OPERATIONS:
        raise ValueError(f"no value for the operator {t[0]!r}")
    operation, operands = OPERATIONS[t[0]], [_function(x, letters) for x in t[1:]]
    if len(operands) == 1:
        (only,) = operands
        return lambda of: operation(only(of))
    return lambda of: operation(*[x(of) for x in operands])


def _power(base: Any, exponent: int) -> Any:
    return np.linalg.matrix_power(base, exponent) if np.ndim(base) else base**exponent


def _product(x: Any, y: Any) -> Any:
    return x * y if isinstance(x, float) and isinstance(y, float) else np.dot(x, y)


def hat(x: Any) -> Any:
    """j(x), the matrix of the vector product with x on the left."""
    return np.array([np.cross(x, e) for e in np.eye(3)]).T


OPERATIONS: dict[str, Callable[..., Any]] = {
    "add": lambda *x: sum(x),
    "mul": lambda *x: reduce(_product, x),
    "div": truediv,
    "inv": lambda x: np.linalg.inv(x) if np.ndim(x) else 1 / x,
    "T": np.transpose,
    "tr": np.trace,
    "wedge": np.cross,
    "hat": hat,
    "bracket": lambda x, y: x @ y - y @ x,
    "inner": lambda x, y: np.sum(x * y),
}
"""Operator → its value by those of its operands."""
