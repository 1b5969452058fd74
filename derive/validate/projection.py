"""The tests of ``project``, a Newton step back to the group, and of ``defect``.

If ``project`` keeps every state of the group, and its derivative there takes any change of a state
to one that is tangent to the group, then of an error ε it leaves O(ε²). ``defect`` is a sum of
sizes: each vanishes on the group, and together they see every change that is not tangent to it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from ..algebra.families import group
from ..algebra.groups import Group
from ..check.values.arithmetic import EPS, part
from ..check.values.residue import Residue
from ..language import rational as q
from .chart import EPSILON, StateChart
from .declarations import DiffersError
from .exact_points import Point

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
