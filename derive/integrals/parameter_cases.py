"""Cases of the parameters: where polynomials in them vanish, solved for one letter after another.

Parameters are real numbers.  Those that the kinetic energy makes positive are > 0, and no
denominator of H vanishes.  A factor that is of first order in a letter is solved for it; what
vanishes for no such numbers is dropped; what is neither stays unsolved, and is told.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any

from .lie_poisson import Algebra, Polynomial

Values = dict[int, Any]
"""The place of a letter → its value in the field, in the other letters."""


@dataclass(frozen=True)
class Case:
    """``solved``: letters with their values, in which no solved letter occurs; ``nonzero``:
    polynomials in the others that do not vanish."""

    solved: tuple[tuple[int, Any], ...] = ()
    nonzero: tuple[Any, ...] = ()


class Cases:
    """The cases of the parameters of a Lie–Poisson system.

    ``positive``: the places of the letters that a positive kinetic energy makes positive;
    ``units``: polynomials that vanish nowhere, the factors of the denominators of H.
    """

    def __init__(self, algebra: Algebra):
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

    def at(self, case: Case, c: Any) -> Any:
        """An element of the field in a case; ``ZeroDivisionError`` where it has none."""
        if not case.solved:
            return c
        values = dict(case.solved)
        return self._polynomial(c.numer, values) / self._polynomial(c.denom, values)

    def polynomial_at(self, case: Case, f: Polynomial) -> Polynomial:
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

    def inside(self, case: Case, wider: Case) -> bool:
        """Is every point of a case one of the closure of another?"""
        try:
            return all(
                self.at(case, self.field.gens[j]) == self.at(case, value)
                for j, value in wider.solved
            )
        except ZeroDivisionError:
            return False

    # -- where a polynomial vanishes -----------------------------------------------------------

    def vanishing(self, case: Case, f: Any) -> list[Case] | None:
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

    def never_zero(self, case: Case, f: Any) -> bool:
        """Does a polynomial vanish for none of the parameters of a case, or only where a factor
        vanishes that does not?"""
        return all(self._never_zero(case, g) for g in self.factors(f))

    def _never_zero(self, case: Case, f: Any) -> bool:
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

    def _linear_in(self, case: Case, f: Any) -> int | None:
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
        self, case: Case, values: Sequence[tuple[int, Any]], nonzero: Sequence[Any]
    ) -> Iterator[Case]:
        """The case with these values as well, where it is one."""
        step = Case((*values,))
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
        yield Case(whole, (*sorted(kept, key=str),))

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


def _positive(algebra: Algebra) -> Iterable[int]:
    """The letters q with c/q, c > 0, as the coefficient of the square of a momentum in H."""
    for a in range(algebra.system.momenta):
        e = tuple(2 * (i == a) for i in range(algebra.size))
        c = algebra.hamiltonian.get(e)
        if c is not None and c.numer.is_ground and len(c.denom) == 1:
            ((m, y),) = c.denom.items()
            used = [j for j, k in enumerate(m) if k]
            if len(used) == 1 and m[used[0]] % 2 and y * c.numer.LC > 0:
                yield used[0]
