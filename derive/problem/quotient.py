"""Motions on a quotient of the group: what its directions without kinetic energy change.

Along a direction n that keeps ℓ, g goes on to g exp(s n), on the right to exp(s n) g, with any
function s of the time: δg = s g n, δZ = ṡ n + s [Z, n], δŻ = s̈ n + ṡ [Z, n] + s [Ż, n]; on the
right the brackets change their sign.  A motion of the quotient tells what none of it changes.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..algebra.groups import Group
from ..language.derivatives import derivative
from ..language.tree import Tree, add, mul, neg, plain
from .entries_on_orbit import (
    Direction,
    EntriesOfElement,
    along,
    hessian,
    null_directions,
    vanishes_on,
)
from .fields import coordinates
from .problem import Problem


def quotient_of(problem: Problem) -> Quotient | None:
    """That of a Lagrangian which has such directions."""
    given, group = problem.lagrangian, problem.group
    if given is None or group is None or not given.held:
        return None
    null = null_directions(hessian(given.L, coordinates(group))) or ()
    return Quotient(group, given.trivialisation, null)


class Quotient:
    """What the directions without kinetic energy change; ``side``: the trivialisation."""

    def __init__(self, group: Group, side: str, directions: Sequence[Direction]):
        self.group, self.directions = group, directions
        self.entries = EntriesOfElement(group, side)
        self.sign = 1 if side == "left" else -1
        self.zeta: list[Tree] = coordinates(group)
        self.rates: list[Tree] = [("entry", "ζ̇", a + 1) for a in range(group.dimension)]

    def bracket(self, values: Sequence[Tree], n: Direction) -> list[Tree]:
        """The coordinates of [v, n], on the right of [n, v]."""
        table, span = self.group.structure_constants, range(self.group.dimension)
        return [
            add(
                *(
                    mul(plain(self.sign * x * table[b][a][k]), values[b])
                    for a, x in enumerate(n)
                    for b in span
                    if x and table[b][a][k]
                )
            )
            for k in span
        ]

    def variation(self, t: Tree, n: Direction) -> Tree:
        """That of an expression of g, ζ and ζ̇ where s is constant."""
        span = range(self.group.dimension)
        moved = along([self.entries.along(t, a) for a in span], n)
        terms = [
            mul(derivative(t, x), y)
            for values in (self.zeta, self.rates)
            for x, y in zip(values, self.bracket(values, n), strict=True)
            if y != 0
        ]
        return add(moved, *terms)

    def turned(self, t: Tree, n: Direction) -> list[Tree]:
        """Its derivatives by ṡ and by s̈."""
        by_rates = [derivative(t, x) for x in self.rates]
        ahead = zip(by_rates, self.bracket(self.zeta, n), strict=True)
        first = along([derivative(t, x) for x in self.zeta], n)
        return [add(first, *(mul(x, y) for x, y in ahead)), along(by_rates, n)]

    def keeps(self, t: Tree) -> bool:
        """Has an expression the same value for all motions of one of the quotient?"""
        return all(
            vanishes_on(self.group, x)
            for n in self.directions
            for x in (self.variation(t, n), *self.turned(t, n))
        )

    def laws(self, Q: Sequence[Tree], n: Direction) -> list[tuple[Tree, Tree]]:
        """What is so of a covector that acts on the quotient: ⟨Q, n⟩ = 0; and it goes on with g,
        δQ_a = s ⟨Q, [n, E_a]⟩, on the right −s ⟨Q, [n, E_a]⟩."""
        table, span = self.group.structure_constants, range(self.group.dimension)
        carried = [
            add(
                *(
                    mul(plain(self.sign * x * table[b][a][k]), Q[k])
                    for b, x in enumerate(n)
                    for k in span
                    if x and table[b][a][k]
                )
            )
            for a in span
        ]
        return [(along(Q, n), 0), *zip([self.variation(x, n) for x in Q], carried, strict=True)]

    def bears(self, Q: Sequence[Tree]) -> bool:
        """Is a covector one of the quotient?"""
        return all(
            vanishes_on(self.group, x)
            for n in self.directions
            for x in (
                *(add(one, neg(other)) for one, other in self.laws(Q, n)),
                *(y for t in Q for y in self.turned(t, n)),
            )
        )
