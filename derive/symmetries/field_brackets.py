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

import numpy as np

from ..algebra.exact_kernel import kernel
from ..algebra.residue_arrays import Array, ResidueSource
from ..language import rational as q
from ..language.rational import Matrix
from ..language.tree import Tree, add, mul, neg
from .group_entries import varying
from .scalar_lagrangian import by_state
from .search import Search
from .symmetry import Symmetry
from .tangent_fields import TangentField


class Brackets:
    """The brackets of the symmetries that a search has found, for each value of the parameters."""

    def __init__(self, search: Search):
        self.search, self.p = search, search.p
        unknowns = search.system.unknowns
        self.fields = unknowns.fields
        first, count = unknowns.first_field, len(self.fields)
        _, table = search.samples
        whole = np.zeros((*table.shape[:2], unknowns.count), np.int64)
        whole[:, :, search.support] = table
        rest = whole[:, :, first:]
        self.moving, self.still = rest[:, :, :count], rest[:, :, count : 2 * count]
        self.tau = rest[:, :, 2 * count]

    @cached_property
    def of_fields(self) -> Array:
        """The coordinates of the brackets of the tangent fields, d × d × d: of (Y, X) and (Y′, X′)
        it is ([Y′, Y], [X′, X])."""
        group, p = self.search.system.group, self.p
        source = ResidueSource(p, 2 * group.size**2, 5)
        g = group.sample_inside(source, 1)
        basis = [_values(x, g, source) for x in self.fields]
        count = len(self.fields)
        found = np.zeros((count, count, count), np.int64)
        for a, x in enumerate(self.fields):
            for b, y in enumerate(self.fields[:a]):
                z = TangentField(q.bracket(y.Y, x.Y), q.bracket(y.X, x.X))
                if any(map(any, (*z.Y, *z.X))):
                    columns = np.array([*basis, _values(z, g, source)]).T
                    vectors, free = kernel(columns, p)
                    assert free == [count]
                    found[a, b] = -vectors[0][:count] % p
                    found[b, a] = vectors[0][:count]
        return found

    def _bracket(self, x: Array, y: Array) -> Array:
        """The bracket of fields by their coordinates, for each value of the parameters."""
        total = np.zeros_like(x)
        for a, b in zip(*np.nonzero(self.of_fields.any(axis=2)), strict=True):
            weight = x[:, a] * y[:, b] % self.p
            total = (total + weight[:, None] * self.of_fields[a, b] % self.p) % self.p
        return total

    def commute(self, i: int, j: int) -> bool:
        """Is the bracket of two symmetries 0?"""
        u, v = self.still[:, i], self.still[:, j]
        du, dv = self.moving[:, i], self.moving[:, j]
        tau, tau_prime = self.tau[:, i, None], self.tau[:, j, None]
        start = tau * dv - tau_prime * du + self._bracket(u, v)
        rate = self._bracket(u, dv) + self._bracket(du, v)
        return not any((x % self.p).any() for x in (start, rate, self._bracket(du, dv)))

    def commuting(self) -> Iterator[tuple[int, int]]:
        """The pairs of symmetries whose bracket is 0."""
        count = self.moving.shape[1]
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


def _values(field: TangentField, g: Matrix, source: ResidueSource) -> Array:
    """The values of a field at the points, in one list."""
    value = q.minus(q.times(field.Y, g), q.times(g, field.X))
    zero = source.constant(0)
    return np.concatenate([(zero + x).values for row in value for x in row])
