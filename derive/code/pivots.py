"""What elimination divides by, where a symmetric matrix may be indefinite.

The inverse is that of a product L D L̄ with rows in another order and pivots of one or two rows,
chosen while code is emitted: by the values of the entries at points of a prime field, where a
function that is 0 is told from one that is not.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement
from operator import mul
from random import Random

from ..language import rational as q
from ..language.rational import Matrix
from . import dense
from .graph import Graph, Node
from .rewrite import reachable

PRIME = 2**61 - 1
POINTS = 2

Block = tuple[int, ...]
"""The rows of one pivot."""

Sampled = list[dict[tuple[int, int], int]]
"""The entries of a matrix at each point."""


class Pivots:
    """The pivots of a symmetric matrix, in the order of elimination.

    ``blocks``: their rows; ``sure``: is the matrix singular wherever a pivot is?
    """

    def __init__(self, m: Matrix):
        self.blocks: list[Block] = []
        self.sure = True
        rest = list(range(len(m)))
        points = [_at_a_point(m, Random(seed)) for seed in range(POINTS)]
        while rest:
            block, harmless = self._next(points, rest)
            self.blocks.append(block)
            self.sure = self.sure and harmless
            rest = [i for i in rest if i not in block]
            points = [_eliminated(x, block, rest) for x in points]

    @property
    def as_given(self) -> bool:
        """Is it each row in its place?"""
        return self.blocks == [(i,) for i in range(len(self.blocks))]

    def _next(self, points: Sampled, rest: Sequence[int]) -> tuple[Block, bool]:
        """The rows of the next pivot, and whether the matrix is singular wherever that is 0: a
        number, or of rows that are coupled to no other."""
        singles = [(i,) for i in rest if all(x[i, i] for x in points)]
        pairs = [*_pairs(points, rest)]
        alone = [b for b in (*singles[:1], *pairs) if not _coupled(points, b, rest)]
        known = [b for b in (*singles, *pairs) if len({_determinant(x, b) for x in points}) == 1]
        turned = [b for b in alone if len(b) == 2 and not all(points[0][i, i] for i in b)]
        if found := [*(b for b in alone if len(b) == 1), *known, *turned]:
            return found[0], True
        if found := [*singles, *pairs]:
            return found[0], False
        raise ZeroDivisionError("a matrix that is singular whatever the parameters")


def _coupled(points: Sampled, block: Block, rest: Sequence[int]) -> bool:
    """Is there another row with an entry in the columns of a pivot?"""
    others = [j for j in rest if j not in block]
    return any(x[i, j] for x in points for i in block for j in others)


def _pairs(points: Sampled, rest: Sequence[int]) -> Iterator[Block]:
    """Two coupled rows each, with a determinant that is not 0."""
    coupled = (b for b in combinations(rest, 2) if any(x[b] for x in points))
    return (b for b in coupled if all(_determinant(x, b) for x in points))


def _at_a_point(m: Matrix, random: Random) -> dict[tuple[int, int], int]:
    """The entries of a matrix where leaves and functions have random values."""
    values: dict[Node, int] = {}
    for x in reachable(y for row in m for y in row):
        values[x] = _value(x, [values[y] for y in x.args], random)
    return {(i, j): values[x] for i, row in enumerate(m) for j, x in enumerate(row)}


def _value(x: Node, args: Sequence[int], random: Random) -> int:
    """The value of a node by those of its operands."""
    match x.op:
        case "num":
            return int(x.data.numerator * pow(x.data.denominator, -1, PRIME) % PRIME)
        case "add":
            coefficients = (c.numerator * pow(c.denominator, -1, PRIME) for c in x.data)
            return int(sum(map(mul, coefficients, args)) % PRIME)
        case "mul":
            found = 1
            for y in args:
                found = found * y % PRIME
            return found
        case "value":
            return args[0]
        case "recip" if args[0]:
            return pow(args[0], -1, PRIME)
        case "recip":
            raise ZeroDivisionError("1/0 in the equations of this problem")
    return random.randrange(1, PRIME)


def _determinant(x: dict[tuple[int, int], int], block: Block) -> int:
    """The determinant of a pivot at a point."""
    return int(dense.determinant([[x[i, j] for j in block] for i in block]) % PRIME)


def _eliminated(
    x: dict[tuple[int, int], int], block: Block, rest: Sequence[int]
) -> dict[tuple[int, int], int]:
    """The entries that are left when the rows of a pivot are eliminated, at a point."""
    scale = pow(_determinant(x, block), -1, PRIME)
    pairs = [(a, b, scale * c % PRIME) for a, b, c in _adjugate(x, block)]
    return {
        (i, j): (x[i, j] - sum(x[i, a] * c % PRIME * x[b, j] for a, b, c in pairs)) % PRIME
        for i in rest
        for j in rest
    }


def _adjugate(x: dict[tuple[int, int], int], block: Block) -> list[tuple[int, int, int]]:
    """The entries of the adjugate of one or two rows, each after its two rows."""
    if len(block) == 1:
        return [(*block, *block, 1)]
    i, j = block
    return [(i, i, x[j, j]), (j, j, x[i, i]), (i, j, -x[i, j]), (j, i, -x[i, j])]


def solve(
    g: Graph, m: Matrix, blocks: Sequence[Block], right: Matrix, named: dense.NodeNamer
) -> tuple[Matrix, list[Node]]:
    """The matrix x with m x = ``right``, and the determinants of the pivots of m."""
    left = {(i, j): x for i, row in enumerate(m) for j, x in enumerate(row)}
    known = [list(row) for row in right]
    determinants: list[Node] = []
    inverses: list[Matrix] = []
    lower: dict[tuple[int, int], Node] = {}
    rest = list(range(len(m)))
    for block in blocks:
        rest = [i for i in rest if i not in block]
        own = tuple(tuple(left[i, j] for j in block) for i in block)
        place = "_".join(str(i + 1) for i in block)
        determinants.append(dense.determinant(own))
        over = named(f"r_{place}", g.recip(named(f"d_{place}", determinants[-1])))
        inverses.append(q.scaled(over, dense.adjugate(g, own)))
        for i in rest:
            (row,) = q.times(((*(left[i, j] for j in block),),), inverses[-1])
            for j, x in zip(block, row, strict=True):
                lower[i, j] = named(f"l_{i + 1}_{j + 1}", x)
            for k, column in enumerate(zip(*(known[j] for j in block), strict=True)):
                taken = [lower[i, j] * x for j, x in zip(block, column, strict=True)]
                known[i][k] = named(f"y_{i + 1}_{k + 1}", known[i][k] - g.sum(taken))
        for i, j in combinations_with_replacement(rest, 2):
            left[i, j] = left[j, i] = left[i, j] - g.sum(lower[i, k] * left[k, j] for k in block)
    for block, inverse in zip(reversed(blocks), reversed(inverses), strict=True):
        found = q.times(inverse, tuple(tuple(known[i]) for i in block))
        for i, row in zip(block, found, strict=True):
            terms = [[lower[k, i] * x for x in known[k]] for k in rest if (k, i) in lower]
            known[i] = [x - g.sum(column) for x, *column in zip(row, *terms, strict=True)]
        rest += block
    return tuple(map(tuple, known)), determinants
