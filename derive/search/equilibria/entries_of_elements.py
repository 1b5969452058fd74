"""Which values of the entries of g among the variables are those of an element of the group.

Of every factor H of the group three things are read off its Lie algebra: what is linear among the
entries, a form S with ĀSA = S or μS, and whether det A = 1.  Rows r that are all known (columns,
where Z = ġg⁻¹) have the products r S⁻¹ r̄′ of 1, they are independent, and where all are known
det A is 1, or positive.  For the groups with names, and others of irreducible matrices, that is
all: what rows are left is found beside these (Witt).  Of another group that is tried on one matrix
A: where all this holds, and no eigenvalue of A is negative or 0, A is exp(log A), and log A in 𝔥.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...algebra.groups import Group, affine_entries
from ...algebra.relations import Relations, relations
from ...algebra.samplers import minimal_polynomial
from ...algebra.user_groups import nilpotent
from ...language import rational as q
from ...language.univariate import real_roots
from ..integrals.lie_poisson import (
    ONE,
    Exponents,
    LiePoisson,
    Polynomial,
    multiplied,
)

Line = Sequence[Mapping[int, Fraction]]
"""A row or a column of linear forms in the variables, ``ONE`` for the constant."""


@dataclass(frozen=True)
class Minor:
    """A ``matrix`` of linear forms in the variables, and what is ``said`` of it in a message."""

    matrix: Sequence[Line]
    said: str


@dataclass(frozen=True)
class EntryConditions:
    """What the entries of g satisfy in a factor of the group.  ``constant``: polynomials that have
    their values at 1; ``independent``: matrices with independent rows; ``positive``: those with a
    positive determinant.

    ``sufficient``: have elements all such entries?  ``entries``: those of one matrix of the hull;
    ``factor``: the factor of the group; ``relations``: those of its entries.
    """

    constant: tuple[Polynomial, ...]
    independent: tuple[Minor, ...]
    positive: tuple[Minor, ...]
    sufficient: bool
    entries: Sequence[Line]
    factor: Group
    relations: Relations

    @property
    def open(self) -> bool:
        """Is the factor open in the affine hull of its matrices?"""
        relations = self.relations
        return (
            not (relations.form or relations.determinant)
            and relations.dimension == self.factor.dimension
        )

    def attained(self, at: Sequence[Any]) -> bool:
        """Has an element these entries, which are not refuted?  True is proved."""
        if self.sufficient:
            return True
        g = numbers(self.entries, at)
        return g == q.identity(len(g)) or self._exponential(self.factor.linear_part(g))

    def _exponential(self, a: q.Matrix) -> bool:
        """Is the matrix exp of one in the Lie algebra?  True is proved."""
        relations, S = self.relations, self.relations.form
        if relations.dimension > self.factor.dimension or relations.complex_basis:
            return False
        product = q.times(q.transposed(a), q.times(S, a)) if S else ()
        factor = next((y / x for x, y in zip(*map(q.flatten, (S, product)), strict=True) if x), 1)
        if S and (product != q.scaled(factor, S) or (factor != 1 and not relations.conformal)):
            return False
        if relations.determinant and q.determinant(a) != 1:
            return False
        roots = real_roots(minimal_polynomial(a))
        return not (roots.at_zero or roots.negative)


def numbers(matrix: Sequence[Line], at: Sequence[Any]) -> q.Matrix:
    """A matrix of linear forms at a point."""

    def value(form: Mapping[int, Fraction]) -> Any:
        return sum((c * (1 if k == ONE else at[k]) for k, c in form.items()), Fraction(0))

    return tuple(tuple(map(value, row)) for row in matrix)


def conditions(system: LiePoisson, group: Group, *, left: bool) -> tuple[EntryConditions, ...]:
    """The conditions of every factor of a group in which entries of g are variables; ``left``: is
    it Z = g⁻¹ġ?"""
    found = []
    for offset, factor in group.places:
        places = {
            k: (x[2] - 1 - offset, x[3] - 1 - offset)
            for k, x in enumerate(system.variables)
            if isinstance(x, tuple) and x[1] == "A"
        }
        inside = {k: x for k, x in places.items() if all(0 <= i < factor.size for i in x)}
        if inside:
            found.append(
                _EntryReader(factor, inside, offset, len(system.variables)).conditions(left=left)
            )
    return tuple(found)


class _EntryReader:
    """The entries of an element of a factor, by those that are variables."""

    def __init__(
        self, factor: Group, places: Mapping[int, tuple[int, int]], offset: int, size: int
    ):
        self.factor, self.places, self.offset, self.size = factor, places, offset, size
        self.relations = relations(factor)
        entries = affine_entries(factor)
        free = sorted({x for row in entries for _, weights in row for x in weights})
        weights = [[[w.get(x, Fraction(0)) for x in free] for _, w in row] for row in entries]
        self.weight_rows = [weights[i][j] for i, j in places.values()]
        one = q.identity(len(places))
        rows, pivots = q.echelon(
            tuple((*w, *e) for w, e in zip(self.weight_rows, one, strict=True))
        )
        m = len(free)
        self.solved = [(p, row) for p, row in zip(pivots, rows, strict=False) if p < m]
        self.linear = [row[m:] for p, row in zip(pivots, rows, strict=True) if p >= m]
        self.known = [[self._determined(w, m) for w in row] for row in weights]
        self.entries = [
            [self._form(w, m, int(i == j)) for j, w in enumerate(row)]
            for i, row in enumerate(weights)
        ]

    def _determined(self, weights: Sequence[Fraction], m: int) -> bool:
        """Do the variables tell an entry?"""
        left = [*weights]
        for p, row in self.solved:
            left = [x - weights[p] * y for x, y in zip(left, row[:m], strict=True)]
        return not any(left)

    def _form(self, weights: Sequence[Fraction], m: int, start: int) -> dict[int, Fraction]:
        """An entry by the variables, less their values at 1; what they leave open is as at 1."""
        chosen = [Fraction(0)] * len(self.places)
        for p, row in self.solved:
            chosen = [x + weights[p] * y for x, y in zip(chosen, row[m:], strict=True)]
        return self._combined(chosen, start)

    def _combined(self, by: Sequence[Fraction], start: int) -> dict[int, Fraction]:
        """A combination of the variables less their values at 1, plus a number."""
        found = {k: c for k, c in zip(self.places, by, strict=True) if c}
        pairs = zip(by, self.places.values(), strict=True)
        rest = start - sum((c for c, (i, j) in pairs if i == j), Fraction(0))
        return found | ({ONE: rest} if rest else {})

    def conditions(self, *, left: bool) -> EntryConditions:
        """All of them."""
        n, relations = self.factor.n, self.relations
        linear = [row[:n] for row in self.entries[:n]]
        rows = [i for i in range(n) if all(self.known[i][:n])]
        columns = [j for j in range(n) if all(row[j] for row in self.known[:n])]
        lines = (
            ("row", rows, [linear[i] for i in rows]),
            ("column", columns, [[row[j] for row in linear] for j in columns]),
        )
        _, chosen, moved = lines[not left]
        constant = [self._polynomial(self._combined(row, 0)) for row in self.linear]
        if relations.form:
            metric = q.inverted(relations.form) if left else relations.form
            constant += self._products(moved, chosen, metric)
        full = len(rows) == n
        if full and relations.determinant and not relations.complex_basis:
            constant.append(self._determinant(linear))
        positive = [
            Minor([[linear[j][j]]], f"the entry {j + 1 + self.offset} of the diagonal of g")
            for j in range(n)
            if self.known[j][j] and self._scales(j)
        ]
        if full and not (relations.none and not self.factor.larger):
            positive.append(Minor(linear, "the determinant of g"))
        return EntryConditions(
            tuple(f for f in constant if any(map(any, f))),
            tuple(self._named(*x) for x in lines if x[1]),
            tuple(positive),
            self._sufficient(full=full),
            self.entries,
            self.factor,
            relations,
        )

    def _named(self, what: str, places: Sequence[int], matrix: Sequence[Line]) -> Minor:
        listed = ", ".join(str(i + 1 + self.offset) for i in places)
        if len(places) > 1:
            return Minor(matrix, f"{what}s {listed} of g would be dependent")
        return Minor(matrix, f"{what} {listed} of g would be 0")

    def _scales(self, j: int) -> bool:
        """Is the unit vector e_j, as a row or a column, an eigenvector of all of 𝔥?"""
        span = [i for i in range(self.factor.size) if i != j]
        basis = self.factor.basis
        return any(not any(f(e, i) for e in basis for i in span) for f in _in_line_with(j))

    def _sufficient(self, *, full: bool) -> bool:
        """Are the conditions sufficient, whatever the values?"""
        g, relations, S = self.factor, self.relations, self.relations.form
        if nilpotent(g.basis):  # its orbits are closed: one that is open in its hull is all of it
            moved = [[e[i][j] for i, j in self.places.values()] for e in g.basis]
            return q.rank(q.matrix(moved)) == q.rank(q.matrix(self.weight_rows))
        if relations.dimension > g.dimension or (full and relations.complex_basis):
            return False
        skew = bool(S) and q.transposed(S) == q.scaled(-1, S)
        definite = bool(S) and any(q.definite(q.scaled(sign, S)) for sign in (1, -1))
        by_one_form = not S or definite or (skew and not relations.conformal)
        return not g.larger or (not relations.hull and by_one_form)

    # -- polynomials in the variables ------------------------------------------------------------

    def _polynomial(self, form: Mapping[int, Fraction]) -> Polynomial:
        return {tuple(int(i == k) for i in range(self.size)): c for k, c in form.items()}

    def _products(
        self, lines: Sequence[Line], places: Sequence[int], metric: q.Matrix
    ) -> Iterator[Polynomial]:
        """The products of lines; where 𝔥 has dilations, less what they are by the first of them
        that is not 0 at 1."""
        reference: tuple[Polynomial, Fraction] | None = None
        for a, i in enumerate(places):
            for b, j in enumerate(places[: a + 1]):
                f = self._product(lines[a], lines[b], metric)
                at_one = metric[i][j]
                if self.relations.conformal and at_one and reference is None:
                    reference = f, at_one
                elif self.relations.conformal and at_one and reference:
                    by = -at_one / reference[1]
                    yield q.summed([*f.items(), *((e, by * c) for e, c in reference[0].items())])
                elif not self.relations.conformal or not at_one:
                    yield f

    def _product(self, one: Line, two: Line, metric: q.Matrix) -> Polynomial:
        return q.summed(
            (e, c * z)
            for x, row in zip(one, metric, strict=True)
            for y, c in zip(two, row, strict=True)
            for e, z in multiplied(*map(self._polynomial, (x, y)))
        )

    def _determinant(self, rows: Sequence[Line]) -> Polynomial:
        """det of linear forms, by its first row."""
        if not rows:
            return {(0,) * self.size: Fraction(1)}
        terms: list[tuple[Exponents, Fraction]] = []
        for j, x in enumerate(rows[0]):
            if x:
                smaller = [[*row[:j], *row[j + 1 :]] for row in rows[1:]]
                by = self._polynomial({k: c * (-1) ** j for k, c in x.items()})
                terms += multiplied(by, self._determinant(smaller))
        return q.summed(terms)


def _in_line_with(j: int) -> tuple[Callable[[q.Matrix, int], Any], ...]:
    """The entries of column j, and of row j."""
    return lambda e, i: e[i][j], lambda e, i: e[j][i]
