"""The Casimirs and the polynomial first integrals up to a degree, and what is proved of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import lcm, prod
from random import Random
from typing import Any, TypeVar

from ...language.limits import tell
from .degree_search import PolynomialSearch, PrimePoint, UnluckyPrimeError, blocks, point, unknowns
from .lie_poisson import Level, LiePoisson, PoissonPolynomials, Polynomial, rank_modulo, slope
from .parameter_cases import Cases, Grading, Stratum, grading

ATTEMPTS = 6
LONG = 500
"""More unknowns take seconds: that they are solved for is told before."""

T = TypeVar("T")


@dataclass(frozen=True)
class OnLevel:
    """The ``integrals`` on the level where the Casimir of the number ``casimir``, from 0, vanishes,
    that are none elsewhere, and what is ``proved`` there with all integrals, these last."""

    casimir: int
    integrals: tuple[Any, ...]
    proved: Integrability


@dataclass(frozen=True)
class Condition:
    """A case of the parameters with its system, the ``integrals`` of a ``degree`` that it has
    beside the generic ones, and what is ``proved`` in it with these, the last."""

    case: Stratum
    degree: Fraction
    system: LiePoisson
    integrals: tuple[Any, ...]
    proved: Integrability


@dataclass(frozen=True)
class ParameterConditions:
    """The ``conditions`` on the parameters, all but those within the ``unsolved``: cases with a
    polynomial where it vanishes."""

    cases: Cases
    conditions: tuple[Condition, ...]
    unsolved: tuple[tuple[Stratum, Any], ...]


@dataclass(frozen=True)
class IntegralsFound:
    """Casimirs and integrals, polynomials of the ring of the algebra (over Z in the variables and
    the parameters), of at most a ``degree`` in the ``grading``.

    ``integrals``: those that are no polynomials in H, the Casimirs and those before; ``fresh``: for
    each, is it functionally independent of these?  ``levels``: what there is on levels alone;
    ``conditions``: on the parameters, where they were searched.
    """

    system: LiePoisson
    degree: int
    grading: Grading
    casimirs: tuple[Any, ...]
    integrals: tuple[Any, ...]
    fresh: tuple[bool, ...]
    proved: Integrability
    levels: tuple[OnLevel, ...] = ()
    conditions: ParameterConditions | None = None


def found(system: LiePoisson, degree: int) -> IntegralsFound:
    """All Casimirs and integrals up to a degree, for generic values of the parameters.

    Each is verified by exact brackets; that there are no more is proved, too.
    """
    return lucky(system, lambda at: _found(system, degree, at))


def casimirs(system: LiePoisson, degree: int) -> list[Any]:
    """All Casimirs up to a degree, whatever the energy is."""
    algebra, by = system.algebra, grading(system)
    every = [algebra.along(j) for j in range(algebra.size)]
    return lucky(system, lambda at: _all(PolynomialSearch(algebra, by, every, at), degree, []))


def lucky(system: LiePoisson, searched: Callable[[PrimePoint], T]) -> T:
    """What is found at the first point of the parameters that is like a generic one."""
    for attempt in range(ATTEMPTS):
        try:
            return searched(point(system.algebra, attempt))
        except UnluckyPrimeError:
            continue
    raise ArithmeticError("no point of the parameters modulo a prime is like a generic one")


def _found(system: LiePoisson, degree: int, at: PrimePoint) -> IntegralsFound:
    algebra, by = system.algebra, grading(system)
    blocks(by, Fraction(degree))  # the largest first: too large a degree is refused at once
    every = PolynomialSearch(algebra, by, [algebra.along(j) for j in range(algebra.size)], at)
    flow = PolynomialSearch(algebra, by, [algebra.flow], at)
    casimirs = _all(every, degree, [])
    integrals = _all(flow, degree, [*casimirs, algebra.energy])
    proved = integrability(algebra, casimirs, integrals, at)
    new = fresh(algebra, casimirs, integrals, at)
    whole = IntegralsFound(system, degree, by, (*casimirs,), (*integrals,), (*new,), proved)
    return whole if proved.complete else _with_levels(whole, flow)


def _all(search: PolynomialSearch, degree: int, known: Sequence[Any]) -> list[Any]:
    """The polynomials found degree by degree that are none in the ``known`` and those before."""
    over = search.algebra.over_the_field
    found: list[Any] = []
    there = [search.algebra.energy if type(f) is dict else over(f) for f in known]
    for v in degrees(search.grading, degree):
        if (count := unknowns(search.grading, v)) > LONG:
            what = "Casimirs" if len(search.derivations) > 1 else "integrals"
            where = " on a level" if search.level else ""
            tell(f"{what} of degree {v} are sought{where}: {count} unknowns in one linear system")
        new = search.of_degree(v, there)
        found += new
        there += map(over, new)
    return found


def degrees(by: Grading, most: int) -> Iterator[Fraction]:
    """The degrees that monomials may have, up to one, in order."""
    unit = lcm(*(w.denominator for w in by.degree))
    return (Fraction(k, unit) for k in range(1, most * unit + 1))


def _with_levels(whole: IntegralsFound, flow: PolynomialSearch) -> IntegralsFound:
    """The same, with the integrals on levels of its Casimirs."""
    algebra = whole.system.algebra
    levels = []
    for k, casimir in enumerate(whole.casimirs):
        if Level.possible(algebra, casimir):
            level = Level(algebra, casimir)
            others = [c for c in whole.casimirs if c != casimir]
            known = [*others, algebra.energy, *whole.integrals]
            new = _all(replace(flow, level=level), whole.degree, known)
            if new:
                every = [*whole.integrals, *new]
                proved = integrability(algebra, whole.casimirs, every, flow.at, level)
                levels.append(OnLevel(k, (*new,), proved))
    return replace(whole, levels=(*levels,))


# What is proved of some integrals: independence, involution, complete integrability.
#
# Ranks at a point modulo a prime are never larger than the generic ones over Q(parameters): a
# full rank there is a proof. Brackets are computed in full.


@dataclass(frozen=True)
class Integrability:
    """``rank`` of the Poisson tensor on the reduced space of a ``dimension``, ``proved`` where it
    is the largest even number that the independent Casimirs leave; ``involution``: the places of
    rank/2 integrals, 0 for H, independent of each other and of the Casimirs, in involution; ()
    where they are not known."""

    dimension: int
    rank: int
    proved: bool
    involution: tuple[int, ...]

    @property
    def complete(self) -> bool:
        """Is complete integrability, Liouville's, proved?"""
        return self.proved and len(self.involution) == self.rank // 2 > 0


