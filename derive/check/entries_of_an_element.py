"""Has an element of a group some given, exact entries?

In every factor H the linear equations of its affine hull are solved for one matrix g with these
entries.  Rows and columns of which these tell all are compared with the relations of H: products of
a form, the determinant, signs.  What remains is a theorem (Witt: lines with the right products are
those of an element), or g is exp of a matrix in 𝔥, as none of its eigenvalues is negative or 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any, Literal

from ..algebra.groups import Group
from ..algebra.relations import relations
from ..algebra.told_entries import told_entries
from ..language import rational as q
from ..language.quadratic import Number
from .claims.exact_spectra import characteristic, negative_or_zero

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
        self.factor, self.inside, self.kept = factor, inside, relations(factor)
        told = told_entries(factor)
        free = sorted({x for row in told for _, weights in row for x in weights})
        self.weights = [[[w.get(x, Fraction(0)) for x in free] for _, w in row] for row in told]
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
    def _whole(self) -> bool:
        """Are all entries of the linear part told?"""
        n = self.factor.n
        return all(x for row in self.known[:n] for x in row[:n])

    def _refuted(self) -> bool:
        """Do the lines contradict the relations of the factor?"""
        n, kept, S = self.factor.n, self.kept, self.kept.form
        a, known = (tuple(tuple(row[:n]) for row in x[:n]) for x in (self.g, self.known))
        inverse = q.inverse(S) if S else None
        for lines, told, form in ((a, known, inverse), (*map(q.transposed, (a, known)), S)):
            chosen = [i for i in range(n) if all(told[i])]
            if chosen and q.rank(tuple(lines[i] for i in chosen)) < len(chosen):
                return True
            if form and not self._has_products(tuple(lines[i] for i in chosen), chosen, form):
                return True
        if self._whole and kept.determinant and not kept.complex_basis and q.determinant(a) != 1:
            return True
        positive: list[Any] = [a[j][j] for j in range(n) if known[j][j] and self._scales(j)]
        if self._whole and (self.factor.larger or not kept.none):
            positive.append(q.determinant(a))
        return not all(x > 0 for x in positive)

    def _has_products(self, lines: q.Matrix, places: Sequence[int], form: q.Matrix) -> bool:
        """Are the products of lines those of the same lines of 1, up to a factor where dilations
        are in the group?"""
        found = q.times(q.times(lines, form), q.transposed(lines)) if lines else ()
        pairs = [
            (found[a][b], form[i][j]) for (a, i), (b, j) in product(enumerate(places), repeat=2)
        ]
        factor = next((x / y for x, y in pairs if y), 1) if self.kept.conformal else 1
        return all(x == factor * y for x, y in pairs)

    def _scales(self, j: int) -> bool:
        """Is e_j, as a row or a column, an eigenvector of the whole factor?"""
        others = [i for i in range(self.factor.size) if i != j]
        column, row = (
            not any(e[i][j] if down else e[j][i] for e in self.factor.basis for i in others)
            for down in (True, False)
        )
        return column or row

    def _by_theorem(self) -> bool:
        """Are all lines that have the relations those of elements?"""
        g, kept, S = self.factor, self.kept, self.kept.form
        moved = [[e[i][j] for i, j in self.inside] for e in g.basis]
        if _nilpotent(g):  # its orbits are closed: one that is open in the hull is all of it
            return q.rank(q.matrix(moved)) == len(self.pivots)
        if kept.dimension > g.dimension or (self._whole and kept.complex_basis):
            return False
        if not g.larger or not S:
            return not (g.larger and kept.hull)
        definite = any(q.definite(q.scaled(sign, S)) for sign in (1, -1))
        skew = q.transposed(S) == q.scaled(-1, S) and not kept.conformal
        return not kept.hull and (definite or skew)

    def _exponential(self) -> bool:
        """Is g exp of a matrix of the Lie algebra, the logarithm in the hull?"""
        kept, S, n = self.kept, self.kept.form, self.factor.n
        if kept.dimension > self.factor.dimension or kept.complex_basis:
            return False
        a = tuple(row[:n] for row in self.g[:n])
        if S and not self._has_products(q.transposed(a), range(n), S):
            return False
        if kept.determinant and q.determinant(a) != 1:
            return False
        return not negative_or_zero(characteristic(a))


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
