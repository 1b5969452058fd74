"""How many symmetries a Lagrangian has among the fields that are searched."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import combinations_with_replacement
from math import prod
from random import Random
from typing import Any, NamedTuple, TypeVar

from ...algebra.exact_kernel import (
    ResidueVector,
    ResidueVectorSource,
    kernel,
    pivots,
    primes_from,
    residue_of,
)
from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, add, neg, nodes, operands, terms
from ...record.as_json import decode
from ...record.record import Derivation, RecordError, Step
from ...record.sentence import Claim
from ..values.arithmetic import Varying, value_of
from ..values.residue import Residue
from .entries_checked import constant_entries
from .spectra_and_residues import (
    ResidueFunctions,
    UnluckyError,
    begins,
    drawn,
    gradient,
    is_parameter,
    value,
)

V = TypeVar("V")
Field = tuple[Matrix, Matrix]
"""Y and X."""
SPARE = 8
"""So many more points than unknowns."""
ROOTS = 6
"""So many square roots are true at each point, which half of the points have of each; where there
are more, each may be any number."""
TRIES = 200
"""So many primes and values of the parameters are tried, where roots of them are to be true."""


class SymmetryCount:
    """The symmetries of the Lagrangian of a problem on a group."""

    def __init__(self, problem: Mapping[str, Any], group: Group, random: Random):
        given = problem["lagrangian"]
        self.group, self.random = group, random
        self.left = given["trivialisation"] == "left"
        self.tree = decode(given["L"], "problem, L")
        seen = [*dict.fromkeys(nodes(self.tree))]
        self.parameters: list[Tree] = [x for x in seen if is_parameter(x)]
        roots = sum(begins(x, "fun", "sqrt") and _of_state(x) for x in seen)
        self.true_roots = roots <= ROOTS
        self.oversampling = 2**roots if self.true_roots else 1
        functions = {x[1] for x in seen if isinstance(x, tuple) and x[0] == "fun"}
        self.open_functions = sorted(functions - ({"sqrt"} if self.true_roots else set()))

    @cached_property
    def dimension(self) -> int:
        """How many there are, for generic parameters."""
        return self.modulo_a_prime(self._counted)

    def independent(self, listed: Sequence[Listed]) -> bool:
        """Is no combination of what the motion keeps by these symmetries constant, for generic
        parameters?"""
        return self.modulo_a_prime(lambda p: self._rank(listed, p)) == len(listed)

    def modulo_a_prime(self, found: Callable[[int], V]) -> V:
        """What is found modulo a random prime with the roots that are needed."""
        for _ in range(TRIES):
            p = next(primes_from(self.random.randrange(2**30, 2**31) | 3))
            try:
                return found(p)
            except UnluckyError:
                continue
        raise RecordError("no points are known at which the roots of the Lagrangian are numbers")

    def _rank(self, listed: Sequence[Listed], p: int) -> int:
        """The rank of ⟨Π, η⟩ − τh̃ − F modulo constants."""
        seen = (x for field in listed for t in field for x in nodes(t))
        letters = dict.fromkeys([*self.parameters, *(x for x in seen if is_parameter(x))])
        parameters = drawn(letters, self.random, p)
        points = self.points(len(listed) + SPARE, parameters, p)
        source = ResidueVectorSource(p, points.count, self.seed())
        functions = ResidueFunctions(source, roots=self.true_roots)
        found = points.rank([points.conserved_by(x, parameters, functions) for x in listed])
        if not all(functions.valid):
            raise UnluckyError
        return found

    def _counted(self, p: int) -> int:
        """The dimension modulo a prime."""
        parameters, fields = drawn(self.parameters, self.random, p), self._tangent_fields(p)
        columns = len(self.monomials) + 2 * len(fields) + 1
        points = self.points(columns + SPARE, parameters, p)
        found = kernel(_rows(points.row(fields), points.count, p), columns, p)[0]
        tried = self.points(len(found) + SPARE, parameters, p)
        values = tried.conserved(fields)
        return tried.rank([q.dot(v, values) for v in found])

    @cached_property
    def entries(self) -> list[tuple[int, int]]:
        """The places of g that are not the same for all elements."""
        constant, span = constant_entries(self.group), range(self.group.size)
        return [(i, j) for i in span for j in span if (i, j) not in constant]

    @cached_property
    def monomials(self) -> list[tuple[int, ...]]:
        """The factors of the monomials of F: 0 is t, k the k-th entry."""
        letters = range(len(self.entries) + 1)
        return [(k,) for k in letters] + [*combinations_with_replacement(letters, 2)]

    def _tangent_fields(self, p: int) -> list[Field]:
        """A basis of the pairs (Y, X) with g⁻¹Yg − X in 𝔤 for all g."""
        size, rows, normal = self.group.size, list[list[int]](), self.group.normal_space
        source = ResidueVectorSource(p, 2 * size**2 // max(1, len(normal)) + SPARE, self.seed())
        g, back = self._sampled(source)
        for m in normal:
            pulled = q.times(q.times(q.transposed(back), m), q.transposed(g))
            columns = (*q.flatten(pulled), *(-x for x in q.flatten(m)))
            rows += _rows(columns, source.points, p)
        found = kernel(rows, 2 * size**2, p)[0]
        matrices = ([v[k : k + size] for k in range(0, len(v), size)] for v in found)
        return [(q.matrix(x[:size]), q.matrix(x[size:])) for x in matrices]

    def seed(self) -> int:
        """A seed of random numbers."""
        return self.random.getrandbits(64)

    def _sampled(self, source: ResidueVectorSource) -> tuple[Matrix, Matrix]:
        """Random elements with their inverses."""
        zero = source.constant(0)
        g = q.matrix([[zero + x for x in row] for row in self.group.sample_inside(source, 1)])
        back = q.inverse(g)
        if back is None or q.times(g, back) != q.identity(len(g)):
            raise UnluckyError
        return g, back

    def points(self, several: int, parameters: Mapping[Tree, Residue], p: int) -> JetPoints:
        """So many points of R × G × 𝔤; ``UnluckyError`` for fewer."""
        count = several if self.oversampling == 1 else self.oversampling * several * 5 // 4 + SPARE
        source = ResidueVectorSource(p, count, self.seed())
        g, back = self._sampled(source)
        t, *zeta = (source.randint(1, p) for _ in range(self.group.dimension + 1))
        leaves: dict[Tree, ResidueVector] = {"t": t}
        leaves |= {("entry", "A", i + 1, j + 1): g[i][j] for i, j in self.entries}
        leaves |= {("entry", "ζ", a): x for a, x in enumerate(zeta, 1)}
        at: dict[Tree, Any] = {**parameters}
        at |= {x: Residue(y.values[0], p) for x, y in _entries(g).items()}
        units = q.identity(len(leaves))
        at |= {x: Varying(y, unit) for (x, y), unit in zip(leaves.items(), units, strict=True)}
        functions = ResidueFunctions(source, roots=self.true_roots)
        L = value(self.tree, at, p, functions)
        valid = [k for k, holds in enumerate(functions.valid) if holds][:several]
        if len(valid) < several:
            raise UnluckyError

        def chosen(x: Any) -> ResidueVector:
            found: ResidueVector = (source.constant(0) + x).at(valid)
            return found

        here, undone = (tuple(tuple(map(chosen, row)) for row in x) for x in (g, back))
        drawn, slopes = ([*map(chosen, x)] for x in (leaves.values(), gradient(L, len(leaves))))
        return JetPoints(self, p, here, undone, drawn, slopes, chosen(value_of(L)))


class Listed(NamedTuple):
    """A symmetry as a record lists it: δt = τ, δA, and F."""

    time: Tree
    displacement: Tree
    F: Tree


@dataclass(frozen=True)
class JetPoints:
    """Points modulo p: g, g⁻¹, the values of t, the entries of g and ζ, the slopes of L̃ by these,
    and L̃."""

    of: SymmetryCount
    p: int
    g: Matrix
    back: Matrix
    leaves: Sequence[ResidueVector]
    slopes: Sequence[ResidueVector]
    value: ResidueVector

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.value.values)

    def rank(self, columns: Sequence[Any]) -> int:
        """The rank of numbers at the points, modulo constants."""
        one = [1] * self.count
        found = [each(x, self.count, self.p) for x in columns]
        return len(pivots([one, *found], self.count, self.p)) - 1

    @cached_property
    def Z(self) -> Matrix:
        """The velocity in 𝔤."""
        return self.of.group.hat(self.leaves[1 + len(self.of.entries) :])

    def tangent_vector(self, eta: Matrix) -> Matrix:
        """The tangent vector gη, or ηg."""
        return q.times(self.g, eta) if self.of.left else q.times(eta, self.g)

    def advected_rate(self, field: Field) -> Matrix:
        """η of V."""
        Y, X = field
        if self.of.left:
            return q.minus(q.times(q.times(self.back, Y), self.g), X)
        return q.minus(Y, q.times(q.times(self.g, X), self.back))

    def paired(self, z: Matrix) -> Any:
        """⟨Π, z⟩ for z in 𝔤, with Π = ∂L̃/∂ζ."""
        return q.dot(self.slopes[1 + len(self.of.entries) :], self.of.group.nearest(z))

    def row(self, fields: Sequence[Field]) -> list[Any]:
        """δL̃ − dF/dt for each monomial of F, V₁, V₀ and τ."""
        turning, still = [], []
        for field in fields:
            eta = self.advected_rate(field)
            turn = field[1] if self.of.left else field[0]
            along = self.tangent_vector(eta)
            pairs = zip(self.slopes[1:], self.of.entries, strict=False)
            pushed = sum(x * along[i][j] for x, (i, j) in pairs)
            own = self.paired(q.bracket(turn, self.Z)) + pushed
            still.append(own)
            turning.append(self.leaves[0] * own + self.paired(eta))
        return [*(-x for x in self.rates), *turning, *still, self.slopes[0]]

    @property
    def rates(self) -> Iterator[Any]:
        """The rates of the monomials of F."""
        velocity = self.tangent_vector(self.Z)
        rate = [1, *(velocity[i][j] for i, j in self.of.entries)]
        for first, *second in self.of.monomials:
            if second:
                k = second[0]
                yield self.leaves[first] * rate[k] + rate[first] * self.leaves[k]
            else:
                yield rate[first]

    def conserved(self, fields: Sequence[Field]) -> list[Any]:
        """⟨Π, η⟩ − τh̃ − F for each of the same."""
        still = [self.paired(self.advected_rate(field)) for field in fields]
        minus_f = (-prod(self.leaves[k] for k in m) for m in self.of.monomials)
        return [*minus_f, *(self.leaves[0] * x for x in still), *still, -self.energy]

    @property
    def energy(self) -> Any:
        """h̃."""
        return self.paired(self.Z) - self.value

    def conserved_by(
        self, listed: Listed, parameters: Mapping[Tree, Residue], functions: ResidueFunctions
    ) -> Any:
        """⟨Π, η⟩ − τh̃ − F for a field given by trees."""
        scalar = self.scalar(parameters, functions)
        moved = displaced(listed.displacement, self.g, scalar)
        eta = q.times(*((self.back, moved) if self.of.left else (moved, self.back)))
        return self.paired(eta) - (scalar(listed.time) * self.energy + scalar(listed.F))

    def scalar(
        self, parameters: Mapping[Tree, Residue], functions: ResidueFunctions
    ) -> Callable[[Tree], Any]:
        """The values of trees of the time, the entries of g and parameters."""
        at = {"t": self.leaves[0], **parameters, **_entries(self.g)}

        def of(t: Tree) -> Any:
            found = value(t, at, self.p, functions)
            return found.n if isinstance(found, Residue) else found

        return of


def _entries(g: Matrix) -> dict[Tree, Any]:
    return {("entry", "A", i, j): x for i, row in enumerate(g, 1) for j, x in enumerate(row, 1)}


def displaced(t: Tree, g: Matrix, scalar: Callable[[Tree], Any]) -> Matrix:
    """The value of δA, a sum of products of numbers, matrices and A."""
    if t == "A":
        return g
    if t == 0:
        return q.scaled(0, g)
    if not isinstance(t, tuple) or t[0] not in ("matrix", "add", "mul"):
        raise RecordError("δA is no sum of products of matrices and A")
    if t[0] == "matrix":
        return q.matrix([[scalar(x) for x in operands(row)] for row in operands(t)])
    if t[0] == "add":
        return reduce(q.plus, (displaced(x, g, scalar) for x in operands(t)))
    found = q.identity(len(g))
    for x in operands(t):
        if x == "A" or begins(x, "matrix") or begins(x, "add"):
            found = q.times(found, displaced(x, g, scalar))
        else:
            found = q.scaled(scalar(x), found)
    return found


def _of_state(x: Tree) -> bool:
    """Does it depend on the time, g or ζ?"""
    return any(y == "t" or begins(y, "entry") for y in nodes(x))


def each(x: Any, count: int, p: int) -> list[int]:
    """A number at each of so many points."""
    return x.values if isinstance(x, ResidueVector) else [residue_of(x, p)] * count


def _rows(columns: Iterable[Any], count: int, p: int) -> list[list[int]]:
    """The numbers at each of so many points."""
    return [[*row] for row in zip(*(each(x, count, p) for x in columns), strict=True)]


# The claims about the symmetries of a Lagrangian: how many there are, as many independent ones
# are listed, which functions in it were taken for any numbers.

Judge = Callable[[SymmetryCount, Derivation, Step, Claim], str]
ON_FORM: Tree = ("call", "ϖ", "δy")
LISTED = re.compile(r"\.conserved_[0-9]+$")


def _dimension(found: SymmetryCount, record: Derivation, step: Step, claim: Claim) -> str:
    """The dimension is that of all symmetries, and as many are listed."""
    told = dict(claim.values).get("dimension", 0)
    held = bool(record.problem["lagrangian"].get("held"))
    if held is not (claim.kind == "symmetries.algebra_modulo") and told != 0:
        return "it is modulo those without kinetic energy, or not"
    if found.open_functions and not any(x.kind == "symmetries.open" for x in step.claims):
        return "functions were taken for any numbers"
    if told != found.dimension:
        return f"the dimension is {found.dimension}"
    listed = [_listed(x) for x in record.steps if LISTED.search(x.label)]
    if told != len(listed):
        return f"{len(listed)} are listed"
    return "" if found.independent(listed) else "those that are listed depend on one another"


def _listed(step: Step) -> Listed:
    """The field of a step about a symmetry, and F, which is taken from ϖ of the field."""
    field = {e.lhs: e.rhs for e in step.given}
    forms = [terms(e.lhs) for e in step.equations if ON_FORM in terms(e.lhs)]
    if {*field} != {"δt", "δA"} or len(forms) != 1:
        raise RecordError(f"the step {step.label} lists no symmetry")
    F = neg(add(*(x for x in forms[0] if x != ON_FORM)))
    return Listed(field["δt"], field["δA"], F)


def _open(found: SymmetryCount, record: Derivation, step: Step, claim: Claim) -> str:
    names = claim["functions"]
    same = names == ("row", *found.open_functions)
    return "" if same else f"they are {', '.join(found.open_functions) or 'none'}"


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(
        ("symmetries.algebra", "symmetries.algebra_modulo", "symmetries.none"), _dimension
    ),
    "symmetries.open": _open,
}
