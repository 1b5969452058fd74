"""The spaces of a fluid: flat tori, and the unit ball of the plane or of space."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache, cached_property
from itertools import combinations_with_replacement
from math import prod
from typing import Any

from ..values.residue import Graded
from .exact_functions import Exponents, Field, Function, divergence, laplacian

# The torus Rᵈ/2πZᵈ: trigonometric polynomials, their frequencies drawn at random.
#
# A field has a mode of each of the r frequencies drawn, and of minus the sum of the first 1, 2 …
# r: so n fields have modes of n frequencies that are any, and n + 1 fields modes of any with the
# sum 0, for n ≤ r. A product of n fields that vanishes for these vanishes for all: in its part
# with n amplitudes of different frequencies these are anything. The i of e^{ik·x} is taken into
# k: what is a polynomial in k vanishes for all ik where it vanishes for all k, and all numbers
# stay rational. Frequencies need not be whole: sums of such waves are as dense in what is
# quasi-periodic.

FREQUENCIES = 3
"""The number of those that are drawn for claims of few fields."""
AUTOMORPHISMS = {2: ((2, 1), (1, 1)), 3: ((1, 1, 0), (0, 1, 1), (1, 1, 1))}
"""A matrix of SL(d, Z), the displacement where all others begin."""


class FlatTorus:
    """One with ``frequencies`` in its d dimensions, of any ``volume``."""

    bounded = False

    def __init__(self, frequencies: tuple[tuple[Any, ...], ...], volume: Any = 1):
        self.frequencies, self.volume = frequencies, volume
        self.dimension, self.length = len(frequencies[0]), len(frequencies) + 1
        self._frequencies: dict[Exponents, list[Any]] = {}
        span = range(len(frequencies))
        one = [tuple(int(i == j) for i in span) for j in span]
        back = [tuple(-int(i <= j) for i in span) for j in span]
        self.modes: list[Exponents] = [(0,) * len(frequencies), *one, *back]
        self.levels = [one[0], back[0], one[1]]

    def frequency(self, m: Exponents) -> list[Any]:
        """The frequency k of a mode, found once."""
        if m not in self._frequencies:
            both = [(n, k) for n, k in zip(m, self.frequencies, strict=False) if n]
            columns = range(self.dimension)
            self._frequencies[m] = [sum(n * k[j] for n, k in both) for j in columns]
        return self._frequencies[m]

    def derivative(self, f: Function, j: int) -> Function:
        """∂f/∂x_j."""
        terms = {m: x * self.frequency(m)[j] for m, x in f.terms.items() if any(m[:-1])}
        return Function(self, terms)

    def mean(self, f: Function) -> Function:
        """The integral over the torus: the mode 0, times the volume."""
        return Function(self, {m: x * self.volume for m, x in f.terms.items() if not any(m[:-1])})

    def potential(self, field: Field) -> Function:
        """The function with mean 0 whose gradient taken away leaves a field without divergence:
        Leray's projection, mode by mode."""
        terms: dict[Exponents, Any] = {}
        modes = {m for f in field for m in f.terms if any(m[:-1])}
        common: Any = None
        for m in modes:
            k = self.frequency(m)
            square = sum(y * y for y in k)
            along = sum(y * f.terms[m] for y, f in zip(k, field, strict=True) if m in f.terms)
            if isinstance(square, Graded):  # of degrees alone: over one denominator for all modes
                others = square ** max(len(modes) - 1, 1)
                common = common or square * others
                along, square = along * others, common
            terms[m] = along / square
        return Function(self, terms)

    def function(self, draw: Any) -> Function:
        """A random function."""
        return Function(self, {(*m, 0): draw() for m in self.modes})

    def level(self, draw: Any) -> Function:
        """A random density."""
        return Function(self, {(*m, 0): draw() for m in self.levels})

    def layered(self, draw: Any) -> Function:
        """A random density in plane layers, those of the first frequency."""
        return Function(self, {(*m, 0): draw() for m in self.levels[:2]})

    def energy(self, draw: Any) -> Function:
        """A random potential per unit mass."""
        return self.function(draw)

    def any_field(self, draw: Any, like: Field = ()) -> Field:
        """A random field; with all modes that pair with those of another."""
        modes = {tuple(-x for x in m[:-1]) for f in like for m in f.terms} | {*self.modes}
        listed = sorted(modes)
        return tuple(
            Function(self, {(*m, 0): draw() for m in listed}) for _ in range(self.dimension)
        )

    tangent = any_field

    def solenoidal(self, draw: Any) -> Field:
        """A random field without divergence: the curl of another."""
        modes: list[dict[Exponents, Any]] = [{} for _ in range(self.dimension)]
        for m in self.modes:
            k = self.frequency(m)
            if not any(m):
                found = [draw() for _ in k]
            elif self.dimension == 2:
                c = draw()
                found = [-k[1] * c, k[0] * c]
            else:
                found = crossed(k, [draw() for _ in k])
            for x, y in zip(modes, found, strict=True):
                x[(*m, 0)] = y
        return tuple(Function(self, x) for x in modes)

    def of_points(self) -> FlatTorus:
        """The torus of the points, which x ↦ g₀x takes to this one: k·g₀x = (ḡ₀k)·x."""
        g = AUTOMORPHISMS[self.dimension]
        columns = range(self.dimension)
        turned = (
            tuple(sum(k[i] * g[i][j] for i in columns) for j in columns) for k in self.frequencies
        )
        return FlatTorus(tuple(turned), self.volume)

    def pulled_back(self, f: Function, points: FlatTorus) -> Function:
        """f ∘ g₀."""
        return Function(points, f.terms)


