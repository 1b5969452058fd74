"""The tests of ``to_matrix`` and ``from_matrix``, which change the quaternion of a state for A and
back.

``from_matrix`` asks for signs of products of the numbers of the quaternion, and is one rational
function, but for the root of a square, where none of them changes. So it is tried with each choice
of the signs of the vector, the scalar being positive.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import isqrt
from typing import Any

from ..language import rational as q
from ..language.rational import Matrix
from .chart import StateChart
from .degree_bounds import Measured
from .exact_points import Point
from .terms import CodeError

Run = Callable[[str, Sequence[Any], int], Sequence[Any]]
"""(name, state, how many numbers it gives) → these numbers."""
RequireEqual = Callable[[str, Sequence[str], Sequence[Any], Sequence[Any]], None]


def compare_attitude(
    run: Run, require_equal: RequireEqual, state: StateChart, point: Point
) -> tuple[str, str]:
    """The names of the two functions, each found right at the turns of a point."""
    plain = replace(state, chart=replace(state.chart, attitude="matrix"))
    for g in turned(point.g):
        there, here = plain.values(g, point.Z), state.values(g, point.Z)
        found = run("to_matrix", here, len(there))
        require_equal("to_matrix", plain.names, found, there)
        require_equal("from_matrix", state.names, run("from_matrix", there, len(here)), here)
    return "to_matrix", "from_matrix"


def turned(g: Matrix) -> Iterator[Matrix]:
    """The displacements whose quaternion has that of g but for the signs of its vector: D A D for
    the diagonal matrices D of signs, and their transposes."""
    n = 3
    for signs in product((1, -1), repeat=2):
        D = (1, *signs)
        A = tuple(tuple(D[i] * g[i][j] * D[j] for j in range(n)) for i in range(n))
        for linear in (A, q.transposed(A)):
            rows = (tuple(linear[i]) + tuple(g[i][n:]) for i in range(n))
            yield (*rows, *g[n:])


def exact_root(name: str, x: Any) -> Any:
    """√x of the square of a fraction; ``CodeError`` for other functions and other numbers."""
    x = Measured.of(x)
    value = Fraction(x.value)
    if name != "sqrt" or value < 0:
        raise CodeError(f"{name} of {float(value):.3g} has no place here")
    root = Fraction(isqrt(value.numerator), isqrt(value.denominator))
    if root * root != value:
        raise CodeError("the root of a number that is no square")
    return Measured(root, x.num, x.den)
