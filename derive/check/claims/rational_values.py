"""Values of trees of rational functions modulo a prime: at points, and with their gradients."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

from ...algebra.residue_vectors import residue_of
from ...language import rational as q
from ...language.tree import Tree
from ..residue import Residue

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
