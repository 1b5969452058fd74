"""All symmetries of a kind: the kernel of the conditions, for generic parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm

from ..algebra.exact_kernel import Rows, kernel, rational
from ..algebra.residue_vectors import Residues
from ..language.tree import Tree, coefficient, mul, plain, terms
from ..problem.problem import ProblemError
from .conditions import Conditions
from .in_parameters import Quotient, Samples, constant, quantities, quotients_of
from .scalar_lagrangian import by_state, of_parameters
from .sparse_vectors import Columns, independent, sparse, vector

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
        self.system, self.primes = system, system.parameters.primes
        self.p = self.primes[0]
        self._others: dict[int, tuple[dict[Tree, int], Rows]] = {}
        self.shapes: list[Columns] = []
        ((_, rows),) = system.systems(1, self.p, 1)
        found, free = kernel(rows, system.unknowns.count, self.p)
        first = system.unknowns.first_field
        kept = [x for x, c in zip(found, free, strict=True) if c >= first]
        self.free = [c for c in free if c >= first]
        self.support = [c for c, column in enumerate(zip(*kept, strict=True)) if any(column)]

    def at(self, count: int, seed: int) -> list[tuple[dict[Tree, int], Rows]]:
        """Random parameters, and the kernel there on the columns of its support."""
        found = []
        for values, rows in self.system.systems(count, self.p, seed, self.support):
            basis, free = kernel(rows, len(self.support), self.p)
            if [self.support[c] for c in free] != self.free:
                raise ProblemError(
                    f"{self.system.problem.name}: there are not as many symmetries for all "
                    "parameters; give numbers for them"
                )
            found.append((values, self._shaped(basis, self.p)))
        return found

    def _shaped(self, basis: Rows, p: int) -> Rows:
        """The kernel by other vectors, where these have been chosen."""
        return [vector(basis, x, p) for x in self.shapes] if self.shapes else basis

    @cached_property
    def samples(self) -> tuple[list[dict[Tree, int]], list[list[Residues]]]:
        """Values of the parameters, and the kernel, symmetries × support, for all of them."""
        found = self.at(2, 2)
        if found[0][1] != found[1][1]:
            found += self.at(SAMPLES, 3)
        rows = zip(*(basis for _, basis in found), strict=True)
        table = [[Residues([*x], self.p) for x in zip(*row, strict=True)] for row in rows]
        return [x for x, _ in found], table

    @cached_property
    def known(self) -> dict[Tree, Samples]:
        """The residues of the quantities that depend on parameters alone, for each sample."""
        trees = quantities(self.system.tape, of_parameters)
        values = self.samples[0]
        return {t: Residues([self._value(t, x) for x in values], self.p) for t in trees}

    def _value(self, t: Tree, values: Mapping[Tree, int]) -> int:
        return self.system.parameters.at(t, values, self.p)

    def solutions(self) -> list[Solution]:
        """The symmetries: in the order of their last columns, or those with many zeros if only
        these are found as functions of the parameters; ``ProblemError`` if none are."""
        found = [self._solution(k) for k in range(len(self.free))]
        if None in found:
            found = self._sparse_solutions()
        if len(found) < len(self.free):
            raise ProblemError(
                f"{self.system.problem.name}: a coefficient of a symmetry is no simple "
                "function of the parameters; give numbers for them"
            )
        return [x for x in found if x is not None]

    def _sparse_solutions(self) -> list[Solution | None]:
        """Independent ones among vectors with many zeros, as far as they are found."""
        tried = sparse(self._first(), self.p)
        self._choose(tried)
        rows, found, chosen = self._first(), list[Solution | None](), list[int]()
        for k in range(len(tried)):
            rank = independent([rows[i] for i in (*chosen, k)], self.p)
            if rank and (x := self._solution(k)):
                found.append(x)
                chosen.append(k)
        self._choose([tried[k] for k in chosen])
        return found

    def _first(self) -> Rows:
        """The kernel for the first of the values."""
        return [[x.values[0] for x in row] for row in self.samples[1]]

    def _choose(self, shapes: list[Columns]) -> None:
        """Takes other vectors of the kernel."""
        self.shapes = shapes
        del self.samples
        self._others.clear()

    def _solution(self, k: int) -> Solution | None:
        found = {}
        for j, (column, x) in enumerate(zip(self.support, self.samples[1][k], strict=True)):
            if x:
                guesses = quotients_of(x, self.known, self.p)
                quotient = self._constant(k, j) or next(
                    (y for y in guesses if self._holds(y, k, j)), None
                )
                if quotient is None:
                    return None
                found[column] = quotient
        return Solution(_without_divisors(found, self.system.unknowns.first_field))

    def _constant(self, k: int, j: int) -> Quotient | None:
        """The number that a coefficient is for all parameters, by as many primes as it needs:
        rational, or a multiple of a root of a number."""
        if not constant(self.samples[1][k][j]):
            return None
        for t in (1, *self.system.parameters.roots_of_numbers):
            x = self._multiple_of(t, k, j)
            if x is not None:
                return mul(plain(x), t), 1
        return None

    def _multiple_of(self, t: Tree, k: int, j: int) -> Fraction | None:
        """A coefficient over a constant, if that is a fraction."""
        residues: list[int] = []
        for count, p in enumerate(self.primes, 1):
            values, basis = self._modulo(p)
            residues.append(basis[k][j] * pow(self.system.parameters.at(t, values, p), -1, p) % p)
            if count > 1 and (x := rational(residues, self.primes[:count])) is not None:
                return x
        return None

    def _holds(self, quotient: Quotient, k: int, j: int) -> bool:
        """Is a coefficient what was found, modulo another prime too?"""
        p = self.primes[1]
        values, basis = self._modulo(p)
        above, below = (self.system.parameters.at(t, values, p) for t in quotient)
        return (above - below * basis[k][j]) % p == 0

    def _modulo(self, p: int) -> tuple[dict[Tree, int], Rows]:
        """Random parameters, and the kernel there, modulo another prime."""
        if p not in self._others:
            ((values, rows),) = self.system.systems(1, p, 4, self.support)
            self._others[p] = values, self._shaped(kernel(rows, len(self.support), p)[0], p)
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
