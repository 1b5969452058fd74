"""A turn of an element by X in 𝔤, to first order 1 + X: by Cayley's transform, or the exponential.

W = (1 − ½X)⁻¹(1 + ½X) is in the group where 𝔤 has the cubes of its elements, as so(n), sp(n), se(n)
and nilpotents of degree 3 have, and no traces: it is exp 2 artanh ½X, an odd series.
"""

from __future__ import annotations

from fractions import Fraction

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from .. import dense
from ..graph import Node
from .discrete_ends import Ends

MOST = 12
"""The powers of X that the exponential has, for turns of at most 0.3.  Of those of 1e-8 and less,
1 + X is exact to rounding."""

Places = list[tuple[int, int]]


def turned(
    e: Ends, V: Matrix, U: Matrix, places: Places, turns: list[Node]
) -> dict[str, list[Node]]:
    """The functions that give V after 1 + V = U ← UW, X of coordinates ``turns``."""
    X = e.named(e.space.hat(turns), "X")
    whole = cayley(e, X) if has_cubes(e.group) else exponential(e, X, MOST)
    ways = {"step_turn": whole, "step_turn_little": X}
    ends = {name: q.plus(V, q.times(U, W)) for name, W in ways.items()}
    return {name: [m[i][j] for i, j in places] for name, m in ends.items()}


def has_cubes(group: Group) -> bool:
    """Is X³ in 𝔤 for every X of it, and Tr X = 0?  By all E_aE_bE_c with each order of them, of
    which X³ is made."""
    if "unimodular" not in group.relations:
        return False
    span = range(group.dimension)
    products = {(a, b): q.times(group.basis[a], group.basis[b]) for a in span for b in span}
    for a in span:
        for b in span[a:]:
            both = q.plus(products[a, b], products[b, a])
            for c in span[b:]:
                last, whole = group.basis[c], q.times(both, group.basis[c])
                for x, y in ((a, b), (b, a)):
                    ends = q.plus(
                        q.times(last, products[x, y]), q.times(products[x, c], group.basis[y])
                    )
                    whole = q.plus(whole, ends)
                if group.vee(whole) is None:
                    return False
    return True


def cayley(e: Ends, X: Matrix) -> Matrix:
    """W − 1, by the characteristic polynomial Σ c_i λ^(N−i) of Y = ½X, which has even i alone:

    ½(W − 1) = Y(1 − Y)⁻¹ = (Σ_k s_(N−k−1) Yᵏ − c_N) / s_N,  s_m = c_0 + … + c_m,  k = 1 … N − 1.
    """
    g, N = e.graph, len(X)
    Y = e.named(q.scaled(Fraction(1, 2), X), "Y")
    powers = [dense.numbers(g, q.identity(N)), Y]
    for k in range(2, N):
        powers.append(e.named(q.times(powers[k - 1], Y), f"power_{k}"))
    c, s = [e.one], [e.one]
    for k in range(1, N + 1):
        even = k % 2 == 0 and k <= e.group.n
        total = (
            g.sum(c[k - i] * _traced(powers, i) for i in range(2, k + 1, 2)) if even else g.num(0)
        )
        c.append(g.value(total * Fraction(-1, k), f"c_{k}"))
        s.append(g.value(g.sum(c), f"s_{k}"))
    whole = q.scaled(-c[N], powers[0])
    for k in range(1, N):
        whole = q.plus(whole, q.scaled(s[N - k - 1], powers[k]))
    over = g.value(g.recip(s[N]) * 2, "over")
    return e.named(q.scaled(over, e.named(whole, "above")), "beside")


def _traced(powers: list[Matrix], k: int) -> Node:
    """Tr Yᵏ, k even."""
    half = powers[k // 2]
    return dense.dot(half, q.transposed(half))


def exponential(e: Ends, X: Matrix, order: int) -> Matrix:
    """W − 1, W = exp X by the series up to a power that 3 divides."""
    square = e.named(q.times(X, X), "square")
    cube = e.named(q.times(square, X), "cube")
    factorial = [Fraction(1)]
    for k in range(1, order + 1):
        factorial.append(factorial[-1] / k)
    total: Matrix | None = None
    for first in range(order - 2, 0, -3):
        three = e.zero(X)
        for k, power in enumerate((X, square, cube)):
            three = q.plus(three, q.scaled(factorial[first + k], power))
        three = three if total is None else q.plus(three, q.times(cube, total))
        total = e.named(three, f"series_{first}")
    assert total is not None
    return total


def pattern(basis: tuple[Matrix, ...], size: int) -> list[tuple[int, int]]:
    """The places where a product of some E_a may have an entry that is not 0, by rows."""
    span = range(size)
    found = {(i, j) for e in basis for i in span for j in span if e[i][j]}
    while True:
        more = found | {(i, j) for i, k in found for m, j in found if k == m}
        if more == found:
            return sorted(found)
        found = more