def integrability(
    algebra: PoissonPolynomials,
    casimirs: Sequence[Any],
    integrals: Sequence[Any],
    at: PrimePoint,
    level: Level | None = None,
) -> Integrability:
    """What is proved by these Casimirs and integrals beside H; on a level of a Casimir alone, where
    one is given."""
    place = _place(algebra, at, level)
    over = algebra.over_the_field
    fixed = [row for _, row in _independent(place, map(over, casimirs))]
    rows = [place.differential(f) for f in (algebra.energy, *map(over, integrals))]
    rank = poisson_rank(algebra, place)
    chosen = _commuting(_Involution(algebra, integrals, level), fixed, rows, rank // 2, at.p)
    most = (algebra.size - len(fixed)) // 2 * 2  # a skew matrix has even rank
    return Integrability(algebra.size, rank, rank == most, chosen)


@dataclass(frozen=True)
class PoissonPoint:
    """A point of the variables, modulo a prime, at a point of the parameters."""

    at: PrimePoint
    x: tuple[int, ...]

    def differential(self, f: Polynomial) -> list[int]:
        """The differential of a polynomial over the field."""
        terms = self.at.residues(f)
        return [self.value(slope(terms, i)) for i in range(len(self.x))]

    def value(self, f: Polynomial) -> int:
        """That of a polynomial modulo the prime."""
        return int(sum(c * self.monomial(e) for e, c in f.items()) % self.at.p)

    def monomial(self, e: tuple[int, ...]) -> int:
        """A monomial in x."""
        return prod(pow(v, k, self.at.p) for v, k in zip(self.x, e, strict=True) if k)


def _place(algebra: PoissonPolynomials, at: PrimePoint, level: Level | None) -> PoissonPoint:
    """A point, the same at every run; on the level, where a Casimir vanishes that is linear in its
    leading variable."""
    random = Random("independence")
    x = [random.randrange(1, at.p) for _ in range(algebra.size)]
    if level is not None:
        i = level.lead.index(1)
        without = PoissonPoint(at, (*x[:i], 0, *x[i + 1 :]))
        factor = without.value(slope({level.lead: 1}, i))
        x[i] = without.value(level.rest) * pow(factor, -1, at.p) % at.p
    return PoissonPoint(at, tuple(x))


def _independent(
    place: PoissonPoint, f: Any, before: Sequence[list[int]] = ()
) -> list[tuple[int, list[int]]]:
    """The polynomials whose differentials are independent of those before, by their numbers, with
    these differentials."""
    chosen: list[tuple[int, list[int]]] = []
    for k, y in enumerate(f):
        row = place.differential(y)
        rows = [*before, *(x for _, x in chosen), row]
        if rank_modulo(rows, place.at.p) == len(rows):
            chosen.append((k, row))
    return chosen


def fresh(
    algebra: PoissonPolynomials, known: Sequence[Any], f: Sequence[Any], at: PrimePoint
) -> list[bool]:
    """For each polynomial: is it functionally independent of H, the known and those before?"""
    over, place = algebra.over_the_field, _place(algebra, at, None)
    start = [row for _, row in _independent(place, [*map(over, known), algebra.energy])]
    chosen = {k for k, _ in _independent(place, map(over, f), start)}
    return [k in chosen for k, _ in enumerate(f)]


def poisson_rank(algebra: PoissonPolynomials, place: PoissonPoint) -> int:
    """The rank of the Poisson tensor at a point."""
    n = algebra.size
    rows = [[0] * n for _ in range(n)]
    for j in range(n):
        for i, form in algebra.along(j).items():
            rows[i][j] = place.value(place.at.residues(form))
    return rank_modulo(rows, place.at.p)


@dataclass(frozen=True)
class _Involution:
    """Which pairs of H and some integrals, by their places, are in involution."""

    algebra: PoissonPolynomials
    integrals: Sequence[Any]
    level: Level | None
    known: dict[tuple[int, int], bool] = field(default_factory=dict)

    def __call__(self, i: int, j: int) -> bool:
        """Are they?  All are with the first, H."""
        if not i:
            return True
        if (i, j) not in self.known:
            bracket = self.algebra.bracket(self.integrals[i - 1], self.integrals[j - 1])
            self.known[i, j] = bracket == 0 or (
                self.level is not None and self.level.contains(bracket)
            )
        return self.known[i, j]


def _commuting(
    commute: _Involution,
    fixed: Sequence[list[int]],
    rows: Sequence[list[int]],
    several: int,
    p: int,
) -> tuple[int, ...]:
    """The first ``several`` places of functions, given by their differentials, that are in
    involution, and independent of each other and of those ``fixed``; () where there are none."""

    def extended(chosen: tuple[int, ...], left: Sequence[int]) -> tuple[int, ...]:
        own = [*fixed, *(rows[k] for k in chosen)]
        if len(chosen) == several:
            return chosen
        if rank_modulo([*own, *(rows[k] for k in left)], p) < len(fixed) + several:
            return ()
        for k, i in enumerate(left):
            if rank_modulo([*own, rows[i]], p) > len(own):
                commuting = [j for j in left[k + 1 :] if commute(i, j)]
                if found := extended((*chosen, i), commuting):
                    return found
        return ()

    return extended((), range(len(rows)))
