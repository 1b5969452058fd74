"""The unit disc: polynomials, whose means over it and potentials are exact.

Fields that are tangent to the boundary and without divergence are those of the stream functions
(1 − x² − y²)q.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import prod
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from .functions import Exponents, Field, Function

DEGREE = 1
"""Of the polynomials that are drawn."""
COSINE, SINE = Fraction(3, 5), Fraction(4, 5)
"""Of the turn where all displacements begin."""


class Disc:
    """The disc; that of the ``points`` is turned."""

    length = 3
    dimension = 2
    bounded = True
    name = "disc"

    def derivative(self, f: Function, j: int) -> Function:
        """∂f/∂x_j."""
        terms = {}
        for m, x in f.terms.items():
            if m[j]:
                terms[tuple(n - (i == j) for i, n in enumerate(m))] = x * m[j]
        return Function(self, terms)

    def mean(self, f: Function) -> Function:
        """The integral over the disc, by its area."""
        orders: dict[Exponents, Any] = {}
        for (a, b, s), x in f.terms.items():
            if a % 2 == b % 2 == 0:
                found = x * mean_of_monomial(a, b)
                orders[0, 0, s] = orders[0, 0, s] + found if (0, 0, s) in orders else found
        return Function(self, orders)

    def potential(self, field: Field) -> Function:
        """A function whose gradient taken away leaves a field without divergence, tangent to the
        boundary: Neumann's problem for polynomials."""
        degree = max((m[0] + m[1] for f in field for m in f.terms), default=0) + 1
        sources = sum((f.d(j) for j, f in enumerate(field)), Function(self, {}))
        flux = on_boundary(
            sum((f * axis(self, j) for j, f in enumerate(field)), Function(self, {}))
        )
        unknown, solving, inside, outside = neumann(degree)
        terms: dict[Exponents, Any] = {}
        for s in {m[2] for f in field for m in f.terms}:
            right = [sources.terms.get((*m, s), Fraction(0)) for m in inside]
            right += [flux.terms.get((*m, s), Fraction(0)) for m in outside]
            for m, row in zip(unknown, solving, strict=True):
                found = [x * y for x, y in zip(row, right, strict=True) if x]
                if found:
                    terms[*m, s] = sum(found[1:], found[0])
        return Function(self, terms)

    def function(self, draw: Any, degree: int = DEGREE) -> Function:
        """A random polynomial."""
        return Function(self, {(*m, 0): draw() for m in monomials(degree)})

    def level(self, draw: Any) -> Function:
        """A random polynomial that is constant on the boundary."""
        found: Function = bump(self) * self.function(draw)
        return found

    def energy(self, draw: Any) -> Function:
        """A random potential per unit mass, whose force is not the same everywhere."""
        return self.function(draw, DEGREE + 1)

    def any_field(self, draw: Any, like: Field = ()) -> Field:
        """A random field."""
        del like
        return self.function(draw), self.function(draw)

    def tangent(self, draw: Any, like: Field = ()) -> Field:
        """A random field that is tangent to the boundary, of the degree of another."""
        degree = max((m[0] + m[1] for f in like for m in f.terms), default=DEGREE)
        inside = [bump(self) * self.function(draw, degree) for _ in range(2)]
        around = self.solenoidal(draw)
        return tuple(x + y for x, y in zip(inside, around, strict=True))

    def solenoidal(self, draw: Any, *, wide: bool = False) -> Field:
        """A random field without divergence that is tangent to the boundary."""
        del wide
        stream = bump(self) * self.function(draw)
        return -stream.d(1), stream.d(0)

    def moved(self) -> Disc:
        """The disc of the points."""
        return Disc()

    def carried(self, f: Function, points: Disc) -> Function:
        """f ∘ g₀, g₀ a turn."""
        x, y = axis(points, 0), axis(points, 1)
        turned = x * COSINE - y * SINE, x * SINE + y * COSINE
        total = Function(points, {})
        for (a, b, s), c in f.terms.items():
            total = total + power(turned[0], a) * power(turned[1], b) * Function(
                points, {(0, 0, s): c}
            )
        return total


def power(f: Function, n: int) -> Function:
    """fⁿ."""
    return prod([f] * n, start=f.constant(Fraction(1)))


def axis(space: Disc, j: int) -> Function:
    """The function x_j."""
    return Function(space, {(int(j == 0), int(j == 1), 0): Fraction(1)})


def bump(space: Disc) -> Function:
    """1 − x² − y², which vanishes at the boundary."""
    one = Fraction(1)
    return Function(space, {(0, 0, 0): one, (2, 0, 0): -one, (0, 2, 0): -one})


def on_boundary(f: Function) -> Function:
    """The same function on the circle, with 1 − x² for y²."""
    total: dict[Exponents, Any] = {}
    for (a, b, s), x in f.terms.items():
        half, odd = divmod(b, 2)
        binomial = Fraction(1)
        for n in range(half + 1):  # (1 − x²)^half
            key, term = (a + 2 * n, odd, s), x * binomial
            total[key] = total[key] + term if key in total else term
            binomial = -binomial * (half - n) / (n + 1)
    return Function(f.space, total)


def monomials(degree: int) -> list[tuple[int, int]]:
    """The exponents of the monomials up to a degree."""
    return [(a, n - a) for n in range(degree + 1) for a in range(n + 1)]


@lru_cache(None)
def mean_of_monomial(a: int, b: int) -> Fraction:
    """The mean of xᵃyᵇ over the disc, for even a and b."""
    double = Fraction(prod(range(1, a, 2)) * prod(range(1, b, 2)), prod(range(2, a + b + 1, 2)))
    return double * 2 / (a + b + 2)


@lru_cache(None)
def neumann(degree: int) -> tuple[list[tuple[int, int]], Matrix, list[Any], list[Any]]:
    """The monomials of the solution; a matrix from the coefficients of Δq and of ∂ₙq to those of q;
    and the monomials of these."""
    space = Disc()
    unknown = monomials(degree)[1:]
    columns = []
    for m in unknown:
        f = Function(space, {(*m, 0): Fraction(1)})
        inside = f.d(0).d(0) + f.d(1).d(1)
        outside = on_boundary(axis(space, 0) * f.d(0) + axis(space, 1) * f.d(1))
        columns.append((inside, outside))
    rows_inside = monomials(max(degree - 2, 0))
    rows_outside = [(a, b) for b in (0, 1) for a in range(degree + 1 - b)]
    rows = [
        [c[k].terms.get((*m, 0), Fraction(0)) for c in columns]
        for k, listed in ((0, rows_inside), (1, rows_outside))
        for m in listed
    ]
    return unknown, left_inverse(tuple(map(tuple, rows))), rows_inside, rows_outside


def left_inverse(m: Matrix) -> Matrix:
    """A matrix with product 1 before m, of independent columns."""
    turned = q.transposed(m)
    found = q.inverse(q.times(turned, m))
    assert found is not None
    return q.times(found, turned)
