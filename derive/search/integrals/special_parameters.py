"""Conditions on the parameters under which there are more integrals than for generic values."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import reduce
from typing import Any

from .all_integrals import (
    Condition,
    IntegralsFound,
    ParameterConditions,
    degrees,
    integrability,
    lucky,
)
from .degree_search import (
    PolynomialSearch,
    PrimePoint,
    TooLargeError,
    blocks,
    products,
    system_rows,
)
from .lie_poisson import Exponents, LiePoisson, Polynomial
from .parameter_cases import Cases, Stratum

LETTERS = 6
"""The most parameters."""
SIZE = 60
"""The most unknowns of one linear system."""
TRIED = 24
"""So many entries with few terms are factored to choose a pivot."""
WORK = 40_000
"""The most products of terms in the eliminations of one search: some ten seconds."""

Sparse = dict[int, Any]
"""A row: unknown → polynomial in the parameters."""


def conditions(result: IntegralsFound) -> ParameterConditions:
    """The conditions under which there are more integrals, up to the degree of what is found;
    ``TooLargeError`` where there are too many parameters, unknowns or cases."""
    algebra = result.system.algebra
    several = len(result.system.parameters)
    if not 0 < several <= LETTERS:
        raise TooLargeError(
            f"conditions on {several} parameters; from 1 to {LETTERS} are searched"
            + ("" if several else ": without --at-defaults parameters stay letters")
        )
    largest = max(map(len, blocks(result.grading, Fraction(result.degree))), default=0)
    if largest > SIZE:
        raise TooLargeError(
            f"degree {result.degree}: conditions on {several} parameters from a linear system of "
            f"{largest} unknowns; at most {SIZE}"
        )
    cases = Cases(algebra)
    known = [algebra.energy, *map(algebra.over_the_field, (*result.casimirs, *result.integrals))]
    drop = _Drop(result, cases)
    for v in degrees(result.grading, result.degree):
        for block in blocks(result.grading, v):
            for matrix in (_equations(result, block), _products(result, block, known, v)):
                if matrix:
                    drop.search(matrix, v)
    widest = [x for x in drop.there if not drop.known(x.case, but=x)]
    unsolved = [(x, f) for x, f in drop.unsolved if not drop.known(x)]
    return ParameterConditions(cases, (*widest,), (*unsolved,))


def _equations(result: IntegralsFound, block: Sequence[Exponents]) -> list[Sparse]:
    """{F, H} = 0 over the parameters: a row for each equation."""
    rows = system_rows(block, [result.system.algebra.flow]).values()
    return [_cleared(row) for row in rows if any(row.values())]


def _products(
    result: IntegralsFound,
    block: Sequence[Exponents],
    known: Sequence[Polynomial],
    degree: Fraction,
) -> list[Sparse]:
    """The products of what is known of a degree that are in a block: a row for each monomial."""
    place = {e: j for j, e in enumerate(block)}
    grading = result.grading
    graded = [(f, grading.largest(f)) for f in known]
    found = products(graded, degree, exactly=grading.homogeneous)
    columns = [x for x in found if x and all(e in place for e in x)]
    rows: dict[Exponents, dict[int, Any]] = {}
    for k, x in enumerate(columns):
        for e, c in x.items():
            rows.setdefault(e, {})[k] = c
    return [_cleared(row) for _, row in sorted(rows.items())]


def _cleared(row: Mapping[int, Any]) -> Sparse:
    """A row of the field times the denominators of its entries."""
    nonzero = {j: c for j, c in row.items() if c}
    if not nonzero:
        return {}
    common = reduce(lambda x, y: x.lcm(y), (c.denom for c in nonzero.values()))
    return {j: c.numer * common.exquo(c.denom) for j, c in nonzero.items()}


class _Drop:
    """The search of the cases in which the rank of a matrix is less than for generic values.

    ``there``: the conditions that are found; ``unsolved``: cases with a factor that is of first
    order in no letter, which every choice of pivots has; ``work``: products of terms so far.
    """

    def __init__(self, result: IntegralsFound, cases: Cases):
        self.result, self.cases = result, cases
        self.there: list[Condition] = []
        self.unsolved: list[tuple[Stratum, Any]] = []
        self.work = 0

    def search(self, rows: Sequence[Sparse], degree: Fraction) -> None:
        """Add the conditions under which the rank of these rows drops."""
        self.rows, self.degree, self.rank = rows, degree, len(rows)
        self.rank, factors = self._pivots(Stratum())
        seen: set[tuple[tuple[int, Any], ...]] = set()
        level = [*self._within(Stratum(), factors)]
        while level:  # few equations first
            following: list[Stratum] = []
            for case in level:
                if case.solved not in seen and not self.known(case):
                    seen.add(case.solved)
                    rank, factors = self._pivots(case)
                    if rank == self.rank:
                        following += self._within(case, factors)
                    else:
                        self.there.append(condition(self.result, self.cases, case, degree))
            level = following

    def known(self, case: Stratum, but: Condition | None = None) -> bool:
        """Is a case within that of a condition that is found?"""
        return any(x is not but and self.cases.inside(case, x.case) for x in self.there)

    def _within(
        self, case: Stratum, factors: Iterable[Any], avoided: frozenset[Any] = frozenset()
    ) -> Iterator[Stratum]:
        """The cases within one in which some factor vanishes, and all that are ``avoided`` may."""
        for f in factors:
            found = self.cases.vanishing(case, f)
            if found is not None:
                yield from found
                continue
            avoid = avoided | {f}  # by other pivots: then one of these vanishes, too
            _, others = self._pivots(case, avoid)
            if avoid & {*others}:
                self.unsolved += [] if (case, f) in self.unsolved else [(case, f)]
                continue
            for inner in self._within(case, others, avoid):
                left = self.cases.at(inner, self.cases.field(f))
                if left == 0:
                    yield inner
                else:
                    yield from self._within(inner, self.cases.factors(left.numer))

    def _pivots(
        self, case: Stratum, avoided: frozenset[Any] = frozenset()
    ) -> tuple[int, list[Any]]:
        """The rank in a case, at most the generic one, and the factors of the pivots and of what
        rows were divided by that may vanish in it, if possible without those ``avoided``."""
        field = self.cases.field
        rows = []
        for row in self.rows:
            entries = {j: self.cases.at(case, field(c)) for j, c in row.items()}
            if cleared := _cleared(entries):
                rows.append(self._divided(cleared, frozenset(), case))
        found: dict[Any, None] = {}
        rank = 0
        while rows and rank < self.rank:
            k, j, new = self._cheapest(rows, found, case, avoided)
            row, debts = rows.pop(k)
            found |= dict.fromkeys(sorted({*debts, *new}, key=str))
            rows = [
                (self._reduced(other, row, j), owed) if j in other else (other, owed)
                for other, owed in rows
            ]
            rows = [self._divided(x, owed, case) for x, owed in rows if x]
            rank += 1
        return rank, [*found]

    def _cheapest(
        self,
        rows: Sequence[tuple[Sparse, frozenset[Any]]],
        found: Mapping[Any, None],
        case: Stratum,
        avoided: frozenset[Any],
    ) -> tuple[int, int, frozenset[Any]]:
        """The row and the column of a pivot with few new factors and terms, and its factors."""
        candidates = sorted(
            (bool(owed & avoided), len(owed - {*found}), len(c), len(row), k, j)
            for k, (row, owed) in enumerate(rows)
            for j, c in row.items()
        )
        best: tuple[tuple[bool, int, int], int, int, frozenset[Any]] | None = None
        for bad, owed, terms, _, k, j in candidates[:TRIED]:
            new = self._factors(rows[k][0][j], case)
            cost = (bad or bool(new & avoided), owed + len(new - {*found}), terms)
            if best is None or cost < best[0]:
                best = cost, k, j, new
            if cost[:2] == (False, 0):
                break
        assert best is not None
        return best[1:]

    def _factors(self, f: Any, case: Stratum) -> frozenset[Any]:
        """The irreducible factors of a polynomial that may vanish."""
        factors = self.cases.factors(f)
        return frozenset(g for g in factors if not self.cases.never_zero(case, g))

    def _divided(
        self, row: Sparse, debts: frozenset[Any], case: Stratum
    ) -> tuple[Sparse, frozenset[Any]]:
        """A row without a common factor, which is noted among its debts."""
        common = reduce(lambda x, y: x.gcd(y), row.values())
        if common.is_ground:
            return row, debts
        divided = {j: c.exquo(common) for j, c in row.items()}
        return divided, debts | self._factors(common, case)

    def _reduced(self, row: Sparse, pivot: Sparse, j: int) -> Sparse:
        """A row less the multiple of another that makes an entry vanish."""
        common = row[j].gcd(pivot[j])
        factor, other = pivot[j].exquo(common), row[j].exquo(common)
        self.work += sum(len(c) for c in row.values()) * len(factor)
        self.work += sum(len(c) for c in pivot.values()) * len(other)
        if self.work > WORK:
            several = len(self.result.system.parameters)
            raise TooLargeError(
                f"degree {self.degree}: conditions on {several} parameters by eliminations of more "
                f"than {WORK} products of terms"
            )
        found = {k: c * factor for k, c in row.items()}
        for k, c in pivot.items():
            found[k] = found[k] - c * other if k in found else -c * other
        return {k: c for k, c in found.items() if c}


# -- the integrals in a case ----------------------------------------------------------------------


def system_in(result: IntegralsFound, cases: Cases, case: Stratum) -> LiePoisson:
    """The equations in a case, in the letters that are left."""
    algebra, system = result.system.algebra, result.system
    solved = {system.parameters[j] for j, _ in case.solved}
    energy = cases.polynomial_at(case, algebra.hamiltonian)
    return replace(
        system,
        hamiltonian={e: algebra.number_tree(c) for e, c in energy.items()},
        parameters=tuple(x for x in system.parameters if x not in solved),
    )


def condition(result: IntegralsFound, cases: Cases, case: Stratum, degree: Fraction) -> Condition:
    """What there is in a case beside the generic integrals, verified over its letters."""
    system = system_in(result, cases, case)
    algebra, generic = system.algebra, result.system.algebra

    def there(f: Any) -> Any:
        polynomial = cases.polynomial_at(case, generic.over_the_field(f))
        return algebra.cleared(
            {e: algebra.number(generic.number_tree(c)) for e, c in polynomial.items()}
        )

    casimirs, integrals = ([there(f) for f in x] for x in (result.casimirs, result.integrals))
    known = [algebra.energy, *map(algebra.over_the_field, (*casimirs, *integrals))]

    def searched(at: PrimePoint) -> Condition:
        search = PolynomialSearch(algebra, result.grading, [algebra.flow], at)
        new = search.of_degree(degree, [f for f in known if f])
        proved = integrability(algebra, casimirs, [*integrals, *new], at)
        return Condition(case, degree, system, (*new,), proved)

    return lucky(system, searched)
