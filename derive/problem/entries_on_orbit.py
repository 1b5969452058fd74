"""The entries of g in a Lagrangian, how they move; directions without kinetic energy."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any, ClassVar

from ..algebra.exact_kernel import PRIMES, ResidueVector, ResidueVectorSource, fraction_of
from ..algebra.groups import Group, constant_entries
from ..language import rational as q
from ..language.derivatives import DIVISOR_PRIMES, derivative, product, quotient, residue
from ..language.tree import Tree, add, fold, mul, neg, nodes, plain

Entry = tuple[Any, ...]
"""An entry of a letter, as a tree."""


class OrbitEntries(ABC):
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
class EntriesOfElement(OrbitEntries):
    """Those of g, with δg = g E_a on the left, E_a g on the right."""

    letter = "A"
    rate = "Ȧ"
    group: Group
    side: str

    def displaced(self, entry: Entry, a: int) -> Tree:
        """An entry of g E_a, or of E_a g."""
        *_, i, j = entry
        g, e = element(self.group), rational(self.group.basis[a])
        one, two = (g, e) if self.side == "left" else (e, g)
        return add(*(mul(x, row[j - 1]) for x, row in zip(one[i - 1], two, strict=True)))


Rows = tuple[tuple[Tree, ...], ...]
Entries = Sequence[Sequence[Tree]]
"""A matrix of expressions."""


@cache
def element(group: Group) -> Rows:
    """The entries of g: numbers where they are the same in all of the group."""
    still, span = constant_entries(group), range(group.size)

    def entry(i: int, j: int) -> Tree:
        return plain(still[i, j]) if (i, j) in still else ("entry", "A", i + 1, j + 1)

    return tuple(tuple(entry(i, j) for j in span) for i in span)


def with_constant_entries(t: Tree, group: Group) -> Tree:
    """An expression with numbers for the entries of g that are the same in all of the group;
    ``ZeroDivisionError`` where it divides by one that is 0."""
    still = {("entry", "A", i + 1, j + 1) for i, j in constant_entries(group)}
    return with_entries(t, element(group)) if still & {*nodes(t)} else t


def vanishes_on(group: Group, t: Tree) -> bool:
    """Is an expression 0 at all elements of a group, whatever its other names are?

    It is evaluated modulo primes at random elements, so that whatever relations the entries of g
    have are used; where none are known, those alone that never vary are.
    """
    named = any(isinstance(x, tuple) and x[:2] == ("entry", "A") for x in nodes(t))
    if not named or not group.has_inner_samples:
        return vanishes(with_constant_entries(t, group))
    for k, p in enumerate(PRIMES):
        source = ResidueVectorSource(p, 1, k)
        g = group.sample_inside(source, 1)
        rows = tuple(tuple((source.constant(0) + x).values[0] for x in row) for row in g)
        if residue(with_entries(t, rows), p):
            return False
    return True


def with_entries(t: Tree, g: Rows) -> Tree:
    """An expression with those of a matrix for the entries of g."""

    @fold
    def at(x: Tree, *parts: Tree) -> Tree:
        match x:
            case ("entry", "A", int(i), int(j)):
                return g[i - 1][j - 1]
            case ("add", *_):
                return add(*parts)
            case ("mul", *_):
                return product(*parts)
            case ("div", _, _):
                return quotient(*parts)
            case ("pow", _, int(n)):
                return product(("pow", parts[0], n))
            case ("fun", name, _):
                return ("fun", name, parts[0])
        return x

    return at(t)


def rational(rows: Sequence[Sequence[Fraction]]) -> Rows:
    """A matrix of numbers as one of trees: integers where they are."""
    return tuple(tuple(map(plain, row)) for row in rows)


def times(a: Entries, b: Entries) -> Rows:
    """The product of matrices of expressions."""
    columns = [*zip(*b, strict=True)]
    return tuple(
        tuple(
            add(*(mul(x, y) for x, y in zip(row, col, strict=True) if x != 0 and y != 0))
            for col in columns
        )
        for row in a
    )


def wedge(x: Sequence[Tree], y: Sequence[Tree]) -> tuple[Tree, ...]:
    """x ∧ y of two vectors of R³."""
    pairs = ((1, 2), (2, 0), (0, 1))
    return tuple(add(mul(x[i], y[j]), neg(mul(x[j], y[i]))) for i, j in pairs)


def matrix(m: Entries) -> Tree:
    """A matrix as a tree."""
    return ("matrix", *(("row", *row) for row in m))


# Directions of 𝔤 in which a Lagrangian has no kinetic energy, wherever it is.
#
# The second derivatives ∂²ℓ/∂ζ² are evaluated in residues modulo two large primes, names by a
# hash: what is null there, and one vector of small fractions for both, is so everywhere but with
# probability below 1e-14 (Schwartz, Zippel).

Direction = tuple[Fraction, ...]
"""The coordinates of an element of 𝔤."""


def hessian(tree: Tree, zeta: Sequence[Tree]) -> list[list[Tree]]:
    """The second derivatives ∂²ℓ/∂ζ_a∂ζ_b, d × d."""
    slopes = [derivative(tree, x) for x in zeta]
    return [[derivative(slope, y) for y in zeta] for slope in slopes]


def null_directions(second: Sequence[Sequence[Tree]]) -> tuple[Direction, ...] | None:
    """A basis of those that the matrix sends to 0, each 1 in one coordinate where the others are 0,
    the last that can be; ``None`` where they are not the same everywhere."""
    one, two = (
        _kernel([[residue(x, p) for x in row] for row in second], p) for p in DIVISOR_PRIMES
    )
    return one if one == two else None


def vanishes(tree: Tree) -> bool:
    """Is an expression 0 whatever its names are?"""
    return all(residue(tree, p) == 0 for p in DIVISOR_PRIMES)


def along(values: Sequence[Tree], direction: Sequence[Fraction]) -> Tree:
    """Σ x_a v_a."""
    return add(*(mul(plain(x), v) for x, v in zip(direction, values, strict=True) if x))


def held(directions: Sequence[Direction]) -> tuple[int, ...]:
    """The coordinates, from 0, of which each belongs to one of the directions alone: its last."""
    return tuple(max(k for k, x in enumerate(v) if x) for v in directions)


def _kernel(rows: list[list[int]], p: int) -> tuple[Direction, ...] | None:
    """The vectors that a matrix modulo p sends to 0, as fractions; ``None`` where they are none."""
    found: list[Direction] = []
    for vector in q.nullspace(q.matrix([[ResidueVector([x], p) for x in row] for row in rows])):
        residues = (x.values[0] if isinstance(x, ResidueVector) else int(x) for x in vector)
        numbers = [fraction_of(x, p) for x in residues]
        small = [
            x for x in numbers if x is not None and max(abs(x.numerator), x.denominator) <= SMALL
        ]
        if len(small) < len(numbers):
            return None
        found.append(tuple(small))
    return tuple(found)


SMALL = 10**6
"""Larger numbers has no direction."""
