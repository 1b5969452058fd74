"""The fields Yg − gX that are tangent to a group at each of its elements.

    g⁻¹Yg − X ∈ 𝔤  for every g,  so that Y and X normalise 𝔤

They are those of left and right translations, and others in which neither Y nor X is in 𝔤: a turn
of space about the body that a group of translations moves.  Fields that vanish, as for Y = X = 1,
are divided out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from ..algebra.exact_kernel import kernel, pivots, rational
from ..algebra.groups import Group
from ..algebra.residue_vectors import PRIMES, Residues, ResidueSource
from ..language import rational as q
from ..language.rational import Matrix

EXTRA = 6
"""So many random points more than there are unknowns: what vanishes at all of them vanishes, as a
wrong solution would meet with a chance of about 1/p at each."""


@dataclass(frozen=True)
class TangentField:
    """δg = Yg − gX, both matrices of the group's size, over Q."""

    Y: Matrix
    X: Matrix

    def carried(self, g: Matrix, back: Matrix, side: str) -> Matrix:
        """g⁻¹δg on the left, δg g⁻¹ on the right, ``back`` being g⁻¹."""
        if side == "left":
            return q.minus(q.times(q.times(back, self.Y), g), self.X)
        return q.minus(self.Y, q.times(q.times(g, self.X), back))


@cache
def tangent_fields(group: Group) -> tuple[TangentField, ...]:
    """A basis of the tangent fields modulo those that vanish: of right translations as far as it
    goes, the last basis element first, of others, and of left translations."""
    zero = q.scaled(0, q.identity(group.size))
    left = [TangentField(e, zero) for e in group.basis]
    right = [TangentField(zero, e) for e in group.basis]
    others = sorted(_mixed(group), key=_weight)
    listed = [*left, *right, *others]
    chosen = independent([_values(x, group) for x in listed])
    kept = [listed[k] for k in chosen]
    mixed = [x for x in kept if x not in left and x not in right]
    return (*mixed[::-1], *[x for x in right if x in kept][::-1], *list(left)[::-1])


def independent(vectors: Sequence[Sequence[int]]) -> list[int]:
    """The places of vectors that are no combinations of earlier ones, modulo a prime."""
    return pivots(zip(*vectors, strict=True), len(vectors), PRIMES[0])


def _values(field: TangentField, group: Group) -> list[int]:
    """The values of a field at some elements of the group, in one list."""
    g = _element(group, group.size**2)
    value = q.minus(q.times(field.Y, g), q.times(g, field.X))
    return [y for row in value for x in row for y in _at_all(x, len(g[0][0].values))]


def _at_all(x: object, points: int) -> list[int]:
    """The values of a number at the points, 0 where it is none of them."""
    return x.values if isinstance(x, Residues) else [0] * points


@cache
def _element(group: Group, points: int, p: int = PRIMES[0]) -> Matrix:
    """An element of the group at each of so many points."""
    source = ResidueSource(p, points, 1)
    zero = source.constant(0)
    return tuple(tuple(zero + x for x in row) for row in group.sample_inside(source, 1))


def _mixed(group: Group) -> list[TangentField]:
    """A basis of all pairs (Y, X) with g⁻¹Yg − X in 𝔤 for every g."""
    s = group.size
    found = [kernel(_tangency(group, p), 2 * s**2, p)[0] for p in PRIMES[:2]]
    fields = []
    for residues in zip(*found, strict=True):
        entries = [rational(x, PRIMES[:2]) or Fraction(0) for x in zip(*residues, strict=True)]
        rows = [tuple(entries[k : k + s]) for k in range(0, len(entries), s)]
        fields.append(_without_scaling(TangentField((*rows[:s],), (*rows[s:],)), group))
    return fields


def _tangency(group: Group, p: int) -> list[tuple[int, ...]]:
    """A row at each point of the group for the entries of Y and X: Tr N̄(g⁻¹Yg − X), which
    vanishes for every N normal to 𝔤; N is random there."""
    span, source = range(group.size), ResidueSource(p, 2 * group.size**2 + EXTRA, 2)
    g = _element(group, source.points, p)
    N = q.scaled(source.constant(0), q.identity(group.size))
    for normal in group.normal_space:
        N = q.plus(N, q.scaled(source.randint(1, 1), normal))
    turned = q.times(q.times(g, q.transposed(N)), inverse(g, source))  # by Y_ij it is its ji
    columns = [turned[j][i] for i in span for j in span] + [-N[i][j] for i in span for j in span]
    return [*zip(*(_at_all(x, source.points) for x in columns), strict=True)]


def _without_scaling(field: TangentField, group: Group) -> TangentField:
    """The same field as maps of (r, 1) that keep the 1: Y = X = 1 on a factor changes nothing."""
    Y, X = field.Y, field.X
    for offset, factor in group.places:
        k, corner = factor.size, offset + factor.size - 1
        if factor.affine and Y[corner][corner] == X[corner][corner] != 0:
            one = [
                [Fraction(i == j and offset <= i < offset + k) for j in range(len(Y))]
                for i in range(len(Y))
            ]
            block = q.scaled(Y[corner][corner], q.matrix(one))
            Y, X = q.scaled(-1, q.minus(Y, block)), q.scaled(-1, q.minus(X, block))
    return TangentField(Y, X)


def inverse(g: Matrix, source: ResidueSource) -> Matrix:
    """g⁻¹ at each of the points."""
    one = tuple(tuple(source.constant(int(x)) for x in row) for row in q.identity(len(g)))
    found = q.solve(g, one)
    assert found is not None
    return found


def _weight(field: TangentField) -> tuple[int, int]:
    """How simple a field is: how many entries are not 0, those of X first."""
    X, Y = (sum(map(bool, q.flatten(m))) for m in (field.X, field.Y))
    return X + Y, X
