"""The condition on a symmetry, at random points of R × G × 𝔤 modulo a prime: a row at each.

A field δt = τ, δg = V₀ + tV₁ with V = Yg − gX carries a velocity along, so that

    left:  η = g⁻¹Yg − X,  δZ = [X, Z] + η₁        right:  η = Y − gXg⁻¹,  δZ = [Y, Z] + η₁

and δL̃ = ⟨Π, δZ⟩ + Φ(η) + τ ∂ₜL̃ = dF/dt is linear in V₀, V₁, τ and F.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property

from ..algebra.exact_kernel import Rows
from ..algebra.groups import Group
from ..algebra.residue_vectors import Residues, ResidueSource
from ..language import rational as q
from ..language.rational import Matrix
from ..language.show import show
from ..language.tree import Tree, nodes
from ..problem.problem import Problem, ProblemError
from ..problem.state_names import coordinates
from .gradient import Functions, Tape
from .group_entries import entries, varying
from .parameter_values import ParameterValues, is_root
from .tangent_fields import EXTRA, TangentField, inverse, tangent_fields

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


class Conditions:
    """The system of a problem with a scalar Lagrangian."""

    def __init__(self, problem: Problem):
        assert problem.lagrangian is not None
        assert problem.group is not None
        self.problem, self.group = problem, problem.group
        self.side, self.tree = problem.lagrangian.trivialisation, problem.lagrangian.L
        self.parameters = ParameterValues(self.tree)
        self.tape = Tape(self.tree, self.parameters.functions)
        self.unknowns = unknowns(problem.group)
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
        source = ResidueSource(p, count * points, 2 * seed + 1)
        values = {x: Residues([c for c in v for _ in range(points)], p) for x, v in drawn.items()}
        found = Functions(source, true_roots=self.true_roots)
        point = Point(self, source, values, found)
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


class Point:
    """Random points of a problem: t, g, Z and the derivatives of L̃ there."""

    def __init__(
        self,
        system: Conditions,
        source: ResidueSource,
        parameters: Mapping[Tree, Residues],
        found: Functions,
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
        leaves: dict[Tree, Residues] = {"t": self.t, **parameters}
        leaves |= dict(zip(coordinates(group), zeta, strict=True))
        leaves |= {x: self.g[i][j] for x, (i, j) in self.places.items()}
        self.leaves = leaves
        self.group, self.evaluated = group, system.tape.at(leaves, source, found)

    def at(self, places: Sequence[int]) -> Point:
        """Some of the points, all in their order: before what is computed when it is asked for."""
        if len(places) == self.source.points:
            return self
        found = copy(self)
        found.source = ResidueSource(self.source.p, len(places), 0)  # of constants alone
        found.t = self.t.at(places)
        found.g, found.Z = (
            tuple(tuple(x.at(places) for x in row) for row in m) for m in (self.g, self.Z)
        )
        found.leaves = {x: y.at(places) for x, y in self.leaves.items()}
        found.evaluated = self.evaluated.at(places, found.source)
        return found

    @cached_property
    def slopes(self) -> Mapping[Tree, Residues]:
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

    def column(self, k: int) -> Residues:
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
        rate: Residues = self.slopes.get("t", self.source.constant(0))
        return rate

    def _rate(self, monomial: Monomial) -> Residues:
        """d/dt of a monomial along ġ."""
        total = self.source.constant(0)
        for k, x in enumerate(monomial):
            slope = self._speed(x)
            for y in (*monomial[:k], *monomial[k + 1 :]):
                slope = slope * self.leaves[y]
            total = total + slope
        return total

    def _speed(self, x: Tree) -> Residues:
        if x == "t":
            return self.source.constant(1)
        i, j = self.places[x]
        speed: Residues = self.velocity[i][j]
        return speed

    def _contracted(self, by: tuple[Matrix, Matrix], field: TangentField) -> Residues:
        """Tr M̄Y − Tr N̄X."""
        total = self.source.constant(0)
        for sign, weights, matrix in ((1, by[0], field.Y), (-1, by[1], field.X)):
            for row, numbers in zip(weights, matrix, strict=True):
                for x, c in zip(row, numbers, strict=True):
                    if c:
                        total = total + x * (sign * c)
        return total
