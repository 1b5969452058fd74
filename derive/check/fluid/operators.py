"""Operators on fields, and what is told of a field by its scalar products alone.

The transpose of an operator is known by ⟨X̄a, b⟩ = ⟨a, Xb⟩, for fields b tangent to the boundary.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..arithmetic import EvaluationError

Apply = Callable[[Any], Any]
Factor = tuple[Apply, bool]
"""What an operator does, and whether it is transposed."""


@dataclass(frozen=True)
class Operator:
    """A sum of numbers times products of factors; ``on_curve``: of what is along the curve."""

    terms: tuple[tuple[Any, tuple[Factor, ...]], ...]
    on_curve: bool = False

    @staticmethod
    def of(apply: Apply, *, on_curve: bool = False) -> Operator:
        """A single operator."""
        return Operator(((1, ((apply, False),)),), on_curve)

    @property
    def transposed(self) -> Operator:
        """The transpose."""
        turned = ((c, tuple((f, not t) for f, t in reversed(w))) for c, w in self.terms)
        return Operator(tuple(turned), self.on_curve)

    def __add__(self, other: Operator) -> Operator:
        return Operator(self.terms + other.terms, self.on_curve)

    def scaled(self, x: Any) -> Operator:
        """A number times the operator."""
        return Operator(tuple((c * x, w) for c, w in self.terms), self.on_curve)

    def then(self, other: Operator) -> Operator:
        """The product, ``other`` first."""
        both = ((a * b, v + w) for a, v in self.terms for b, w in other.terms)
        return Operator(tuple(both), other.on_curve)


@dataclass(frozen=True)
class Told:
    """A field by its scalar products: a sum of numbers times transposed operators on fields."""

    terms: tuple[tuple[Any, tuple[Factor, ...], Any], ...]

    def __add__(self, other: Told) -> Told:
        return Told(self.terms + other.terms)

    def scaled(self, x: Any) -> Told:
        """A number times the field."""
        return Told(tuple((c * x, w, a) for c, w, a in self.terms))

    def paired(self, b: Any, product: Callable[[Any, Any], Any]) -> Any:
        """⟨this, b⟩, by the ``product`` of fields or of functions."""
        total: Any = 0
        for c, word, a in self.terms:
            moved = b
            for apply, transposed in word:
                if not transposed:
                    raise EvaluationError("an operator stands before a transposed one")
                moved = apply(moved)
            total = product(a, moved) * c + total
        return total


def applied(x: Operator, a: Any, added: Callable[[Any, Any], Any], times: Any) -> Any:
    """The field or function X a; told by scalar products where a transposed operator is left."""
    total: Any = None
    for c, word in x.terms:
        moved, left = a, [*word]
        while left and not left[-1][1]:
            moved = left.pop()[0](moved)
        found = Told(((c, tuple(left), moved),)) if left else times(c, moved)
        total = found if total is None else added(total, found)
    return total
