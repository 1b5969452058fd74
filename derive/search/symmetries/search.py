"""All symmetries of a kind: the kernel of the conditions, with coefficients in the parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain, combinations, combinations_with_replacement
from math import gcd, lcm
from random import Random

from ...algebra.exact_kernel import (
    ResidueVector,
    Rows,
    echelon,
    fraction_of,
    kernel,
    pivots,
    rational,
)
from ...language.tree import Tree, add, coefficient, mul, plain, terms
from ...problem.problem import ProblemError
from .conditions import SymmetryConditions
from .gradient import Tape
from .scalar_lagrangian import by_state, of_parameters

SAMPLES = 60
"""So many values of the parameters are tried where coefficients depend on them."""


@dataclass(frozen=True)
class SymmetrySolution:
    """The unknowns of one symmetry that do not vanish: column → coefficient, an expression in the
    parameters."""

    coefficients: Mapping[int, Tree]


class SymmetrySearch:
    """The kernel of the conditions of a problem: its support, and its value for any parameters."""

    def __init__(self, system: SymmetryConditions):
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
    def samples(self) -> tuple[list[dict[Tree, int]], list[list[ResidueVector]]]:
        """Values of the parameters, and the kernel, symmetries × support, for all of them."""
        found = self.at(2, 2)
        if found[0][1] != found[1][1]:
            found += self.at(SAMPLES, 3)
        rows = zip(*(basis for _, basis in found), strict=True)
        table = [[ResidueVector([*x], self.p) for x in zip(*row, strict=True)] for row in rows]
        return [x for x, _ in found], table

    @cached_property
    def known(self) -> dict[Tree, Samples]:
        """The residues of the quantities that depend on parameters alone, for each sample."""
        trees = quantities(self.system.tape, of_parameters)
        values = self.samples[0]
        return {t: ResidueVector([self._value(t, x) for x in values], self.p) for t in trees}

    def _value(self, t: Tree, values: Mapping[Tree, int]) -> int:
        return self.system.parameters.at(t, values, self.p)

    def solutions(self) -> list[SymmetrySolution]:
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

    def _sparse_solutions(self) -> list[SymmetrySolution | None]:
        """Independent ones among vectors with many zeros, as far as they are found."""
        tried = sparse(self._first(), self.p)
        self._choose(tried)
        rows, found, chosen = self._first(), list[SymmetrySolution | None](), list[int]()
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

    def _solution(self, k: int) -> SymmetrySolution | None:
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
        return SymmetrySolution(_without_divisors(found, self.system.unknowns.first_field))

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


# Coefficients as functions of the parameters, from their residues for many values of these.
#
# A coefficient is sought among rational multiples of the quantities of L̃ that depend on
# parameters alone (a mass, a first moment), their quotients, their linear combinations, and
# rational functions of small degree. What is found has agreed at more values than it has
# coefficients.

Samples = ResidueVector
"""The residues of a number, one for each of the values of the parameters."""

SPARE = 6
"""So many values more than there are unknown coefficients."""

LARGEST_DEGREE = 4
"""Of the polynomials in parameters in a quotient."""

FEW = 3
"""So many parameters are tried in a quotient, any of them; then all."""

Quotient = tuple[Tree, Tree]
"""Numerator and denominator."""


def quotients_of(samples: Samples, known: dict[Tree, Samples], p: int) -> Iterator[Quotient]:
    """The expressions in known quantities that have these residues, the simplest first.

    ``known``: the residues of quantities, the simplest first, without the number 1.
    """
    for guess in (_constant, _multiple, _ratio, _linear, _rational):
        found = guess(samples, known, p)
        if found is not None:
            yield found


def constant(samples: Samples) -> bool:
    """Is it the same number for all values of the parameters?"""
    return len({*samples.values}) == 1


def _constant(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    del known
    if not constant(samples):
        return None
    x = fraction_of(samples.values[0], p)
    return None if x is None else (plain(x), 1)


def _multiple(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """c times a known quantity."""
    for t, values in known.items():
        c = _same_ratio(samples, values, p)
        if c is not None:
            return mul(plain(c), t), 1
    return None


def _ratio(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """c times a quotient of known quantities."""
    for t, values in known.items():
        if (found := _multiple(samples * values, known, p)) is not None:
            return found[0], t
    return None


def _linear(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """A linear combination of known quantities."""
    listed = [*known][: max(0, len(samples.values) - SPARE)]
    terms = _dependence([known[t] for t in listed], samples, p)
    return None if terms is None else (_combination(terms, listed), 1)


def _rational(samples: Samples, known: dict[Tree, Samples], p: int) -> Quotient | None:
    """A quotient of polynomials in the parameters."""
    names = [t for t in known if isinstance(t, tuple) and t[0] in ("par", "fun")]
    product = _Products(samples, known)
    few = chain.from_iterable(combinations(names, n) for n in range(1, FEW + 1))
    for some in (*few, *[names] * (len(names) > FEW)):
        for degree in range(1, LARGEST_DEGREE + 1):
            every = [*_monomials(some, degree)]
            products = [product[m] for m in every]
            independent = pivots(_rows(products), len(products), p)  # cos² + sin² = 1
            if 2 * len(independent) + SPARE > len(samples.values):
                break
            listed = [every[k] for k in independent]
            columns = [products[k] for k in independent]
            below = [-samples * x for x in columns]
            basis, _ = kernel(_rows([*columns, *below]), 2 * len(columns), p)
            numbers = [fraction_of(x, p) for x in basis[0]] if basis else [None]
            if None not in numbers:
                trees = [mul(1, *m) for m in listed]
                above, under = numbers[: len(listed)], numbers[len(listed) :]
                return _combination(above, trees), _combination(under, trees)
    return None


class _Products(dict[tuple[Tree, ...], Samples]):
    """The products of known quantities, each made when it is asked for."""

    def __init__(self, samples: Samples, known: dict[Tree, Samples]):
        self[()], self.known = samples.like([1] * len(samples.values)), known

    def __missing__(self, m: tuple[Tree, ...]) -> Samples:
        self[m] = self[m[:-1]] * self.known[m[-1]]
        return self[m]


def _monomials(names: Sequence[Tree], degree: int) -> Iterator[tuple[Tree, ...]]:
    for d in range(degree + 1):
        yield from combinations_with_replacement(names, d)


def _rows(columns: Sequence[Samples]) -> Iterator[tuple[int, ...]]:
    """A matrix by its columns."""
    return zip(*(x.values for x in columns), strict=True)


def _same_ratio(a: Samples, b: Samples, p: int) -> Fraction | None:
    """c with a = c b for all samples; ``None`` where there is none."""
    if not b.values[0]:
        return None
    c = a.values[0] * pow(b.values[0], -1, p) % p
    return fraction_of(c, p) if a == b * c else None


def _dependence(
    columns: Sequence[Samples], samples: Samples, p: int
) -> list[Fraction | None] | None:
    """Numbers x with Σ x_k column_k = samples, as few as elimination leaves."""
    if not columns:
        return None
    basis, free = kernel(_rows([*columns, samples]), len(columns) + 1, p)
    if not free or free[-1] != len(columns):
        return None
    numbers = [fraction_of(-x % p, p) for x in basis[-1][:-1]]
    return None if None in numbers else numbers


def _combination(numbers: Sequence[Fraction | None], trees: Sequence[Tree]) -> Tree:
    return add(*(mul(plain(c), t) for c, t in zip(numbers, trees, strict=True) if c))


def quantities(tape: Tape, depends_on_parameters: Callable[[Tree], bool]) -> list[Tree]:
    """The parts of an expression that depend on parameters alone and are factors or terms of what
    does not; the parameters themselves and functions of them first."""
    found: dict[Tree, None] = {}
    for t in tape.places:
        if isinstance(t, tuple) and (t[0] == "par" or t in tape.given):
            found[t] = None
    for t in tape.places:
        if not isinstance(t, tuple) or t[0] in ("par", "entry") or depends_on_parameters(t):
            continue
        inside = [
            x for x in t[1:] if not isinstance(x, (int, Fraction)) and depends_on_parameters(x)
        ]
        if t[0] == "mul" and inside:
            found[mul(1, *inside)] = None
        elif t[0] in ("add", "div"):
            found |= dict.fromkeys(inside)
    return [*found]


# Vectors of a space with many zeros, which have simpler functions of the parameters as entries.
#
# A relabelling of a turned ellipsoid, r ↦ r + εWJ⁻¹r with W skew, has a row of zeros where two of
# the three numbers of W vanish; the reduced echelon form mixes these.

ORDERS = 200
"""So many orders of the columns are tried."""

MOST = 40
"""So many vectors are tried."""

Columns = tuple[int, ...]
"""Where a vector is 1, then where it is 0: as many as the dimension, which determines it."""


def vector(basis: Rows, columns: Columns, p: int) -> list[int]:
    """The vector of the span of independent rows that is 1 and 0 at these columns."""
    width = len(basis[0])
    order = [*columns, *(c for c in range(width) if c not in columns)]
    reduced, _ = echelon(_permuted(basis, order), width, p)
    return [x for _, x in sorted(zip(order, reduced[0], strict=True))]


def sparse(basis: Rows, p: int) -> list[Columns]:
    """Vectors of the span with many zeros, those with most first: rows of echelon forms."""
    random, width = Random(0), len(basis[0])
    found: dict[frozenset[int], Columns] = {}
    for _ in range(ORDERS):
        order = sorted(range(width), key=lambda _: random.random())
        reduced, leading = echelon(_permuted(basis, order), width, p)
        columns = [order[c] for c in leading]
        for k, row in enumerate(reduced):
            support = frozenset(c for c, x in zip(order, row, strict=True) if x)
            found.setdefault(support, (columns[k], *columns[:k], *columns[k + 1 :]))
    return [found[x] for x in sorted(found, key=lambda x: (len(x), sorted(x)))][:MOST]


def _permuted(basis: Rows, order: list[int]) -> Rows:
    return [[row[c] for c in order] for row in basis]


def independent(basis: Rows, p: int) -> bool:
    """Are rows independent modulo p?"""
    return len(pivots(basis, len(basis[0]), p)) == len(basis)
