"""Elementary functions in exact arithmetic: an unknown value at each argument, and its derivatives.

√x, sin x and the rest are no rational numbers.  A claim in which they occur is put to the test with
an independent random value y for each function at each argument, and derivatives by the rules of
calculus, (√x)′ = 1/(2y): what holds for every y holds for the true one.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from random import Random
from typing import Any

from .arithmetic import EvaluationError
from .nilpotent import Nilpotent

Derivatives = tuple[Any, Any, Any]

PARTNERS = {"sin": "cos", "cos": "sin", "sinh": "cosh", "cosh": "sinh"}
ALGEBRAIC: dict[str, Callable[[Any, Any], Derivatives]] = {
    "sqrt": lambda x, y: (1 / (2 * y), -1 / (4 * y**3), 3 / (8 * y**5)),
    "exp": lambda x, y: (y, y, y),
    "log": lambda x, y: (1 / x, -1 / x**2, 2 / x**3),
    "tan": lambda x, y: (1 + y**2, 2 * y * (1 + y**2), (1 + y**2) * (2 + 6 * y**2)),
    "tanh": lambda x, y: (1 - y**2, -2 * y * (1 - y**2), (1 - y**2) * (6 * y**2 - 2)),
    "atan": lambda x, y: (
        1 / (1 + x**2),
        -2 * x / (1 + x**2) ** 2,
        (6 * x**2 - 2) / (1 + x**2) ** 3,
    ),
}
"""First three derivatives at x, where the function is y."""


class Opaque:
    """The values of the functions at one point of a model."""

    def __init__(self, random: Random, size: int):
        self.random, self.size = random, size
        self.values: dict[tuple[str, Fraction], Fraction] = {}

    def value(self, name: str, x: Fraction) -> Fraction:
        """y at x, always the same."""
        key = (name, x)
        if key not in self.values:
            self.values[key] = Fraction(self.random.randint(1, self.size))
        return self.values[key]

    def derivatives(self, name: str, x: Fraction) -> Derivatives:
        """The first three."""
        y = self.value(name, x)
        if name in PARTNERS:
            z = self.value(PARTNERS[name], x)
            if name in ("sinh", "cosh"):
                return z, y, z
            return (z, -y, -z) if name == "sin" else (-z, -y, z)
        if name not in ALGEBRAIC:
            raise EvaluationError(f"no function {name!r}")
        return ALGEBRAIC[name](x, y)

    def __call__(self, name: str, x: Any) -> Any:
        """The function of a number, or by Taylor's formula of one with nilpotent parts."""
        if not isinstance(x, Nilpotent):
            self.derivatives(name, Fraction(x))
            return self.value(name, Fraction(x))
        base, small = x.part(0), x.small()
        result, power, factorial = Nilpotent.of(self.value(name, base)), small, 1
        for k, d in enumerate(self.derivatives(name, base), 1):
            factorial *= k
            result = result + power * (d / factorial)
            power = power * small
        return result
