"""Equilibria near a point, enclosed: critical points of H on a level of the Casimirs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, prod
from typing import Any

from ...language import rational as q
from ...language.intervals import Interval, characteristic
from ...language.univariate import Number, Quadratic
from ..integrals.all_integrals import IntegralsFound
from ..integrals.lie_poisson import LiePoisson, Polynomial, plain
from .energy_casimir import diagonalised, second_derivatives, signs
from .entries_of_elements import Line, numbers
from .equilibrium_points import (
    About,
    Elements,
    Expansion,
    NoEquilibriumError,
    coordinates,
    group_value,
)
from .stability import eigenvalues

DIGITS, BITS = 10**6, 128
"""Decimals are of so many parts of 1; digits after the point, in fractions."""
STEPS = 60
"""The most steps of Newton's method."""

Terms = dict[tuple[int, ...], Fraction]
"""A polynomial in y and δλ: exponents → coefficient."""
Bounded = list[list[Interval]]


@dataclass(frozen=True)
class Enclosed:
    """An equilibrium within ``radius`` of a point, in each coordinate and multiplier.  ``about``:
    the point x̂; ``level``: the values c of the Casimirs; ``multipliers``: λ̂; ``signature``: of the
    form on the level; ``eigenvalues``: about those of the linearised rates at x̂; ``grows``: has
    one of them a positive real part, surely?  ``nearest``: the doubles next to its coordinates."""

    about: About
    level: tuple[Fraction, ...]
    multipliers: tuple[Fraction, ...]
    radius: Fraction
    signature: tuple[int, int]
    eigenvalues: tuple[complex, ...]
    grows: bool
    nearest: tuple[float, ...]

    @property
    def verdict(self) -> str:
        """What is proved: "stable", "unstable" or "open"."""
        return "stable" if 0 in self.signature else "unstable" if self.grows else "open"


def enclosed(whole: IntegralsFound, values: Mapping[str, Number], on: Elements) -> Enclosed:
    """The equilibrium near a point, on its level of the Casimirs, where those of the entries of g
    have the values of the group; ``NoEquilibriumError`` where none is found or enclosed, or it is
    not proved that an element of the group has its entries, which satisfy ``on``."""
    system, algebra = whole.system, whole.system.algebra
    kept = [algebra.over_the_field(f) for f in whole.casimirs]
    start = About(system, start_of(system, values))
    level = [rational(group_value(system, f, start.expansion(f).value)) for f in kept]
    x, multipliers = newton(start, kept, level)
    about = About(system, (*map(_rounded, x),))
    found = [_rounded(y) for y in multipliers]
    function = lagrange_function(about, kept, level, found)
    radius, signature, y = certified(function, len(x) + len(found), len(found))
    if not near_the_group(about, kept, level, radius, on):
        raise NoEquilibriumError(NOT_ON_THE_GROUP)
    values_near = eigenvalues([e.slope for e in about.rates])
    unstable = 0 not in signature and grows(about, kept, radius)
    nearest = tuple(float(rational(a) + b) for a, b in zip(about.at, y, strict=False))
    return Enclosed(about, (*level,), (*found,), radius, signature, values_near, unstable, nearest)


def start_of(system: LiePoisson, values: Mapping[str, Number]) -> tuple[Fraction, ...]:
    """The point with these coordinates, the others 0, in decimals."""
    return tuple(_rounded(float(values.get(x, 0))) for x in coordinates(system, values))


def _rounded(x: float) -> Fraction:
    return Fraction(round(x * DIGITS), DIGITS)


def newton(
    start: About, kept: Sequence[Polynomial], level: Sequence[Fraction]
) -> tuple[list[float], list[float]]:
    """Coordinates and multipliers of a critical point, in floats, by Newton's method."""
    import numpy as np

    n, k = len(start.at), len(kept)

    def there(x: Any) -> tuple[Expansion, list[Expansion], Any]:
        """The energy and the others about a point, and the slopes of these."""
        about = About(start.system, (*map(float, x),))  # type: ignore[arg-type]
        energy, *others = (about.expansion(f) for f in (start.algebra.hamiltonian, *kept))
        borders = np.array([e.slope for e in others], float).reshape(k, n)
        return energy, others, borders

    x = np.array(start.at, float)
    energy, others, borders = there(x)
    multipliers = np.linalg.lstsq(borders.T, -np.array(energy.slope, float), rcond=None)[0]
    for _ in range(STEPS):
        second = np.array(second_derivatives(multipliers, energy, others), float)
        slope = np.array(energy.slope, float) + multipliers @ borders
        off = [float(e.value - c) for e, c in zip(others, level, strict=True)]
        matrix = np.block([[second, borders.T], [borders, np.zeros((k, k))]])
        step = np.linalg.lstsq(matrix, -np.array([*slope, *off]), rcond=1e-12)[0]
        x, multipliers = x + step[:n], multipliers + step[n:]
        if not np.all(np.isfinite(step)) or max(abs(x)) > 1e6:
            break
        if max(abs(step), default=0.0) < 1e-13 * (1 + max(abs(x))):
            return [*map(float, x)], [*map(float, multipliers)]
        energy, others, borders = there(x)
    raise NoEquilibriumError("no equilibrium is found near there: Newton's method does not settle")


