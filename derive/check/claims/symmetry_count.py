"""How many symmetries a Lagrangian has among the fields that are searched."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement
from math import prod
from operator import mul
from random import Random
from typing import Any, NamedTuple

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
from ...language.tree import Tree, add, neg, nodes, operands, terms
from ...record.as_json import decode
from ...record.record import Derivation, RecordError, Step
from ...record.sentence import Claim
from ..values.residue import Residue
from .entries_checked import constant_entries
from .modular_values import Functions, Jet, UnluckyError, value

Square = list[list[int]]
"""A square matrix of residues."""
Field = tuple[Square, Square]
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
        self.parameters: list[Tree] = [x for x in seen if _is_parameter(x)]
        roots = sum(_is(x, "fun", "sqrt") and _of_state(x) for x in seen)
        self.true_roots = roots <= ROOTS
        self.oversampling = 2**roots if self.true_roots else 1
        functions = {x[1] for x in seen if isinstance(x, tuple) and x[0] == "fun"}
        self.open_functions = sorted(functions - ({"sqrt"} if self.true_roots else set()))

    @cached_property
    def dimension(self) -> int:
        """How many there are, for generic parameters."""
        return self._modulo_a_prime(self._counted)

    def independent(self, listed: Sequence[Listed]) -> bool:
        """Is no combination of what the motion keeps by these symmetries constant, for generic
        parameters?"""
        return self._modulo_a_prime(lambda p: self._rank(listed, p)) == len(listed)

    def _modulo_a_prime(self, found: Callable[[int], int]) -> int:
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
        letters = dict.fromkeys([*self.parameters, *(x for x in seen if _is_parameter(x))])
        parameters = {x: self.random.randrange(1, p) for x in letters}
        points = self._points(len(listed) + SPARE, parameters, p)
        functions = Functions(ResidueVectorSource(p, 1, self._seed()), roots=self.true_roots)
        rows = [[x.conserved_by(field, parameters, functions) for x in points] for field in listed]
        one = [1] * len(points)
        return len(pivots([one, *rows], len(one), p)) - 1

    def _counted(self, p: int) -> int:
        """The dimension modulo a prime."""
        parameters = {x: self.random.randrange(1, p) for x in self.parameters}
        fields = self._tangent_fields(p)
        columns = len(self.monomials) + 2 * len(fields) + 1
        points = self._points(columns + SPARE, parameters, p)
        found = kernel((x.row(fields) for x in points), columns, p)[0]
        tried = self._points(len(found) + SPARE, parameters, p)
        values = [x.conserved(fields) for x in tried]
        kept = [[sum(map(mul, v, row)) % p for row in values] for v in found]
        one = [1] * len(tried)
        return len(pivots([one, *kept], len(one), p)) - 1

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
        size, rows = self.group.size, list[list[int]]()
        normal = [_residues(m, p) for m in self.group.normal_space]
        source = ResidueVectorSource(p, 2 * size**2 // max(1, len(normal)) + SPARE, self._seed())
        for g, back in zip(*self._sampled(source), strict=True):
            for m in normal:
                pulled = _times(_times(_transposed(back), m, p), _transposed(g), p)
                rows.append([*_flat(pulled), *(-x % p for x in _flat(m))])
        found = kernel(rows, 2 * size**2, p)[0]
        return [(_square(v[: size**2], size), _square(v[size**2 :], size)) for v in found]

    def _seed(self) -> int:
        return self.random.getrandbits(64)

    def _sampled(self, source: ResidueVectorSource) -> tuple[list[Square], list[Square]]:
        """Random elements with their inverses."""
        zero = source.constant(0)
        g = [[(zero + x).values for x in row] for row in self.group.sample_inside(source, 1)]
        each = [[[x[k] for x in row] for row in g] for k in range(source.points)]
        return each, [_inverse(x, source.p) for x in each]

    def _points(self, several: int, parameters: Mapping[Tree, int], p: int) -> list[JetPoint]:
        """So many points of R × G × 𝔤; ``UnluckyError`` for fewer."""
        count = several if self.oversampling == 1 else self.oversampling * several * 5 // 4 + SPARE
        source = ResidueVectorSource(p, count, self._seed())
        g, back = self._sampled(source)
        t, *zeta = (source.randint(1, p) for _ in range(self.group.dimension + 1))
        leaves: dict[Tree, ResidueVector] = {"t": t}
        for i, j in self.entries:
            leaves["entry", "A", i + 1, j + 1] = ResidueVector([x[i][j] for x in g], p)
        leaves |= {("entry", "ζ", a): x for a, x in enumerate(zeta, 1)}
        at: dict[Tree, Any] = {**parameters}
        at |= {
            ("entry", "A", i + 1, j + 1): g[0][i][j]
            for i, row in enumerate(g[0])
            for j, _ in enumerate(row)
        }
        at |= {x: Jet(y, {k: 1}, p) for k, (x, y) in enumerate(leaves.items())}
        functions = Functions(source, roots=self.true_roots)
        L = Jet(source.constant(0), {}, p) + value(self.tree, at, p, functions)
        slopes = [_spread(L.slopes.get(k, 0), count) for k, _ in enumerate(leaves)]
        values, drawn = _spread(L.n, count), [x.values for x in leaves.values()]
        valid = [k for k, holds in enumerate(functions.valid) if holds][:several]
        if len(valid) < several:
            raise UnluckyError

        def at_point(k: int) -> JetPoint:
            own, derived = ([x[k] for x in y] for y in (drawn, slopes))
            return JetPoint(self, p, g[k], back[k], own, derived, values[k])

        return [*map(at_point, valid)]


class Listed(NamedTuple):
    """A symmetry as a record lists it: δt = τ, δA, and F."""

    time: Tree
    displacement: Tree
    F: Tree


@dataclass(frozen=True)
class JetPoint:
    """A point modulo p: g, g⁻¹, the values of t, the entries of g and ζ, the slopes of L̃ by these,
    and L̃."""

    of: SymmetryCount
    p: int
    g: Square
    back: Square
    leaves: Sequence[int]
    slopes: Sequence[int]
    value: int

    @cached_property
    def Z(self) -> Square:
        """The velocity in 𝔤."""
        zeta = self.leaves[1 + len(self.of.entries) :]
        return _residues(q.combine(zeta, self.of.group.basis), self.p)

    @property
    def momenta(self) -> Sequence[int]:
        """∂L̃/∂ζ."""
        return self.slopes[1 + len(self.of.entries) :]

    def tangent_vector(self, eta: Square) -> Square:
        """The tangent vector gη, or ηg."""
        return _times(*((self.g, eta) if self.of.left else (eta, self.g)), self.p)

    def advected_rate(self, field: Field) -> Square:
        """η of V."""
        Y, X = field
        if self.of.left:
            return _minus(_times(_times(self.back, Y, self.p), self.g, self.p), X, self.p)
        return _minus(Y, _times(_times(self.g, X, self.p), self.back, self.p), self.p)

    def paired(self, z: Square) -> int:
        """⟨Π, z⟩ for z in 𝔤."""
        total = 0
        for a, pi in enumerate(self.momenta):
            terms = self.of.group.coordinate_terms(a)
            total += pi * sum(residue_of(c, self.p) * z[i][j] for c, i, j in terms)
        return total % self.p

    def row(self, fields: Sequence[Field]) -> list[int]:
        """δL̃ − dF/dt for each monomial of F, V₁, V₀ and τ."""
        t, p = self.leaves[0], self.p
        turning, still = [], []
        for field in fields:
            eta = self.advected_rate(field)
            turn = field[1] if self.of.left else field[0]
            along = self.tangent_vector(eta)
            pairs = zip(self.slopes[1:], self.of.entries, strict=False)
            pushed = sum(x * along[i][j] for x, (i, j) in pairs)
            own = self.paired(_minus(_times(turn, self.Z, p), _times(self.Z, turn, p), p)) + pushed
            still.append(own % p)
            turning.append((t * own + self.paired(eta)) % p)
        return [*(-x % p for x in self.rates), *turning, *still, self.slopes[0] % p]

    @property
    def rates(self) -> Iterator[int]:
        """The rates of the monomials of F."""
        velocity = self.tangent_vector(self.Z)
        rate = [1, *(velocity[i][j] for i, j in self.of.entries)]
        for first, *second in self.of.monomials:
            if second:
                k = second[0]
                yield self.leaves[first] * rate[k] + rate[first] * self.leaves[k]
            else:
                yield rate[first]

    def conserved(self, fields: Sequence[Field]) -> list[int]:
        """⟨Π, η⟩ − τh̃ − F for each of the same."""
        t, p = self.leaves[0], self.p
        still = [self.paired(self.advected_rate(field)) for field in fields]
        minus_f = (-prod(self.leaves[k] for k in m) % p for m in self.of.monomials)
        return [*minus_f, *(t * x % p for x in still), *still, -self.energy % p]

    @property
    def energy(self) -> int:
        """h̃."""
        return self.paired(self.Z) - self.value

    def conserved_by(
        self, listed: Listed, parameters: Mapping[Tree, int], functions: Functions
    ) -> int:
        """⟨Π, η⟩ − τh̃ − F for a field given by trees."""
        at = {"t": self.leaves[0], **parameters}
        at |= {
            ("entry", "A", i, j): x for i, row in enumerate(self.g, 1) for j, x in enumerate(row, 1)
        }

        def scalar(t: Tree) -> int:
            return int(value(t, at, self.p, functions))

        moved = _matrix(listed.displacement, self.g, scalar, self.p)
        eta = _times(*((self.back, moved) if self.of.left else (moved, self.back)), self.p)
        rest = scalar(listed.time) * self.energy + scalar(listed.F)
        return (self.paired(eta) - rest) % self.p


def _matrix(t: Tree, g: Square, scalar: Callable[[Tree], int], p: int) -> Square:
    """The value of δA, a sum of products of numbers, matrices and A."""
    if t == "A":
        return g
    if t == 0:
        return [[0 for _ in row] for row in g]
    if not isinstance(t, tuple) or t[0] not in ("matrix", "add", "mul"):
        raise RecordError("δA is no sum of products of matrices and A")
    if t[0] == "matrix":
        return [[scalar(x) for x in operands(row)] for row in operands(t)]
    if t[0] == "add":
        parts = [_matrix(x, g, scalar, p) for x in operands(t)]
        return [
            [sum(entries) % p for entries in zip(*rows, strict=True)]
            for rows in zip(*parts, strict=True)
        ]
    found = [[int(i == j) for j, _ in enumerate(g)] for i, _ in enumerate(g)]
    for x in operands(t):
        if x == "A" or _is(x, "matrix") or _is(x, "add"):
            found = _times(found, _matrix(x, g, scalar, p), p)
        else:
            factor = scalar(x)
            found = [[factor * y % p for y in row] for row in found]
    return found


def _is_parameter(x: Tree) -> bool:
    return x == "π" or _is(x, "par")


def _is(x: Tree, *head: str) -> bool:
    return isinstance(x, tuple) and x[: len(head)] == head


def _of_state(x: Tree) -> bool:
    """Does it depend on the time, g or ζ?"""
    return any(y == "t" or _is(y, "entry") for y in nodes(x))


# -- matrices of residues -------------------------------------------------------------------------


def _residues(m: q.Matrix, p: int) -> Square:
    return [[residue_of(x, p) for x in row] for row in m]


def _times(a: Square, b: Square, p: int) -> Square:
    columns = _transposed(b)
    return [[sum(map(mul, row, c)) % p for c in columns] for row in a]


def _minus(a: Square, b: Square, p: int) -> Square:
    return [[(x - y) % p for x, y in zip(r, s, strict=True)] for r, s in zip(a, b, strict=True)]


def _transposed(a: Square) -> Square:
    return [[*x] for x in zip(*a, strict=True)]


def _inverse(a: Square, p: int) -> Square:
    found = q.inverse(tuple(tuple(Residue(x, p) for x in row) for row in a))
    if found is None:
        raise UnluckyError
    return [[x.n if isinstance(x, Residue) else residue_of(x, p) for x in row] for row in found]


def _flat(a: Square) -> list[int]:
    return [x for row in a for x in row]


def _square(v: Sequence[int], size: int) -> Square:
    return [[*v[i * size : (i + 1) * size]] for i in range(size)]


def _spread(x: Any, count: int) -> list[int]:
    """A number at each of so many points."""
    return [x] * count if isinstance(x, int) else x.values


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
