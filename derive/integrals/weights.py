"""Gradings of Lie–Poisson equations: the weights for which the brackets and H are homogeneous.

    w_k = w_i + w_j + s  where x_k occurs in {x_i, x_j},   ⟨e, w⟩ = h  where x^e occurs in H

Then {·, H} takes a polynomial of weight v to one of weight v + h + s, so that integrals are sums of
homogeneous ones.  Weights are in Z, found over Q; or modulo 2, reflections.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from ..language import rational as q
from .lie_poisson import ONE, Exponents, LiePoisson


@dataclass(frozen=True)
class Grading:
    """``degree``: the positive weights by which degrees count, momenta of weight 1.
    ``homogeneous``: is H homogeneous for it?  ``others``: further weights, each with its modulus,
    0 for none."""

    degree: tuple[Fraction, ...]
    homogeneous: bool
    others: tuple[tuple[tuple[int, ...], int], ...]

    def weight(self, e: Exponents) -> Fraction:
        """The degree of a monomial."""
        return sum((k * w for k, w in zip(e, self.degree, strict=True) if k), Fraction(0))

    def largest(self, f: Iterable[Exponents]) -> Fraction:
        """The degree of a polynomial, by the exponents in it."""
        return max(map(self.weight, f))

    def block(self, e: Exponents) -> tuple[int, ...]:
        """The other weights of a monomial: {·, H} does not mix monomials in which these differ."""
        found = []
        for weights, modulus in self.others:
            total = sum(k * w for k, w in zip(e, weights, strict=True) if k)
            found.append(total % modulus if modulus else total)
        return tuple(found)


def grading(system: LiePoisson) -> Grading:
    """The gradings of the equations, and the weights by which degrees count.

    Where H is not homogeneous, its terms of first order in the momenta and low powers of the other
    variables do not count for the degree.
    """
    n = len(system.variables)
    rows = [*_bracket_rows(system)]
    whole = [*rows, *_energy_rows(system.hamiltonian, n)]
    others = [(x, 0) for x in _integral_weights(whole, n)]
    others += [(x, 2) for x in _reflections(whole, n)]
    degree = _degree(whole, system.momenta, n)
    if degree:
        return Grading(degree, True, tuple(others))
    top = [*rows, *_energy_rows(_leading(system), n)]
    degree = _degree(top, system.momenta, n) or (Fraction(1),) * n
    return Grading(degree, False, tuple(others))


Row = tuple[int, ...]
"""The coefficients of w_1 …, w_n, s, h in an equation whose right side is 0."""


def _bracket_rows(system: LiePoisson) -> Iterator[Row]:
    n = len(system.variables)
    for (i, j), form in system.brackets.items():
        for k in form:
            row = [0] * (n + 2)
            row[i] += 1
            row[j] += 1
            row[n] += 1
            if k != ONE:
                row[k] -= 1
            yield tuple(row)


def _energy_rows(monomials: Iterable[Exponents], n: int) -> Iterator[Row]:
    return ((*e, 0, -1) for e in monomials if any(e))


def _leading(system: LiePoisson) -> list[Exponents]:
    """The terms of H that are quadratic in the momenta, and the highest of those without them."""
    m = system.momenta
    still = [e for e in system.hamiltonian if not any(e[:m])]
    most = max(map(sum, still), default=0)
    kinetic = [e for e in system.hamiltonian if sum(e[:m]) == 2 and not any(e[m:])]
    return kinetic + [e for e in still if sum(e) == most > 0]


def _degree(rows: Sequence[Row], momenta: int, n: int) -> tuple[Fraction, ...]:
    """Positive weights with 1 for each momentum; none where there are none."""
    fixed = [tuple(int(i == j) for i in range(n + 2)) for j in range(momenta)]
    ones = (*(0,) * len(rows), *(1,) * momenta)
    extra: list[Row] = []
    while True:
        a = q.matrix([*rows, *fixed, *extra])
        b = q.column((*ones, *(1,) * len(extra)))
        reduced, pivots = q.echelon(tuple((*r, *s) for r, s in zip(a, b, strict=True)))
        if n + 2 in pivots:
            return ()
        free = [j for j in range(n) if j not in pivots]
        if not free:
            break
        extra.append(tuple(int(i == free[0]) for i in range(n + 2)))  # any weight: 1
    found = [Fraction(0)] * (n + 2)
    for r, j in enumerate(pivots):
        found[j] = Fraction(reduced[r][n + 2])
    degree = tuple(found[:n])
    return degree if all(w > 0 for w in degree) else ()


def _integral_weights(rows: Sequence[Row], n: int) -> Iterator[tuple[int, ...]]:
    for x in q.nullspace(q.matrix(rows)):
        below = lcm(*(Fraction(y).denominator for y in x))
        yield tuple(int(y * below) for y in x[:n])


def _reflections(rows: Sequence[Row], n: int) -> Iterator[tuple[int, ...]]:
    """A basis of the weights modulo 2, by elimination."""
    reduced: list[tuple[int, list[int]]] = []
    for row in rows:
        left = [x % 2 for x in row]
        for lead, other in reduced:
            if left[lead]:
                left = [x ^ y for x, y in zip(left, other, strict=True)]
        if any(left):
            lead = left.index(1)
            reduced = [
                (k, [x ^ y for x, y in zip(r, left, strict=True)] if r[lead] else r)
                for k, r in reduced
            ]
            reduced.append((lead, left))
    leads = {k for k, _ in reduced}
    for free in (j for j in range(n + 2) if j not in leads):
        x = [0] * (n + 2)
        x[free] = 1
        for k, r in reduced:
            x[k] = r[free]
        if any(x[:n]):
            yield tuple(x[:n])
