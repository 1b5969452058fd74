"""What is particular in the products and brackets of a Lie algebra, read off its basis."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.rational import Matrix
from ..record.record import Equation, Step, stated
from ..record.sentence import Prose
from .chapter import Chapter
from .wording import say

Row = tuple[Any, ...]


def bracket_step(group: Group, c: Chapter) -> tuple[Step, ...]:
    """The step that says whether 𝔤 is commutative, its brackets central, its matrices nilpotent;
    none where nothing of this holds."""
    basis, equations = group.basis, list[Equation]()
    prose: Prose = ()
    if not any(map(_nonzero, group.linear_basis)):
        return ()
    if not any(_nonzero(q.bracket(*pair)) for pair in combinations(basis, 2)):
        equations += stated("[ξ′, ξ] = 0")
        if group.affine:
            equations += stated("ξ′η − ξη′ = 0")
        prose += say("brackets.commutative")
    elif not group.affine and not any(
        _nonzero(q.bracket(q.bracket(*pair), z)) for pair in combinations(basis, 2) for z in basis
    ):
        equations += stated("[[ξ′, ξ], Z] = 0")
        prose += say("brackets.central")
    if not group.affine and (k := vanishing_power(basis)):
        equations.append(Equation(("pow", "Z", k), 0))
        prose += say("brackets.nilpotent")
    return (c.draft("brackets", "relation").step(equations, prose),) if equations else ()


def vanishing_power(basis: Sequence[Matrix]) -> int:
    """The least k for which all products of k matrices of 𝔤 vanish; 0 where there is none."""
    if any(q.trace(q.times(e, e)) != 0 for e in basis):
        return 0
    k, image = 0, list[Row](q.identity(len(basis[0])))
    while image:
        moved = (q.times(e, tuple((x,) for x in v)) for v in image for e in basis)
        found = _independent(q.flatten(x) for x in moved)
        if len(found) == len(image):
            return 0
        k, image = k + 1, found
    return k


def _independent(rows: Iterable[Row]) -> list[Row]:
    found: list[Row] = []
    for x in rows:
        if q.rank((*found, x)) > len(found):
            found.append(x)
    return found


def _nonzero(x: Matrix) -> bool:
    return any(y != 0 for row in x for y in row)
