"""Directions of 𝔤 in which a Lagrangian has no kinetic energy, wherever it is.

The second derivatives ∂²ℓ/∂ζ² are evaluated in residues modulo two large primes, names by a hash:
what is null there, and one vector of small fractions for both, is so everywhere but with
probability below 1e-14 (Schwartz, Zippel).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from ..language.derivatives import derivative
from ..language.divisors import PRIMES, residue
from ..language.tree import Tree, add, mul, plain

Direction = tuple[Fraction, ...]
"""The coordinates of an element of 𝔤."""


def hessian(tree: Tree, zeta: Sequence[Tree]) -> list[list[Tree]]:
    """The second derivatives ∂²ℓ/∂ζ_a∂ζ_b, d × d."""
    slopes = [derivative(tree, x) for x in zeta]
    return [[derivative(slope, y) for y in zeta] for slope in slopes]


def null_directions(second: Sequence[Sequence[Tree]]) -> tuple[Direction, ...] | None:
    """A basis of those that the matrix sends to 0, each 1 in one coordinate where the others are 0,
    the last that can be; ``None`` where they are not the same everywhere."""
    one, two = (_kernel([[residue(x, p) for x in row] for row in second], p) for p in PRIMES)
    return one if one == two else None


def vanishes(tree: Tree) -> bool:
    """Is an expression 0 whatever its names are?"""
    return all(residue(tree, p) == 0 for p in PRIMES)


def along(values: Sequence[Tree], direction: Direction) -> Tree:
    """Σ x_a v_a."""
    return add(*(mul(plain(x), v) for x, v in zip(direction, values, strict=True) if x))


def held(directions: Sequence[Direction]) -> tuple[int, ...]:
    """The coordinates, from 0, of which each belongs to one of the directions alone: its last."""
    return tuple(max(k for k, x in enumerate(v) if x) for v in directions)


def _kernel(rows: list[list[int]], p: int) -> tuple[Direction, ...] | None:
    """The vectors that a matrix modulo p sends to 0, as fractions; ``None`` where they are none."""
    size, pivots = len(rows), list[int]()
    for column in range(size):
        r = len(pivots)
        found = next((i for i in range(r, size) if rows[i][column]), None)
        if found is None:
            continue
        rows[r], rows[found] = rows[found], rows[r]
        scale = pow(rows[r][column], -1, p)
        rows[r] = [x * scale % p for x in rows[r]]
        for i in range(size):
            if i != r and (factor := rows[i][column]):
                rows[i] = [(x - factor * y) % p for x, y in zip(rows[i], rows[r], strict=True)]
        pivots.append(column)
    directions = []
    for free in (c for c in range(size) if c not in pivots):
        vector = [Fraction(int(c == free)) for c in range(size)]
        for r, column in enumerate(pivots):
            fraction = _fraction(-rows[r][free] % p, p)
            if fraction is None:
                return None
            vector[column] = fraction
        directions.append(tuple(vector))
    return tuple(directions)


SMALL = 10**6


def _fraction(x: int, p: int) -> Fraction | None:
    """The fraction a/b of small numbers that is x modulo p, by Euclid's algorithm."""
    a, b, c, d = p, x, 0, 1
    while b > SMALL:
        quotient = a // b
        a, b, c, d = b, a - quotient * b, d, c - quotient * d
    return Fraction(b, d) if abs(d) <= SMALL else None
