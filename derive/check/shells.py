"""An ellipsoid in layers: its density by the level s = ⟨r, Q r⟩, and integrals over its shells.

∫ f(⟨r, Q r⟩) dx is V n ∫₀¹ f(t²) tⁿ⁻¹ dt, and with r r̄ it is V Q⁻¹ ∫₀¹ f(t²) tⁿ⁺¹ dt.  Integrals
are found by values at equal steps, with the weights that are exact for polynomials.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from typing import Any

from ..language import rational as q
from ..language.layers import LEVEL, degree_in_level
from ..record.as_json import decode
from .arithmetic import EvaluationError
from .draws import Draws
from .evaluate import evaluate

Function = Callable[[Any], Any]
MOST = 64
"""The degree of a polynomial at most that is integrated."""


@cache
def _weights(degree: int) -> tuple[Fraction, ...]:
    """Those w_k for which Σ w_k f(k/degree) is ∫₀¹ f dt for all polynomials of the degree."""
    if degree > MOST:
        raise EvaluationError(f"a polynomial of degree {degree} in the level")
    nodes = [Fraction(k, max(degree, 1)) for k in range(degree + 1)]
    powers = tuple(tuple(x**j for x in nodes) for j in range(degree + 1))
    found = q.solve(powers, q.column(Fraction(1, j + 1) for j in range(degree + 1)))
    assert found is not None
    return q.flatten(found)


def integrated(f: Function, low: Any, high: Any, degree: int) -> Any:
    """∫ f of a polynomial of a degree between two ends."""
    step, total = (high - low) * Fraction(1, max(degree, 1)), Fraction(0)
    for k, weight in enumerate(_weights(degree)):
        total = total + f(low + step * k) * weight
    return total * (high - low)


@dataclass(frozen=True)
class Layers:
    """The density of an ellipsoid in Rⁿ by the level."""

    density: Function
    degree: int
    n: int

    @classmethod
    def of(cls, model: Draws, solid: Mapping[str, Any]) -> Layers:
        """Those of a solid of the record."""
        tree, known = decode(solid["density"], "body"), model.expressions

        def density(level: Any) -> Any:
            return evaluate(tree, replace(known, names={**known.names, LEVEL: level}))

        degree = degree_in_level(tree)
        if degree is None:
            raise EvaluationError("a density that is no polynomial in the level")
        return cls(density, degree, model.n)

    def above(self, level: Any) -> Any:
        """∫ of the density from a level to 1."""
        return integrated(self.density, level, Fraction(1), self.degree)

    def mean(self, f: Function, degree: int) -> Any:
        """The mean of a polynomial in the level over the volume."""
        return _by_shells(f, degree, self.n)

    @property
    def means(self) -> tuple[Any, Any]:
        """The means of the density, over the volume and with the weights r r̄."""
        if not self.degree:
            return (self.density(Fraction(0)),) * 2
        inner, outer = (_by_shells(self.density, self.degree, n) for n in (self.n, self.n + 2))
        return inner, outer


def _by_shells(f: Function, degree: int, n: int) -> Any:
    """n ∫₀¹ f(t²) tⁿ⁻¹ dt, which is 1 for f = 1."""
    found = integrated(
        lambda t: f(t * t) * t ** (n - 1), Fraction(0), Fraction(1), 2 * degree + n - 1
    )
    return found * n
