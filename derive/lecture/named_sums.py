"""Letters for sums within roots and quotients, where these make an equation wider than the text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ..language.tree import Tree, nodes, replaced, terms
from ..record.record import Equation
from ..views.printing.tex import formula
from ..views.printing.typeset import measure, plain
from .common_factors import by_divisors, tidied
from .displays import WIDTH, sides

LEAST = 10.0
"""The width, in em, from which a sum gets a letter."""
LETTERS = "SNDXY"
"""What sums are called, with an index, by the first of these letters that a text does not have."""


class NamedSums:
    """The letters of a chapter: one sum, one letter; ``used``: the names that its equations have,
    ``parameters``: in the order in which they stand in a product.
    Where a letter is first used, its definition stands below."""

    def __init__(self, used: Iterable[str], parameters: Iterable[str] = ()):
        self.order = (*parameters,)
        used = {*used, *self.order}
        self.letter = next(x for x in LETTERS if not any(y.startswith(x) for y in used))
        self.sums: dict[Tree, Tree] = {}
        self._shown: dict[tuple[Equation, ...], tuple[Equation, ...]] = {}

    def equations(self, told: Sequence[Equation]) -> tuple[Equation, ...]:
        """Equations with letters for sums where they are too wide, and what the letters are; the
        same for both languages."""
        if (told := tuple(told)) not in self._shown:
            self._shown[told] = self._named(told)
        return self._shown[told]

    def _named(self, told: Sequence[Equation]) -> tuple[Equation, ...]:
        # a Lagrangian that is typed keeps the order in which it is
        left = [tidied(e, () if e.lhs == "L̃" else self.order) for e in told]
        found: list[Equation] = []
        while left:
            e = left.pop(0)
            new: list[Equation] = []
            while measure(plain(sides(e).tex)) > WIDTH and (sum_ := self._chosen(e.rhs)):
                if sum_ not in self.sums:
                    self.sums[sum_] = ("at", self.letter, len(self.sums) + 1)
                    divisors = [x for x in nodes(e.rhs) if terms(x)[1:]]
                    new.append(Equation(self.sums[sum_], by_divisors(sum_, divisors)))
                e = Equation(e.lhs, replaced(e.rhs, sum_, self.sums[sum_]), e.for_all, e.exists)
            found.append(e)
            left = new + left
        return tuple(found)

    def _chosen(self, t: Tree) -> Tree:
        """The widest of the sums within roots and quotients that have neither in them; 0 if none
        is."""
        return max(_within(t), key=_width, default=0)


def _width(t: Tree) -> float:
    return measure(plain(formula(t).tex))


def _within(t: Tree, *, inside: bool = False) -> Iterator[Tree]:
    """The sums within a root or a quotient of a tree that are wide and have neither in them."""
    if not isinstance(t, tuple):
        return
    if inside and t[0] == "add" and not any(map(_divided, nodes(t))):
        if _width(t) > LEAST:
            yield t
        return
    for x in t[1:]:
        yield from _within(x, inside=inside or _divided(t))


def _divided(t: Tree) -> bool:
    """Is a tree a quotient, but by a number, or a function as a root?"""
    if not isinstance(t, tuple):
        return False
    return t[0] in ("inv", "fun", "call") or (t[0] == "div" and not isinstance(t[2], int))
