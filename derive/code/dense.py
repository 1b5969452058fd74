"""Small matrices of nodes: products in the cheapest order, inverses by what is known of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

from ..algebra.rational import Matrix
from .graph import PARAMETER, Graph, Node

Namer = Callable[[Matrix, int, int], Matrix]


def stage_of(m: Matrix) -> int:
    """0 when the matrix depends on parameters alone."""
    return int(max(x.stage for row in m for x in row))


def times(g: Graph, a: Matrix, b: Matrix) -> Matrix:
    """a b."""
    columns = list(zip(*b, strict=True))
    return tuple(
        tuple(g.sum(g.product((x, y)) for x, y in zip(r, c, strict=True)) for c in columns)
        for r in a
    )


def chain(g: Graph, factors: Sequence[Matrix], named: Namer) -> Matrix:
    """The product of a chain, multiplied in the order with the fewest multiplications.

    What depends on parameters alone costs nothing: it is computed once.  ``named(m, i, j)`` gives a
    name to the partial product of the factors i … j.
    """

    @cache
    def best(i: int, j: int) -> tuple[int, int]:
        """(cost, split) of the factors i … j."""
        if i == j:
            return 0, i
        options = []
        for k in range(i, j):
            rows, inner, cols = len(factors[i]), len(factors[k + 1]), len(factors[j][0])
            fixed = all(stage_of(f) == PARAMETER for f in factors[i : j + 1])
            cost = 0 if fixed else rows * inner * cols
            options.append((best(i, k)[0] + best(k + 1, j)[0] + cost, k))
        return min(options)

    def build(i: int, j: int) -> Matrix:
        if i == j:
            return factors[i]
        k = best(i, j)[1]
        product = times(g, build(i, k), build(k + 1, j))
        return product if (i, j) == (0, len(factors) - 1) else named(product, i, j)

    return build(0, len(factors) - 1)


def dot(g: Graph, a: Matrix, b: Matrix) -> Node:
    """Σ a_ij b_ij."""
    return g.sum(
        g.product((x, y)) for r, s in zip(a, b, strict=True) for x, y in zip(r, s, strict=True)
    )


def determinant(g: Graph, m: Matrix) -> Node:
    """By expansion along the first row."""
    if len(m) == 1:
        return m[0][0]  # type: ignore[no-any-return]
    return g.sum(
        g.linear([((-1) ** j, g.product((m[0][j], determinant(g, minor(m, 0, j)))))])
        for j in range(len(m))
    )


def minor(m: Matrix, i: int, j: int) -> Matrix:
    """The matrix without row i and column j."""
    return tuple(row[:j] + row[j + 1 :] for k, row in enumerate(m) if k != i)


def adjugate(g: Graph, m: Matrix) -> Matrix:
    """The transpose of the cofactors: det m · m⁻¹."""
    n = len(m)
    if n == 1:
        return ((g.num(1),),)
    return tuple(
        tuple(g.linear([((-1) ** (i + j), determinant(g, minor(m, j, i)))]) for j in range(n))
        for i in range(n)
    )


def symmetric_inverse(
    g: Graph, m: Matrix, named: Callable[[str, Node], Node]
) -> tuple[Matrix, list[Node]]:
    """m⁻¹ and the pivots of  m = L D L̄,  for a positive definite m: no square roots, no search.

    ``named(name, node)`` names an intermediate value.
    """
    n = len(m)
    L: list[list[Node]] = [[g.num(int(i == j)) for j in range(n)] for i in range(n)]
    D: list[Node] = []
    R: list[Node] = []
    for j in range(n):
        earlier = [g.product((L[j][k], L[j][k], D[k])) for k in range(j)]
        D.append(named(f"d_{j + 1}", m[j][j] - g.sum(earlier)))
        R.append(named(f"r_{j + 1}", g.recip(D[j])))
        for i in range(j + 1, n):
            terms = [g.product((L[i][k], L[j][k], D[k])) for k in range(j)]
            L[i][j] = named(f"l_{i + 1}{j + 1}", g.product((m[i][j] - g.sum(terms), R[j])))
    W: list[list[Node]] = [[g.num(0)] * n for _ in range(n)]
    for j in range(n):
        W[j][j] = g.num(1)
        for i in range(j + 1, n):
            terms = [g.product((L[i][k], W[k][j])) for k in range(j, i)]
            W[i][j] = named(f"w_{i + 1}{j + 1}", -g.sum(terms))
    inverse = tuple(
        tuple(
            g.sum(g.product((W[k][i], W[k][j], R[k])) for k in range(max(i, j), n))
            for j in range(n)
        )
        for i in range(n)
    )
    return inverse, D
