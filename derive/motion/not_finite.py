"""Why the equations have no finite value at a start, as far as can be told, in words."""

from __future__ import annotations

import math

from ..problem.problem import Problem
from ..schema.kinds.attraction import Attraction
from ..schema.kinds.spring import Spring
from .start import Start

LARGE = 1e60
"""Products of a few numbers that are larger leave the range of doubles, 1e308."""


def why_not_finite(problem: Problem, begin: Start, energy: float) -> str:
    """The reason that fits: numbers too large, the function itself, ∂²ℓ/∂Z², or a collision.

    ``energy``: that of the start.
    """
    largest = max((*begin.parameters.values(), *begin.u, *begin.x), key=abs, default=0.0)
    if abs(largest) > LARGE:
        return f"its numbers are too large, as {largest:g}"
    given, finite = problem.lagrangian, math.isfinite(energy)
    if given is not None:
        if finite:
            return "the second derivative of L in the velocity is singular there"
        return "L has no finite value there, as the root of a negative number or a division by 0"
    kinds = {type(x) for x in problem.potentials}
    if Spring in kinds:
        return "look at the state, as two ends of a spring at one place"
    if Attraction in kinds:
        return "look at the state, as a mass at the centre of attraction"
    if finite:
        return "the mass matrix is singular there, or a force is not finite"
    return "a potential has no finite value there, as the root of a negative number"
