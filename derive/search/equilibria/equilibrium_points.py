"""Points of the reduced space at which nothing moves: Λ dH = 0, given by a user or tried."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import comb
from typing import Any

from ...language import rational as q
from ...language.expression import parse
from ...language.limits import Refused
from ...language.show import show
from ...language.tree import Tree
from ...language.univariate import Number, Quadratic, value_of
from ...language.univariate import tree as number_tree
from ..integrals.lie_poisson import (
    LiePoisson,
    PoissonPolynomials,
    Polynomial,
    plain,
    scaled,
)
from .entries_of_elements import EntryConditions, numbers

Point = tuple[Number, ...]
Elements = Sequence[EntryConditions]
"""What the entries of g at a point satisfy, in every factor of the group."""
Matrix = Sequence[Sequence[Number]]


class NoEquilibriumError(Refused, ValueError):
    """A point that is none of the problem, or at which something moves: the message says what."""


@dataclass(frozen=True)
class Expansion:
    """A polynomial about a point: its ``value``, its ``slope``, the matrix Q of ``second``
    derivatives, and the terms of y above the second, by exponents."""

    value: Number
    slope: list[Number]
    second: Matrix
    higher: dict[tuple[int, ...], Number]


@dataclass(frozen=True)
class About:
    """The reduced equations about a point: y = x − ``at``."""

    system: LiePoisson
    at: Point

    @property
    def algebra(self) -> PoissonPolynomials:
        """The ring of the polynomials."""
        return self.system.algebra

    def tree(self, x: Number) -> Tree:
        """A number, or a function of letters, as a tree."""
        known = isinstance(x, (int, Fraction, Quadratic))
        return number_tree(x) if known else scaled(self.algebra.number_tree(x))

    def number(self, f: Polynomial) -> Number:
        """The value of a polynomial at the point: few of its terms have one where most coordinates
        are 0."""
        zero = [i for i, x in enumerate(self.at) if x == 0]
        own = ((e, c) for e, c in f.items() if not any(e[i] for i in zero))
        total: Number = Fraction(0)
        for e, c in own:
            term: Any = c if self.algebra.letters else Fraction(plain(c))
            for x, k in zip(self.at, e, strict=True):
                term = term * x**k if k else term
            total = total + term
        return total

    def moving(self) -> list[Number]:
        """The rates of the variables at the point."""
        return [self.number(self.algebra.flow.get(i, {})) for i, _ in enumerate(self.at)]

    def terms(self, f: Polynomial) -> dict[tuple[int, ...], Number]:
        """A polynomial with coefficients in the field, in powers of y, by their exponents."""
        own = f if self.algebra.letters else {e: Fraction(plain(c)) for e, c in f.items()}
        terms = ((m, c * x) for e, c in own.items() for m, x in self._shifted(e).items())
        return dict(sorted(q.summed(terms).items(), key=_order))

    def expansion(self, f: Polynomial) -> Expansion:
        """The same by their orders."""
        n, terms = len(self.at), self.terms(f)

        def of(*places: int) -> Number:
            return terms.get(tuple(places.count(i) for i in range(n)), Fraction(0))

        second = [[of(i, j) * (2 if i == j else 1) for j in range(n)] for i in range(n)]
        higher = {m: c for m, c in terms.items() if sum(m) > 2}
        return Expansion(of(), [of(i) for i in range(n)], second, higher)

    def _shifted(self, e: tuple[int, ...]) -> dict[tuple[int, ...], Number]:
        """The monomial Π (at_i + y_i)^e_i in powers of y."""
        found: dict[tuple[int, ...], Number] = {(): Fraction(1)}
        for value, k in zip(self.at, e, strict=True):
            powers = {j: comb(k, j) * value ** (k - j) for j in range(k + 1)}
            found = {(*m, j): x * y for m, x in found.items() for j, y in powers.items() if y != 0}
        return found

    @cached_property
    def rates(self) -> list[Expansion]:
        """The rates of the variables, ẋ_i."""
        return [self.expansion(self.algebra.flow.get(i, {})) for i, _ in enumerate(self.at)]

    @cached_property
    def tensor(self) -> Matrix:
        """The Poisson tensor Λ at the point."""
        places = range(len(self.at))
        forms = [[self.system.bracket(i, j) for j in places] for i in places]
        return [[*row] for row in numbers(forms, self.at)]


def _order(term: tuple[tuple[int, ...], Number]) -> tuple[int, ...]:
    """Terms as a ring of SymPy orders them, from the last to the first power."""
    return tuple(-k for k in term[0])


def number_from(text: str) -> Number:
    """The exact number of a text as 1/10, 0.5, sqrt(3)/2; ``NoEquilibriumError`` for any other."""
    try:
        return value_of(parse(text))
    except (ValueError, ZeroDivisionError) as error:
        reason = str(error).partition(";")[0]
        raise NoEquilibriumError(
            f"{text[:40]!r} is no exact number, of fractions and one square root: {reason}"
        ) from None


def coordinates(system: LiePoisson, values: Mapping[str, Number]) -> tuple[str, ...]:
    """The names of the variables; ``NoEquilibriumError`` where a value is of none."""
    for name in values:
        if name not in system.names:
            known = ", ".join(system.names)
            raise NoEquilibriumError(f"{name} is no coordinate; these are {known}")
    return system.names


def given(
    system: LiePoisson, values: Mapping[str, Number], kept: Sequence[Polynomial], on: Elements
) -> About:
    """The point with these coordinates, the others 0; ``NoEquilibriumError`` where it is none of
    the problem or no equilibrium.  ``kept``: the Casimirs."""
    names = coordinates(system, values)
    about = About(system, tuple(values.get(x, Fraction(0)) for x in names))
    if reason := off_the_group(about, kept, on):
        raise NoEquilibriumError(f"no element of the group has these entries: {reason}")
    moving = [
        f"the rate of {name} is {rate}"
        for name, rate in zip(names, about.moving(), strict=True)
        if rate
    ]
    if moving:
        raise NoEquilibriumError(f"no equilibrium: {', '.join(moving)}")
    return about


def off_the_group(about: About, kept: Sequence[Polynomial], on: Elements) -> str:
    """How the entries of g at a point cannot be those of an element: what has one value on the
    group, as a Casimir of them alone, has another, or rows of g are dependent, or what is positive
    is not; "" where nothing is found."""
    for f in (*kept, *(f for x in on for f in x.constant)):
        here = about.number(f)
        there = group_value(about.system, f, here)
        if here != there:
            return (
                f"{show(about.algebra.field_tree(f))} would be {here}, and is {there} on the group"
            )
    for x in on:
        for minor in x.independent:
            if q.rank(numbers(minor.matrix, about.at)) < len(minor.matrix):
                return minor.said
        for minor in x.positive:
            if not (here := q.determinant(numbers(minor.matrix, about.at))) > 0:
                return f"{minor.said} would be {here}, and is positive on the group"
    return ""


def attained(about: About, on: Elements) -> bool:
    """Has an element of the group the entries of g at a point?  True is proved, of entries of which
    :func:`off_the_group` says nothing."""
    return all(x.attained(about.at) for x in on)


def group_value(system: LiePoisson, f: Polynomial, else_: Number) -> Number:
    """The value of a Casimir at the elements of the group, where it is of their entries alone."""
    if not _has_entries(system) or any(any(e[: system.momenta]) for e in f):
        return else_
    one = tuple(
        Fraction(int(x[2] == x[3])) if isinstance(x, tuple) and x[1] == "A" else Fraction(0)
        for x in system.variables
    )
    return About(system, one).number(f)


def _has_entries(system: LiePoisson) -> bool:
    """Are entries of g among the variables?"""
    return any(isinstance(x, tuple) and x[1] == "A" for x in system.variables)


def tried(system: LiePoisson, kept: Sequence[Polynomial], on: Elements) -> Iterator[About]:
    """The equilibria among the points with at most one momentum that is not 0, it being 1, and at
    most one other coordinate that is not 0, it being 1 or −1; the origin, which is trivial
    otherwise, where entries of g are variables."""
    n, momenta, entries = len(system.variables), system.momenta, _has_entries(system)
    for b, sign in ((None, 0), *((b, s) for b in range(momenta, n) for s in (1, -1))):
        for a in (None, *range(momenta)):
            chosen = {a: 1, b: sign}
            at = tuple(Fraction(chosen.get(i, 0)) for i in range(n))
            about = About(system, at)
            if (
                (any(at) or entries)
                and not any(about.moving())
                and not off_the_group(about, kept, on)
            ):
                yield about
