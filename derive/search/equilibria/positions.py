"""Where bodies point at an equilibrium, and whether their potential energy is the least there."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import comb
from typing import Any

from ...algebra.groups import Group
from ...language.rational import Matrix
from ...language.values import approximate
from ...record.sentence import Prose
from ...walk.chapter import Draft
from .equilibrium_points import About, Expansion


def position(about: About, draft: Draft, *, near: bool = False) -> Prose:
    """Is the potential energy the least or the greatest at a point, or where that is ``near``, and
    which axes of the bodies that turn point along axes of space there?"""
    blocks = _turning(about.system.group)
    rows: dict[tuple[range, int], dict[int, int]] = {}
    for k, x in enumerate(about.system.variables):
        for own in blocks:
            if isinstance(x, tuple) and x[1] == "A" and x[2] in own and x[3] in own:
                rows.setdefault((own, x[2]), {})[x[3]] = k
    axes: Prose = ()
    for (own, row), entries in () if near else rows.items():
        for column, k in entries.items():
            axes += _axis(blocks, own, (row, column), about.at[k], draft)
    count = about.system.momenta + sum(len(own) for own, _ in rows)
    if count != len(about.at) or len({own for own, _ in rows}) != len(rows) or not rows:
        return axes
    h = about.expansion(about.algebra.hamiltonian)
    signs = {_along(about, h, [*x.values()], near) for x in rows.values()}
    bent = h.higher or any(any(x) for x in h.second[about.system.momenta :])
    if bent or signs not in ({1}, {-1}):
        return axes
    end = "_near" if near else ""
    return draft.claim(f"position.{'lowest' if -1 in signs else 'highest'}{end}") + axes


def _axis(
    blocks: Sequence[range], own: range, place: tuple[int, int], entry: Any, draft: Draft
) -> Prose:
    """That an axis points along one of space, or opposite to it, where an entry of A is 1 or −1;
    ``own``: the rows of its body, of the ``blocks``; ``place``: its row and column, from 1."""
    if entry not in (1, -1):
        return ()
    several = {"body": blocks.index(own) + 1} if len(blocks) > 1 else {}
    places = {"axis": place[1] - own.start + 1, "space": place[0] - own.start + 1}
    kind = ("along" if entry == 1 else "against") + ("_of" if several else "")
    return draft.claim(f"position.{kind}", **places, **several)


def axes_that_stay(g: Matrix, Z: Matrix, group: Group, draft: Draft) -> Prose:
    """Of bodies that are turned, by a matrix g of a group, which of their axes point along axes of
    space, and go on to at the velocity Z."""
    blocks, found = _turning(group), Prose()
    for own in blocks:
        places = [(i, j) for i in own for j in own]
        turned = any(g[i - 1][j - 1] != int(i == j) for i, j in places)
        for i, j in places if turned else ():
            if not any(Z[k - 1][j - 1] for k in own):
                found += _axis(blocks, own, (i, j), g[i - 1][j - 1], draft)
    return found


APART = Fraction(1, 10**8)
"""The square of an angle, in rad², within which a direction in decimals is near another."""


def _along(about: About, h: Expansion, entries: Sequence[int], near: bool) -> int:
    """1 or −1 where the slope of the energy along these variables is along the vector of their
    values or opposite to it, 0 elsewhere."""
    slope, at = ([x[k] for k in entries] for x in (h.slope, about.at))
    along, *squares = (
        sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))
        for a, b in ((slope, at), (slope, slope), (at, at))
    )
    off = squares[0] * squares[1] - along * along
    number = approximate(about.tree(along), {}, float)
    if not number or (off > APART * along * along if near else off):
        return 0
    return 1 if number > 0 else -1


def _turning(group: Group) -> list[range]:
    """The rows of A, from 1, of each body that a group, or a product, turns by all rotations;
    nothing where a factor does not."""
    whole = all(
        len(x.linear_basis) == comb(x.n, 2) > 0 and "orthogonal" in x.relations
        for _, x in group.places
    )
    return [range(first + 1, first + x.n + 1) for first, x in group.places if whole]
