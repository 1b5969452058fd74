"""Entries that an element of a group has: given exactly, on a level, or the same for all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any, Literal

from ...algebra.families import LARGEST_PRODUCT
from ...algebra.groups import Group, affine_entries
from ...algebra.relations import relations
from ...language import rational as q
from ...language.tree import Tree
from ...language.univariate import Number
from .spectra_and_residues import characteristic, negative_or_zero

# Has an element of a group some given, exact entries?
#
# In every factor H the linear equations of its affine hull are solved for one matrix g with these
# entries. Rows and columns of which these tell all are compared with the relations of H: products
# of a form, the determinant, signs. What remains is a theorem (Witt: lines with the right
# products are those of an element), or g is exp of a matrix in 𝔥, as none of its eigenvalues is
# negative or 0.

Place = tuple[int, int]
Decision = Literal["yes", "no", "open"]


def decided(group: Group, at: Mapping[Place, Number]) -> Decision:
    """Has an element of a group these entries, by their places from 0?  "open": neither that nor
    the opposite is proved."""
    found: set[Decision] = set()
    for offset, factor in group.places:
        inside = {(i - offset, j - offset): x for (i, j), x in at.items()}
        inside = {x: y for x, y in inside.items() if all(0 <= i < factor.size for i in x)}
        found.add(_Candidate(factor, inside).decision if inside else "yes")
    return "no" if "no" in found else "open" if "open" in found else "yes"


class _Candidate:
    """A matrix of the affine hull of a factor with some entries, and which of its entries they
    tell."""

    def __init__(self, factor: Group, inside: Mapping[Place, Number]):
        self.factor, self.inside, self.relations = factor, inside, relations(factor)
        entries = affine_entries(factor)
        free = sorted({x for row in entries for _, weights in row for x in weights})
        self.weights = [[[w.get(x, Fraction(0)) for x in free] for _, w in row] for row in entries]
        rows = [(*self.weights[i][j], x - Fraction(int(i == j))) for (i, j), x in inside.items()]
        echelon, self.pivots = q.echelon(tuple(rows))
        self.rows = echelon[: len(self.pivots)]
        self.consistent = len(free) not in self.pivots
        solved = dict(zip(self.pivots, self.rows, strict=True))
        change = [solved[k][-1] if k in solved else Fraction(0) for k, _ in enumerate(free)]
        self.g = tuple(
            tuple(
                sum((x * y for x, y in zip(w, change, strict=True)), Fraction(int(i == j)))
                for j, w in enumerate(row)
            )
            for i, row in enumerate(self.weights)
        )

    @cached_property
    def known(self) -> list[list[bool]]:
        """Which entries are told: those whose weights are combinations of the rows."""
        return [[self._spanned(w) for w in row] for row in self.weights]

    def _spanned(self, weights: Sequence[Number]) -> bool:
        left = [*weights]
        for p, row in zip(self.pivots, self.rows, strict=True):
            left = [x - weights[p] * y for x, y in zip(left, row[:-1], strict=True)]
        return not any(left)

    @property
    def decision(self) -> Decision:
        """Has an element the entries?"""
        if not self.consistent or self._refuted():
            return "no"
        at_one = all(x == int(i == j) for (i, j), x in self.inside.items())
        return "yes" if at_one or self._by_theorem() or self._exponential() else "open"

    @cached_property
    def _has_all_entries(self) -> bool:
        """Are all entries of the linear part told?"""
        n = self.factor.n
        return all(x for row in self.known[:n] for x in row[:n])

    def _refuted(self) -> bool:
        """Do the lines contradict the relations of the factor?"""
        n, relations, S = self.factor.n, self.relations, self.relations.form
        a, known = (tuple(tuple(row[:n]) for row in x[:n]) for x in (self.g, self.known))
        inverse = q.inverse(S) if S else None
        for lines, given, form in ((a, known, inverse), (*map(q.transposed, (a, known)), S)):
            chosen = [i for i in range(n) if all(given[i])]
            if chosen and q.rank(tuple(lines[i] for i in chosen)) < len(chosen):
                return True
            if form and not self._has_products(tuple(lines[i] for i in chosen), chosen, form):
                return True
        if (
            self._has_all_entries
            and relations.determinant
            and not relations.complex_basis
            and q.determinant(a) != 1
        ):
            return True
        positive: list[Any] = [
            a[j][j] for j in range(n) if known[j][j] and _is_scaled(self.factor, j)
        ]
        if self._has_all_entries and (self.factor.larger or not relations.none):
            positive.append(q.determinant(a))
        return not all(x > 0 for x in positive)

    def _has_products(self, lines: q.Matrix, places: Sequence[int], form: q.Matrix) -> bool:
        """Are the products of lines those of the same lines of 1, up to a factor where dilations
        are in the group?"""
        found = q.times(q.times(lines, form), q.transposed(lines)) if lines else ()
        pairs = [
            (found[a][b], form[i][j]) for (a, i), (b, j) in product(enumerate(places), repeat=2)
        ]
        factor = next((x / y for x, y in pairs if y), 1) if self.relations.conformal else 1
        return all(x == factor * y for x, y in pairs)

    def _by_theorem(self) -> bool:
        """Are all lines that have the relations those of elements?"""
        g, relations, S = self.factor, self.relations, self.relations.form
        moved = [[e[i][j] for i, j in self.inside] for e in g.basis]
        if _nilpotent(g):  # its orbits are closed: one that is open in the hull is all of it
            return q.rank(q.matrix(moved)) == len(self.pivots)
        if relations.dimension > g.dimension or (self._has_all_entries and relations.complex_basis):
            return False
        if not g.larger or not S:
            return not (g.larger and relations.hull)
        definite = any(q.definite(q.scaled(sign, S)) for sign in (1, -1))
        skew = q.transposed(S) == q.scaled(-1, S) and not relations.conformal
        return not relations.hull and (definite or skew)

    def _exponential(self) -> bool:
        """Is g exp of a matrix of the Lie algebra, the logarithm in the hull?"""
        relations, S, n = self.relations, self.relations.form, self.factor.n
        if relations.dimension > self.factor.dimension or relations.complex_basis:
            return False
        a = tuple(row[:n] for row in self.g[:n])
        if S and not self._has_products(q.transposed(a), range(n), S):
            return False
        if relations.determinant and q.determinant(a) != 1:
            return False
        return not negative_or_zero(characteristic(a))


def _is_scaled(g: Group, j: int) -> bool:
    """Is e_j, as a row or a column, an eigenvector of a whole group?"""
    pairs = [(e[i][j], e[j][i]) for e in g.basis for i in range(g.size) if i != j]
    return not pairs or not all(map(any, zip(*pairs, strict=True)))


def _nilpotent(g: Group) -> bool:
    """Is the algebra one of strictly triangular matrices, in some basis: do all products of as many
    of its matrices as these have rows vanish?"""
    lines = list(q.identity(g.size))
    for _ in range(g.size):
        moved = [x for e in g.basis for x in q.times(tuple(lines), e) if any(x)]
        if not moved:
            return True
        echelon, pivots = q.echelon(tuple(moved))
        lines = list(echelon[: len(pivots)])
    return False


# Are the entries of g near a point of a level those of an element of the group?
#
# The polynomials of entries alone that the level fixes have there the values that they have at 1,
# and they are as many as the orbit of 1 has codimension; the orbit of the point has the same
# dimension, and what is positive on the group, determinants and factors of common eigenvectors,
# is positive.

Terms = Mapping[tuple[tuple[Tree, int], ...], Fraction]


def entries_moved(e: q.Matrix, place: Place, *, left: bool) -> dict[Place, Fraction]:
    """The entries of g in one of gE, ``left``, or of Eg."""
    (i, j), span = place, range(len(e))
    if left:
        return {(i, k): e[k][j] for k in span if e[k][j]}
    return {(k, j): e[i][k] for k in span if e[i][k]}


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
        moved = {x for place, e in pairs for x in entries_moved(e, place, left=self.left)}
        away = sorted(moved - {*self.places} - {*constant_entries(self.group)})
        return [("entry", "A", i + 1, j + 1) for i, j in away]

    def rates(self, at: Mapping[Place, Fraction]) -> q.Matrix:
        """What gE_b is at the places, by b, for these entries of g."""

        def rate(place: Place, e: q.Matrix) -> Fraction:
            terms = entries_moved(e, place, left=self.left).items()
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
        off = [
            [
                radius * sum(abs(c) for c in entries_moved(e, x, left=self.left).values())
                for x in self.places
            ]
            for e in self.group.basis
        ]
        if sure_rank(self.rates(at), off) < rank:
            return False
        return all(
            q.determinant(a) > 0 and invertible(a, [[radius] * len(a) for _ in a])
            for a in self._positive(at)
        )

    def _positive(self, at: Mapping[Place, Fraction]) -> list[q.Matrix]:
        """Matrices of entries with a positive determinant on the group: linear parts that are all
        here, and the factors of unit vectors that are eigenvectors of the whole group."""
        found: list[q.Matrix] = []
        for offset, factor in self.group.places:
            span = range(offset, offset + factor.n)
            constrained = factor.larger or factor.dimension < factor.n * factor.size
            if constrained and all((i, j) in at for i in span for j in span):
                found.append(tuple(tuple(at[i, j] for j in span) for i in span))
        scaled = {j for i, j in self.places if i == j and _is_scaled(self.group, j)}
        return [*found, *(((at[j, j],),) for j in scaled)]


def _of_entries_alone(levels: Sequence[Terms]) -> list[Terms]:
    """A basis of the combinations without momenta."""
    if not levels:
        return []
    momenta = (m for f in levels for m in f if any(_momentum(x) for x, _ in m))
    monomials = sorted({*momenta}, key=str)
    rows = [[f.get(m, Fraction(0)) for f in levels] for m in monomials]
    found: list[Terms] = []
    for weights in q.nullspace(q.matrix([*rows, [Fraction(0)] * len(levels)])):
        pairs = zip(weights, levels, strict=True)
        found.append(q.summed((m, w * c) for w, f in pairs for m, c in f.items()))
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


def sure_rank(a: q.Matrix, change: Sequence[Sequence[Fraction]]) -> int:
    """The rank of a matrix, where it is no less whatever such changes of its entries; else 0."""
    rows, columns = (q.echelon(x)[1] for x in (q.transposed(a), a))
    chosen, moved = ([[x[i][j] for j in columns] for i in rows] for x in (a, change))
    return len(rows) if rows and invertible(q.matrix(chosen), moved) else 0


# The entries that are the same for all elements of a group, as 1 and 0 in the last row of affine
# maps: g is 1 and a sum of products of elements of 𝔤, all of which are 0 there.


def constant_entries(group: Group) -> dict[tuple[int, int], Fraction]:
    """Row and column, from 0 → the number that all elements have in common there."""
    span = range(group.size)
    rows = [_rows(group, i) for i in span]
    return {(i, j): Fraction(i == j) for i in span for j in span if not any(v[j] for v in rows[i])}


def _rows(group: Group, i: int) -> list[tuple[Fraction, ...]]:
    """A basis of the rows i of the products."""
    found: list[tuple[Fraction, ...]] = []
    waiting = [q.identity(group.size)[i]]
    while waiting:
        row = (waiting.pop(),)
        for (x,) in (q.times(row, e) for e in group.basis):
            if q.rank((*found, x)) > len(found):
                found.append(x)
                waiting.append(x)
    return found
