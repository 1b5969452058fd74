"""Equilibria near a point, enclosed: critical points of H on a level of the Casimirs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil
from typing import Any

from ...language import rational as q
from ...language.univariate import Number, Quadratic
from ..integrals.all_integrals import IntegralsFound
from ..integrals.lie_poisson import LiePoisson, Polynomial, plain
from .energy_casimir import diagonalised, signs
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

DIGITS = 10**6
"""Decimals are of so many parts of 1."""
STEPS = 60
"""The most steps of Newton's method."""

Terms = dict[tuple[int, ...], Fraction]
"""A polynomial in y and δλ: exponents → coefficient."""


@dataclass(frozen=True)
class Enclosed:
    """An equilibrium within ``radius`` of a point, in each coordinate and multiplier.  ``about``:
    the point x̂; ``level``: the values c of the Casimirs; ``multipliers``: λ̂; ``signature``: of the
    form on the level; ``eigenvalues``: about those of the linearised rates at x̂; ``grows``: has
    one of them a positive real part, surely?"""

    about: About
    level: tuple[Fraction, ...]
    multipliers: tuple[Fraction, ...]
    radius: Fraction
    signature: tuple[int, int]
    eigenvalues: tuple[complex, ...]
    grows: bool

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
    radius, signature = certified(function, len(x) + len(found), len(found))
    if not near_the_group(about, kept, level, radius, on):
        raise NoEquilibriumError(NOT_ON_THE_GROUP)
    values_near = eigenvalues([e.slope for e in about.rates])
    unstable = 0 not in signature and grows(about, kept, radius)
    return Enclosed(about, (*level,), (*found,), radius, signature, values_near, unstable)


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

    algebra, n, k = start.algebra, len(start.at), len(kept)
    x = np.array([*map(float, start.at)])
    energy, *others = (_Floats(f) for f in (algebra.hamiltonian, *kept))
    borders = np.array([f.slope(x) for f in others]).reshape(k, n)
    multipliers = np.linalg.lstsq(borders.T, -energy.slope(x), rcond=None)[0]
    for _ in range(STEPS):
        borders = np.array([f.slope(x) for f in others]).reshape(k, n)
        second = energy.second(x) + sum(
            y * f.second(x) for y, f in zip(multipliers, others, strict=True)
        )
        slope = energy.slope(x) + multipliers @ borders
        off = [f.value(x) - float(c) for f, c in zip(others, level, strict=True)]
        matrix = np.block([[second, borders.T], [borders, np.zeros((k, k))]])
        step = np.linalg.lstsq(matrix, -np.array([*slope, *off]), rcond=1e-12)[0]
        x, multipliers = x + step[:n], multipliers + step[n:]
        if not np.all(np.isfinite(step)) or max(abs(x)) > 1e6:
            break
        if max(abs(step), default=0.0) < 1e-13 * (1 + max(abs(x))):
            return [*map(float, x)], [*map(float, multipliers)]
    raise NoEquilibriumError("no equilibrium is found near there: Newton's method does not settle")


class _Floats:
    """A polynomial with its derivatives in floats."""

    def __init__(self, f: Polynomial):
        self.terms = [(e, float(c)) for e, c in f.items()]

    def _sum(self, x: Any, *places: int) -> float:
        total = 0.0
        for e, c in self.terms:
            left = [*e]
            for i in places:
                c, left[i] = c * left[i], left[i] - 1
            if c:
                for y, k in zip(x, left, strict=True):
                    c *= y**k
                total += c
        return total

    def value(self, x: Any) -> float:
        return self._sum(x)

    def slope(self, x: Any) -> Any:
        import numpy as np

        return np.array([self._sum(x, i) for i in range(len(x))])

    def second(self, x: Any) -> Any:
        import numpy as np

        places = range(len(x))
        return np.array([[self._sum(x, i, j) for j in places] for i in places])


def lagrange_function(
    about: About, kept: Sequence[Polynomial], level: Sequence[Fraction], found: Sequence[Fraction]
) -> Terms:
    """𝓛 in powers of y = x − x̂ and δλ = λ − λ̂."""
    k = len(kept)
    terms: Terms = {}

    def include(e: Expansion, factor: Fraction, multiplier: tuple[int, ...]) -> None:
        for m, c in terms_of(e).items():
            there = (*m, *multiplier)
            terms[there] = terms.get(there, Fraction(0)) + factor * c

    include(about.expansion(about.algebra.hamiltonian), Fraction(1), (0,) * k)
    for j, (f, c, y) in enumerate(zip(kept, level, found, strict=True)):
        e = less(about.expansion(f), c)
        include(e, y, (0,) * k)
        include(e, Fraction(1), tuple(int(i == j) for i in range(k)))
    return terms


def less(e: Expansion, c: Fraction) -> Expansion:
    """A polynomial less a constant."""
    return Expansion(e.value - c, e.slope, e.second, e.higher)


def terms_of(e: Expansion) -> Terms:
    """The terms of a polynomial by their exponents, its coefficients rational."""
    n = len(e.slope)
    found: dict[tuple[int, ...], Any] = {(0,) * n: e.value, **e.higher}
    for i in range(n):
        found[tuple(int(k == i) for k in range(n))] = e.slope[i]
        for j in range(i, n):
            m = tuple(int(k == i) + int(k == j) for k in range(n))
            found[m] = e.second[i][j] / (2 if i == j else 1)
    return {m: rational(c) for m, c in found.items() if c}


def rational(x: Number) -> Fraction:
    """A number of which it is known that it is rational."""
    assert not isinstance(x, Quadratic)
    return x


