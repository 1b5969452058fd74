"""The functions of a state beside the equations, by what they mean: ``project`` and ``defect``,
``to_matrix`` and ``from_matrix``, ``conserved``.

If ``project``, a Newton step back to the group, keeps every state of the group, and its derivative
there takes any change of a state to one that is tangent to the group, then of an error ε it leaves
O(ε²).  ``defect`` is a sum of sizes: each vanishes on the group, and together they see every change
that is not tangent to it.

``from_matrix`` asks for signs of products of the numbers of the quaternion, and is one rational
function, but for the root of a square, where none of them changes.  So it is tried with each choice
of the signs of the vector, the scalar being positive.

Along the exact rates the numbers of ``conserved`` do not change, elsewhere each does.  The rates
are those of ``rhs``, which has been found equal to the record, without inputs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import isqrt
from typing import Any

from ..algebra.families import group
from ..algebra.groups import Group
from ..check.nilpotent import EPS, part
from ..check.residue import Residue
from ..language import rational as q
from ..language.rational import Matrix
from .chart import EPSILON, StateChart
from .exact_points import Point
from .straight_line import Measured
from .terms import Array, CodeError, DiffersError, Machine

PRIME = 2**61 - 1
"""The prime modulo which ranks are counted: they are no larger than the true ones."""

Run = Callable[[str, Sequence[Any]], Sequence[Any]]
"""(name, state) → the numbers of ``project``, or the summands of ``defect``, at a state."""


def compare_drift(run: Run, draw: Callable[[], Fraction], state: StateChart, point: Point) -> str:
    """The functions that were found right at a point, as text for a report; ``DiffersError`` where
    one is wrong.

    Of a group that is given by its basis neither random elements nor all relations are known: there
    both are tried at its unit, and no more is asked than that they leave it alone.
    """
    named = is_named(state.group)
    g = point.g if named else q.identity(state.group.size)
    x = list(state.values(g, point.Z))
    if list(run("project", x)) != x:
        raise DiffersError("project: a state of the group is changed")
    if any(run("defect", x)):
        raise DiffersError("defect: it does not vanish on the group")
    if not named:
        return "project, defect (at the unit of the group)"
    moved = run("project", [a + EPSILON * draw() for a in x])
    if not state.tangent(g, point.Z, [part(y, EPS) for y in moved]):
        raise DiffersError("project: a change that leaves the group is not taken back")
    slopes = []
    for i in range(len(x)):
        beside = [a + EPSILON * Fraction(i == j) for j, a in enumerate(x)]
        slopes.append([part(y, EPS) for y in run("defect", beside)])
    if rank(slopes) != len(x) - 2 * state.group.dimension + len(state.held):
        raise DiffersError("defect: it does not see all that leaves the group")
    return "project, defect"


def is_named(g: Group) -> bool:
    """Is the group one of the named ones, all of whose relations are known?"""
    try:
        return group(g.name).basis == g.basis
    except ValueError:
        return False


def rank(rows: Sequence[Sequence[Fraction]]) -> int:
    """The rank of a matrix modulo the prime."""
    one = Residue(1, PRIME)
    return q.rank(tuple(tuple(one * x for x in row) for row in rows))


RunSized = Callable[[str, Sequence[Any], int], Sequence[Any]]
"""(name, state, how many numbers it gives) → these numbers."""
RequireEqual = Callable[[str, Sequence[str], Sequence[Any], Sequence[Any]], None]


def compare_attitude(
    run: RunSized, require_equal: RequireEqual, state: StateChart, point: Point
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


Numbers = Sequence[Any]


def compare_conserved(
    machine: Machine,
    point: Point,
    x: Numbers,
    k: Numbers,
    draw: Callable[[], Fraction],
    count: int,
) -> str:
    """The name of the function that was found right at a state x; ``DiffersError`` where one of its
    ``count`` numbers is not kept, or is none."""
    at = {**point.arguments, "x": x}

    def run(name: str, changed: Mapping[str, Any], **size: int) -> list[Any]:
        arrays: dict[str, Any] = {"x": x, "k": k, "u": [Fraction(0)] * len(at["u"]), **changed}
        t = arrays.pop("t", at["t"])
        arguments = {x: Array(values, x) for x, values in arrays.items()}
        return [
            y for found in machine.call(name, {"t": t, **arguments}, **size).values() for y in found
        ]

    rates = run("rhs", {}, dx=len(x))
    later = {"x": [y + EPSILON * v for y, v in zip(x, rates, strict=True)]}
    kept = run("conserved", later | {"t": at["t"] + EPSILON}, out=count)
    beside = run("conserved", {"x": [y + EPSILON * draw() for y in x]}, out=count)
    for i, (along, off) in enumerate(zip(kept, beside, strict=True)):
        if part(along, EPS):
            raise DiffersError(f"conserved: number {i} of it is not kept")
        if not part(off, EPS):
            raise DiffersError(f"conserved: number {i} of it says nothing of the state")
    return "conserved"
