"""The torus Rᵈ/2πZᵈ: trigonometric polynomials, their frequencies drawn at random.

A field has a mode of each of the r frequencies drawn, and of minus the sum of the first 1, 2 … r:
so n fields have modes of n frequencies that are any, and n + 1 fields modes of any with the sum 0,
for n ≤ r.  A product of n fields that vanishes for these vanishes for all: in its part with n
amplitudes of different frequencies these are anything.  The i of e^{ik·x} is taken into k: what is
a polynomial in k vanishes for all ik where it vanishes for all k, and all numbers stay rational.
Frequencies need not be whole: sums of such waves are as dense in what is quasi-periodic.
"""

from __future__ import annotations

from typing import Any

from ..grades import Graded
from .functions import Exponents, Field, Function

FREQUENCIES = 3
"""The number of those that are drawn for claims of few fields."""
TURNED = {2: ((2, 1), (1, 1)), 3: ((1, 1, 0), (0, 1, 1), (1, 1, 1))}
"""A matrix of SL(d, Z), the displacement where all others begin."""


class Torus:
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

    def moved(self) -> Torus:
        """The torus of the points, which x ↦ g₀x takes to this one: k·g₀x = (ḡ₀k)·x."""
        g = TURNED[self.dimension]
        columns = range(self.dimension)
        turned = (
            tuple(sum(k[i] * g[i][j] for i in columns) for j in columns) for k in self.frequencies
        )
        return Torus(tuple(turned), self.volume)

    def carried(self, f: Function, points: Torus) -> Function:
        """f ∘ g₀."""
        return Function(points, f.terms)


def crossed(a: list[Any], b: list[Any]) -> list[Any]:
    """The vector product."""
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
