"""Values of trees modulo a prime, with derivatives, and about an exact point to second order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from typing import Any

from ...algebra.exact_kernel import ResidueVectorSource, residue_of
from ...language import rational as q
from ...language.tree import Tree
from ...language.univariate import Number, value_of
from ..values.residue import Residue

# Values of trees of rational functions modulo a prime: at points, and with their gradients.

Value = Any
"""A residue as an integer; or of a ring over them, as :class:`Jet` is one."""
LARGEST_POWER = 64

At = Mapping[Tree, Value]
"""The values of variables and parameters."""


def value(t: Tree, at: At, p: int, functions: Callable[[str, Value], Value] | None = None) -> Value:
    """The value of a tree modulo p; ``ValueError`` for what has none.

    Without ``functions`` of names and arguments it is to be a polynomial in the variables: nothing
    is divided by them.
    """
    if isinstance(t, (int, Fraction)):
        return residue_of(t, p)
    if t in at:
        return at[t]
    if functions and isinstance(t, tuple) and t[0] == "fun":
        return functions(t[1], value(t[2], at, p, functions))
    if not isinstance(t, tuple) or t[0] not in ("add", "mul", "div", "pow"):
        raise ValueError("no function of the variables and the parameters that has a value")
    if t[0] == "pow":
        x, n = value(t[1], at, p, functions), t[2]
        if not isinstance(n, int) or abs(n) > LARGEST_POWER:
            raise ValueError(f"an exponent that is no integer up to {LARGEST_POWER}")
        x = inverse(x, p, polynomial=functions is None) if n < 0 else x
        return pow(x, abs(n), p) if isinstance(x, int) else x ** abs(n)
    parts = [value(x, at, p, functions) for x in t[1:]]
    if t[0] == "add":
        return reduce(lambda x, y: _reduced(x + y, p), parts)
    if t[0] == "div":
        parts[1] = inverse(parts[1], p, polynomial=functions is None)
    return reduce(lambda x, y: _reduced(x * y, p), parts)


def inverse(x: Value, p: int, *, polynomial: bool = False) -> Value:
    """1/x, of a number alone where what is computed is a ``polynomial``; ``ZeroDivisionError``, or
    0 at the points where it is 0."""
    if isinstance(x, int):
        if x % p == 0:
            raise ZeroDivisionError
        return pow(x, -1, p)
    if polynomial:
        raise ValueError("a division by a variable")
    if not isinstance(x, Jet):
        return x.inverse()
    y = inverse(x.n, p)
    return x.through(y, -(y * y))


def _reduced(x: Value, p: int) -> Value:
    return x % p if isinstance(x, int) else x


class Jet:
    """A residue ``n`` modulo p, or one at each of some points, with its ``slopes``, the derivatives
    by variables, which are numbered, where they are not 0."""

    __slots__ = ("n", "p", "slopes")

    def __init__(self, n: Value, slopes: Mapping[int, Value], p: int):
        self.n, self.slopes, self.p = _reduced(n, p), slopes, p

    def __add__(self, other: Value) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.n + other, self.slopes, self.p)
        found = {**self.slopes}
        for k, x in other.slopes.items():
            found[k] = _reduced(found[k] + x, self.p) if k in found else x
        return Jet(self.n + other.n, found, self.p)

    __radd__ = __add__

    def __mul__(self, other: Value) -> Jet:
        if not isinstance(other, Jet):
            return self.through(self.n * other, other)
        varied = self.through(0, other.n) + other.through(0, self.n)
        return Jet(self.n * other.n, varied.slopes, self.p)

    __rmul__ = __mul__

    def __pow__(self, k: int) -> Jet:
        if k < 2:
            return self if k else Jet(1, {}, self.p)
        slope = pow(self.n, k - 1, self.p) if isinstance(self.n, int) else self.n ** (k - 1)
        return self.through(slope * self.n, k * slope)

    def through(self, y: Value, slope: Value) -> Jet:
        """A function that has this value and this derivative here."""
        slopes = {k: _reduced(x * slope, self.p) for k, x in self.slopes.items()}
        return Jet(y, slopes, self.p)


def rank(rows: Sequence[Sequence[int]], p: int) -> int:
    """The rank of a matrix modulo p."""
    return q.rank(tuple(tuple(Residue(x, p) for x in row) for row in rows)) if rows else 0


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


# Polynomials about an exact point, up to the second order, from their trees.

Matrix = list[list[Number]]


@dataclass(frozen=True)
class SecondOrder:
    """The ``value`` of a polynomial at a point, its first derivatives (``slope``) and the
    ``second`` ones, both by the numbers of the variables, where they are not 0."""

    value: Number
    slope: Mapping[int, Number] = field(default_factory=dict)
    second: Mapping[tuple[int, int], Number] = field(default_factory=dict)

    def __add__(self, other: SecondOrder) -> SecondOrder:
        slope, second = {**self.slope}, {**self.second}
        for i, x in other.slope.items():
            slope[i] = slope.get(i, Fraction(0)) + x
        for ij, x in other.second.items():
            second[ij] = second.get(ij, Fraction(0)) + x
        return SecondOrder(self.value + other.value, slope, second)

    def __mul__(self, other: SecondOrder) -> SecondOrder:
        slopes = {
            (i, j): x * y for i, x in self.slope.items() for j, y in other.slope.items() if x and y
        }
        both = SecondOrder(
            self.value * other.value,
            second={
                ij: slopes.get(ij, Fraction(0)) + slopes.get(ij[::-1], Fraction(0))
                for ij in {y for x in slopes for y in (x, x[::-1])}
            },
        )
        return both + self._times(other.value) + other._times(self.value)

    def _times(self, c: Number) -> SecondOrder:
        """The derivatives times a number."""
        if not c:
            return SecondOrder(Fraction(0))
        slope, second = ({k: c * x for k, x in y.items()} for y in (self.slope, self.second))
        return SecondOrder(Fraction(0), slope, second)  # type: ignore[arg-type]

    def slopes(self, n: int) -> list[Number]:
        """The first derivatives by n variables."""
        return [self.slope.get(i, Fraction(0)) for i in range(n)]

    def matrix(self, n: int) -> Matrix:
        """The second derivatives by n variables."""
        span = range(n)
        return [[self.second.get((i, j), Fraction(0)) for j in span] for i in span]


SecondOrderAt = Mapping[Tree, SecondOrder]


def about(variables: Sequence[Tree], values: Sequence[Number]) -> dict[Tree, SecondOrder]:
    """The variables themselves about a point."""
    pairs = zip(variables, values, strict=True)
    return {x: SecondOrder(y, {k: Fraction(1)}) for k, (x, y) in enumerate(pairs)}


def expansion(t: Tree, at: SecondOrderAt) -> SecondOrder:
    """A tree about a point; ``ValueError`` for what is no polynomial of what has an expansion."""
    if isinstance(t, (int, Fraction)):
        return SecondOrder(Fraction(t))
    if t in at:
        return at[t]
    if not isinstance(t, tuple) or t[0] not in ("add", "mul", "div", "pow", "fun"):
        raise ValueError("not a polynomial of the variables")
    if t[0] == "fun":
        return SecondOrder(value_of(t))
    if t[0] == "pow":
        if not isinstance(t[2], int) or not 0 <= t[2] <= LARGEST_POWER:
            raise ValueError(f"an exponent that is no integer up to {LARGEST_POWER}")
        return reduce(SecondOrder.__mul__, [expansion(t[1], at)] * t[2], SecondOrder(Fraction(1)))
    if t[0] == "div":
        below = expansion(t[2], at)
        if below.slope or below.second:
            raise ValueError("a division by a variable")
        return expansion(t[1], at) * SecondOrder(1 / below.value)
    parts = (expansion(x, at) for x in t[1:])
    return reduce(SecondOrder.__add__ if t[0] == "add" else SecondOrder.__mul__, parts)
