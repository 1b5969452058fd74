"""Rooted trees, and the order conditions of Runge–Kutta methods (Butcher; Hairer, Nørsett and
Wanner, *Solving Ordinary Differential Equations I*, II.2).

A tree is the tuple of the trees on its root, in order.  Of |t| vertices, it asks of weights b for

    Σ_i b_i φ_i(t) = 1/γ(t),  φ_i(t) = Π_s Σ_j a_ij φ_j(s),  γ(t) = |t| Π_s γ(s),  s on the root.
"""

from collections.abc import Sequence
from decimal import Decimal
from functools import cache
from itertools import combinations_with_replacement, product
from math import prod
from typing import Any

Tree = tuple[Any, ...]
Vector = list[Decimal]


@cache
def trees(n: int) -> tuple[Tree, ...]:
    """The rooted trees of n vertices: 1, 1, 2, 4, 9, 20, 48, 115, 286, 719, …"""
    found = []
    for sizes in _partitions(n - 1, n - 1):
        counts = {size: sizes.count(size) for size in sizes}
        choices = [combinations_with_replacement(trees(m), k) for m, k in counts.items()]
        found += [tuple(t for part in picked for t in part) for picked in product(*choices)]
    return tuple(found)


def _partitions(n: int, largest: int) -> list[tuple[int, ...]]:
    """n as sums of positive numbers, none above the one before it."""
    if n == 0:
        return [()]
    return [
        (first, *rest)
        for first in range(min(n, largest), 0, -1)
        for rest in _partitions(n - first, first)
    ]


def order(t: Tree) -> int:
    """|t|."""
    return 1 + sum(map(order, t))


def density(t: Tree) -> int:
    """γ(t)."""
    return order(t) * prod(map(density, t))


class Weights:
    """φ(t) of the stages of a method: a by rows of the numbers before the diagonal."""

    def __init__(self, a: Sequence[Sequence[Decimal]]):
        self.a, self.known = a, dict[Tree, Vector]()

    def stages(self, t: Tree) -> Vector:
        """φ_i(t), for each stage i."""
        if t not in self.known:
            found = [Decimal(1)] * len(self.a)
            for s in t:
                inner = self.stages(s)
                rows = (zip(row, inner, strict=False) for row in self.a)
                sums = [sum((x * y for x, y in row), Decimal(0)) for row in rows]
                found = [x * y for x, y in zip(found, sums, strict=True)]
            self.known[t] = found
        return self.known[t]

    def defect(self, b: Sequence[Decimal], n: int, theta: Decimal = Decimal(1)) -> Decimal:
        """The largest |Σ_i b_i φ_i(t) − θⁿ/γ(t)| of the trees of n vertices."""
        return max(
            abs(
                sum((x * y for x, y in zip(b, self.stages(t), strict=False)), Decimal(0))
                - theta**n / density(t)
            )
            for t in trees(n)
        )
