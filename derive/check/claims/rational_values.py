"""Values of trees of rational functions modulo a prime: at points, and with their gradients."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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


def value(t: Tree, at: At, p: int) -> Value:
    """The value of a tree modulo p; ``ValueError`` for what is no rational function of what has a
    value."""
    if isinstance(t, (int, Fraction)):
        return residue_of(t, p)
    if t in at:
        return at[t]
    if not isinstance(t, tuple) or t[0] not in ("add", "mul", "div", "pow"):
        raise ValueError("not a rational function of the variables and the parameters")
    if t[0] == "pow":
        x, n = value(t[1], at, p), t[2]
        if not isinstance(n, int) or not 0 <= n <= LARGEST_POWER:
            raise ValueError(f"an exponent that is no integer up to {LARGEST_POWER}")
        return pow(x, n, p) if isinstance(x, int) else x**n
    parts = [value(x, at, p) for x in t[1:]]
    if t[0] == "add":
        return reduce(lambda x, y: _reduced(x + y, p), parts)
    if t[0] == "mul":
        return reduce(lambda x, y: _reduced(x * y, p), parts)
    above, below = parts
    if not isinstance(below, int):
        raise ValueError("a division by a variable")
    return _reduced(above * pow(below, -1, p), p)


def _reduced(x: Value, p: int) -> Value:
    return x % p if isinstance(x, int) else x


class Jet:
    """A residue ``n`` modulo p with its ``slopes``, the derivatives by variables, which are
    numbered, where they are not 0."""

    __slots__ = ("n", "p", "slopes")

    def __init__(self, n: int, slopes: Mapping[int, int], p: int):
        self.n, self.slopes, self.p = n % p, slopes, p

    def __add__(self, other: Jet | int) -> Jet:
        if isinstance(other, int):
            return Jet(self.n + other, self.slopes, self.p)
        found = {**self.slopes}
        for k, x in other.slopes.items():
            found[k] = (found.get(k, 0) + x) % self.p
        return Jet(self.n + other.n, found, self.p)

    __radd__ = __add__

    def __mul__(self, other: Jet | int) -> Jet:
        if isinstance(other, int):
            slopes = {k: x * other % self.p for k, x in self.slopes.items()}
            return Jet(self.n * other, slopes, self.p)
        product = self * other.n + other * self.n
        return Jet(self.n * other.n, product.slopes, self.p)

    __rmul__ = __mul__

    def __pow__(self, k: int) -> Jet:
        slope = k * pow(self.n, k - 1, self.p) if k else 0
        return Jet(pow(self.n, k, self.p), (self * slope).slopes, self.p)


def rank(rows: Sequence[Sequence[int]], p: int) -> int:
    """The rank of a matrix modulo p."""
    return q.rank(tuple(tuple(Residue(x, p) for x in row) for row in rows)) if rows else 0
