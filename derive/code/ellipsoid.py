"""Integrals over an ellipsoid in the code, with P(u) = u³ + I₁u² + I₂u + I₃: Ψ = ∫ P^(−½) du and
Ψ_k = ∫ u^k P^(−3/2) du of self-gravity, all four by one call; ∫ u^k P^(−5/2) du, k = 0, …, 4, by
another.

As ∂P/∂I_i = u^(3−i), the derivatives of ∫ u^k P^(−s) du by I_i are −s ∫ u^(k+3−i) P^(−s−1) du.
"""

from __future__ import annotations

from fractions import Fraction

from .graph import Graph, Node
from .naming import name_of

INTEGRALS, SLOPES = "ellipsoid", "ellipsoid_slopes"
"""The emitted functions of I₁, I₂, I₃."""
BUNDLES = {
    INTEGRALS: "1/sqrt(P), then of 1, u, u^2 over P sqrt(P)",
    SLOPES: "1, u, u^2, u^3, u^4 over P^2 sqrt(P)",
}
"""Of what a function gives the integrals; ``ellipsoid_k`` is what it gives at place k."""
PLACES = {"Ψ": 0, "Ψ_0": 1, "Ψ_1": 2, "Ψ_2": 3}


def is_integral(name: str) -> bool:
    """Is an elementary function of the graph one of these, or their bundle?"""
    return name.startswith(INTEGRALS)


def is_item(name: str) -> bool:
    """Is it one of a bundle?"""
    return is_integral(name) and name not in BUNDLES


def integral(g: Graph, name: str, invariants: list[Node], label: str) -> Node:
    """The node of Ψ or Ψ_k at I₁, I₂, I₃."""
    return g.value(_item(g, INTEGRALS, PLACES[name], invariants, label), name_of(name), label)


def _item(g: Graph, bundle: str, place: int, invariants: list[Node], label: str) -> Node:
    title = "integrals" if bundle == INTEGRALS else "slopes"
    found = g.value(g.function(bundle, *invariants), title, label)
    return g.function(f"{INTEGRALS}_{place}", found)


def slopes(x: Node) -> list[tuple[Node, Node]]:
    """I_i and the derivative by it, of the node of Ψ or Ψ_k."""
    (found,), place = x.args, int(x.data.removeprefix(f"{INTEGRALS}_"))
    bundle, g = found.args[0], x.graph
    assert bundle.data == INTEGRALS
    s, k = (Fraction(3, 2), place - 1) if place else (Fraction(1, 2), 0)
    after, shift = (SLOPES, 0) if place else (INTEGRALS, 1)
    label = g.titles[found][1]
    return [
        (by, -s * _item(g, after, k + 3 - i + shift, [*bundle.args], label))
        for i, by in enumerate(bundle.args, 1)
    ]
