"""Elementary functions in exact arithmetic: a random value at each argument.

√x, sin x and the rest are no rational numbers. A claim in which they occur is put to the test with
an independent random value y for each function at each argument, and derivatives by the rules of
calculus, as (√x)′ = 1/(2y): what holds for every y holds for the true one. sin, cos and tan at one
argument are those of a point of the circle, sinh, cosh and tanh of one of the hyperbola. The roots
of the numbers that a claim writes, if they are of one quadratic field, are exact there.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from ..language.quadratic import Quadratic, root
from .arithmetic import EvaluationError
from .grades import Graded
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
"""Function → its first three derivatives at x, in x and in y, the value of the function there."""

ELEMENTARY = frozenset((*PARTNERS, *ALGEBRAIC))
"""The functions that a record has, and emitted code well_formedness."""

ON_CURVE = (("cos", "sin", "tan"), ("cosh", "sinh", "tanh"))
"""The functions that have their values from one point of a curve."""


def on_curve(names: tuple[str, ...], d: Any) -> dict[str, Any]:
    """Their values by the triangle of the sides 1 + 2d, 2d(1 + d), 1 + 2d(1 + d), all positive."""
    a, b = 1 + 2 * d, 2 * d * (1 + d)
    c = 1 + b
    values = (a / c, b / c, b / a) if names[0] == "cos" else (c / a, b / a, b / c)
    return dict(zip(names, values, strict=True))


class ElementaryValues:
    """The elementary functions at one model, f(name, x): y is drawn once for each argument.

    ``exact``: are numbers rational, so that they have square roots?
    """

    def __init__(self, draw: Callable[[], Any], *, exact: bool = False):
        self.draw, self.exact, self.radicand = draw, exact, 0
        self.values: dict[tuple[str, Any], Any] = {}
        self.graded_arguments: list[Graded] = []

    def value(self, name: str, x: Any) -> Any:
        """The value of a function at x, the same each time; two graded numbers are different
        arguments unless they are one object."""
        at = id(x) if isinstance(x, Graded) else x
        key = (name, at)
        if key not in self.values:
            d = self.draw()
            curve = next((names for names in ON_CURVE if name in names), ())
            found = on_curve(curve, d) if curve else {name: d}
            self.values |= {(other, at): y for other, y in found.items()}
            if isinstance(x, Graded):
                self.graded_arguments.append(x)  # kept, so that its id is
        return self.values[key]

    def written(self, name: str, x: int | Fraction) -> Any:
        """The function of a number that a claim writes: a root of the first quadratic field that
        is met exactly, else as of any number."""
        if self.exact and name == "sqrt" and x >= 0:
            y = root(x)
            if not isinstance(y, Quadratic) or self.radicand in (0, y.d):
                self.radicand = y.d if isinstance(y, Quadratic) else self.radicand
                return y
        return self(name, Fraction(x))

    @property
    def largest(self) -> int:
        """The largest degree of an argument in graded numbers."""
        return max((x.degree.total_degree for x in self.graded_arguments), default=0)

    def derivatives(self, name: str, x: Any) -> Derivatives:
        """The first three derivatives of a function at x; ``EvaluationError`` if unknown."""
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
            self.derivatives(name, x)
            return self.value(name, x)
        base = x.part(0)
        small = Nilpotent({k: v for k, v in x.parts.items() if k})
        result, power, factorial = Nilpotent.of(self.value(name, base)), small, 1
        for k, d in enumerate(self.derivatives(name, base), 1):
            factorial *= k
            result = result + power * (d / factorial)
            power = power * small
        return result
