"""Elementary functions at random points modulo a prime, and their derivatives.

Square roots are true ones, at points and for parameters that have them; the others are any numbers
at each argument, on c² ± s² = 1.
"""

from __future__ import annotations

from typing import Any

from ...algebra.residue_vectors import ResidueSource
from .rational_values import Jet, inverse

CURVES = (("sin", "cos", "tan", 1), ("sinh", "cosh", "tanh", -1))


class UnluckyError(ArithmeticError):
    """No true roots of numbers and parameters, or too few points with roots."""


class Functions:
    """The functions at the points of a source; roots are true at those that are ``valid``, or any
    numbers without ``roots``."""

    def __init__(self, source: ResidueSource, *, roots: bool):
        self.source, self.p, self.roots = source, source.p, roots
        self.valid = [True] * source.points
        self.known: dict[tuple[str, Any], Any] = {}

    def __call__(self, name: str, x: Any) -> Any:
        """A function of a residue or of a jet."""
        if not isinstance(x, Jet):
            return self._value(name, x)
        y = self._value(name, x.n)
        return x.through(y, self._slope(name, x.n, y))

    def _value(self, name: str, x: Any) -> Any:
        key = (name, x if isinstance(x, int) else (*x.values,))
        if key not in self.known:
            curve = next((x for x in CURVES if name in x), None)
            if curve:
                self._on_curve(curve, key[1], x)
            else:
                self.known[key] = self._root(x) if name == "sqrt" and self.roots else self._any(x)
        return self.known[key]

    def _any(self, x: Any) -> Any:
        """A random number for a number, or one for each point."""
        drawn = self.source.randint(1, self.p)
        return drawn.values[0] if isinstance(x, int) else drawn

    def _root(self, x: Any) -> Any:
        if isinstance(x, int):
            y = pow(x, (self.p + 1) // 4, self.p)
            if (y * y - x) % self.p:
                raise UnluckyError
            return y
        root = x.root()
        there = zip(self.valid, (root * root).values, x.values, strict=True)
        self.valid = [v and a == b for v, a, b in there]
        return root

    def _on_curve(self, curve: tuple[str, str, str, int], argument: Any, x: Any) -> None:
        """The point of the curve by the tangent u of half the argument."""
        *names, sign = curve
        u = self._any(x)
        s = 2 * u * inverse(1 + sign * (u * u), self.p)
        c = (1 + -sign * (u * u)) * inverse(1 + sign * (u * u), self.p)
        values = (s, c, s * inverse(c, self.p))
        self.known |= {(f, argument): y for f, y in zip(names, values, strict=True)}

    def _slope(self, name: str, x: Any, y: Any) -> Any:
        """The derivative at x, where the value is y."""
        for s, c, tangent, sign in CURVES:
            if name == tangent:
                return 1 + sign * (y * y)
            if name in (s, c):
                return self._value(c, x) if name == s else self._value(s, x) * -sign
        if name == "exp":
            return y
        return inverse({"sqrt": 2 * y, "log": x, "atan": 1 + x * x}[name], self.p)