def crossed(a: list[Any], b: list[Any]) -> list[Any]:
    """The vector product."""
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


# The unit ball of the plane or of space: polynomials, whose means and potentials are exact.
#
# Fields that are tangent to the boundary and without divergence are curls of (1 − ‖x‖²)q.

DEGREE = 1
"""Of the polynomials that are drawn for claims with few derivatives."""
TURNED = {
    2: ((Fraction(3, 5), Fraction(-4, 5)), (Fraction(4, 5), Fraction(3, 5))),
    3: tuple(tuple(Fraction(x, 3) for x in row) for row in ((2, -1, 2), (2, 2, -1), (-1, 2, 2))),
}
"""A rotation, the displacement where all others begin."""


class Ball:
    """A ball of ``dimension`` 2 or 3, of any ``volume``; ``degree``: of what is drawn."""

    bounded = True

    def __init__(self, dimension: int, volume: Any = 1, degree: int = DEGREE):
        self.dimension, self.volume, self.degree = dimension, volume, degree
        self.length = dimension + 1
        self.zero = Function(self, {})
        self._powers: list[Function] = [self.zero.constant(Fraction(1))]

    def derivative(self, f: Function, j: int) -> Function:
        """∂f/∂x_j."""
        terms = {}
        for m, x in f.terms.items():
            if m[j]:
                terms[tuple(n - (i == j) for i, n in enumerate(m))] = x * m[j]
        return Function(self, terms)

    def mean(self, f: Function) -> Function:
        """The integral over the ball."""
        orders: dict[Exponents, Any] = {}
        for (*m, s), x in f.terms.items():
            if not any(n % 2 for n in m):
                key, found = self.exponents(s=s), x * mean_of_monomial(*m) * self.volume
                orders[key] = orders[key] + found if key in orders else found
        return Function(self, orders)

    def potential(self, field: Field) -> Function:
        """A function whose gradient taken away leaves a field without divergence, tangent to the
        boundary: Neumann's problem for polynomials."""
        found = Function(self, {})
        for degree, p in homogeneous(divergence(field)).items():
            found = found + self.square * _times_square(p, degree)  # whose Laplacian is p
        flux = self.outwards(field) - self.outwards([found.d(j) for j in range(self.dimension)])
        return sum((h * Fraction(1, n) for n, h in harmonics(flux) if n), found)

    def outwards(self, field: Any) -> Function:
        """⟨x, field⟩, which at the boundary is the part along the normal."""
        found: Function = sum((x * y for x, y in zip(self.axes, field, strict=True)), self.zero)
        return found

    # -- draws ---------------------------------------------------------------------------------

    def function(self, draw: Any, degree: int | None = None) -> Function:
        """A random polynomial."""
        listed = monomials(self.dimension, self.degree if degree is None else degree)
        return Function(self, {(*m, 0): draw() for m in listed})

    def level(self, draw: Any) -> Function:
        """A random polynomial that is constant on the boundary."""
        found: Function = self.bump * self.function(draw)
        return found

    def energy(self, draw: Any) -> Function:
        """A random potential per unit mass, whose force is not the same everywhere."""
        return self.function(draw, self.degree + 1)

    def any_field(self, draw: Any, like: Field = ()) -> Field:
        """A random field."""
        del like
        return tuple(self.function(draw) for _ in range(self.dimension))

    def tangent(self, draw: Any, like: Field = ()) -> Field:
        """A random field that is tangent to the boundary, of the degree of another."""
        degree = max((sum(m[:-1]) for f in like for m in f.terms), default=self.degree)
        inside = [self.bump * self.function(draw, degree) for _ in range(self.dimension)]
        return tuple(x + y for x, y in zip(inside, self.solenoidal(draw), strict=True))

    def solenoidal(self, draw: Any) -> Field:
        """A random field without divergence that is tangent to the boundary."""
        return curl(*(self.level(draw) for _ in range(1 if self.dimension == 2 else 3)))

    # -- the ball of the points ----------------------------------------------------------------

    def of_points(self) -> Ball:
        """The ball of the points."""
        return Ball(self.dimension, self.volume, self.degree)

    def pulled_back(self, f: Function, points: Ball) -> Function:
        """f ∘ g₀, g₀ a rotation."""
        return substituted(f, points.turned(points.axes))

    def turned(self, place: Any) -> Field:
        """g₀ of a place."""
        return tuple(
            sum((x * a for x, a in zip(place, row, strict=True)), place[0] * 0)
            for row in TURNED[self.dimension]
        )

    # -- polynomials ---------------------------------------------------------------------------

    def exponents(self, j: int = -1, n: int = 1, s: int = 0) -> Exponents:
        """Those of x_jⁿ times a power of s."""
        return (*(n * (i == j) for i in range(self.dimension)), s)

    @cached_property
    def axes(self) -> Field:
        """The functions x_j."""
        return tuple(
            Function(self, {self.exponents(j): Fraction(1)}) for j in range(self.dimension)
        )

    @cached_property
    def square(self) -> Function:
        """‖x‖²."""
        span = range(self.dimension)
        return Function(self, {self.exponents(j, 2): Fraction(1) for j in span})

    @cached_property
    def bump(self) -> Function:
        """1 − ‖x‖², which vanishes at the boundary."""
        found: Function = -self.square + Fraction(1)
        return found

    def power_of_square(self, n: int) -> Function:
        """‖x‖²ⁿ, made once."""
        while len(self._powers) <= n:
            self._powers.append(self._powers[-1] * self.square)
        return self._powers[n]


