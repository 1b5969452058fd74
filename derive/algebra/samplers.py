"""Samplers of groups: exact rational elements, whose entries are polynomials or quotients.

A sampler takes what draws integers, and their range: a :class:`random.Random`, or anything else
with its ``randint``, whose numbers need be no integers but of some ring over Q.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any, Protocol

from ..language import rational as q
from ..language.rational import Matrix


class Source(Protocol):
    """A source of random numbers, as :class:`random.Random` is one."""

    def randint(self, a: int, b: int, /) -> Any:
        """A random integer from a to b."""


Sampler = Callable[[Source, int], Matrix]
"""(source, size) → a random element of a group, from integers within ±size."""


def integer(random: Source, size: int) -> Any:
    """A random integer within ±size, as a fraction or a number of the source's ring."""
    return Fraction(1) * random.randint(-size, size)


def combination(random: Source, size: int, basis: Sequence[Matrix]) -> Matrix:
    """A random element of a linear space of matrices, with integer coordinates on its basis."""
    return q.combine([integer(random, size) for _ in basis], basis)


def cayley(skew: Matrix) -> Matrix:
    """The rotation (1 − S)(1 + S)⁻¹ of a skew S, for which 1 + S is invertible."""
    one = q.identity(len(skew))
    inverse = q.inverse(q.plus(one, skew))
    assert inverse is not None
    return q.times(q.minus(one, skew), inverse)


def by_cayley(basis: Sequence[Matrix]) -> Sampler:
    """A sampler of the group of a Lie algebra of skew matrices, by the Cayley transform; the group
    must contain its values."""
    return lambda random, size: cayley(combination(random, size, basis))


def product(samplers: Sequence[Sampler]) -> Sampler:
    """A sampler of products, with one factor by each of the samplers."""
    return lambda random, size: reduce(q.times, [draw(random, size) for draw in samplers])


def triangular(random: Source, n: int, size: int, *, lower: bool) -> Matrix:
    """A random unitriangular n × n matrix, upper or ``lower``."""
    return tuple(
        tuple(
            Fraction(1) if i == j else integer(random, size) if (i > j) == lower else Fraction(0)
            for j in range(n)
        )
        for i in range(n)
    )


def unitriangular(n: int, *, lower: bool = False) -> Sampler:
    """A sampler of UT(n), upper unitriangular matrices, or ``lower`` ones."""
    return lambda random, size: triangular(random, n, size, lower=lower)


def special_linear(n: int) -> Sampler:
    """A sampler of SL(n), by products lower · upper · lower of unitriangular matrices."""
    return product([unitriangular(n, lower=x) for x in (True, False, True)])


def general_linear(n: int) -> Sampler:
    """A sampler of GL(n): any matrix; singular with probability ≤ n / size, then drawn again."""

    def draw(random: Source, size: int) -> Matrix:
        while True:
            a = tuple(tuple(integer(random, size) for _ in range(n)) for _ in range(n))
            if q.rank(a) == n:
                return a

    return draw


def shears(basis: Sequence[Matrix]) -> Sampler:
    """A sampler of 1 + N, for N in a linear space of matrices all of whose products vanish."""
    one = q.identity(len(basis[0]))
    return lambda random, size: q.plus(one, combination(random, size, basis))


def exponentials(basis: Sequence[Matrix]) -> Sampler:
    """A sampler of exp N = 1 + N + ½N² + …, for N in a nilpotent algebra of n × n matrices,
    products of n of which vanish."""
    n = len(basis[0])

    def draw(random: Source, size: int) -> Matrix:
        N, power, total = combination(random, size, basis), q.identity(n), q.identity(n)
        for k in range(1, n):
            power = q.scaled(Fraction(1, k), q.times(power, N))
            total = q.plus(total, power)
        return total

    return draw


def dilations(n: int) -> Sampler:
    """A sampler of the dilations: positive integer multiples of the n × n identity."""
    return lambda random, size: q.scaled(random.randint(1, size), q.identity(n))


def affine(linear: Sampler, n: int) -> Sampler:
    """A sampler of [[A, T], [0, 1]] with A by a sampler of n × n matrices and any T."""

    def draw(random: Source, size: int) -> Matrix:
        a = linear(random, size)
        shift = q.column(integer(random, size) for _ in range(n))
        return q.bordered(a, shift, Fraction(1))

    return draw


def block_diagonal(blocks: Sequence[Matrix]) -> Matrix:
    """The matrix with square blocks along the diagonal, and 0 elsewhere."""
    size = sum(map(len, blocks))
    rows, offset = [], 0
    for block in blocks:
        before, after = offset, size - offset - len(block)
        rows += [(*(Fraction(0),) * before, *row, *(Fraction(0),) * after) for row in block]
        offset += len(block)
    return tuple(rows)


def blocks(samplers: Sequence[Sampler]) -> Sampler:
    """A sampler of block diagonal matrices, with independent blocks by each of the samplers."""
    return lambda random, size: block_diagonal([draw(random, size) for draw in samplers])
