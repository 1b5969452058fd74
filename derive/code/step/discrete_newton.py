"""A step of Newton's method as straight-line code: elimination without a search for pivots.

The matrix is near the metric, which is positive; where it is not, the determinant tells.
"""

from __future__ import annotations

from collections.abc import Sequence

from .. import dense
from ..graph import Graph, Node
from ..schedule import Directional

SMALL = 3
"""Up to this size by the adjugate."""


def newton(g: Graph, left: Sequence[Node], unknowns: Sequence[Node], label: str) -> list[Node]:
    """By what the unknowns of equations ``left`` = 0 are too large, and the determinant of the
    derivative, after that; ``label``: the key of what is solved."""
    varied = [Directional(g, {x: g.num(1)}, str(x.data[1])) for x in unknowns]
    return change(g, [[v.of(y) for v in varied] for y in left], left, label)


def change(g: Graph, K: Sequence[Sequence[Node]], left: Sequence[Node], label: str) -> list[Node]:
    """K⁻¹ left, and det K."""
    n = len(left)
    named = [
        [g.value(y, f"K_{i}{j}", label) for j, y in enumerate(row, 1)] for i, row in enumerate(K, 1)
    ]
    r = [g.value(y, f"left_{i}", label) for i, y in enumerate(left, 1)]
    if n > SMALL:
        return _eliminated(g, named, r)
    whole = tuple(map(tuple, named))
    back = dense.entrywise(dense.adjugate(g, whole), "cofactor", g.value, False)
    det = g.value(g.sum(x * row[0] for x, row in zip(whole[0], back, strict=True)), "det")
    over = g.value(g.recip(det), "over")
    return [
        g.product((over, g.sum(x * y for x, y in zip(row, r, strict=True)))) for row in back
    ] + [det]


def _eliminated(g: Graph, K: Sequence[Sequence[Node]], left: Sequence[Node]) -> list[Node]:
    """The same by Gauss's elimination, row by row."""
    n = len(left)
    rows, right, over = [[*row] for row in K], [*left], list[Node]()
    for c in range(n):
        over.append(g.value(g.recip(rows[c][c]), f"over_{c + 1}"))
        for i in range(c + 1, n):
            if rows[i][c].is_zero:
                continue
            by = g.value(rows[i][c] * over[c], f"by_{i + 1}_{c + 1}")
            for j in range(c + 1, n):
                rows[i][j] = g.value(rows[i][j] - by * rows[c][j], f"K_{i + 1}_{j + 1}_{c + 1}")
            right[i] = g.value(right[i] - by * right[c], f"left_{i + 1}_{c + 1}")
    found = [*right]
    for i in reversed(range(n)):
        rest = g.sum(rows[i][j] * found[j] for j in range(i + 1, n))
        found[i] = g.value((right[i] - rest) * over[i], f"change_{i + 1}")
    return [*found, g.product(rows[i][i] for i in range(n))]
