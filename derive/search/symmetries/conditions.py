"""The condition on a symmetry at random points modulo a prime, and the fields that are tried."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property

from ...algebra.exact_kernel import (
    PRIMES,
    ResidueVector,
    ResidueVectorSource,
    Rows,
    kernel,
    pivots,
    rational,
)
from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.show import show
from ...language.tree import Tree, nodes
from ...problem.fields import coordinates
from ...problem.problem import Problem, ProblemError
from .gradient import FunctionsAtPoints, Tape
from .scalar_lagrangian import ParameterValues, entries, is_root, varying

# The fields Yg − gX that are tangent to a group at each of its elements.
#
# g⁻¹Yg − X ∈ 𝔤  for every g,  so that Y and X normalise 𝔤
#
# They are those of left and right translations, and others in which neither Y nor X is in 𝔤: a
# turn of space about the body that a group of translations moves. Fields that vanish, as for Y =
# X = 1, are divided out.

EXTRA = 6
"""So many random points more than there are unknowns: what vanishes at all of them vanishes, as a
wrong solution would meet with a chance of about 1/p at each."""


@dataclass(frozen=True)
class TangentField:
    """δg = Yg − gX, both matrices of the group's size, over Q."""

    Y: Matrix
    X: Matrix


@cache
def tangent_fields(group: Group) -> tuple[TangentField, ...]:
    """A basis of the tangent fields modulo those that vanish: of right translations as far as it
    goes, the last basis element first, of others, and of left translations."""
    zero = q.scaled(0, q.identity(group.size))
    left = [TangentField(e, zero) for e in group.basis]
    right = [TangentField(zero, e) for e in group.basis]
    others = sorted(_mixed(group), key=_weight)
    listed = [*left, *right, *others]
    chosen = independent([values(x, group, group.size**2) for x in listed])
    kept = [listed[k] for k in chosen]
    mixed = [x for x in kept if x not in left and x not in right]
    return (*mixed[::-1], *[x for x in right if x in kept][::-1], *list(left)[::-1])


def independent(vectors: Sequence[Sequence[int]]) -> list[int]:
    """The places of vectors that are no combinations of earlier ones, modulo a prime."""
    return pivots(zip(*vectors, strict=True), len(vectors), PRIMES[0])


def values(field: TangentField, group: Group, points: int, p: int = PRIMES[0]) -> list[int]:
    """The values of a field at so many elements of the group, in one list."""
    g = _element(group, points, p)
    value = q.minus(q.times(field.Y, g), q.times(g, field.X))
    return [y for row in value for x in row for y in _at_all(x, points)]


def _at_all(x: object, points: int) -> list[int]:
    """The values of a number at the points, 0 where it is none of them."""
    return x.values if isinstance(x, ResidueVector) else [0] * points


@cache
def _element(group: Group, points: int, p: int = PRIMES[0]) -> Matrix:
    """An element of the group at each of so many points."""
    source = ResidueVectorSource(p, points, 1)
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
    span, source = range(group.size), ResidueVectorSource(p, 2 * group.size**2 + EXTRA, 2)
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


def inverse(g: Matrix, source: ResidueVectorSource) -> Matrix:
    """g⁻¹ at each of the points."""
    one = tuple(tuple(source.constant(int(x)) for x in row) for row in q.identity(len(g)))
    found = q.solve(g, one)
    assert found is not None
    return found


def _weight(field: TangentField) -> tuple[int, int]:
    """How simple a field is: how many entries are not 0, those of X first."""
    X, Y = (sum(map(bool, q.flatten(m))) for m in (field.X, field.Y))
    return X + Y, X


Monomial = tuple[Tree, ...]
"""Its factors, each the time or an entry of g."""

TRUE_ROOTS = 6
"""So many square roots are true ones at each point, which half of the points have of each; where
there are more, each may be any number."""

TRIES = 40
"""So many batches of random parameters are tried, where square roots of them are to be true."""

MOST_POINTS = 4000
"""So many points are tried at once, unless one system needs more."""

System = tuple[dict[Tree, int], Rows]
"""Values of the parameters and their functions, and the rows for them."""


@dataclass(frozen=True)
class Unknowns:
    """What is sought, in the order of the columns: F by its monomials, V₁, V₀ on a basis of the
    tangent fields, then τ."""

    monomials: tuple[Monomial, ...]
    fields: tuple[TangentField, ...]

    @property
    def count(self) -> int:
        """The number of columns."""
        return len(self.monomials) + 2 * len(self.fields) + 1

    @property
    def first_field(self) -> int:
        """The column at which F ends."""
        return len(self.monomials)


