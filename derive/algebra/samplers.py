"""Exact rational elements of groups, for checking: their entries are polynomials or quotients.

Each sampler says how large the degree of its entries is in the integers that it draws: what a
Schwartz–Zippel bound asks for.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from . import rational as q
from .rational import Matrix

Denominators = tuple[tuple[tuple[str, int], int], ...]


@dataclass(frozen=True)
class Sampler:
    """``draw(random, size)``: an element, from integers within ±``size``.

    Its entries are numerators of ``degree`` over the product of ``denominators``: a polynomial's
    (name, degree) and its power.
    """

    draw: Callable[[Random, int], Matrix]
    degree: int
    denominators: Denominators = ()


def integer(random: Random, size: int) -> Fraction:
    """A random integer, as a fraction."""
    return Fraction(random.randint(-size, size))


def combination(random: Random, size: int, basis: Sequence[Matrix]) -> Matrix:
    """A random element of a linear space of matrices."""
    return q.combine([integer(random, size) for _ in basis], basis)


def cayley(skew: Matrix) -> Matrix:
    """(1 − S)(1 + S)⁻¹: a rotation for a skew S, for which 1 + S is invertible."""
    one = q.identity(len(skew))
    inverse = q.inverse(q.plus(one, skew))
    assert inverse is not None
    return q.times(q.minus(one, skew), inverse)


def by_cayley(basis: Sequence[Matrix]) -> Sampler:
    """The group of a Lie algebra of skew matrices that its Cayley transforms stay in."""
    n = len(basis[0])
    return Sampler(
        lambda random, size: cayley(combination(random, size, basis)), n, ((("cayley", n), 1),)
    )


def product(samplers: Sequence[Sampler]) -> Sampler:
    """Products of one element of each."""

    def draw(random: Random, size: int) -> Matrix:
        element = samplers[0].draw(random, size)
        for s in samplers[1:]:
            element = q.times(element, s.draw(random, size))
        return element

    denominators = tuple(
        ((f"{k} {name}", degree), power)
        for k, s in enumerate(samplers)
        for (name, degree), power in s.denominators
    )
    return Sampler(draw, sum(s.degree for s in samplers), denominators)


def triangular(random: Random, n: int, size: int, *, lower: bool) -> Matrix:
    """A unitriangular matrix."""
    return tuple(
        tuple(
            Fraction(1) if i == j else integer(random, size) if (i > j) == lower else Fraction(0)
            for j in range(n)
        )
        for i in range(n)
    )


def unitriangular(n: int, *, lower: bool = False) -> Sampler:
    """UT(n), or its transposes."""
    return Sampler(lambda random, size: triangular(random, n, size, lower=lower), 1)


def special_linear(n: int) -> Sampler:
    """SL(n): lower · upper · lower unitriangular, elementary factors gathered."""
    return product([unitriangular(n, lower=x) for x in (True, False, True)])


def general_linear(n: int) -> Sampler:
    """GL(n): any matrix; singular with probability ≤ n / size, then drawn again."""

    def draw(random: Random, size: int) -> Matrix:
        while True:
            a = tuple(tuple(integer(random, size) for _ in range(n)) for _ in range(n))
            if q.rank(a) == n:
                return a

    return Sampler(draw, 1)


def shears(basis: Sequence[Matrix]) -> Sampler:
    """1 + N for N in a space of matrices whose products vanish."""
    one = q.identity(len(basis[0]))
    return Sampler(lambda random, size: q.plus(one, combination(random, size, basis)), 1)


def exponentials(basis: Sequence[Matrix]) -> Sampler:
    """1 + N + ½N² + … for N in an algebra of matrices of size n whose products of n vanish."""
    n = len(basis[0])

    def draw(random: Random, size: int) -> Matrix:
        N, power, total = combination(random, size, basis), q.identity(n), q.identity(n)
        for k in range(1, n):
            power = q.scaled(Fraction(1, k), q.times(power, N))
            total = q.plus(total, power)
        return total

    return Sampler(draw, n - 1)


def dilations(n: int) -> Sampler:
    """Positive multiples of 1."""

    def draw(random: Random, size: int) -> Matrix:
        return q.scaled(Fraction(random.randint(1, size)), q.identity(n))

    return Sampler(draw, 1)


def affine(linear: Sampler, n: int) -> Sampler:
    """A linear element and any translation."""

    def draw(random: Random, size: int) -> Matrix:
        a = linear.draw(random, size)
        rows = tuple((*row, integer(random, size)) for row in a)
        return (*rows, (*(Fraction(0),) * n, Fraction(1)))

    return Sampler(draw, linear.degree, linear.denominators)


def block_diagonal(blocks: Sequence[Matrix]) -> Matrix:
    """Square blocks along the diagonal."""
    size = sum(map(len, blocks))
    rows, offset = [], 0
    for block in blocks:
        before, after = offset, size - offset - len(block)
        rows += [(*(Fraction(0),) * before, *row, *(Fraction(0),) * after) for row in block]
        offset += len(block)
    return tuple(rows)


def blocks(samplers: Sequence[Sampler]) -> Sampler:
    """Independent elements along the diagonal."""
    joint = product(samplers)
    return Sampler(
        lambda random, size: block_diagonal([s.draw(random, size) for s in samplers]),
        joint.degree,
        joint.denominators,
    )
