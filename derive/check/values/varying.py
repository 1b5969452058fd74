"""Numbers with their first derivatives by several others, over any ring: fractions, intervals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ...language.rings import FieldElement
from .arithmetic import Nilpotent


class Varying(FieldElement):
    """A number ``value`` whose derivatives are ``slopes``, 0 for what it does not depend on."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: Any, slopes: Sequence[Any]):
        self.value, self.slopes = value, tuple(slopes)

    def _with(self, value: Any, slope: Callable[[Any], Any]) -> Varying:
        return Varying(value, [slope(x) if x else 0 for x in self.slopes])

    def chained(self, value: Any, derivative: Any) -> Varying:
        """A function of the number, by its value and its derivative there."""
        return self._with(value, lambda x: derivative * x)

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Varying):
            return Varying(self.value + other, self.slopes)
        pairs = zip(self.slopes, other.slopes, strict=True)
        return Varying(self.value + other.value, [x + y for x, y in pairs])

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Nilpotent):
            return NotImplemented
        if not isinstance(other, Varying):
            return self._with(self.value * other, lambda x: x * other)
        pairs = zip(self.slopes, other.slopes, strict=True)
        a, b = self.value, other.value
        slopes = [(x * b if x else 0) + (a * y if y else 0) for x, y in pairs]
        return Varying(a * b, slopes)  # where other is self, a square

    @property
    def inverse(self) -> Varying:
        """1 over the number."""
        value = 1 / self.value
        return self._with(value, lambda x: -(value * value) * x)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Varying):
            return not self + -other
        return bool(self.value == other) and not any(self.slopes)

    def __bool__(self) -> bool:
        return bool(self.value) or any(map(bool, self.slopes))

    def __hash__(self) -> int:
        return hash((self.value, self.slopes))


def value_of(x: Any) -> Any:
    """The value of a number, which may vary."""
    return x.value if isinstance(x, Varying) else x


def slopes_of(x: Any, count: int) -> Sequence[Any]:
    """Its derivatives by so many others."""
    return x.slopes if isinstance(x, Varying) else (0,) * count
