"""Exact elements of the least algebraic group that contains a group given by a basis of 𝔤.

What is polynomial in the entries of g and holds on the group holds there, and the other way round.
Of exp(sE), with E = S + N its semisimple and nilpotent parts, that is exp(uN) times a torus: a
power of one number for each rational eigenvalue of S, and a point of a conic c² + qσ² = 1 for a
pair ±√−q, since cos(ωs) 1 + (sin(ωs)/ω) S does not need ω.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import lcm

from ..language import rational as q
from ..language.rational import Matrix
from ..language.univariate import derivative, division, square_free, value
from .samplers import Sampler, Source, exponentials, integer

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

    def sample(self, random: Source, size: int) -> Matrix:
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
        projection = q.scaled(1 / value(other, x), _at(other, S))
        plane = q.minus(plane, projection)
        powers.append((int(x * over), projection))
    square = rest[0] / rest[2] if len(rest) == 3 else Fraction(0)
    return OneParameter(tuple(powers), q.times(S, plane), plane, square, q.minus(e, S))


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
        back = q.inverse(_at(slope, S))
        assert back is not None
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
                if x not in found and value(f, x) == 0:
                    found.append(x)
    return found


def _at(f: Polynomial, m: Matrix) -> Matrix:
    """f of a matrix."""
    one = q.identity(len(m))
    total = q.scaled(0, one)
    for c in reversed(f):
        total = q.plus(q.times(total, m), q.scaled(c, one))
    return total
