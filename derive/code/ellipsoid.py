"""Integrals over an ellipsoid in the code, and the tension of a spring."""

from __future__ import annotations

from fractions import Fraction

from ..language.tree import Tree
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


# The tension c(s − l)/s of a spring between ends at the distance s = √q, where l may be 0.
#
# As c − cl/s it is c where l is 0, if only s is not 0 there: then q is added to by as good as
# nothing. Where l is not 0 nothing is added, and at distance 0 there is no direction and no
# number.

SLACK = {"double": Fraction(1, 10**37), "float": Fraction(1, 10**20)}
"""Added to the square of a distance that may be 0; its root has a third power that is not 0.

That of doubles is a number of 32 bits as well, for arrays of these.
"""


def tension(t: Tree) -> tuple[tuple[Tree, ...], Tree, Tree, Tree] | None:
    """The factors of c, then s = √q, q and l of a spring's tension c(s − l)/s, l a parameter.

    ``None`` for any other tree.
    """
    match t:
        case ("div", ("mul", *factors), ("fun", "sqrt", q) as s):
            for k, x in enumerate(factors):
                match x:
                    case ("add", a, ("mul", -1, ("par", _) as length)) if a == s:
                        return (*factors[:k], *factors[k + 1 :]), s, q, length
    return None


UNSEEN = {"double": Fraction(1, 10**300), "float": Fraction(1, 10**37)}
"""What is added to the y of an atan2(y, x) on its half line: less than any y that is meant."""


def half_angle(t: Tree) -> Tree | None:
    """The r + x of the half of an atan2(y, x), as a file's expression is read: 0/0 where it is 0;
    ``None`` for any other tree."""
    match t:
        case ("div", ("mul", 2, r, y), ("add", ("pow", ("add", s, _) as found, 2), ("pow", z, 2))):
            return found if s == r and z == y else None
    return None
