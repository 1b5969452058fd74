"""What a Lagrangian depends on beside the time and ζ: the entries of g, and how they move."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar

from ..algebra.groups import Group
from ..language.derivatives import derivative
from ..language.tree import Tree, add, mul, nodes, plain

Entry = tuple[Any, ...]
"""An entry of a letter, as a tree."""


class Moved(ABC):
    """The entries of a ``letter``, and their rates, those of another."""

    letter: ClassVar[str]
    rate: ClassVar[str]

    @abstractmethod
    def displaced(self, entry: Entry, a: int) -> Tree:
        """The derivative of an entry along the group, in the direction of E_a; a from 0."""

    def entries(self, t: Tree) -> list[Entry]:
        """Those in an expression, once each."""
        found = (x for x in nodes(t) if isinstance(x, tuple) and x[:2] == ("entry", self.letter))
        return [*dict.fromkeys(found)]

    def along(self, t: Tree, a: int) -> Tree:
        """The derivative of an expression in the direction of E_a, at fixed t and Z."""
        terms = (mul(derivative(t, x), self.displaced(x, a)) for x in self.entries(t))
        return add(*terms)

    def in_time(self, t: Tree) -> Tree:
        """Its rate along the motion, at fixed Z."""
        terms = [derivative(t, "t")]
        terms += [mul(derivative(t, x), ("entry", self.rate, *x[2:])) for x in self.entries(t)]
        return add(*terms)


@dataclass(frozen=True)
class EntriesOfElement(Moved):
    """Those of g, with δg = g E_a on the left, E_a g on the right."""

    letter = "A"
    rate = "Ȧ"
    group: Group
    side: str

    def displaced(self, entry: Entry, a: int) -> Tree:
        """An entry of g E_a, or of E_a g."""
        *_, i, j = entry
        g, e = self._element, rational(self.group.basis[a])
        one, two = (g, e) if self.side == "left" else (e, g)
        return add(*(mul(x, row[j - 1]) for x, row in zip(one[i - 1], two, strict=True)))

    @property
    def _element(self) -> list[list[Tree]]:
        span = range(self.group.n)
        return [[entry_of(self.group, i, j) for j in span] for i in span]


def entry_of(group: Group, i: int, j: int) -> Tree:
    """An entry of g: a number in the last row of an affine factor, and between blocks."""
    for offset, factor in group.places:
        inside = range(offset, offset + factor.size)
        if i in inside and j in inside and factor.affine and i == offset + factor.n:
            return int(i == j)
        if (i in inside) != (j in inside):
            return 0
    return ("entry", "A", i + 1, j + 1)


def rational(rows: Sequence[Sequence[Fraction]]) -> list[list[Tree]]:
    """A matrix of numbers as one of trees: integers where they are."""
    return [[plain(x) for x in row] for row in rows]
