"""Are the entries of g near a point of a level those of an element of the group?

The polynomials of entries alone that the level fixes have there the values that they have at 1, and
they are as many as the orbit of 1 has codimension; the orbit of the point has the same dimension,
and what is positive on the group, determinants and factors of common eigenvectors, is positive.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from ..algebra.families import LARGEST_PRODUCT
from ..algebra.groups import Group
from ..language import rational as q
from ..language.tree import Tree
from .claims.constant_entries import constant_entries

Terms = Mapping[tuple[tuple[Tree, int], ...], Fraction]
Place = tuple[int, int]


class Entries:
    """Entries of g among the variables, those at ``places`` from 0, and their rates; ``left``: do
    they move by gE_b, not E_bg?"""

    def __init__(self, group: Group, names: Sequence[Tree], *, left: bool):
        self.group, self.left = group, left
        found = [(x[2] - 1, x[3] - 1) for x in names if isinstance(x, tuple) and x[1] == "A"]
        self.places: list[Place] = sorted(found)

    def missing(self) -> list[Tree]:
        """Variables into which these move and that are not among them."""
        pairs = [(place, e) for place in self.places for e in self.group.basis]
        moved = {x for place, e in pairs for x in self._terms(place, e)}
        away = sorted(moved - {*self.places} - {*constant_entries(self.group)})
        return [("entry", "A", i + 1, j + 1) for i, j in away]

    def _terms(self, place: Place, e: q.Matrix) -> dict[Place, Fraction]:
        """The entries of g in one of gE, or of Eg."""
        (i, j), span = place, range(len(e))
        if self.left:
            return {(i, k): e[k][j] for k in span if e[k][j]}
        return {(k, j): e[i][k] for k in span if e[i][k]}

    def rates(self, at: Mapping[Place, Fraction]) -> q.Matrix:
        """What gE_b is at the places, by b, for these entries of g."""

        def rate(place: Place, e: q.Matrix) -> Fraction:
            terms = self._terms(place, e).items()
            return sum((c * at.get(x, Fraction(x[0] == x[1])) for x, c in terms), Fraction(0))

        return tuple(tuple(rate(x, e) for x in self.places) for e in self.group.basis)

    def fault(
        self, levels: Sequence[Terms], centre: Mapping[Tree, Fraction], radius: Fraction
    ) -> str:
        """Why no element is known to have the entries within the radius of a point on the level;
        "" where one has them."""
        if not self.places:
            return ""
        alone = _of_entries_alone(levels)
        if any(map(_at_one, alone)):
            return "no element of the group is on the level: entries of g have another value at 1"
        one, at = {}, {}
        for i, j in self.places:
            one[i, j] = Fraction(i == j)
            at[i, j] = centre[("entry", "A", i + 1, j + 1)]
        rank = q.rank(self.rates(one))
        if len(alone) + rank < len(self.places):
            return "the level does not say that the entries of g are those of an element"
        if not self._near(at, radius, rank):
            return "no element of the group is known to have entries of g like these"
        return ""

    def _near(self, at: Mapping[Place, Fraction], radius: Fraction, rank: int) -> bool:
        """Is the orbit as large as that of 1, and what is positive on the group positive?"""
        if not rank:
            return True
        rates, off = self.rates(at), self._most(radius)
        rows, columns = (q.echelon(x)[1] for x in (q.transposed(rates), rates))
        if len(rows) < rank:
            return False
        chosen = tuple(tuple(rates[i][j] for j in columns) for i in rows)
        if not invertible(chosen, [[off[i][j] for j in columns] for i in rows]):
            return False
        return all(
            q.determinant(a) > 0 and invertible(a, [[radius] * len(a) for _ in a])
            for a in self._positive(at)
        )

    def _most(self, radius: Fraction) -> list[list[Fraction]]:
        """How much the rates change within a radius, at most."""
        return [
            [radius * sum(abs(c) for c in self._terms(x, e).values()) for x in self.places]
            for e in self.group.basis
        ]

    def _positive(self, at: Mapping[Place, Fraction]) -> list[q.Matrix]:
        """Matrices of entries with a positive determinant on the group: linear parts that are all
        here, and the factors of unit vectors that are eigenvectors of the whole group."""
        found: list[q.Matrix] = []
        for offset, factor in self.group.places:
            span = range(offset, offset + factor.n)
            whole = factor.larger or factor.dimension < factor.n * factor.size
            if whole and all((i, j) in at for i in span for j in span):
                found.append(tuple(tuple(at[i, j] for j in span) for i in span))
        for j in {j for i, j in self.places if i == j}:
            others = [i for i in range(self.group.size) if i != j]
            fixed = (
                all(not e[i][j] for e in self.group.basis for i in others),
                all(not e[j][i] for e in self.group.basis for i in others),
            )
            if any(fixed):
                found.append(((at[j, j],),))
        return found


def _of_entries_alone(levels: Sequence[Terms]) -> list[Terms]:
    """A basis of the combinations without momenta."""
    if not levels:
        return []
    momenta = (m for f in levels for m in f if any(_momentum(x) for x, _ in m))
    monomials = sorted({*momenta}, key=str)
    rows = [[f.get(m, Fraction(0)) for f in levels] for m in monomials]
    found: list[Terms] = []
    for weights in q.nullspace(q.matrix([*rows, [Fraction(0)] * len(levels)])):
        total: dict[tuple[tuple[Tree, int], ...], Fraction] = {}
        for w, f in zip(weights, levels, strict=True):
            for m, c in f.items():
                total[m] = total.get(m, Fraction(0)) + w * c
        found.append({m: c for m, c in total.items() if c})
    return found


def _momentum(x: Tree) -> bool:
    return isinstance(x, tuple) and x[1] == "Π"


def _at_one(f: Terms) -> Fraction:
    """The value of a polynomial of entries at g = 1."""
    ones = [("entry", "A", k, k) for k in range(1, 1 + LARGEST_PRODUCT)]
    inside = (c for m, c in f.items() if all(x in ones for x, _ in m))
    return sum(inside, Fraction(0))


def invertible(a: q.Matrix, change: Sequence[Sequence[Fraction]]) -> bool:
    """Is a matrix invertible whatever changes of its entries, of at most these sizes?"""
    inverse = q.inverse(a)
    if inverse is None:
        return False
    moved = q.times(tuple(tuple(map(abs, row)) for row in inverse), q.matrix(change))
    return bool(max(map(sum, moved)) < 1)