def lagrange_function(
    about: About, kept: Sequence[Polynomial], level: Sequence[Fraction], found: Sequence[Fraction]
) -> Terms:
    """𝓛 in powers of y = x − x̂ and δλ = λ − λ̂."""
    none, one = (0,) * len(kept), (0,) * len(about.at)
    energy = _rational_terms(about, about.algebra.hamiltonian)
    terms = [((*m, *none), c) for m, c in energy.items()]
    for multiplier, f, value, y in zip(q.identity(len(kept)), kept, level, found, strict=True):
        own = q.summed([*_rational_terms(about, f).items(), (one, -value)])
        terms += [((*m, *none), y * c) for m, c in own.items()]
        terms += [((*m, *map(int, multiplier)), c) for m, c in own.items()]
    return q.summed(terms)


def _rational_terms(about: About, f: Polynomial) -> Terms:
    return {m: rational(c) for m, c in about.terms(f).items()}


def rational(x: Number) -> Fraction:
    """A number of which it is known that it is rational."""
    assert not isinstance(x, Quadratic)
    return x


def certified(
    function: Terms, size: int, casimirs: int
) -> tuple[Fraction, tuple[int, int], list[Fraction]]:
    """The radius within which there is one critical point, the signature on the level, and that
    point to many digits; ``NoEquilibriumError`` where Newton's step is not proved to contract."""
    places = range(size)

    def derivative(*chosen: int) -> Fraction:
        m = tuple(chosen.count(i) for i in places)
        return function.get(m, Fraction(0)) * (2 if len({*chosen}) < len(chosen) else 1)

    slope = q.column(derivative(i) for i in places)
    second = q.matrix([[derivative(i, j) for j in places] for i in places])
    inverse = q.inverse(second)
    if inverse is None:
        raise NoEquilibriumError(NOT_ISOLATED)
    reached = max(abs(x) for x in q.flatten(q.times(inverse, slope)))
    radius = one_digit_above(2 * reached) or Fraction(1, DIGITS)
    change = [[Fraction(0)] * size for _ in places]
    for m, c in function.items():
        if sum(m) > 2:
            for i in places:
                for j in places:
                    twice = m[i] * (m[j] - (i == j))
                    change[i][j] += abs(c) * twice * radius ** (sum(m) - 2)
    if contraction(inverse, change) >= Fraction(1, 2):
        raise NoEquilibriumError(NOT_ISOLATED)
    positive, negative = signs(diagonalised([[*row] for row in second]))
    return radius, (positive - casimirs, negative - casimirs), _critical_point(function, inverse)


def _critical_point(function: Terms, inverse: q.Matrix) -> list[Fraction]:
    """The critical point by Newton's steps, each of which at least halves the distance from it."""
    places, step, unit = range(len(inverse)), [Fraction(1)], 2**BITS  # rounding is below 8 units
    y = [Fraction(0) for _ in places]

    def slope(i: int) -> Fraction:
        terms = ((m, c * m[i]) for m, c in function.items() if m[i])
        return sum(
            (c * prod(y[j] ** (m[j] - (i == j)) for j in places) for m, c in terms), Fraction(0)
        )

    while max(map(abs, step)) * unit > 8:
        step = [*q.flatten(q.times(inverse, q.column(map(slope, places))))]
        y = [Fraction(round((a - b) * unit), unit) for a, b in zip(y, step, strict=True)]
    return y


def one_digit_above(x: Fraction) -> Fraction:
    """The least number with one digit that is not below a number from 0 to 1."""
    if not x:
        return x
    k = 0
    while x * 10**k < 1:
        k += 1
    return Fraction(ceil(x * 10**k), 10**k)


def contraction(inverse: q.Matrix, change: Sequence[Sequence[Fraction]]) -> Fraction:
    """The largest row sum of |J⁻¹| B."""
    moved = q.times(tuple(tuple(map(abs, row)) for row in inverse), q.matrix(change))
    return Fraction(max(map(sum, moved)))


# -- elements of the group -----------------------------------------------------------------------