def unknowns(group: Group) -> Unknowns:
    """F of degree two at most in the time and the entries of g, and the tangent fields."""
    singles: list[Tree] = ["t", *varying(group)]
    pairs = [(x, y) for k, x in enumerate(singles) for y in singles[k:]]
    return Unknowns((*((x,) for x in singles), *pairs), tangent_fields(group))


class SymmetryConditions:
    """The system of a problem with a scalar Lagrangian."""

    def __init__(self, problem: Problem):
        self.problem, self.group = problem, problem.own_group
        self.side, self.tree = problem.own_lagrangian.trivialisation, problem.own_lagrangian.L
        self.parameters = ParameterValues(self.tree)
        self.tape = Tape(self.tree, self.parameters.functions)
        self.unknowns = unknowns(problem.own_group)
        roots = {x for x in nodes(self.tree) if is_root(x)} - {*self.parameters.roots}
        self.true_roots = len(roots) <= TRUE_ROOTS
        self.oversampling = 2 ** len(roots) if self.true_roots else 1

    @property
    def open_functions(self) -> tuple[str, ...]:
        """The functions in L̃ whose values are taken for any numbers."""
        exact = {"sqrt"} if self.true_roots else set()
        own = {x[1] for x in self.parameters.functions if isinstance(x, tuple)} - {"sqrt"}
        return tuple(sorted((self.tape.functions - exact) | own))

    def systems(
        self, count: int, p: int, seed: int, columns: Sequence[int] | None = None
    ) -> list[System]:
        """So many random values of the parameters, each with rows at random points for some of the
        columns, all by default; more rows than there are columns."""
        kept = [*range(self.unknowns.count)] if columns is None else [*columns]
        wanted, found = len(kept) + EXTRA, list[System]()
        points = (wanted * 5 // 4) * self.oversampling + EXTRA if self.oversampling > 1 else wanted
        for batch in range(TRIES):
            several = min(count - len(found), max(1, MOST_POINTS // points))
            found += self._batch(several, points, wanted, kept, p, TRIES * seed + batch)
            if len(found) == count:
                return found
        roots = dict.fromkeys(show(x)[:60] for x in nodes(self.tree) if is_root(x))
        raise ProblemError(
            f"{self.problem.name}: no values are found at which {', '.join(roots)} of its "
            "Lagrangian can be tried: is a root of what is never positive among them?"
        )

    def _batch(
        self, count: int, points: int, wanted: int, kept: Sequence[int], p: int, seed: int
    ) -> list[System]:
        """Those of some random values of the parameters that leave enough points."""
        drawn = self.parameters.drawn(count, p, 2 * seed)
        count = len(drawn["π"])
        source = ResidueVectorSource(p, count * points, 2 * seed + 1)
        values = {
            x: ResidueVector([c for c in v for _ in range(points)], p) for x, v in drawn.items()
        }
        found = FunctionsAtPoints(source, true_roots=self.true_roots)
        point = SamplePoints(self, source, values, found)
        enough: dict[int, list[int]] = {}
        for k in range(count):
            valid = [i for i in range(k * points, (k + 1) * points) if found.valid[i]]
            if len(valid) >= wanted:
                enough[k] = valid[:wanted]
        if not enough:
            return []
        there = point.at([i for valid in enough.values() for i in valid])
        rows = [*map(list, zip(*(there.column(k).values for k in kept), strict=True))]
        return [
            ({x: v[k] for x, v in drawn.items()}, rows[j * wanted : (j + 1) * wanted])
            for j, k in enumerate(enough)
        ]


class SamplePoints:
    """Random points of a problem: t, g, Z and the derivatives of L̃ there."""

    def __init__(
        self,
        system: SymmetryConditions,
        source: ResidueVectorSource,
        parameters: Mapping[Tree, ResidueVector],
        found: FunctionsAtPoints,
    ):
        group, self.unknowns, self.side = system.group, system.unknowns, system.side
        zero = source.constant(0)
        self.source, self.t = source, source.randint(1, 1)
        self.g: Matrix = tuple(
            tuple(zero + x for x in row) for row in group.sample_inside(source, 1)
        )
        zeta = [source.randint(1, 1) for _ in group.basis]
        self.Z: Matrix = tuple(tuple(zero + x for x in row) for row in group.hat(zeta))
        self.places = entries(group)
        leaves: dict[Tree, ResidueVector] = {"t": self.t, **parameters}
        leaves |= dict(zip(coordinates(group), zeta, strict=True))
        leaves |= {x: self.g[i][j] for x, (i, j) in self.places.items()}
        self.leaves = leaves
        self.group, self.evaluated = group, system.tape.at(leaves, source, found)

    def at(self, places: Sequence[int]) -> SamplePoints:
        """Some of the points, all in their order: before what is computed when it is asked for."""
        if len(places) == self.source.points:
            return self
        found = copy(self)
        found.source = ResidueVectorSource(self.source.p, len(places), 0)  # of constants alone
        found.t = self.t.at(places)
        found.g, found.Z = (
            tuple(tuple(x.at(places) for x in row) for row in m) for m in (self.g, self.Z)
        )
        found.leaves = {x: y.at(places) for x, y in self.leaves.items()}
        found.evaluated = self.evaluated.at(places, found.source)
        return found

    @cached_property
    def slopes(self) -> Mapping[Tree, ResidueVector]:
        """The derivatives of L̃."""
        return self.evaluated.gradient()

    @cached_property
    def P(self) -> Matrix:
        """The momenta, a matrix."""
        zero = self.source.constant(0)
        momenta = [self.slopes.get(x, zero) for x in coordinates(self.group)]
        return tuple(tuple(zero + x for x in row) for row in self.group.covector_matrix(momenta))

    @cached_property
    def along(self) -> Matrix:
        """∂L̃/∂g, a matrix."""
        zero = self.source.constant(0)
        rows = [[zero] * len(self.g) for _ in self.g]
        for x, (i, j) in self.places.items():
            rows[i][j] = self.slopes.get(x, zero)
        return q.matrix(rows)

    @cached_property
    def velocity(self) -> Matrix:
        """ġ."""
        return q.times(self.g, self.Z) if self.side == "left" else q.times(self.Z, self.g)

    @cached_property
    def pairing(self) -> tuple[Matrix, Matrix]:
        """The matrices (M, N) with ⟨Π, η⟩ = Tr M̄Y − Tr N̄X."""
        bar, back = q.transposed(self.g), inverse(self.g, self.source)
        if self.side == "left":
            return q.times(q.times(q.transposed(back), self.P), bar), self.P
        return self.P, q.times(q.times(bar, self.P), q.transposed(back))

    @cached_property
    def change(self) -> tuple[Matrix, Matrix]:
        """The matrices (M, N) with δL̃ = Tr M̄Y − Tr N̄X for a constant field."""
        bar = q.transposed(self.g)
        Y, X = q.times(self.along, bar), q.times(bar, self.along)
        turned = q.bracket(self.P, q.transposed(self.Z))  # ⟨Π, [X, Z]⟩ = Tr X‾[P, Z̄]
        return (Y, q.minus(X, turned)) if self.side == "left" else (q.plus(Y, turned), X)

    def column(self, k: int) -> ResidueVector:
        """The coefficient of an unknown in δL̃ − dF/dt."""
        first, count = self.unknowns.first_field, len(self.unknowns.fields)
        if k < first:
            return -self._rate(self.unknowns.monomials[k])
        if k < first + count:
            field = self.unknowns.fields[k - first]
            later = self._contracted(self.change, field) * self.t
            return later + self._contracted(self.pairing, field)
        if k < first + 2 * count:
            return self._contracted(self.change, self.unknowns.fields[k - first - count])
        rate: ResidueVector = self.slopes.get("t", self.source.constant(0))
        return rate

    def _rate(self, monomial: Monomial) -> ResidueVector:
        """d/dt of a monomial along ġ."""
        total = self.source.constant(0)
        for k, x in enumerate(monomial):
            slope = self._speed(x)
            for y in (*monomial[:k], *monomial[k + 1 :]):
                slope = slope * self.leaves[y]
            total = total + slope
        return total

    def _speed(self, x: Tree) -> ResidueVector:
        if x == "t":
            return self.source.constant(1)
        i, j = self.places[x]
        speed: ResidueVector = self.velocity[i][j]
        return speed

    def _contracted(self, by: tuple[Matrix, Matrix], field: TangentField) -> ResidueVector:
        """Tr M̄Y − Tr N̄X."""
        total = self.source.constant(0)
        for sign, weights, matrix in ((1, by[0], field.Y), (-1, by[1], field.X)):
            for row, numbers in zip(weights, matrix, strict=True):
                for x, c in zip(row, numbers, strict=True):
                    if c:
                        total = total + x * (sign * c)
        return total
