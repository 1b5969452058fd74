"""The brackets of symmetries, and dϖ of two that commute: the cocycle of the conserved quantities.

    dϖ(δ, δ′) = δ′F − δF′ + ϖ([δ, δ′]),  for δL̃ = dF/dt and δ′L̃ = dF′/dt

so that it is a number where [δ, δ′] = 0: the same at all points, and there is no other choice of F
for which it vanishes (Galilei's group: the mass).  No bracket has a square of the time: in that of
(t K − f) and (t K′ − f′) it would be {K, K′}, kept together with t²{K, K′} + t h, h a function on
the group; so {K, K′} = h = 0.  The symmetries are therefore a Lie algebra.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from ..algebra.exact_kernel import kernel
from ..algebra.residue_vectors import Residues, ResidueSource
from ..language import rational as q
from ..language.rational import Matrix
from ..language.tree import Tree, add, mul, neg
from .group_entries import varying
from .scalar_lagrangian import by_state
from .search import Search
from .symmetry import Symmetry
from .tangent_fields import TangentField

Vector = list[Residues]
"""Coordinates, each for all values of the parameters."""


class Brackets:
    """The brackets of the symmetries that a search has found, for each value of the parameters."""

    def __init__(self, search: Search):
        self.search, self.p = search, search.p
        unknowns = search.system.unknowns
        self.fields = unknowns.fields
        first, count = unknowns.first_field, len(self.fields)
        _, table = search.samples
        zero = Residues([0] * len(search.samples[0]), self.p)
        whole = [
            [x.get(k, zero) for k in range(first, unknowns.count)]
            for x in (dict(zip(search.support, row, strict=True)) for row in table)
        ]
        self.moving, self.still = ([row[k : k + count] for row in whole] for k in (0, count))
        self.tau = [row[2 * count] for row in whole]

    @cached_property
    def of_fields(self) -> dict[tuple[int, int], dict[int, int]]:
        """The coordinates of the brackets of the tangent fields, for those that are not 0: of
        (Y, X) and (Y′, X′) it is ([Y′, Y], [X′, X])."""
        group, p = self.search.system.group, self.p
        source = ResidueSource(p, 2 * group.size**2, 5)
        g = group.sample_inside(source, 1)
        basis = [_values(x, g, source) for x in self.fields]
        count, brackets = len(self.fields), dict[tuple[int, int], TangentField]()
        for a, x in enumerate(self.fields):
            for b, y in enumerate(self.fields[:a]):
                z = TangentField(q.bracket(y.Y, x.Y), q.bracket(y.X, x.X))
                if any(map(any, (*z.Y, *z.X))):
                    brackets[b, a] = z
        columns = [*basis, *(_values(z, g, source) for z in brackets.values())]
        vectors, free = kernel(zip(*columns, strict=True), len(columns), p)
        assert free == [*range(count, len(columns))]
        found: dict[tuple[int, int], dict[int, int]] = {}
        for (b, a), vector in zip(brackets, vectors, strict=True):
            found[b, a] = {k: x for k, x in enumerate(vector[:count]) if x}
            found[a, b] = {k: p - x for k, x in found[b, a].items()}
        return found

    def _bracket(self, x: Vector, y: Vector) -> Vector:
        """The bracket of fields by their coordinates."""
        total = [0 * z for z in x]
        for (a, b), coordinates in self.of_fields.items():
            if x[a] and y[b]:
                weight = x[a] * y[b]
                for k, c in coordinates.items():
                    total[k] = total[k] + weight * c
        return total

    def commute(self, i: int, j: int) -> bool:
        """Is the bracket of two symmetries 0?"""
        u, v, du, dv = self.still[i], self.still[j], self.moving[i], self.moving[j]
        tau, tau_prime = self.tau[i], self.tau[j]
        pairs = zip(du, dv, self._bracket(u, v), strict=True)
        start = [tau * y - tau_prime * x + z for x, y, z in pairs]
        rates = zip(self._bracket(u, dv), self._bracket(du, v), strict=True)
        return not any((*start, *(x + y for x, y in rates), *self._bracket(du, dv)))

    def commuting(self) -> Iterator[tuple[int, int]]:
        """The pairs of symmetries whose bracket is 0."""
        count = len(self.moving)
        yield from ((i, j) for i in range(count) for j in range(i) if self.commute(i, j))


def cocycle(one: Symmetry, two: Symmetry) -> Tree:
    """δ′F − δF′ of two symmetries that commute: a number, so that it is taken at t = 0, g = 1."""
    return by_state(add(_along(two, one), neg(_along(one, two))))


def _along(field: Symmetry, other: Symmetry) -> Tree:
    """The derivative of the F of another symmetry along a field, at t = 0, g = 1."""
    Y, X = field.still
    values: dict[Tree, Tree] = {"t": 0}
    speeds: dict[Tree, Tree] = {"t": field.tau}
    for x, (i, j) in varying(field.group).items():
        values[x], speeds[x] = int(i == j), add(Y[i][j], neg(X[i][j]))
    found = []
    for c, monomial in other.terms:
        for k, x in enumerate(monomial):
            rest = (values[y] for y in (*monomial[:k], *monomial[k + 1 :]))
            found.append(mul(c, speeds[x], *rest))
    return add(*found)


def _values(field: TangentField, g: Matrix, source: ResidueSource) -> list[int]:
    """The values of a field at the points, in one list."""
    value = q.minus(q.times(field.Y, g), q.times(g, field.X))
    zero = source.constant(0)
    return [y for row in value for x in row for y in (zero + x).values]
