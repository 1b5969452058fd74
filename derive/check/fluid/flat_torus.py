"""The torus Rᵈ/2πZᵈ: trigonometric polynomials, their frequencies drawn at random.

The frequencies are sums of three random vectors of Zᵈ, so that there are triads and quartets of any
frequencies with the sum 0.  The i of e^{ik·x} is taken into k: what is a polynomial in k vanishes
for all ik where it vanishes for all k, and all numbers stay rational.
"""

from __future__ import annotations

from typing import Any

from ...algebra.samplers import Source
from ..grades import Graded
from .functions import Exponents, Field, Function

MODES = ((0, 0, 0), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (1, 1, 0), (-1, -1, 0))
WIDE = (*MODES, (0, 0, 1), (0, 0, -1), (1, 1, 1), (-1, -1, -1))
LEVELS = ((1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1))
"""Those of the fields that are drawn, of δ′ and of the density: pairs, triads and quartets of them
have the sum 0."""
TURNED = {2: ((2, 1), (1, 1)), 3: ((1, 1, 0), (0, 1, 1), (1, 1, 1))}
"""A matrix of SL(d, Z), the displacement where all others begin."""
LENGTH = 4


class Torus:
    """One of dimension d, with three ``frequencies``."""

    length = LENGTH
    bounded = False

    def __init__(self, frequencies: tuple[tuple[Any, ...], ...]):
        self.frequencies, self.dimension = frequencies, len(frequencies[0])
        self.name = f"T{'²³'[self.dimension - 2]}"

    def frequency(self, m: Exponents) -> list[Any]:
        """The frequency k of a mode."""
        columns = range(self.dimension)
        return [sum(n * k[j] for n, k in zip(m, self.frequencies, strict=False)) for j in columns]

    def derivative(self, f: Function, j: int) -> Function:
        """∂f/∂x_j."""
        terms = {m: x * self.frequency(m)[j] for m, x in f.terms.items() if any(m[:-1])}
        return Function(self, terms)

    def mean(self, f: Function) -> Function:
        """The mode 0."""
        return Function(self, {m: x for m, x in f.terms.items() if not any(m[:-1])})

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
        return Function(self, {(*m, 0): draw() for m in MODES})

    def level(self, draw: Any) -> Function:
        """A random density."""
        return Function(self, {(*m, 0): draw() for m in LEVELS})

    def layered(self, draw: Any) -> Function:
        """A random density in plane layers, those of the first frequency."""
        return Function(self, {(*m, 0): draw() for m in LEVELS[:2]})

    def energy(self, draw: Any) -> Function:
        """A random potential per unit mass."""
        return self.function(draw)

    def any_field(self, draw: Any, like: Field = ()) -> Field:
        """A random field; with all modes that pair with those of another."""
        modes = {tuple(-x for x in m[:-1]) for f in like for m in f.terms} | {*MODES}
        listed = sorted(modes)
        return tuple(
            Function(self, {(*m, 0): draw() for m in listed}) for _ in range(self.dimension)
        )

    tangent = any_field

    def solenoidal(self, draw: Any, *, wide: bool = False) -> Field:
        """A random field without divergence: the curl of another."""
        modes: list[dict[Exponents, Any]] = [{} for _ in range(self.dimension)]
        for m in WIDE if wide else MODES:
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
        return Torus(tuple(turned))

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


def torus(dimension: int, source: Source, size: int) -> Torus:
    """A torus with random frequencies."""
    return Torus(
        tuple(tuple(source.randint(-size, size) for _ in range(dimension)) for _ in range(3))
    )
