"""All symmetries of a kind: the kernel of the conditions, for generic parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm

import numpy as np

from ..algebra.exact_kernel import kernel, rational
from ..algebra.residue_arrays import PRIMES, Array
from ..language.tree import Tree, coefficient, mul, terms
from ..problem.problem import ProblemError
from .conditions import Conditions
from .in_parameters import Quotient, Samples, quantities, quotient_of
from .scalar_lagrangian import by_state, of_parameters

SAMPLES = 60
"""So many values of the parameters are tried where coefficients depend on them."""


@dataclass(frozen=True)
class Solution:
    """The unknowns of one symmetry that do not vanish: column → coefficient, an expression in the
    parameters."""

    coefficients: Mapping[int, Tree]


class Search:
    """The kernel of the conditions of a problem: its support, and its value for any parameters."""

    def __init__(self, system: Conditions):
        self.system, self.p = system, PRIMES[0]
        self._others: dict[int, tuple[dict[str, int], Array]] = {}
        ((_, rows),) = system.systems(1, self.p, 1)
        found, free = kernel(rows, self.p)
        first = system.unknowns.first_field
        kept = [k for k, c in enumerate(free) if c >= first]
        self.free = [free[k] for k in kept]
        self.support = [int(c) for c in np.flatnonzero(found[kept].any(axis=0))] if kept else []

    def at(self, count: int, seed: int) -> list[tuple[dict[str, int], Array]]:
        """Random parameters, and the kernel there on the columns of its support."""
        found = []
        for values, rows in self.system.systems(count, self.p, seed, self.support):
            basis, free = kernel(rows, self.p)
            if [self.support[c] for c in free] != self.free:
                raise ProblemError(
                    f"{self.system.problem.name}: there are not as many symmetries for all "
                    "parameters; give numbers for them"
                )
            found.append((values, basis))
        return found

    @cached_property
    def samples(self) -> tuple[list[dict[str, int]], Array]:
        """Values of the parameters, and the kernel for each: samples × symmetries × support."""
        found = self.at(2, 2)
        if (found[0][1] != found[1][1]).any():
            found += self.at(SAMPLES, 3)
        return [x for x, _ in found], np.array([x for _, x in found])

    @cached_property
    def known(self) -> dict[Tree, Samples]:
        """The residues of the quantities that depend on parameters alone, for each sample."""
        trees = quantities(self.system.tape, of_parameters)
        values = self.samples[0]
        return {t: np.array([self._value(t, x) for x in values]) for t in trees}

    def _value(self, t: Tree, values: Mapping[str, int]) -> int:
        return self.system.value(t, values, self.p)

    def solutions(self) -> list[Solution]:
        """The symmetries, in the order of their last columns."""
        return [self._solution(k) for k in range(len(self.free))]

    def _solution(self, k: int) -> Solution:
        table = self.samples[1][:, k, :]
        found = {}
        for j, column in enumerate(self.support):
            if table[:, j].any():
                quotient = self._constant(k, j) or quotient_of(table[:, j], self.known, self.p)
                if quotient is None or not self._holds(quotient, k, j):
                    raise ProblemError(
                        f"{self.system.problem.name}: a coefficient of a symmetry is no simple "
                        "function of the parameters; give numbers for them"
                    )
                found[column] = quotient
        return Solution(_without_divisors(found, self.system.unknowns.first_field))

    def _constant(self, k: int, j: int) -> Quotient | None:
        """The number that a coefficient is for all parameters, by as many primes as it needs."""
        column = self.samples[1][:, k, j]
        if (column != column[0]).any():
            return None
        residues = [int(column[0])]
        for count, p in enumerate(PRIMES[1:], 2):
            residues.append(int(self._modulo(p)[1][k, j]))
            x = rational(residues, PRIMES[:count])
            if x is not None:
                return (int(x) if x.denominator == 1 else x), 1
        return None

    def _holds(self, quotient: Quotient, k: int, j: int) -> bool:
        """Is a coefficient what was found, modulo another prime too?"""
        p = PRIMES[1]
        values, basis = self._modulo(p)
        above, below = (self.system.value(t, values, p) for t in quotient)
        return (above - below * int(basis[k, j])) % p == 0

    def _modulo(self, p: int) -> tuple[dict[str, int], Array]:
        """Random parameters, and the kernel there, modulo another prime."""
        if p not in self._others:
            ((values, rows),) = self.system.systems(1, p, 4, self.support)
            self._others[p] = values, kernel(rows, p)[0]
        return self._others[p]


def _without_divisors(found: Mapping[int, tuple[Tree, Tree]], first: int) -> dict[int, Tree]:
    """The coefficients times what they are divided by; those of the field, from the column
    ``first`` on, in whole numbers without common factor."""
    divisors = [*dict.fromkeys(below for _, below in found.values() if below != 1)]
    whole = {
        k: by_state(mul(above, *(x for x in divisors if x != below)))
        for k, (above, below) in found.items()
    }
    numbers = [coefficient(x)[0] for k, t in whole.items() if k >= first for x in terms(t)]
    over = lcm(*(x.denominator for x in numbers))
    scale = Fraction(over, gcd(*(int(x * over) for x in numbers)))
    return {k: by_state(mul(scale, t)) for k, t in whole.items()}
