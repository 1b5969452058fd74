"""The operators that every class of numbers has alike."""

from __future__ import annotations

from fractions import Fraction
from typing import Any


class RingElement:
    """Of numbers with ``+`` and ``*``: ``−``, and the operators with the number on the right.

    These call ``+`` and ``*`` by their names: by the operators two classes that do not know each
    other would ask each other without end.
    """

    __slots__ = ()

    def __radd__(self: Any, other: Any) -> Any:
        return self.__add__(other)

    def __rmul__(self: Any, other: Any) -> Any:
        return self.__mul__(other)

    def __neg__(self: Any) -> Any:
        return self * -1

    def __sub__(self: Any, other: Any) -> Any:
        return self + -other

    def __rsub__(self: Any, other: Any) -> Any:
        return -self + other


class FieldElement(RingElement):
    """The same of numbers with an ``inverse``: quotients and powers as well."""

    __slots__ = ()

    def __truediv__(self: Any, other: Any) -> Any:
        return self * (Fraction(1) / other)

    def __rtruediv__(self: Any, other: Any) -> Any:
        return self.inverse * other

    def __pow__(self: Any, n: int) -> Any:
        base, found = self if n >= 0 else self.inverse, Fraction(1)
        for _ in range(abs(n)):
            found = base * found
        return found
