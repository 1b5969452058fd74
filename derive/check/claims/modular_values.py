"""Values of trees modulo a prime, with derivatives, and about an exact point to second order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...algebra.exact_kernel import ResidueVector, ResidueVectorSource
from ...language import rational as q
from ...language.tree import Tree, operands
from ...language.univariate import Number, exact_function
from ...language.values import arithmetic
from ..values.arithmetic import Varying, slopes_of, value_of
from ..values.residue import Residue

# Values of trees of rational functions modulo a prime: at points, and with their gradients.

Value = Any
"""A residue; one at each of some points; either with its derivatives."""
LARGEST_POWER = 64

BY_VARIABLES = (Varying, ResidueVector)
"""What values are that depend on variables, where a polynomial is evaluated."""

At = Mapping[Tree, Value]
"""The values of variables and parameters."""


def value(t: Tree, at: At, p: int, functions: Callable[[str, Value], Value] | None = None) -> Value:
    """The value of a tree modulo p; ``ValueError`` for what has none.

    Without ``functions`` of names and arguments it is to be a polynomial in the variables: nothing
    is divided by them.
    """
    return _value(t, at, lambda x: Residue(1, p) * x, functions)


def _value(
    t: Tree,
    at: At,
    number: Callable[[Fraction], Value],
    functions: Callable[[str, Value], Value] | None,
) -> Value:
    if isinstance(t, (int, Fraction)):
        return number(Fraction(t))
    if t in at:
        return at[t]
    heads = ("add", "mul", "div", "pow", *(() if functions is None else ("fun",)))
    if not isinstance(t, tuple) or t[0] not in heads:
        raise ValueError("no function of the variables and the parameters that has a value")
    if t[0] == "pow" and (not isinstance(t[2], int) or abs(t[2]) > LARGEST_POWER):
        raise ValueError(f"an exponent that is no integer up to {LARGEST_POWER}")
    parts = {x: _value(x, at, number, functions) for x in operands(t)}
    if functions and t[0] == "fun":
        return functions(t[1], parts[t[2]])
    divides = t[0] == "div" or (t[0] == "pow" and t[2] < 0)
    if functions is None and divides and isinstance([*parts.values()][-1], BY_VARIABLES):
        raise ValueError("a division by a variable")
    return arithmetic(t, parts.__getitem__)


def residues(rows: Sequence[Sequence[Any]], p: int) -> q.Matrix:
    """A matrix of rational numbers, or of residues, modulo p."""
    one = Residue(1, p)
    return tuple(tuple(one * x for x in row) for row in rows)


def gradient(x: Value, n: int) -> list[Value]:
    """The derivatives by n variables."""
    return [*map(value_of, slopes_of(x, n))]


# Elementary functions at random points modulo a prime, and their derivatives.
#
# Square roots are true ones, at points and for parameters that have them; the others are any
# numbers at each argument, on c² ± s² = 1.

CURVES = (("sin", "cos", "tan", 1), ("sinh", "cosh", "tanh", -1))


class UnluckyError(ArithmeticError):
    """No true roots of numbers and parameters, or too few points with roots."""


class Functions:
    """The functions at the points of a source; roots are true at those that are ``valid``, or any
    numbers without ``roots``."""

    def __init__(self, source: ResidueVectorSource, *, roots: bool):
        self.source, self.p, self.roots = source, source.p, roots
        self.valid = [True] * source.points
        self.known: dict[tuple[str, Any], Any] = {}

    def __call__(self, name: str, x: Any) -> Any:
        """A function of a residue, or of one at each point, which may have derivatives."""
        if not isinstance(x, Varying):
            return self._value(name, x)
        y = self._value(name, x.value)
        return x.chained(y, self._slope(name, x.value, y))

    def _value(self, name: str, x: Any) -> Any:
        key = (name, x if isinstance(x, Residue) else (*x.values,))
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
        return Residue(drawn.values[0], self.p) if isinstance(x, Residue) else drawn

    def _root(self, x: Any) -> Any:
        if isinstance(x, Residue):
            y = Residue(pow(x.n, (self.p + 1) // 4, self.p), self.p)
            if y * y != x:
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
        below, above = 1 + sign * (u * u), 1 + -sign * (u * u)
        values = (2 * u / below, above / below, 2 * u / above)
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
        return 1 / {"sqrt": 2 * y, "log": x, "atan": 1 + x * x}[name]


# Functions about an exact point, up to the second order: the derivatives vary in turn.


def about(variables: Sequence[Tree], values: Sequence[Number]) -> dict[Tree, Varying]:
    """The variables themselves about a point."""
    units = q.identity(len(variables))
    pairs = zip(variables, values, units, strict=True)
    return {x: Varying(Varying(y, unit), unit) for x, y, unit in pairs}


def expansion(t: Tree, at: At) -> Value:
    """A tree about a point; ``ValueError`` for what has no value there."""
    return _value(t, at, Fraction, exact_function)


def value_there(x: Value) -> Number:
    """The value of an expansion at the point."""
    found: Number = value_of(value_of(x))
    return found


def second_derivatives(x: Value, n: int) -> q.Matrix:
    """Those of an expansion by n variables."""
    return tuple(tuple(slopes_of(y, n)) for y in slopes_of(x, n))
