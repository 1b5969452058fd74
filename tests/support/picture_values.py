"""Values of expressions of numbers, vectors and square matrices, for the figures of the course."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import reduce
from operator import truediv
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
    if t in of:
        return of[t]
    if not isinstance(t, tuple):
        return float(t)
    if t[0] == "pow":
        return _power(value(t[1], of), t[2])
    return OPERATIONS[t[0]](*(value(x, of) for x in t[1:]))


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
