"""Closed curves on the spaces of a fluid, along which functions are integrated exactly."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, cached_property
from typing import Any

from ..values.arithmetic import EvaluationError
from .exact_functions import Edges, Exponents, Field, Function
from .fluid_spaces import Ball, FlatTorus, crossed, substituted

CORNERS = 3


class ClosedCurve:
    """A closed curve in ``space``, and that of the ``points`` that the displacement takes there."""

    space: Any
    points: Any
    bounded = False

    @property
    def length(self) -> int:
        """The number of exponents of a function along the curve."""
        found: int = self.space.length
        return found

    def composed(self, f: Function) -> Function:
        """f along the curve, f a function in space or over the points."""
        raise NotImplementedError

    def of_space(self, f: Function) -> Function:
        """f along the curve; ``EvaluationError`` where f is no function in space."""
        return self._checked(f, self.space)

    def of_points(self, f: Function) -> Function:
        """The same of a function over the points."""
        return self._checked(f, self.points)

    def _checked(self, f: Function, where: Any) -> Function:
        if f.space is not where and not f.is_constant:
            raise EvaluationError("Γ₀ is of what is over the points, Γ of what is in space")
        return self.composed(f)

    def rate(self, f: Function, moved: Sequence[Function]) -> Function:
        """The rate of f along the curve where its points move like this."""
        terms = [self.of_space(f.d(j)) * y for j, y in enumerate(moved)]
        found: Function = sum(terms[1:], terms[0])
        return found


class Polygon(ClosedCurve):
    """A polygon on a torus; on one of a ``level`` the first frequency is constant."""

    def __init__(self, space: FlatTorus, points: FlatTorus, draw: Any, *, level: bool):
        self.space, self.points, self.level = space, points, level
        self.edges = [self._edge(draw) for _ in range(CORNERS)]
        corners = [[draw() for _ in space.frequencies] for _ in range(CORNERS)]
        if level:
            corners = [[corners[0][0], *others] for _, *others in corners]
        self.corners = corners
        self.slope, self.value = cache(self._slope), cache(self._value)

    def _edge(self, draw: Any) -> list[Any]:
        """A random edge; of a level, orthogonal to the first frequency."""
        d, k = self.space.dimension, [*self.space.frequencies[0]]
        if not self.level:
            return [draw() for _ in range(d)]
        if d == 2:
            c = draw()
            return [-k[1] * c, k[0] * c]
        return crossed(k, [draw() for _ in k])

    def _slope(self, m: Exponents) -> Edges:
        """k · edge, the rate of e^{ik·x} on each edge."""
        k = self.space.frequency(m)
        each = (sum(x * y for x, y in zip(k, edge, strict=True)) for edge in self.edges)
        return Edges(tuple(each))

    def _value(self, m: Exponents, corner: int) -> Any:
        """e^{ik·x} at a corner."""
        found: Any = 1
        for x, n in zip(self.corners[corner % CORNERS], m, strict=False):
            found = found * x**n if n else found
        return found

    def composed(self, f: Function) -> Function:
        """f along the polygon, by the modes that are not constant there."""
        if not self.level:
            return Function(self, f.terms)
        terms: dict[Exponents, Any] = {}
        for m, x in f.terms.items():
            left = (0, *m[1:])
            y = x * self.value(m[:1], 0)
            terms[left] = terms[left] + y if left in terms else y
        return Function(self, terms)

    def derivative(self, f: Function, j: int) -> Function:
        """∂f/∂s."""
        del j
        return Function(
            self, {m: x * self.slope(m[:-1]) for m, x in f.terms.items() if any(m[:-1])}
        )

    def mean(self, f: Function) -> Function:
        """The integral over the polygon, where s goes from 0 to 1 on each edge."""
        zero = (0,) * (self.length - 1)
        orders: dict[Exponents, Any] = {}
        for m, x in f.terms.items():
            each = x.each if isinstance(x, Edges) else (x,) * CORNERS
            for i, y in enumerate(each):
                key, found = (*zero, m[-1]), y * self._integral(m[:-1], i)
                orders[key] = orders[key] + found if key in orders else found
        return Function(self, orders)

    def _integral(self, m: Exponents, i: int) -> Any:
        """That of e^{ik·x} over an edge."""
        slope = self.slope(m).each[i] if any(m) else 0
        ends = self.value(m, i), self.value(m, i + 1)
        return ends[0] if slope == 0 else (ends[1] - ends[0]) / slope

    @cached_property
    def tangent(self) -> Field:
        """The derivative of the place in s."""
        columns = zip(*self.edges, strict=True)
        return tuple(Function(self, {(0,) * self.length: Edges(x)}) for x in columns)


class LaurentCurve(ClosedCurve):
    """A curve in a ball, Σ a_n zⁿ with |n| ≤ 2, with the exponents of z, 0, … and s."""

    def __init__(self, space: Ball, points: Ball, draw: Any):
        self.space, self.points, self.pace = space, points, draw()
        self.start = tuple(
            Function(self, {space.exponents(0, n): draw() for n in range(-2, 3)})
            for _ in range(space.dimension)
        )
        self.place = points.turned(self.start)

    def composed(self, f: Function) -> Function:
        """f along the curve, monomial by monomial."""
        return substituted(f, self.start if f.space is self.points else self.place)

    def derivative(self, f: Function, j: int) -> Function:
        """∂f/∂s, where ∂z/∂s is a multiple of z."""
        del j
        return Function(self, {m: x * self.pace * m[0] for m, x in f.terms.items() if m[0]})

    def mean(self, f: Function) -> Function:
        """The integral over the curve: the power 0."""
        return Function(self, {m: x for m, x in f.terms.items() if not m[0]})

    @cached_property
    def tangent(self) -> Field:
        """The derivative of the place in s."""
        return tuple(x.d(0) for x in self.place)


def curve(space: Any, points: Any, draw: Any, *, level: bool) -> ClosedCurve:
    """A random closed curve; on a torus one of a ``level``, if it is to be."""
    if isinstance(space, FlatTorus):
        return Polygon(space, points, draw, level=level)
    return LaurentCurve(space, points, draw)
