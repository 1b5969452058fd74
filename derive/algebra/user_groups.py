"""A group that the user gives by a basis, and that of an algebra which moves no points."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Literal

from ..language import rational as q
from ..language.rational import Matrix
from . import samplers as draw
from .families import LARGEST, affine_basis, so_basis
from .groups import Group
from .samplers import RandomSource, Sampler
from .structure import direct_sum, rank

# A group that the user gives by a basis of its Lie algebra: checked before it is used.


def group_of_basis(
    name: str, action: Literal["linear", "affine"], basis: Sequence[Matrix]
) -> Group:
    """The connected group with that Lie algebra; ``ValueError`` when it is none.

    ``basis``: matrices over Q of one size n (linear), or n + 1 with last row zero (affine).
    """
    _shapes(action, basis)
    rows: list[tuple[Fraction, ...]] = []
    for a, e in enumerate(basis, 1):
        rows.append(q.flatten(e))
        if q.rank(tuple(rows)) < a:
            why = "depends on those before it" if any(rows[-1]) else "is zero"
            raise ValueError(f"element {a} of the basis {why}; leave it out")
    n = len(basis[0]) - (action == "affine")
    bare = Group(name, n, action, tuple(basis), draw.general_linear(n))
    _closed(bare)
    if n == 3 and bare.dimension == 3 + 3 * bare.affine and "orthogonal" in bare.relations:
        return _turning(bare)
    exact = nilpotent(bare.basis) and "orthogonal" not in bare.relations
    sampler = draw.exponentials(bare.basis) if exact else enclosing(bare)
    return Group(name, n, action, bare.basis, sampler, larger=not exact)


def _turning(g: Group) -> Group:
    """The group, which is SO(3) or SE(3), in the basis that j gives; its ``user_basis`` is the
    one that it had, if another."""
    basis = affine_basis(so_basis(3), 3) if g.affine else so_basis(3)
    own = () if g.basis == basis else g.basis
    return Group(g.name, 3, g.action, basis, enclosing(g), larger=True, user_basis=own)


def nilpotent(basis: Sequence[Matrix]) -> bool:
    """Do all products of n matrices of the basis vanish, n being their size?"""
    products = [*basis]
    for _ in basis[0][1:]:
        rows: tuple[tuple[Fraction, ...], ...] = ()
        found: list[Matrix] = []
        for x in (q.times(e, f) for e in products for f in basis):
            if any(map(any, x)) and q.rank((*rows, q.flatten(x))) > len(rows):
                rows, found = (*rows, q.flatten(x)), [*found, x]
        products = found
    return not products


def enclosing(g: Group) -> Sampler:
    """A sampler of the largest named group with the same relations.

    A point g₀ of it stands for the coset g₀G, which left translation makes a copy of G with the
    same Lagrangian up to the potential: what holds on every such coset holds on G.
    """
    if "orthogonal" in g.relations and g.n > 1:
        linear = draw.by_cayley(so_basis(g.n))
    elif "unimodular" in g.relations:
        linear = draw.special_linear(g.n)
    else:
        linear = draw.general_linear(g.n)
    return draw.affine(linear, g.n) if g.affine else linear


def _shapes(action: str, basis: Sequence[Matrix]) -> None:
    if not basis or not basis[0]:
        raise ValueError("the basis is empty; give at least one matrix")
    size = len(basis[0])
    for a, e in enumerate(basis, 1):
        if len(e) != size or any(len(row) != size for row in e):
            raise ValueError(f"element {a} of the basis is not a {size} × {size} matrix")
        if action == "affine" and any(e[-1]):
            raise ValueError(f"element {a} of the basis: the last row of an affine one must be 0")
    n = size - (action == "affine")
    if not 2 <= n <= LARGEST:
        line = (
            '; affine maps of a line are linear ones of (r, 1): action = "linear" with the same '
            "basis, points at [r, 1]"
        )
        raise ValueError(
            f"the matrices move points of R^{n}; from R^2 to R^{LARGEST} are known"
            + line * (action == "affine" and n == 1)
        )


def _closed(g: Group) -> None:
    for a, x in enumerate(g.basis, 1):
        for b, y in enumerate(g.basis[: a - 1], 1):
            bracket = q.bracket(y, x)
            if g.vee(bracket) is None:
                outside = q.minus(bracket, g.hat(g.nearest(bracket)))
                raise ValueError(
                    f"not a Lie algebra: the bracket of elements {b} and {a} of the basis falls "
                    f"outside it by {shown(outside)}; add that to the basis, or mend the two"
                )


def shown(m: Matrix) -> str:
    """The text of a matrix in one line, for a message."""
    return "[" + ", ".join("[" + ", ".join(map(str, row)) + "]" for row in m) + "]"


# The group of an algebra that moves no points: matrices that stand for it, with those of all that
# it carries along.
#
# They are block diagonal; the last blocks are ρ(E_a) of the advected quantities, in order.


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

    def sampler(random: RandomSource, size: int) -> Matrix:
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
