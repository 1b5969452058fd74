"""Whether a velocity on a group is tangent to it, and group-affine; elements at which it is not.

f_u(ab) = f_u(a)b + a f_u(b) − a f_u(1)b for all a and b: A. Barrau, S. Bonnabel, The invariant
extended Kalman filter as a stable observer, IEEE Transactions on Automatic Control 62 (4), 2017.
What is said to hold is so modulo primes of ten digits at random elements, for letters in place of
the inputs (Schwartz, Zippel); the checker has it once more in its own way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from random import Random
from typing import Any

from ...algebra.exact_kernel import PRIMES, ResidueVectorSource
from ...algebra.groups import Group
from ...algebra.samplers import simple_elements
from ...language import rational as q
from ...language.derivatives import derivative, residue
from ...language.laurent import shortened
from ...language.rational import Matrix
from ...language.tree import add, mul, neg
from ...problem.entries_on_orbit import (
    EntriesOfElement,
    Rows,
    element,
    rational,
    vanishes,
    with_entries,
)

Pair = tuple[Matrix, Matrix]
"""Two elements of the group."""


@dataclass(frozen=True)
class Velocity:
    """f, a matrix of expressions in the entries of A and in other names, on a group."""

    group: Group
    rate: Rows

    def at(self, g: Rows) -> Rows:
        """f at another matrix."""
        return tuple(tuple(shortened(with_entries(t, g)) for t in row) for row in self.rate)

    @property
    def at_one(self) -> Rows:
        """f(1)."""
        return self.at(numbers(q.identity(self.group.size)))

    @property
    def at_estimate(self) -> Rows:
        """f(Â)."""
        return self.at(
            tuple(
                tuple(("entry", "Â", *x[2:]) if isinstance(x, tuple) else x for x in row)
                for row in element(self.group)
            )
        )

    def slope(self, a: int) -> Rows:
        """The derivative of f at 1 in the direction of E_a; a from 0."""
        moved = EntriesOfElement(self.group, "left")
        along = tuple(tuple(moved.along(t, a) for t in row) for row in self.rate)
        return Velocity(self.group, along).at_one

    def by_inputs(self, inputs: tuple[str, ...]) -> Velocity:
        """The derivative of f by the inputs along ς."""
        weights = [(("par", x), ("entry", "ς", j)) for j, x in enumerate(inputs, 1)]
        rate = tuple(
            tuple(add(*(mul(derivative(t, u), e) for u, e in weights)) for t in row)
            for row in self.rate
        )
        return Velocity(self.group, rate)

    # -- exact tests ---------------------------------------------------------------------------

    @property
    def tangent(self) -> bool:
        """Is A⁻¹f(A) in the Lie algebra?"""

        def outside(x: Residues) -> Matrix:
            back = q.inverted(x.a)
            z = q.times(back, x.value(self, x.a))
            return q.minus(z, self.group.hat(self.group.nearest(z)))

        return self._vanishes(outside)

    @property
    def group_affine(self) -> bool:
        """Is f(ab) = f(a)b + a f(b) − a f(1)b?"""

        def defect(x: Residues) -> Matrix:
            whole = x.value(self, q.times(x.a, x.b))
            one = x.value(self, q.identity(self.group.size))
            parts = q.plus(q.times(x.value(self, x.a), x.b), q.times(x.a, x.value(self, x.b)))
            return q.plus(q.minus(whole, parts), q.times(q.times(x.a, one), x.b))

        return self._vanishes(defect)

    @property
    def invariant(self) -> str:
        """ "left" where f(A) = A f(1), "right" where it is f(1) A; "" where it is neither."""

        def defect(x: Residues, *, left: bool) -> Matrix:
            one = x.value(self, q.identity(self.group.size))
            moved = q.times(x.a, one) if left else q.times(one, x.a)
            return q.minus(x.value(self, x.a), moved)

        sides = {"left": True, "right": False}
        found = (k for k, v in sides.items() if self._vanishes(lambda x: defect(x, left=v)))  # noqa: B023
        return next(found, "")

    def _vanishes(self, defect: Callable[[Residues], Matrix]) -> bool:
        """Is a matrix 0 at random elements, modulo each prime?"""
        tried = (Residues(self.group, p, k) for k, p in enumerate(PRIMES))
        return not any(x.number(y) for x in tried for row in defect(x) for y in row)

    # -- elements at which it is not so --------------------------------------------------------

    def defect(self, a: Matrix, b: Matrix) -> Rows:
        """f(ab) − f(a)b − a f(b) + a f(1)b, at numbers."""
        A, B = numbers(a), numbers(b)
        whole, one = self.at(numbers(q.times(a, b))), multiplied(multiplied(A, self.at_one), B)
        parts = multiplied(self.at(A), B), multiplied(A, self.at(B))
        return tuple(
            tuple(
                shortened(add(whole[i][j], neg(parts[0][i][j]), neg(parts[1][i][j]), one[i][j]))
                for j in range(len(A))
            )
            for i in range(len(A))
        )

    def counterexample(self) -> Pair:
        """Two elements with small numbers at which f is not group-affine, where it is not."""
        for pair in _pairs(self.group):
            if not all(vanishes(t) for row in self.defect(*pair) for t in row):
                return pair
        raise ValueError("no simple elements at which the velocity is not group-affine")


class Residues:
    """Two random elements a and b of a group modulo a prime, and values there."""

    def __init__(self, group: Group, p: int, seed: int):
        self.p, self.source = p, ResidueVectorSource(p, 1, seed)
        self.a, self.b = (group.sample_inside(self.source, 1) for _ in range(2))

    def number(self, x: Any) -> int:
        """A residue as a number."""
        return int((self.source.constant(0) + x).values[0])

    def value(self, f: Velocity, m: Matrix) -> Matrix:
        """f at a matrix."""
        rows = tuple(tuple(self.number(x) for x in row) for row in m)
        return tuple(
            tuple(self.source.constant(residue(with_entries(t, rows), self.p)) for t in row)
            for row in f.rate
        )


def _pairs(group: Group) -> Iterator[Pair]:
    """Pairs of simple elements of a group, then some of products of two of these."""
    simple = simple_elements(group.basis)
    yield from product(simple, repeat=2)
    twice = [q.times(a, b) for a, b in product(simple, repeat=2)]
    Random(0).shuffle(twice)  # the same each time
    yield from zip(twice, twice[::-1], strict=True)


# Matrices of expressions.


def numbers(m: Matrix) -> Rows:
    """A matrix of numbers as one of expressions."""
    return tuple(map(tuple, rational(m)))


def multiplied(a: Rows, b: Rows) -> Rows:
    """The product of two matrices."""
    columns = [*zip(*b, strict=True)]
    return tuple(tuple(add(*map(mul, row, column)) for column in columns) for row in a)
