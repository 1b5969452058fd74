"""The equations of the record for a small N: its sums over the lattice, term by term."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from typing import Any, NamedTuple

from ...algebra.structure import Place, TorusLattice
from ...language.tree import Tree, mul
from ..graph import Graph, Node
from ..program import LoweringError
from .lattice_state import position


class Complex(NamedTuple):
    """A complex number by its parts."""

    re: Node
    im: Node


class WrittenOut:
    """Trees of the record as pairs of nodes; ``leaves``: the numbers of the state."""

    def __init__(self, torus: TorusLattice, graph: Graph, leaves: list[Node]):
        self.torus, self.graph, self.leaves = torus, graph, leaves
        self.pi = graph.product((graph.num(4), graph.function("atan", graph.num(1))))

    def value(self, t: Tree, at: Mapping[str, Place]) -> Complex:
        """The value of a tree where its indices are bound."""
        g = self.graph
        if isinstance(t, (int, Fraction)):
            return Complex(g.num(t), g.num(0))
        if t == "π":
            return Complex(self.pi, g.num(0))
        if not isinstance(t, tuple):
            raise LoweringError(f"no number {t!r} of the torus")
        op, *parts = t
        if op == "call" and parts[0] == "ω̂":
            return self.vorticity(self.place(parts[1], at))
        if op == "norm2":
            return self.value(sum(x * x for x in self.place(parts[0], at)), at)
        if op == "fun" and parts[0] == "sin":
            return Complex(self.sine(self.turns(parts[1], at)), g.num(0))
        if op == "sum":
            return self.total(parts[1], [{**at, parts[0]: n} for n in self.torus.places])
        found = [self.value(x, at) for x in parts]
        if op == "mul":
            return reduce(self.product, found)
        if op == "div" and found[1].im.is_zero:
            below = g.recip(found[1].re)
            return Complex(g.product((found[0].re, below)), g.product((found[0].im, below)))
        raise LoweringError(f"no {op!r} of numbers on the torus")

    def total(self, term: Tree, places: list[dict[str, Place]]) -> Complex:
        """A sum over places, the terms with the same sine together."""
        g, groups = self.graph, defaultdict[Node, list[Complex]](list)
        factors = term[1:] if isinstance(term, tuple) and term[0] == "mul" else (term,)
        sines = [x for x in factors if isinstance(x, tuple) and x[:2] == ("fun", "sin")]
        rest = mul(*(x for x in factors if x not in sines))
        for at in places:
            sine = self.value(mul(*sines), at).re
            sign, least = sine.split
            there = self.product(Complex(g.num(sign), g.num(0)), self.value(rest, at))
            groups[least].append(there)
        parts = [
            [g.product((sine, g.sum(part))) for part in zip(*found, strict=True)]
            for sine, found in groups.items()
        ]
        return Complex(*(g.sum(x) for x in zip(*parts, strict=True)))

    def product(self, x: Complex, y: Complex) -> Complex:
        """A product, of sums term by term: like ones are added before they are multiplied."""
        g = self.graph
        re = (g.product((x.re, y.re)), -g.product((x.im, y.im)))
        return Complex(g.sum(re), g.sum((g.product((x.re, y.im)), g.product((x.im, y.re)))))

    def vorticity(self, n: Place) -> Complex:
        """ω̂(n), by the state."""
        if self.torus.representative(n) == (0, 0):
            return Complex(self.graph.num(0), self.graph.num(0))
        j, conjugate = position(self.torus, n)
        return Complex(self.leaves[j], -self.leaves[j + 1] if conjugate else self.leaves[j + 1])

    def sine(self, k: int) -> Node:
        """sin 2πk/N, by those of 0 < k < N/2."""
        g, k = self.graph, k % self.torus.N
        if not k:
            return g.num(0)
        least, sign = (k, 1) if k <= self.torus.half else (self.torus.N - k, -1)
        angle = g.product((g.num(Fraction(2 * least, self.torus.N)), self.pi))
        return g.product((g.num(sign), g.function("sin", angle)))

    def turns(self, angle: Tree, at: Mapping[str, Place]) -> int:
        """The k of an angle 2π k/N, k = m ∧ n."""
        match angle:
            case ("div", ("mul", 2, "π", ("wedge", m, n)), self.torus.N):
                (a, b), (c, d) = self.place(m, at), self.place(n, at)
                return a * d - b * c
        raise LoweringError("an angle of another form")

    def place(self, t: Tree, at: Mapping[str, Place]) -> Place:
        """A point of the lattice."""
        if isinstance(t, str):
            return at[t]
        found: list[Any] = [x if isinstance(x, int) else self.place(x, at) for x in t[1:]]  # type: ignore[index]
        if t[0] == "mul":  # type: ignore[index]
            return found[0] * found[1][0], found[0] * found[1][1]
        return sum(x for x, _ in found), sum(y for _, y in found)
