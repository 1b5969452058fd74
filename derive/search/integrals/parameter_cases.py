"""Cases of the parameters, and gradings of the equations in which they have a weight."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import lcm, prod
from typing import Any

from ...algebra.exact_kernel import kernel
from ...language import rational as q
from .lie_poisson import ONE, Exponents, LiePoisson, PoissonPolynomials, Polynomial

Values = dict[int, Any]
"""The place of a letter → its value in the field, in the other letters."""


@dataclass(frozen=True)
class Stratum:
    """``solved``: letters with their values, in which no solved letter occurs; ``nonzero``:
    polynomials in the others that do not vanish."""

    solved: tuple[tuple[int, Any], ...] = ()
    nonzero: tuple[Any, ...] = ()


class Cases:
    """The cases of the parameters of a Lie–Poisson system.

    ``positive``: the places of the letters that a positive kinetic energy makes positive;
    ``units``: polynomials that vanish nowhere, the factors of the denominators of H.
    """

    def __init__(self, algebra: PoissonPolynomials):
        self.field, self.ring = algebra.field, algebra.field.field.ring
        self.positive = {*_positive(algebra)}
        below = (c.denom for c in algebra.hamiltonian.values())
        self.units = {*(f for d in below for f, _ in d.factor_list()[1])}
        self._factors: dict[Any, tuple[Any, ...]] = {}

    def factors(self, f: Any) -> tuple[Any, ...]:
        """The irreducible factors of a polynomial in the letters."""
        if f not in self._factors:
            found = () if f.is_ground else (g for g, _ in f.factor_list()[1])
            self._factors[f] = (*found,)
        return self._factors[f]

    # -- values --------------------------------------------------------------------------------

    def at(self, case: Stratum, c: Any) -> Any:
        """An element of the field in a case; ``ZeroDivisionError`` where it has none."""
        if not case.solved:
            return c
        values = dict(case.solved)
        return self._polynomial(c.numer, values) / self._polynomial(c.denom, values)

    def polynomial_at(self, case: Stratum, f: Polynomial) -> Polynomial:
        """A polynomial in x over the field, in a case."""
        found = {e: self.at(case, c) for e, c in f.items()}
        return {e: c for e, c in found.items() if c}

    def _polynomial(self, f: Any, values: Values) -> Any:
        gens = self.field.gens
        total = self.field.zero
        for m, c in f.items():
            powers = (values.get(j, gens[j]) ** k for j, k in enumerate(m) if k)
            total += prod(powers, start=self.field(c))
        return total

    def inside(self, case: Stratum, wider: Stratum) -> bool:
        """Is every point of a case one of the closure of another?"""
        try:
            return all(
                self.at(case, self.field.gens[j]) == self.at(case, value)
                for j, value in wider.solved
            )
        except ZeroDivisionError:
            return False

    # -- where a polynomial vanishes -----------------------------------------------------------

    def vanishing(self, case: Stratum, f: Any) -> list[Stratum] | None:
        """The cases within one in which an irreducible polynomial in its letters vanishes; ``None``
        where it is of first order in no letter."""
        if self.never_zero(case, f):
            return []
        letters = self._squares(f)
        if letters is not None:
            nothing = [tuple((j, self.field.zero) for j in chosen) for chosen in letters]
            return [x for values in nothing for x in self._with(case, values, ())]
        j = self._linear_in(case, f)
        if j is None:
            return None
        slope = f.diff(self.ring.gens[j])
        rest = f - slope * self.ring.gens[j]
        value = -self.field(rest) / self.field(slope)
        if self.never_zero(case, slope):
            return [*self._with(case, ((j, value),), ())]
        found = [*self._with(case, ((j, value),), (slope,))]
        for factor in self.factors(slope):  # and the rest vanishes with it
            there = self.vanishing(case, factor)
            if there is None:
                return None
            for inner in there:
                left = self.at(inner, self.field(rest))
                if left == 0:
                    found.append(inner)
                for g in self.factors(left.numer) if left else ():
                    again = self.vanishing(inner, g)
                    if again is None:
                        return None
                    found += again
        return found

    def never_zero(self, case: Stratum, f: Any) -> bool:
        """Does a polynomial vanish for none of the parameters of a case, or only where a factor
        vanishes that does not?"""
        return all(self._never_zero(case, g) for g in self.factors(f))

    def _never_zero(self, case: Stratum, f: Any) -> bool:
        known = {*self.units, *case.nonzero}
        if f in known or -f in known:
            return True
        own = [(m, c) for m, c in f.items()]
        inside = all(j in self.positive for m, _ in own for j, k in enumerate(m) if k)
        if inside and len({c > 0 for _, c in own}) == 1:
            return True
        letters = self._squares(f)
        if letters == []:
            return True
        return inside and not self._positive_roots(f)

    def _positive_roots(self, f: Any) -> bool:
        """May a polynomial in positive letters vanish?  False is proved: of two letters,
        homogeneous, by Sturm; else True."""
        from sympy import Poly, Symbol

        used = sorted({j for m in f for j, k in enumerate(m) if k})
        if len({sum(m) for m in f}) > 1 or len(used) != 2:
            return True
        terms = {(m[used[0]],): c for m, c in f.items()}
        q = Poly.from_dict(terms, Symbol("s"), domain="QQ")
        return bool(q.count_roots(0, None))

    def _squares(self, f: Any) -> list[tuple[int, ...]] | None:
        """The sets of letters that vanish where a sum of terms of one sign does: even powers of
        letters, times positive ones; ``None`` for no such sum."""
        if len({c > 0 for _, c in f.items()}) > 1:
            return None
        sets = []
        for m in f:
            own = [j for j, k in enumerate(m) if k and j not in self.positive]
            if any(m[j] % 2 for j in own) and len(f) > 1:
                return None
            sets.append(own)
        found = {tuple(sorted({*x})) for x in product(*sets)}
        return sorted(x for x in found if not any({*y} < {*x} for y in found))

    def _linear_in(self, case: Stratum, f: Any) -> int | None:
        """The letter for which a polynomial is solved, one with a coefficient that never vanishes
        before others."""
        first = None
        for j, x in enumerate(self.ring.gens):
            if f.degree(x) == 1:
                if self.never_zero(case, f.diff(x)):
                    return j
                first = j if first is None else first
        return first

    def _with(
        self, case: Stratum, values: Sequence[tuple[int, Any]], nonzero: Sequence[Any]
    ) -> Iterator[Stratum]:
        """The case with these values as well, where it is one."""
        step = Stratum((*values,))
        try:
            solved = [(j, self.at(step, y)) for j, y in case.solved]
            found = [self.at(step, self.field(f)) for f in (*case.nonzero, *nonzero, *self.units)]
        except ZeroDivisionError:
            return
        whole = (*sorted([*solved, *values], key=lambda x: x[0]),)
        if any(f == 0 for f in found):
            return
        if any(j in self.positive and self._not_positive(y) for j, y in whole):
            return
        kept = {g for f in found for g in self.factors(f.numer) if g not in self.units}
        yield Stratum(whole, (*sorted(kept, key=str),))

    def _not_positive(self, y: Any) -> bool:
        """Is a value surely not positive?"""
        if y == 0:
            return True
        signs = set()
        for f in (y.numer, y.denom):
            own = {c > 0 for c in f.values()}
            inside = all(j in self.positive for m in f for j, k in enumerate(m) if k)
            if not inside or len(own) > 1:
                return False
            signs |= {(f is y.denom, *own)}
        return len({s for _, s in signs}) == 2


def _positive(algebra: PoissonPolynomials) -> Iterable[int]:
    """The letters q with c/q, c > 0, as the coefficient of the square of a momentum in H."""
    for a in range(algebra.system.momenta):
        e = tuple(2 * (i == a) for i in range(algebra.size))
        c = algebra.hamiltonian.get(e)
        if c is not None and c.numer.is_ground and len(c.denom) == 1:
            ((m, y),) = c.denom.items()
            used = [j for j, k in enumerate(m) if k]
            if len(used) == 1 and m[used[0]] % 2 and y * c.numer.LC > 0:
                yield used[0]


# Gradings of Lie–Poisson equations: the weights for which the brackets and H are homogeneous.
#
# w_k = w_i + w_j + s  where x_k occurs in {x_i, x_j},   ⟨e, w⟩ = h  where x^e occurs in H
#
# Then {·, H} takes a polynomial of weight v to one of weight v + h + s, so that integrals are
# sums of homogeneous ones. Weights are in Z, found over Q; or modulo 2, reflections.


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
    whole = [*rows, *_energy_rows(system.hamiltonian)]
    others = [(x, 0) for x in _integral_weights(whole, n)]
    others += [(x, 2) for x in _reflections(whole, n)]
    degree = _degree(whole, system.momenta, n)
    if degree:
        return Grading(degree, True, tuple(others))
    top = [*rows, *_energy_rows(_leading(system))]
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


def _energy_rows(monomials: Iterable[Exponents]) -> Iterator[Row]:
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
    """A basis of the weights modulo 2."""
    basis, _ = kernel(([x % 2 for x in row] for row in rows), n + 2, 2)
    return (tuple(x[:n]) for x in basis if any(x[:n]))