def curl(*a: Function) -> Field:
    """The curl of a field in space, or of one across the plane, of which a number is given."""
    if len(a) == 1:
        return -a[0].d(1), a[0].d(0)
    return a[2].d(1) - a[1].d(2), a[0].d(2) - a[2].d(0), a[1].d(0) - a[0].d(1)


def power(f: Function, n: int) -> Function:
    """fⁿ."""
    return prod([f] * n, start=f.constant(Fraction(1)))


def substituted(f: Function, place: Field) -> Function:
    """f with functions in the place of the x_j."""
    powers = [[x.constant(Fraction(1))] for x in place]
    total = Function(place[0].space, {})
    for (*m, s), c in f.terms.items():
        term = Function(total.space, {(*(0,) * (total.space.length - 1), s): c})
        for x, n, known in zip(place, m, powers, strict=True):
            while len(known) <= n:
                known.append(known[-1] * x)
            term = term * known[n] if n else term
        total = total + term
    return total


def homogeneous(f: Function) -> dict[int, Function]:
    """The homogeneous parts of a polynomial, by their degree."""
    found: dict[int, dict[Exponents, Any]] = {}
    for m, x in f.terms.items():
        found.setdefault(sum(m[:-1]), {})[m] = x
    return {n: Function(f.space, terms) for n, terms in found.items()}


def _times_square(p: Function, degree: int) -> Function:
    """The q for which Δ(‖x‖² q) = p, homogeneous of a degree: as Δ(‖x‖²ᵏ⁺² Δᵏp) is
    (2k + 2)(2m − 2k + d) ‖x‖²ᵏ Δᵏp + ‖x‖²ᵏ⁺² Δᵏ⁺¹p, a sum in which all but the first cancels."""
    space, factor = p.space, Fraction(-1)
    found: Function = space.zero
    for k in range(degree // 2 + 1):
        factor /= -(2 * k + 2) * (2 * degree - 2 * k + space.dimension)
        found = found + space.power_of_square(k) * p * factor
        p = laplacian(p)
    return found


def harmonics(f: Function) -> Iterator[tuple[int, Function]]:
    """The harmonic polynomials h, with their degrees, that together are f on the sphere: each
    homogeneous part p is h + ‖x‖² times another."""
    parts = homogeneous(f)
    for m in range(max(parts, default=-1), -1, -1):
        p = parts.get(m)
        if p is not None:
            rest = _times_square(laplacian(p), m - 2)
            yield m, p - p.space.square * rest
            if m > 1:
                parts[m - 2] = parts[m - 2] + rest if m - 2 in parts else rest


def on_boundary(f: Function) -> Function:
    """The same function on the sphere, with 1 − Σ x_j² for the square of the last coordinate."""
    space = f.space
    rest = space.bump + Function(space, {space.exponents(space.dimension - 1, 2): Fraction(1)})
    total: Function = space.zero
    for (*m, last, s), x in f.terms.items():
        half, odd = divmod(last, 2)
        total = total + power(rest, half) * Function(space, {(*m, odd, s): x})
    return total


@cache
def monomials(dimension: int, degree: int) -> list[tuple[int, ...]]:
    """The exponents of the monomials up to a degree."""
    span = range(dimension)
    listed = (x for n in range(degree + 1) for x in combinations_with_replacement(span, n))
    return [tuple(map(x.count, span)) for x in listed]


@cache
def mean_of_monomial(*m: int) -> Fraction:
    """The mean of Π x_jᵐʲ over the ball, for even exponents: that over the sphere times the mean
    of ‖x‖ᵐ."""
    d, degree = len(m), sum(m)
    sphere = Fraction(prod(prod(range(1, n, 2)) for n in m), prod(range(d, d + degree, 2)))
    return sphere * d / (d + degree)
