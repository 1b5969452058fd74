"""The group of an algebra that moves no points: matrices that stand for it, with those of all that
it carries along.

They are block diagonal; the last blocks are ρ(E_a) of the advected quantities, in order.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..language import rational as q
from ..language.rational import Matrix
from .groups import Group
from .samplers import Source
from .structure import direct_sum, rank


def carrying(
    name: str, dimension: int, own: Sequence[Matrix], representations: Sequence[Sequence[Matrix]]
) -> Group:
    """The group of these representations of an algebra of this dimension; ``own``: matrices that
    stand for the algebra, which are left out where the others do."""
    parts = [*representations]
    if not parts or rank(direct_sum(*parts)) < dimension:
        parts = [own, *parts]
    return of_matrices(name, direct_sum(*parts))


def of_matrices(name: str, basis: tuple[Matrix, ...]) -> Group:
    """The group with this basis, known at its unit alone: another element is one of the same."""
    unit = q.identity(len(basis[0]))

    def sampler(random: Source, size: int) -> Matrix:
        del random, size
        return unit

    return Group(name, len(unit), "linear", basis, sampler)


def last_blocks(group: Group, sizes: Sequence[int]) -> list[range]:
    """The rows of the last blocks, which have these sizes."""
    start, found = group.n - sum(sizes), []
    for size in sizes:
        found.append(range(start, start + size))
        start += size
    return found


def blocks_apart(group: Group, sizes: Sequence[int]) -> bool:
    """Are there such blocks in every matrix of the basis?"""
    blocks = last_blocks(group, sizes)
    rows = range(group.n - sum(sizes)), *blocks
    return all(
        not e[i][j]
        for e in group.basis
        for one in rows
        for other in rows
        if one != other
        for i in one
        for j in other
    )


def block(m: Matrix, rows: range) -> Matrix:
    """The block of a matrix on these rows."""
    return tuple(tuple(m[i][j] for j in rows) for i in rows)
