"""Integrals over an ellipsoid in the code: Ψ and Ψ_k of self-gravity, all four by one call.

With P(u) = u³ + I₁u² + I₂u + I₃ and its roots −x, −y, −z, Ψ = 2 R_F(x, y, z) is invariant under
Carlson's duplication (x, y, z) ↦ ¼(x + λ, y + λ, z + λ), λ = √xy + √yz + √zx.  The emitted function
takes these steps on the symmetric functions of √x, √y, √z, which need no roots, ends with a series
in the two that are left, and goes the same steps back for the derivatives
∂Ψ/∂I₁ = −½Ψ_2, ∂Ψ/∂I₂ = −½Ψ_1, ∂Ψ/∂I₃ = −½Ψ_0.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import factorial, prod

from ..language.rational import Matrix
from ..language.tree import Tree
from .graph import Graph, Node
from .naming import name_of
from .program import Expression

INTEGRALS = "ellipsoid"
"""The emitted function of I₁, I₂, I₃; ``ellipsoid_k`` is what it gives at place k."""
PLACES = {"Ψ": 0, "Ψ_0": 1, "Ψ_1": 2, "Ψ_2": 3}
DUPLICATIONS, NEWTON_STEPS, ORDER = 6, 3, 11
"""What leaves an error below the rounding of doubles for semi-axes of ratios up to 1e8."""
SMALL_Y, CONVERGED = Fraction(1, 5000), Fraction(1, 10**16)
"""Where a step can be the last: |y| of the series, and the square of a relative change in Newton's
method, whose next change is below rounding."""


def is_integral(name: str) -> bool:
    """Is an elementary function of the graph one of these?"""
    return name.startswith(INTEGRALS)


def integral(g: Graph, name: str, invariants: list[Node], label: str) -> Node:
    """The node of Ψ or Ψ_k at I₁, I₂, I₃."""
    found = g.value(g.function(INTEGRALS, *invariants), "integrals", label)
    return g.value(g.function(f"{INTEGRALS}_{PLACES[name]}", found), name_of(name), label)


def series() -> dict[str, Expression]:
    """Ψ √μ / 2 = Σ (−1)^i (½)_{i+j} y^i z^j / (i! j! (4i + 6j + 1)), for μ = I₁/3 and the
    elementary symmetric functions y, z of 1 − x/μ, …; and its derivatives by y and z."""
    terms = {
        (i, j): Fraction(
            (-1) ** i * prod(Fraction(2 * k + 1, 2) for k in range(i + j)),
        )
        / (factorial(i) * factorial(j) * (4 * i + 6 * j + 1))
        for i in range(ORDER // 2 + 1)
        for j in range((ORDER - 2 * i) // 3 + 1)
    }
    by_y = {(i - 1, j): i * c for (i, j), c in terms.items() if i}
    by_z = {(i, j - 1): j * c for (i, j), c in terms.items() if j}
    return {"value": _horner(terms), "by_y": _horner(by_y), "by_z": _horner(by_z)}


def _horner(terms: dict[tuple[int, int], Fraction]) -> Expression:
    """A polynomial in y and z by nested products, in y inside."""

    def nested(name: str, coefficients: list[Expression]) -> Expression:
        *lower, total = coefficients
        for c in reversed(lower):
            total = ("add", c, ("mul", name, total))
        return total

    most = max(j for _, j in terms)
    rows = [[terms[i, k] for i, k in sorted(terms) if k == j] for j in range(most + 1)]
    return nested("z", [nested("y", [*row]) for row in rows])


def polarised(t: Tree) -> tuple[Tree, Tree] | None:
    """(K_a, the matrix C) where a tree is Tr(KC) K − KCK of self-gravity; ``None`` elsewhere."""
    match t:
        case ("add", ("mul", "I_1", "K_G"), ("mul", -1, "K_G", *C, "K_G")):
            return "K_a", ("mul", *C)
    return None


def mixed_adjugate(a: Matrix, b: Matrix) -> Matrix:
    """adj(a + b) − adj a − adj b for symmetric 3 × 3 matrices, without terms that cancel."""

    def entry(i: int, j: int) -> Node:
        (p, q), (r, s) = ([k for k in range(3) if k != x] for x in (i, j))
        pairs: Callable[[int, int, int, int], Node] = lambda k, l, m, n: (  # noqa: E731, E741
            a[k][l] * b[m][n] + b[k][l] * a[m][n]
        )
        found: Node = pairs(p, r, q, s) - pairs(p, s, q, r)
        return found if (i + j) % 2 == 0 else -found

    return tuple(tuple(entry(i, j) for j in range(3)) for i in range(3))
