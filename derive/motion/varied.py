"""What differs from motion to motion of an ensemble: numbers drawn by a law, by a seed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .run import Array
from .start import MotionError


@dataclass(frozen=True)
class Varied:
    """A number by name, uniform between ``a`` and ``b``, or ``normal`` with mean ``a`` and standard
    deviation ``b``.

    ``MotionError`` for a law that is none.
    """

    name: str
    a: float
    b: float
    normal: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.a) and math.isfinite(self.b)):
            raise MotionError(f"{self.name} is varied by what is no finite number")
        if self.normal and self.b < 0:
            raise MotionError(f"{self.name} is varied with a deviation of {self.b:g}, below 0")
        if not self.normal and self.a > self.b:
            raise MotionError(f"{self.name} is varied from {self.a:g} to {self.b:g}, which is less")

    def __str__(self) -> str:
        if self.normal:
            return f"{self.name} normal, mean {self.a:g}, deviation {self.b:g}"
        return f"{self.name} from {self.a:g} to {self.b:g}"

    def drawn(self, source: np.random.Generator, n: int) -> Array:
        """The next n numbers of a source."""
        if self.normal:
            return self.a + self.b * source.standard_normal(n)
        return self.a + (self.b - self.a) * source.random(n)


def laws(given: Mapping[str, Any]) -> tuple[Varied, ...]:
    """Name → (low, high) or ("normal", mean, deviation), as Python gives it."""
    if not isinstance(given, Mapping):
        raise MotionError('vary: expected laws by name, as {"zeta_1": (0, 0.5)}')
    return tuple(_law(name, x) for name, x in given.items())


def _law(name: str, numbers: Sequence[Any]) -> Varied:
    try:
        normal = len(numbers) == 3 and numbers[0] == "normal"
        a, b = map(float, numbers[normal:])
    except (TypeError, ValueError):
        raise MotionError(
            f'{name} is varied by (low, high) or ("normal", mean, deviation), not {numbers!r:.40}'
        ) from None
    return Varied(name, a, b, normal)


class Draws:
    """The numbers of one motion after the other: each name has a source of its own, so that they
    are the same whatever the size of the parts in which they are drawn."""

    def __init__(self, varied: Sequence[Varied], seed: int):
        self._each = [(x, np.random.default_rng([seed, k])) for k, x in enumerate(varied)]

    def next(self, n: int) -> Array:
        """Those of the next n motions, (n, varied)."""
        return np.stack([x.drawn(source, n) for x, source in self._each], axis=1)
