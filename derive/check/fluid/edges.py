"""Numbers of which a polygon has one for each of its edges."""

from __future__ import annotations

from collections.abc import Callable
from operator import add, mul
from typing import Any


class Edges:
    """One number for each edge, added and multiplied edge by edge; a plain number is the same on
    all."""

    __slots__ = ("each",)

    def __init__(self, each: tuple[Any, ...]):
        self.each = each

    def _with(self, other: Any, operation: Callable[[Any, Any], Any]) -> Edges:
        others = other.each if isinstance(other, Edges) else [other] * len(self.each)
        return Edges(tuple(map(operation, self.each, others)))

    def __add__(self, other: Any) -> Edges:
        return self._with(other, add)

    __radd__ = __add__

    def __neg__(self) -> Edges:
        return Edges(tuple(-x for x in self.each))

    def __mul__(self, other: Any) -> Edges:
        return self._with(other, mul)

    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        return all(self._with(other, lambda x, y: x == y).each)

    __hash__ = None  # type: ignore[assignment]
