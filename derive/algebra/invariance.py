"""Where ⟨Y, Y′⟩ = Tr Y J Ȳ′ C is the same at every element of a group, although C = ĀA is not 1.

Along ξ in 𝔤 a form S becomes ξ̄S + Sξ.  What C − 1 reaches on the connected group spans the least
space that holds the changes of 1 and those of its own members; the metric of a body is
left-invariant if and only if it vanishes for each member of that space in the place of C.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..language import rational as q
from ..language.rational import Matrix
from .groups import Group


def changes(g: Group) -> Iterator[Matrix]:
    """A basis of the span of C − 1, for a connected group of linear maps."""
    rows: list[tuple[object, ...]] = []
    forms = [q.identity(g.n)]
    for S in forms:
        for e in g.basis:
            moved = q.times(S, e)
            change = q.plus(moved, q.transposed(moved))
            if any(map(any, change)) and q.rank((*rows, q.flatten(change))) > len(rows):
                rows.append(q.flatten(change))
                forms.append(change)
                yield change


def pairings(g: Group) -> Iterator[Matrix]:
    """The matrices Ē_b S E_a, each once: a metric is left-invariant where J pairs with each of them
    to 0."""
    for S in changes(g):
        for a, x in enumerate(g.basis):
            for y in g.basis[: a + 1]:
                yield q.times(q.transposed(y), q.times(S, x))


def for_every_body(g: Group) -> bool:
    """Is Ȳ C Y′ = ȲY′ for all Y, Y′ of 𝔤, so that the metric of every body is left-invariant?

    So it is where all factors have skew linear parts, on their matrices on (r, 1): their last rows
    are those of 0, and C is 1 but for the last rows and columns of its blocks.
    """
    if g.affine:
        return False
    if all(skew(factor) for factor in g.factors or (g,)):
        return True
    return not g.larger and not any(any(map(any, k)) for k in pairings(g))


def skew(g: Group) -> bool:
    """Are the linear parts of 𝔤 skew?"""
    return "orthogonal" in g.relations
