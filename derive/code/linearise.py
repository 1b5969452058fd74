"""The linearised equations: exact derivatives of the rates, on the graph.

A variation of the state is δg = g η, η = Σ η_a E_a, and δζ.  With δ(g⁻¹ġ) = η̇ + [Z, η]

    η̇ = δζ − [Z, η],    δζ̇ = ∂ζ̇/∂η η + ∂ζ̇/∂ζ δζ,

on the right, with δg = η g, η̇ = δζ + [Z, η]; and the same with inputs and parameters in place of
η, δζ.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction

from ..language.derivatives import DERIVATIVES
from ..language.values import value
from .ellipsoid import is_item, slopes
from .graph import Graph, Node
from .state import StateSpace


class Varied:
    """Directional derivatives of nodes, named ``d_…_name``; ``seeds``: leaf → its derivative."""

    def __init__(self, graph: Graph, seeds: Mapping[Node, Node], name: str):
        self.graph, self.name = graph, name
        self.zero = graph.num(0)
        self._done: dict[Node, Node] = dict(seeds)

    def of(self, x: Node) -> Node:
        """The derivative of a node; leaves without a seed are constant."""
        if x not in self._done:
            self._done[x] = self._derivative(x)
        return self._done[x]

    def _derivative(self, x: Node) -> Node:
        g = self.graph
        if x.op in ("num", "leaf", "none"):
            return self.zero
        if x.op == "value":
            title, label, _ = g.titles[x]
            return g.value(self.of(x.args[0]), f"d_{title}_{self.name}", label)
        if x.op == "add":
            return g.linear((c, self.of(y)) for c, y in zip(x.data, x.args, strict=True))
        if x.op == "mul":
            return g.sum(self._factors(x.args))
        if x.op == "fun" and is_item(x.data):
            return g.sum(g.product((slope, self.of(y))) for y, slope in slopes(x))
        inner = self.of(x.args[0])
        if inner.is_zero:
            return self.zero
        if x.op == "recip":
            return g.linear([(Fraction(-1), g.product((x, x, inner)))])
        if x.op == "fun":
            slope = value(DERIVATIVES[x.data]("x"), {"x": x.args[0]}, None, g.function, g.num)
            return g.product((slope, inner))
        raise ValueError(f"no derivative of {x.op!r}")

    def _factors(self, factors: Sequence[Node]) -> Iterable[Node]:
        """The terms of the derivative of a product."""
        for k, y in enumerate(factors):
            varied = self.of(y)
            if not varied.is_zero:
                yield self.graph.product([*factors[:k], varied, *factors[k + 1 :]])


def by_state(space: StateSpace, accelerations: list[Node]) -> list[Node]:
    """The matrix, 2N × 2N by rows, of (η, δζ) ↦ (η̇, δζ̇); ``accelerations``: ζ̇ (and ẇ)."""
    g, d = space.graph, space.group.dimension
    span = range(d)
    turned = [Varied(g, space.along(a), f"eta_{a + 1}") for a in span]
    sped = [Varied(g, space.faster(a), f"zeta_{a + 1}") for a in span]
    rows = [
        [*(x if space.right else -x for x in row), *(g.num(int(a == b)) for b in span)]
        for a, row in enumerate(_adjoint(space))
    ]
    rows += [[v.of(x) for v in (*turned, *sped)] for x in accelerations]
    return [x for row in rows for x in row]


def by_leaves(space: StateSpace, accelerations: list[Node], leaves: Sequence[Node]) -> list[Node]:
    """∂(η̇, ζ̇)/∂leaves, for inputs or parameters: 2N × len(leaves) by rows, the first N 0."""
    g, d = space.graph, space.group.dimension
    varied = [Varied(g, {x: g.num(1)}, str(x.data[1])) for x in leaves]
    zeros = [g.num(0)] * (d * len(leaves))
    return zeros + [v.of(x) for x in accelerations for v in varied]


def by_numbers(graph: Graph, rates: list[Node], state: Sequence[Node]) -> list[Node]:
    """∂ẋ/∂x by rows, of the numbers of the state as they are stored, on the group and off it."""
    varied = [Varied(graph, {x: graph.num(1)}, str(x.data[1])) for x in state]
    return [v.of(x) for x in rates for v in varied]


def _adjoint(space: StateSpace) -> list[list[Node]]:
    """The matrix of ad_Z = [Z, ·] in the basis: Σ_c ζ_c [E_c, E_b]ᵃ."""
    g, d = space.graph, space.group.dimension
    constants, zeta = space.group.structure_constants, space.coordinates
    return [
        [
            g.linear((constants[c][b][a], zeta[c]) for c in range(d) if constants[c][b][a])
            for b in range(d)
        ]
        for a in range(d)
    ]
