"""The factors of a product each by itself, where the mass matrix couples none of them: what is
changed in one alone, as the axes of a force on its body."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .balance import EXACT, Balance, exact
from .faults import Explanation, explained
from .pairs import of_two
from .users_code import Array


def rows_of(group: str, E: Array, n: int, offset: int = 0) -> dict[str, list[int]]:
    """Sets of rows of a group, or of a factor, whose basis is ``E``, its n rows from ``offset`` on:
    of a body in space or in the plane its moment and its force."""
    linear = E[:, offset : offset + n, offset : offset + n]
    moves = [i for i, e in enumerate(linear) if group in ("SE(2)", "SE(3)") and not e.any()]
    turns = [i for i in range(len(E)) if i not in moves]
    return {"moment": turns, "force": moves} if moves and turns else {"moment": turns}


def blocks(b: Balance) -> list[Balance]:
    """The factors of a product that differ, each by itself; none where the mass matrix couples
    them."""
    group, first, found = b.opened.problem.group, 0, list[Balance]()
    if not group or len(group.places) < 2 or b.a.shape[1] < group.dimension:
        return found
    M, size, E = b.mass(b.values()), b.size(), np.asarray(b.code.BASIS)
    coupled = np.abs(M).max(axis=0)
    for k, (offset, factor) in enumerate(group.places, 1):
        part = slice(first, first := first + factor.dimension)
        moving = slice(b.moving.start + part.start, b.moving.start + part.stop)
        rows = rows_of(factor.name, E[part], factor.n, offset)
        own = replace(b, a=b.a[:, part], rows=rows, moving=moving, part=part, block=k)
        if not exact(b.unexplained[:, part], size[part]):
            found.append(own)
        coupled[part, part] = 0
    return found if coupled.max() <= EXACT * np.abs(M).max() else []


def within_blocks(b: Balance) -> Explanation | None:
    """What explains the difference in each factor; none where one is not explained."""
    found: dict[int, Explanation] = {}
    for own in blocks(b):
        least = EXACT * own.size().max()
        terms = [x for x in own.terms() if np.abs(x.values).max() > least]
        alone = explained(own, terms, [])
        if not (alone.changes and alone.telling):
            alone = of_two(own, terms) or alone
        if not alone.changes:
            return None
        found[own.block] = alone
    if len(found) == 1:
        ((block, alone),) = found.items()
        return replace(alone, changes=tuple(f"in block {block}: {x}" for x in alone.changes))
    links = {True: ", and ", False: ", or: "}
    said = {block: links[x.together].join(x.changes) for block, x in found.items()}
    told = tuple(f"in block {block}: {words}" for block, words in said.items())
    telling = all(x.telling for x in found.values())
    return Explanation(told, together=True, telling=telling) if found else None
