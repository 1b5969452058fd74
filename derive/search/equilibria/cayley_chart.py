"""Elements near one by Cayley's transform C(η) = (1 − ½η)⁻¹(1 + ½η), which is rational in η."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from .steady_velocity import NoTrimError


def turned(group: Group, g: Matrix, eta: Sequence[Any], *, right: bool) -> Matrix:
    """g C(η), ``right``: C(η) g, for the d coordinates η; an element where Cayley's transforms are,
    as of orthogonal groups and of those with translations."""
    C = _cayley(group, eta)
    return q.times(C, g) if right else q.times(g, C)


def conjugated(group: Group, z: Matrix, eta: Sequence[Any], *, right: bool) -> Matrix:
    """C⁻¹zC, ``right``: CzC⁻¹: what is z seen from g is this from g turned."""
    first, last = (_cayley(group, x) for x in (eta, [-x for x in eta]))
    return q.times(q.times(first, z), last) if right else q.times(q.times(last, z), first)


def chart_slopes(group: Group, eta: Sequence[Any], *, right: bool) -> Matrix:
    """Row a: the coordinates of C⁻¹∂C/∂η_a, ``right``: of ∂C/∂η_a C⁻¹."""
    less, more = _halves(group, eta)
    back, one = _inverted(less), q.identity(group.size)
    C = q.times(back, more)
    undone, rows = _inverted(C), []
    for element in group.basis:
        dC = q.times(back, q.times(q.scaled(Fraction(1, 2), element), q.plus(C, one)))
        rows.append(group.nearest(q.times(dC, undone) if right else q.times(undone, dC)))
    return tuple(rows)


def _cayley(group: Group, eta: Sequence[Any]) -> Matrix:
    less, more = _halves(group, eta)
    return q.times(_inverted(less), more)


def _inverted(a: Matrix) -> Matrix:
    """The inverse; ``NoTrimError`` where Cayley's transform has none, as those of SL(n) may."""
    if (found := q.inverse(a)) is None:
        raise NoTrimError(
            "no trim is found: where Newton's method leads no element is Cayley's transform of a "
            "turn; give numbers near it by --at for g, or free others"
        )
    return found


def _halves(group: Group, eta: Sequence[Any]) -> tuple[Matrix, Matrix]:
    """1 − ½η and 1 + ½η."""
    one, half = q.identity(group.size), q.scaled(Fraction(1, 2), group.hat(eta))
    return q.plus(one, q.scaled(Fraction(-1), half)), q.plus(one, half)
