"""Numbers that carry a bound on the degree of the rational function whose value they are.

This is what a Schwartz–Zippel bound asks for. Denominators are multiplied, never brought to a
common one: the degrees are too large, which is safe.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any


class Measured:
    """A value, with bounds on the degrees of numerator and denominator in the random integers."""

    __slots__ = ("den", "num", "value")

    def __init__(self, value: Any, num: int = 0, den: int = 0):
        self.value, self.num, self.den = value, num, den

    @staticmethod
    def of(x: Any) -> Measured:
        """The number x as a constant function, unless it is measured already."""
        return x if isinstance(x, Measured) else Measured(x)

    @property
    def degree(self) -> int:
        """The bound on the degree of numerator and denominator together."""
        return self.num + self.den

    def __add__(self, other: Any) -> Measured:
        b = Measured.of(other)
        num = max(self.num + b.den, b.num + self.den)
        return Measured(self.value + b.value, num, self.den + b.den)

    __radd__ = __add__

    def __neg__(self) -> Measured:
        return Measured(-self.value, self.num, self.den)

    def __sub__(self, other: Any) -> Measured:
        return self + -Measured.of(other)

    def __rsub__(self, other: Any) -> Measured:
        return Measured.of(other) + -self

    def __mul__(self, other: Any) -> Measured:
        b = Measured.of(other)
        return Measured(self.value * b.value, self.num + b.num, self.den + b.den)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Measured:
        b = Measured.of(other)
        return self * Measured(1 / Fraction(b.value), b.den, b.num)

    def __rtruediv__(self, other: Any) -> Measured:
        return Measured.of(other) / self

    def __mod__(self, p: int) -> Measured:
        return Measured(self.value % p, self.num, self.den)

    def inverse(self, p: int) -> Measured:
        """The inverse modulo a prime p."""
        return Measured(pow(self.value, -1, p), self.den, self.num)

    def __eq__(self, other: object) -> bool:
        return bool(self.value == Measured.of(other).value)

    __hash__ = None  # type: ignore[assignment]


class MeasuredElementary:
    """The elementary functions of measured numbers: at each argument a number drawn for itself.

    ``calls``: how often they were called; ``largest``: the largest degree of an argument.
    """

    def __init__(self, values: Any):
        self.values = values
        self.calls, self.largest = 0, 0

    def __call__(self, name: str, x: Any) -> Measured:
        """The value of a function, of degree 1 whatever the argument."""
        x = Measured.of(x)
        self.calls, self.largest = self.calls + 1, max(self.largest, x.degree)
        return Measured(self.values(name, Fraction(x.value)), 1)
