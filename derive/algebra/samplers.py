"""Samplers of groups: exact rational elements, also of a group given by a basis of 𝔤."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import lcm
from typing import Any, Protocol

from ..language import rational as q
from ..language.rational import Matrix
from ..language.univariate import derivative, division, polynomial_value, square_free


class RandomSource(Protocol):
    """A source of random numbers, as :class:`random.Random` is one."""

    def randint(self, a: int, b: int, /) -> Any:
        """A random integer from a to b."""


Sampler = Callable[[RandomSource, int], Matrix]
"""(source, size) → a random element of a group, from integers within ±size."""


def integer(random: RandomSource, size: int) -> Any:
    """A random integer within ±size, as a fraction or a number of the source's ring."""
    return Fraction(1) * random.randint(-size, size)


def combination(random: RandomSource, size: int, basis: Sequence[Matrix]) -> Matrix:
    """A random element of a linear space of matrices, with integer coordinates on its basis."""
    return q.combine([integer(random, size) for _ in basis], basis)


def cayley(skew: Matrix) -> Matrix:
    """The rotation (1 − S)(1 + S)⁻¹ of a skew S, for which 1 + S is invertible."""
    one = q.identity(len(skew))
    inverse = q.inverted(q.plus(one, skew))
    return q.times(q.minus(one, skew), inverse)


def by_cayley(basis: Sequence[Matrix]) -> Sampler:
    """A sampler of the group of a Lie algebra of skew matrices, by the Cayley transform; the group
    must contain its values."""
    return lambda random, size: cayley(combination(random, size, basis))


def product(samplers: Sequence[Sampler]) -> Sampler:
    """A sampler of products, with one factor by each of the samplers."""
    return lambda random, size: reduce(q.times, [draw(random, size) for draw in samplers])


def triangular(random: RandomSource, n: int, size: int, *, lower: bool) -> Matrix:
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

    def draw(random: RandomSource, size: int) -> Matrix:
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

    def draw(random: RandomSource, size: int) -> Matrix:
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

    def draw(random: RandomSource, size: int) -> Matrix:
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


# Exact elements of the least algebraic group that contains a group given by a basis of 𝔤.
#
# What is polynomial in the entries of g and holds on the group holds there, and the other way
# round. Of exp(sE), with E = S + N its semisimple and nilpotent parts, that is exp(uN) times a
# torus: a power of one number for each rational eigenvalue of S, and a point of a conic c² + qσ²
# = 1 for a pair ±√−q, since cos(ωs) 1 + (sin(ωs)/ω) S does not need ω.

Polynomial = tuple[Fraction, ...]
"""Coefficients, the constant one first."""

LARGEST_ROOT = 1000
"""Of the rational eigenvalues, times their denominator."""


@dataclass(frozen=True)
class OneParameter:
    """exp(sE): the projections on the eigenvectors of S for powers of one number, and S where its
    square is −``square``, with the projection there; N."""

    powers: tuple[tuple[int, Matrix], ...]
    turning: Matrix
    plane: Matrix
    square: Fraction
    nilpotent: Matrix

    def sample(self, random: RandomSource, size: int) -> Matrix:
        """A random element."""
        total = q.scaled(Fraction(0), self.turning)
        base = Fraction(1) * random.randint(1, size)
        for k, projection in self.powers:
            total = q.plus(total, q.scaled(base**k, projection) if k else projection)
        m = integer(random, size)
        below = 1 / (1 + m * m * self.square)
        cosine, sine = (1 - m * m * self.square) * below, 2 * m * below
        total = q.plus(total, q.scaled(cosine, self.plane))
        total = q.plus(total, q.scaled(sine, self.turning))
        return q.times(total, exponentials([self.nilpotent])(random, size))


def inner_sampler(basis: Sequence[Matrix]) -> Sampler | None:
    """A sampler of the least algebraic group with this 𝔤 in its own; ``None`` where an element of
    the basis has eigenvalues of another form."""
    found = [one_parameter(e) for e in basis]
    known = [x for x in found if x is not None]
    if len(known) < len(found):
        return None
    return lambda random, size: reduce(
        q.times, [x.sample(random, size) for x in (*known, *known[::-1])]
    )


def one_parameter(e: Matrix) -> OneParameter | None:
    """The parts of exp(sE), for rational eigenvalues and one pair ±√−q; ``None`` for others."""
    f = square_free(minimal_polynomial(e))
    S = _semisimple(e, f)
    roots = _rational_roots(f)
    rest = reduce(lambda g, x: division(g, (-x, Fraction(1)))[0], roots, f)
    if len(rest) > 3 or (len(rest) == 3 and rest[1]) or len(rest) == 2:
        return None
    one = q.identity(len(e))
    over = lcm(*(x.denominator for x in roots)) if roots else 1
    plane, powers = one, []
    for x in roots:
        other = division(f, (-x, Fraction(1)))[0]
        projection = q.scaled(1 / polynomial_value(other, x), _at(other, S))
        plane = q.minus(plane, projection)
        powers.append((int(x * over), projection))
    square = rest[0] / rest[2] if len(rest) == 3 else Fraction(0)
    return OneParameter(tuple(powers), q.times(S, plane), plane, square, q.minus(e, S))


class _Largest:
    """A source of the largest numbers."""

    def randint(self, a: int, b: int, /) -> int:
        """The last one."""
        del a
        return b


def simple_elements(basis: Sequence[Matrix]) -> list[Matrix]:
    """Elements exp(sE) with small numbers, for E in a basis: a shear, a turn by a quarter."""
    known = [x for x in map(one_parameter, basis) if x is not None]
    return [x.sample(_Largest(), size) for size in (1, 2) for x in known]


def minimal_polynomial(e: Matrix) -> Polynomial:
    """The minimal polynomial of a matrix."""
    power, rows = q.identity(len(e)), []
    while True:
        rows.append(q.flatten(power))
        for x in q.nullspace(q.transposed(tuple(rows))):
            return tuple(y / x[-1] for y in x)
        power = q.times(power, e)


def _semisimple(e: Matrix, f: Polynomial) -> Matrix:
    """The semisimple part of a matrix, the root of f near it, by Newton's iteration."""
    S, slope = e, derivative(f)
    while any(map(any, _at(f, S))):
        back = q.inverted(_at(slope, S))
        S = q.minus(S, q.times(_at(f, S), back))
    return S


def _rational_roots(f: Polynomial) -> list[Fraction]:
    """The rational roots of a polynomial without multiple ones."""
    over = lcm(*(x.denominator for x in f))
    whole = [int(x * over) for x in f]
    low = next(x for x in whole if x)
    found = [Fraction(0)] if not whole[0] else []
    for above in (k for k in range(1, min(abs(low), LARGEST_ROOT) + 1) if low % k == 0):
        for below in (
            k for k in range(1, min(abs(whole[-1]), LARGEST_ROOT) + 1) if whole[-1] % k == 0
        ):
            for x in (Fraction(above, below), Fraction(-above, below)):
                if x not in found and polynomial_value(f, x) == 0:
                    found.append(x)
    return found


def _at(f: Polynomial, m: Matrix) -> Matrix:
    """f of a matrix."""
    one = q.identity(len(m))
    total = q.scaled(0, one)
    for c in reversed(f):
        total = q.plus(q.times(total, m), q.scaled(c, one))
    return total
