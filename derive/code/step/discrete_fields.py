"""What the templates of the discrete step are filled with."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from .discrete_step import DiscreteStep
from .tableaux import METHODS

Number = Callable[[Fraction], str]


def written_step(d: DiscreteStep, number: Number, steps: Sequence[str]) -> dict[str, Any]:
    """The counts of a step, its ``counts`` by the names of arrays, and its parts as text; ``norm``:
    no matrix of 𝔤 is larger, by the sums of its rows, than so many times the sum of its
    coordinates; ``number``: that of the step among those of a motion."""
    return {
        **vars(d),
        "counts": [*d.sizes.items()],
        "weights": [number(Fraction(x)) for x in d.weights],
        "norm": number(d.norm),
        "number": 1 + sum(x in METHODS for x in steps),
    }