def certified(function: Terms, size: int, casimirs: int) -> tuple[Fraction, tuple[int, int]]:
    """The radius within which there is one critical point, and the signature on the level;
    ``NoEquilibriumError`` where Newton's step is not proved to contract."""
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
    return radius, (positive - casimirs, negative - casimirs)


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
    at = [RealBall(rational(x), radius) for x in about.at]
    return all(
        (x.sufficient or (x.open and x.attained(about.at) and invertible(_balls(x.entries, at))))
        and all(_spanned(f, group_value(about.system, f, Fraction(0)), levels) for f in x.constant)
        and all(independent(_balls(m.matrix, at)) for m in x.independent)
        and all(determinant(_balls(m.matrix, at)).positive for m in x.positive)
        for x in on
    )


def _spanned(f: Polynomial, value: Number, levels: Sequence[Polynomial]) -> bool:
    """Is a polynomial, less a number, a combination of others?"""
    one = (0,) * len(next(iter(f)))
    every = [*levels, {**f, one: f.get(one, 0) - value}]
    monomials = {m for g in every for m in g}
    rows = [[Fraction(plain(g.get(m, 0))) for m in monomials] for g in every]
    return q.rank(q.matrix(rows)) == q.rank(q.matrix(rows[:-1]))


def _balls(matrix: Sequence[Line], at: Sequence[RealBall]) -> Balls:
    return [[*row] for row in numbers(matrix, at, lambda c: RealBall(Fraction(c)))]


def independent(rows: Balls) -> bool:
    """Are the rows surely independent?"""
    pivots = q.echelon(q.matrix([[x.mid for x in row] for row in rows]))[1]
    return len(pivots) == len(rows) and invertible([[row[j] for j in pivots] for row in rows])


def invertible(a: Balls) -> bool:
    """Is a square matrix surely invertible?"""
    found = determinant(a)
    return abs(found.mid) > found.off


def determinant(a: Balls) -> RealBall:
    """The determinant of a square matrix."""
    return characteristic(a)[-1] * RealBall(Fraction((-1) ** len(a)))


# -- instability ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class RealBall:
    """The numbers at a distance of at most ``off`` from ``mid``."""

    mid: Fraction
    off: Fraction = Fraction(0)

    def __add__(self, other: RealBall) -> RealBall:
        return RealBall(self.mid + other.mid, self.off + other.off)

    def __mul__(self, other: RealBall) -> RealBall:
        off = abs(self.mid) * other.off + abs(other.mid) * self.off + self.off * other.off
        return RealBall(self.mid * other.mid, off)

    @property
    def positive(self) -> bool:
        """Are all its numbers positive?"""
        return self.mid > self.off

    @property
    def negative(self) -> bool:
        """Are all its numbers negative?"""
        return self.mid + self.off < 0


Balls = list[list[RealBall]]


def grows(about: About, kept: Sequence[Polynomial], radius: Fraction) -> bool:
    """Have the linearised rates an eigenvalue with positive real part at every point within the
    radius that is an equilibrium?  True is proved."""
    n = len(about.at)
    rates = [_slopes(e, radius) for e in about.rates]
    borders = [_slopes(about.expansion(f), radius) for f in kept]
    tensor = [
        [
            RealBall(rational(x), radius * sum(map(abs, about.system.bracket(i, j).values())))
            for j, x in enumerate(row)
        ]
        for i, row in enumerate(about.tensor)
    ]
    whole = [[*row, *(b[i] for b in borders)] for i, row in enumerate(tensor)]
    whole += [
        [*(RealBall(-x.mid, x.off) for x in b), *[RealBall(Fraction(0))] * len(kept)]
        for b in borders
    ]
    inverse = q.inverse(q.matrix([[x.mid for x in row] for row in whole]))
    if inverse is None or contraction(inverse, [[x.off for x in row] for row in whole]) >= 1:
        return False  # on a leaf whose dimension is not known the spectrum need not be even
    coefficients = characteristic(rates)[: n - len(kept) + 1 : 2]
    return any(x.negative for x in coefficients) or _breaks_newton(coefficients)


def _slopes(e: Expansion, radius: Fraction) -> list[RealBall]:
    """The first derivatives of a polynomial within a radius."""
    found = []
    for j, x in enumerate(e.slope):
        terms = ((m, c) for m, c in terms_of(e).items() if sum(m) > 1 and m[j])
        off = sum((abs(c) * m[j] * radius ** (sum(m) - 1) for m, c in terms), Fraction(0))
        found.append(RealBall(rational(x), off))
    return found


def characteristic(a: Balls) -> list[RealBall]:
    """The characteristic polynomial from the highest power (Faddeev and Le Verrier)."""
    places = range(len(a))
    zero, found = RealBall(Fraction(0)), [RealBall(Fraction(1))]
    power: Balls = [[zero] * len(a) for _ in places]
    for k in range(1, len(a) + 1):
        inside = [[power[i][j] + (found[-1] if i == j else zero) for j in places] for i in places]
        power = [
            [sum((a[i][m] * inside[m][j] for m in places), zero) for j in places] for i in places
        ]
        trace = sum((power[i][i] for i in places), zero)
        found.append(trace * RealBall(Fraction(-1, k)))
    return found


def _breaks_newton(c: Sequence[RealBall]) -> bool:
    """Is c_j² (j)(d − j) < c_{j−1} c_{j+1} (j + 1)(d − j + 1) for some j, surely?"""
    d = len(c) - 1
    return any(
        (
            c[j] * c[j] * RealBall(Fraction(j * (d - j)))
            + c[j - 1] * c[j + 1] * RealBall(Fraction(-(j + 1) * (d - j + 1)))
        ).negative
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
