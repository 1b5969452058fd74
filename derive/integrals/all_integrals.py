"""The Casimirs and the polynomial first integrals of Lie–Poisson equations up to a degree."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from typing import Any, TypeVar

from ..language.telling import tell
from .degree_search import Point, Search, UnluckyError, blocks, point, unknowns
from .independence import Integrability, fresh, integrability
from .level import Level
from .lie_poisson import LiePoisson
from .parameter_cases import Case, Cases
from .weights import Grading, grading

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

    case: Case
    degree: Fraction
    system: LiePoisson
    integrals: tuple[Any, ...]
    proved: Integrability


@dataclass(frozen=True)
class Conditions:
    """The ``conditions`` on the parameters, all but those within the ``unsolved``: cases with a
    polynomial where it vanishes."""

    cases: Cases
    conditions: tuple[Condition, ...]
    unsolved: tuple[tuple[Case, Any], ...]


@dataclass(frozen=True)
class Found:
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
    conditions: Conditions | None = None


def found(system: LiePoisson, degree: int) -> Found:
    """All Casimirs and integrals up to a degree, for generic values of the parameters.

    Each is verified by exact brackets; that there are no more is proved, too.
    """
    return _lucky(system, lambda at: _found(system, degree, at))


def casimirs(system: LiePoisson, degree: int) -> list[Any]:
    """All Casimirs up to a degree, whatever the energy is."""
    algebra, by = system.algebra, grading(system)
    every = [algebra.along(j) for j in range(algebra.size)]
    return _lucky(system, lambda at: _all(Search(algebra, by, every, at), degree, []))


def _lucky(system: LiePoisson, searched: Callable[[Point], T]) -> T:
    """What is found at the first point of the parameters that is like a generic one."""
    for attempt in range(ATTEMPTS):
        try:
            return searched(point(system.algebra, attempt))
        except UnluckyError:
            continue
    raise ArithmeticError("no point of the parameters modulo a prime is like a generic one")


def _found(system: LiePoisson, degree: int, at: Point) -> Found:
    algebra, by = system.algebra, grading(system)
    blocks(by, Fraction(degree))  # the largest first: too large a degree is refused at once
    every = Search(algebra, by, [algebra.along(j) for j in range(algebra.size)], at)
    flow = Search(algebra, by, [algebra.flow], at)
    casimirs = _all(every, degree, [])
    integrals = _all(flow, degree, [*casimirs, algebra.energy])
    proved = integrability(algebra, casimirs, integrals, at)
    new = fresh(algebra, casimirs, integrals, at)
    whole = Found(system, degree, by, (*casimirs,), (*integrals,), (*new,), proved)
    return whole if proved.complete else _with_levels(whole, flow)


def _all(search: Search, degree: int, known: Sequence[Any]) -> list[Any]:
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


def _with_levels(whole: Found, flow: Search) -> Found:
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
