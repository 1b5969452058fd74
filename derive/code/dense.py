"""Small matrices of nodes: products in the cheapest order, inverses by what is known of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product
from typing import Any, NamedTuple

from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from .graph import PARAMETER, Graph, Node

Namer = Callable[[Matrix, int, int], Matrix]
NodeNamer = Callable[[str, Node], Node]


def stage_of(m: Matrix) -> int:
    """PARAMETER when every entry depends on parameters alone, else STATE."""
    return int(max(x.stage for row in m for x in row))


def numbers(g: Graph, m: Matrix) -> Matrix:
    """A matrix of rational numbers, as nodes."""
    return tuple(tuple(map(g.num, row)) for row in m)


def entrywise(m: Matrix, name: str, made: Callable[[Node, str], Node], column: bool) -> Matrix:
    """What is made of each entry and its name, which in a column has one index."""

    def entry(x: Node, i: int, j: int) -> Node:
        return made(x, suffixed(name, i) if column else suffixed(name, i, j))

    return tuple(tuple(entry(x, i, j) for j, x in enumerate(row, 1)) for i, row in enumerate(m, 1))


def chain(g: Graph, factors: Sequence[Matrix], named: Namer) -> Matrix:
    """The product of a chain of matrices, in the order with the fewest multiplications.

    What depends on parameters alone costs nothing: it is computed once. ``named(m, i, j)`` gives a
    name to the partial product of the factors i … j.
    """

    @cache
    def best(i: int, j: int) -> tuple[int, int]:
        """The fewest multiplications for the factors i … j, and the index after which to split."""
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
        product = q.times(build(i, k), build(k + 1, j))
        return product if (i, j) == (0, len(factors) - 1) else named(product, i, j)

    return build(0, len(factors) - 1)


def dot(a: Matrix, b: Matrix) -> Node:
    """The inner product of matrices of one shape, Σ a_ij b_ij."""
    found: Node = q.dot(q.flatten(a), q.flatten(b))
    return found


def determinant(m: Sequence[Sequence[Any]]) -> Any:
    """The determinant in any ring, by expansion along the rows, each minor computed once."""
    n = len(m)

    @cache
    def below(columns: tuple[int, ...]) -> Any:
        """The minor of the last rows in these columns, as many of each."""
        row = m[n - len(columns)]
        if len(columns) == 1:
            return row[columns[0]]
        parts = [row[j] * below((*columns[:k], *columns[k + 1 :])) for k, j in enumerate(columns)]
        total = parts[0]
        for k, x in enumerate(parts[1:], 1):
            total = total - x if k % 2 else total + x
        return total

    return below(tuple(range(n)))


def minor(m: Matrix, i: int, j: int) -> Matrix:
    """The matrix without row i and column j."""
    return tuple(row[:j] + row[j + 1 :] for k, row in enumerate(m) if k != i)


def adjugate(g: Graph, m: Matrix) -> Matrix:
    """The transpose of the cofactor matrix: det m · m⁻¹."""
    n = len(m)
    if n == 1:
        return ((g.num(1),),)
    return tuple(
        tuple(determinant(minor(m, j, i)) * (-1) ** (i + j) for j in range(n)) for i in range(n)
    )


@dataclass(frozen=True)
class Factors:
    """m = L D L̄ for a positive definite m: no square roots, no search.

    ``lower``: the columns of L below the diagonal by (i, j); ``pivots``: D; ``inverses``: D⁻¹.
    """

    lower: dict[tuple[int, int], Node]
    pivots: list[Node]
    inverses: list[Node]


def factorised(g: Graph, m: Matrix, named: NodeNamer) -> Factors:
    """The factors L, D of m = L D L̄; ``named(name, node)`` names an intermediate value."""
    n = len(m)
    f = Factors({}, [], [])
    for j in range(n):
        scaled = [g.product((f.lower[j, k], f.pivots[k])) for k in range(j)]
        earlier = [g.product((f.lower[j, k], scaled[k])) for k in range(j)]
        f.pivots.append(named(f"d_{j + 1}", m[j][j] - g.sum(earlier)))
        f.inverses.append(named(f"r_{j + 1}", g.recip(f.pivots[j])))
        for i in range(j + 1, n):
            terms = [g.product((f.lower[i, k], scaled[k])) for k in range(j)]
            entry = g.product((m[i][j] - g.sum(terms), f.inverses[j]))
            f.lower[i, j] = named(f"l_{i + 1}{j + 1}", entry)
    return f


def solve(g: Graph, f: Factors, right: Matrix, named: NodeNamer) -> Matrix:
    """The column x with L D L̄ x = ``right``: forward, diagonal, backward."""
    n = len(f.pivots)
    y: list[Node] = []
    for i in range(n):
        terms = [g.product((f.lower[i, k], y[k])) for k in range(i)]
        y.append(named(f"y_{i + 1}", right[i][0] - g.sum(terms)))
    x: list[Node] = [g.num(0)] * n
    for i in reversed(range(n)):
        terms = [g.product((f.lower[k, i], x[k])) for k in range(i + 1, n)]
        apart = y[i] == right[i][0] and g.sum(terms).is_zero
        over = _quotient(g, y[i], f, i) if apart else g.product((y[i], f.inverses[i]))
        x[i] = named(f"x_{i + 1}", over - g.sum(terms))
    return tuple((v,) for v in x)


def _quotient(g: Graph, x: Node, f: Factors, i: int) -> Node:
    """x over pivot i; terms with the pivot as a factor just lose it, as weight over mass."""
    core = x.args[0] if x.op == "value" else x
    terms = zip(core.data, core.args, strict=True) if core.op == "add" else [(Fraction(1), core)]
    free: list[tuple[Fraction, Node]] = []
    others: list[tuple[Fraction, Node]] = []
    for c, term in terms:
        left = _without(g, term, f.pivots[i])
        (others if left is None else free).append((c, term if left is None else left))
    if not free:
        return g.product((x, f.inverses[i]))
    return g.linear([*free, (Fraction(1), g.product((g.linear(others), f.inverses[i])))])


def _without(g: Graph, x: Node, factor: Node) -> Node | None:
    """x divided by one of its factors; ``None`` if it is none."""
    if x == factor:
        return g.num(1)
    if x.op == "value":
        return _without(g, x.args[0], factor)
    parts = [_without(g, y, factor) for y in x.args] if x.op in ("add", "mul") else []
    if x.op == "add" and all(y is not None for y in parts):
        return g.linear((c, y) for c, y in zip(x.data, parts, strict=True) if y is not None)
    if x.op == "mul":
        for k, y in enumerate(parts):
            if y is not None:
                return g.product((*x.args[:k], y, *x.args[k + 1 :]))
    return None


def symmetric_inverse(g: Graph, m: Matrix, named: NodeNamer) -> tuple[Matrix, list[Node]]:
    """m⁻¹ for a positive definite m, and the pivots of its factors L D L̄."""
    n = len(m)
    f = factorised(g, m, named)
    W: list[list[Node]] = [[g.num(0)] * n for _ in range(n)]
    for j in range(n):
        W[j][j] = g.num(1)
        for i in range(j + 1, n):
            terms = [g.product((f.lower[i, k], W[k][j])) for k in range(j, i)]
            W[i][j] = named(f"w_{i + 1}{j + 1}", -g.sum(terms))
    entries = {
        (i, j): g.sum(g.product((W[k][i], W[k][j], f.inverses[k])) for k in range(i, n))
        for i in range(n)
        for j in range(i + 1)
    }
    inverse = tuple(tuple(entries[max(i, j), min(i, j)] for j in range(n)) for i in range(n))
    return inverse, f.pivots


class Complex(NamedTuple):
    """A complex number by its parts."""

    re: Node
    im: Node

    def __add__(self, other: Complex) -> Complex:  # type: ignore[override]
        return Complex(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        return Complex(self.re - other.re, self.im - other.im)

    def __mul__(self, other: Complex) -> Complex:  # type: ignore[override]
        re = self.re * other.re - self.im * other.im
        return Complex(re, self.re * other.im + self.im * other.re)


def diagonal(g: Graph, m: Matrix) -> Node:
    """Tr m."""
    return g.sum(m[i][i] for i in range(len(m)))


def is_constant(m: Matrix) -> bool:
    """Are all entries numbers?"""
    return all(x.op == "num" for row in m for x in row)


def is_diagonal(m: Matrix) -> bool:
    """Are all entries beside the diagonal 0?"""
    return all(x.is_zero for i, row in enumerate(m) for j, x in enumerate(row) if i != j)


def sparse_trace(g: Graph, constants: list[Matrix], between: list[Matrix | None]) -> Node:
    """Tr E_1 X_1 E_2 X_2 …, over the entries of the constant E_k that are not zero."""
    entries = [
        [(i, j, x) for i, row in enumerate(e) for j, x in enumerate(row) if not x.is_zero]
        for e in constants
    ]
    terms: list[Node] = []
    for chosen in product(*entries):
        factors: list[Node] = []
        for k, (_, j, x) in enumerate(chosen):
            i = chosen[(k + 1) % len(chosen)][0]
            middle = between[k]
            link = g.num(int(i == j)) if middle is None else middle[j][i]
            factors += [x, link]
            if link.is_zero:
                break
        else:
            terms.append(g.product(factors))
    return g.sum(terms)