def near_the_group(
    about: About,
    kept: Sequence[Polynomial],
    level: Sequence[Fraction],
    radius: Fraction,
    on: Elements,
) -> bool:
    """Has an element of the group the entries of each point of the level within the radius?  True
    is proved: what is constant on the group is a combination of the Casimirs."""
    one = (0,) * len(about.at)
    levels = [{**f, one: f.get(one, 0) - c} for f, c in zip(kept, level, strict=True)]
    at = [Interval.about(rational(x), radius) for x in about.at]
    return all(
        (x.sufficient or (x.open and x.attained(about.at) and independent(_bounded(x.entries, at))))
        and all(_spanned(f, group_value(about.system, f, Fraction(0)), levels) for f in x.constant)
        and all(independent(_bounded(m.matrix, at)) for m in x.independent)
        and all(determinant(_bounded(m.matrix, at)).sign > 0 for m in x.positive)
        for x in on
    )


def _spanned(f: Polynomial, value: Number, levels: Sequence[Polynomial]) -> bool:
    """Is a polynomial, less a number, a combination of others?"""
    one = (0,) * len(next(iter(f)))
    every = [*levels, {**f, one: f.get(one, 0) - value}]
    monomials = {m for g in every for m in g}
    rows = [[Fraction(plain(g.get(m, 0))) for m in monomials] for g in every]
    return q.rank(q.matrix(rows)) == q.rank(q.matrix(rows[:-1]))


def _bounded(matrix: Sequence[Line], at: Sequence[Interval]) -> Bounded:
    return [[*map(Interval.of, row)] for row in numbers(matrix, at)]


def independent(rows: Bounded) -> bool:
    """Are the rows surely independent?"""
    pivots = q.echelon(q.matrix([[x.middle for x in row] for row in rows]))[1]
    chosen = [[row[j] for j in pivots] for row in rows]
    return len(pivots) == len(rows) and determinant(chosen).sign != 0


def determinant(a: Bounded) -> Interval:
    """The determinant of a square matrix."""
    found = characteristic(a)[-1]
    return -found if len(a) % 2 else found


# -- instability ---------------------------------------------------------------------------------


def grows(about: About, kept: Sequence[Polynomial], radius: Fraction) -> bool:
    """Have the linearised rates an eigenvalue with positive real part at every point within the
    radius that is an equilibrium?  True is proved."""
    n, algebra = len(about.at), about.algebra
    functions = ([algebra.flow.get(i, {}) for i in range(n)], kept)
    rates, borders = ([_slopes(_rational_terms(about, f), n, radius) for f in x] for x in functions)
    tensor = [
        [
            Interval.about(rational(x), radius * sum(map(abs, about.system.bracket(i, j).values())))
            for j, x in enumerate(row)
        ]
        for i, row in enumerate(about.tensor)
    ]
    whole = [[*row, *(b[i] for b in borders)] for i, row in enumerate(tensor)]
    whole += [[*(-x for x in b), *[Interval.of(0)] * len(kept)] for b in borders]
    inverse = q.inverse(q.matrix([[x.middle for x in row] for row in whole]))
    off = [[(x - x.middle).size for x in row] for row in whole]
    if inverse is None or contraction(inverse, off) >= 1:
        return False  # on a leaf whose dimension is not known the spectrum need not be even
    coefficients = characteristic(rates)[: n - len(kept) + 1 : 2]
    return any(x.sign < 0 for x in coefficients) or _breaks_newton(coefficients)


def _slopes(terms: Terms, n: int, radius: Fraction) -> list[Interval]:
    """The first derivatives of a polynomial in n variables within a radius."""
    found = []
    for j in range(n):
        mid = off = Fraction(0)
        for m, c in terms.items():
            if sum(m) == 1:
                mid += c * m[j]
            elif m[j]:
                off += abs(c) * m[j] * radius ** (sum(m) - 1)
        found.append(Interval.about(mid, off))
    return found


def _breaks_newton(c: Sequence[Interval]) -> bool:
    """Is c_j² (j)(d − j) < c_{j−1} c_{j+1} (j + 1)(d − j + 1) for some j, surely?"""
    d = len(c) - 1
    return any(
        (c[j] * c[j] * (j * (d - j)) - c[j - 1] * c[j + 1] * ((j + 1) * (d - j + 1))).sign < 0
        for j in range(1, d)
    )


NOT_ISOLATED = (
    "the equilibrium near there is not proved to be the only one on its level of the Casimirs; "
    "exact coordinates are given by --at"
)

NOT_ON_THE_GROUP = (
    "that an element of the group has the entries of g near there is not proved; exact coordinates "
    "are given by --at"
)
