"""The symmetries of a problem, their brackets, and the names of what they keep."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from ...algebra.exact_kernel import ResidueVector, kernel
from ...algebra.groups import Group
from ...code.graph import Graph
from ...code.options import Options
from ...code.state import StateSpace
from ...language import rational as q
from ...language.tree import Tree, add, coefficient, mul, neg, nodes, terms
from ...problem.entries_on_orbit import along, element, hessian, null_directions, times
from ...problem.fields import coordinates
from ...problem.problem import Problem, ProblemError
from ...record.record import Derivation
from ...schema.body_kinds import Place, Point
from ...schema.kind import Lagrangian
from ...schema.potential_kinds import SelfGravity
from .conditions import SymmetryConditions, TangentField, values
from .scalar_lagrangian import (
    Integrand,
    by_state,
    full,
    negative,
    plus,
    varying,
    with_scalar_lagrangian,
)
from .search import SymmetrySearch
from .symmetry import Symmetry, momenta_on, of_solution

# The brackets of symmetries, and dϖ of two that commute: the cocycle of the conserved quantities.
#
# dϖ(δ, δ′) = δ′F − δF′ + ϖ([δ, δ′]),  for δL̃ = dF/dt and δ′L̃ = dF′/dt
#
# so that it is a number where [δ, δ′] = 0: the same at all points, and there is no other choice
# of F for which it vanishes (Galilei's group: the mass). No bracket has a square of the time: in
# that of (t K − f) and (t K′ − f′) it would be {K, K′}, kept together with t²{K, K′} + t h, h a
# function on the group; so {K, K′} = h = 0. The symmetries are therefore a Lie algebra.

Vector = list[ResidueVector]
"""Coordinates, each for all values of the parameters."""


class Brackets:
    """The brackets of the symmetries that a search has found, for each value of the parameters."""

    def __init__(self, search: SymmetrySearch):
        self.search, self.p = search, search.p
        unknowns = search.system.unknowns
        self.fields = unknowns.fields
        first, count = unknowns.first_field, len(self.fields)
        _, table = search.samples
        zero = ResidueVector([0] * len(search.samples[0]), self.p)
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
        points = 2 * group.size**2
        basis = [values(x, group, points, p) for x in self.fields]
        count, brackets = len(self.fields), dict[tuple[int, int], TangentField]()
        for a, x in enumerate(self.fields):
            for b, y in enumerate(self.fields[:a]):
                z = TangentField(q.bracket(y.Y, x.Y), q.bracket(y.X, x.X))
                if any(map(any, (*z.Y, *z.X))):
                    brackets[b, a] = z
        columns = [*basis, *(values(z, group, points, p) for z in brackets.values())]
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
        for (a, b), bracket in self.of_fields.items():
            if x[a] and y[b]:
                weight = x[a] * y[b]
                for k, c in bracket.items():
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


# The symmetries of a problem, all of the kind that is searched, as data.

ORDER: tuple[str, ...] = (
    *("time", "translation_space", "rotation_space", "displacement_space", "deformation_space"),
    *("boost", "translation_body", "rotation_body", "displacement_body", "deformation_body"),
    *("rotation_alone", "both", "moving"),
)
"""The kinds of symmetries in the order in which they are listed."""


@dataclass(frozen=True)
class Central:
    """Two symmetries, by their places, that commute with dϖ(δ, δ′) = ``number``."""

    first: int
    second: int
    number: Tree


@dataclass(frozen=True)
class SymmetriesFound:
    """``problem``: with L̃ as one expression; ``functions``: those in L̃ whose values were taken for
    any numbers; ``state``: the numbers of the state in the emitted code, by their names, and what
    they are; ``commuting``: the pairs of symmetries, by their places, whose bracket is 0."""

    problem: Problem
    symmetries: tuple[Symmetry, ...]
    functions: tuple[str, ...]
    central: tuple[Central, ...]
    state: Mapping[str, Tree]
    commuting: tuple[frozenset[int], ...] = ()
    integrand: Integrand | None = None
    """What stands for an integral in L̃, where it has one."""
    of_points: bool = False
    """Is L̃ that of a body of points, of which symmetries of the body may change the labels?"""

    @property
    def lagrangian(self) -> Lagrangian:
        """L̃ as one expression."""
        return self.problem.own_lagrangian

    def require_whole(self) -> None:
        """``ProblemError`` where the energy is that of an integrand."""
        if self.integrand:
            raise ProblemError(
                f"{self.problem.name}: the energy has an integral, of which L̃ here has the "
                "integrand; derive emit --conserved writes what is kept"
            )

    @property
    def dimension(self) -> int:
        """The dimension of their Lie algebra."""
        return len(self.symmetries)


def symmetries_of(
    problem: Problem, record: Derivation, *, of_integrand: bool = False
) -> SymmetriesFound:
    """All symmetries of a problem; ``ProblemError`` where it has no Lagrangian of its own.

    ``of_integrand``: may L̃ have the integrand of an integral in its place?
    """
    integral = of_integrand and any(isinstance(p, SelfGravity) for p in problem.potentials)
    integrand = Integrand.with_free_names(problem.parameters) if integral else None
    scalar = with_scalar_lagrangian(problem, record, integrand)
    of_points = problem.lagrangian is None
    system = SymmetryConditions(scalar)
    search, state = SymmetrySearch(system), emitted_state(problem)
    found = [of_solution(x, system.unknowns, system.group, system.side) for x in search.solutions()]
    told = [k for k, x in enumerate(found) if not says_nothing(x, scalar)]
    if integrand:
        integrand.require_unused(t for x in found for t in (x.displacement, x.F))
    order = sorted(told, key=lambda k: (ORDER.index(found[k].kind), -k))
    listed = tuple(found[k] for k in order)
    every = Brackets(search).commuting() if told else ()
    commuting = [(i, j) for i, j in every if {i, j} <= {*told}]
    pairs = [
        _oriented(order.index(i), order.index(j), number)
        for i, j in commuting
        if (number := cocycle(found[i], found[j])) != 0
    ]
    central = tuple(sorted(pairs, key=lambda x: (x.first, x.second)))
    places = tuple(frozenset((order.index(i), order.index(j))) for i, j in commuting)
    return SymmetriesFound(
        scalar, listed, system.open_functions, central, state, places, integrand, of_points
    )


def conserved_with_damping(problem: Problem, record: Derivation) -> SymmetriesFound:
    """The symmetries of L̃ whose quantities the motion of a damped problem keeps: they shift no
    instant and move damped points r_i by constants w_i, 0 or not.  The forces −κ_i v_i change what
    is kept by the symmetry at the rate −Σ κ_i ⟨v_i, w_i⟩, so that with Σ κ_i ⟨r_i, w_i⟩ it is kept
    again.  ``ProblemError`` where none is so."""
    found = symmetries_of(replace(problem, damping=()), record, of_integrand=True)
    group = found.problem.own_group
    points: tuple[Point | Place, ...] = (*problem.points, *problem.places)
    listed = [(kappa, points[i - 1]) for kappa, i in problem.damped_points]
    damped = [
        (kappa, (*problem.own_group.in_block(p.block, p.at, 1), 1)[: group.size])
        for kappa, p in listed
    ]
    still = [y for x in found.symmetries if x.tau == 0 and (y := _damped(x, damped, group))]
    if not still:
        raise ProblemError(
            f"{problem.name}: damping changes the energy at the rate −Σ κ |v|², and no momentum is "
            "known to be kept: no symmetry of L̃ moves the damped points by constants alone"
        )
    return replace(found, symmetries=tuple(still), central=(), commuting=())


def _damped(
    x: Symmetry, damped: Iterable[tuple[Tree, Sequence[Tree]]], group: Group
) -> Symmetry | None:
    """A symmetry with F − Σ κ_i ⟨r_i, w_i⟩ in the place of F, w_i = (YA − AX)(r, 1); ``None`` where
    these are not constant."""
    g, (Y, X), more = element(group), x.matrices, []
    for kappa, place in damped:
        r = [[y] for y in place]
        moved = plus(times(Y, times(g, r)), negative(times(g, times(X, r))))
        for row, (entry,) in zip(g, moved, strict=True):
            w = by_state(entry)
            if any(y == "t" or (isinstance(y, tuple) and y[0] == "entry") for y in nodes(w)):
                return None
            for y, r_k in zip(row, place, strict=True):
                weight = mul(-1, kappa, w, r_k)
                more.append((weight, (y,)) if isinstance(y, tuple) else (mul(y, weight), ()))
    return replace(x, terms=(*x.terms, *((c, m) for c, m in more if c != 0)))


def says_nothing(x: Symmetry, problem: Problem) -> bool:
    """Is what the motion keeps by it 0 whatever the motion is, along what has no kinetic energy?"""
    given, group = problem.own_lagrangian, problem.own_group
    if not given.held:
        return False
    second = hessian(given.L, coordinates(group))
    momenta = momenta_on(group)
    for k, direction in zip(given.held, null_directions(second) or (), strict=True):
        others = [0 if a == k - 1 else y for a, y in enumerate(direction)]
        momenta[k - 1] = neg(along(momenta, tuple(map(Fraction, others))))
    return by_state(x.conserved(momenta)) == 0


def _oriented(i: int, j: int, number: Tree) -> Central:
    """The pair in the order in which the first term of the number is positive."""
    if coefficient(terms(number)[0])[0] < 0:
        return Central(j, i, by_state(neg(number)))
    return Central(i, j, number)


def emitted_state(problem: Problem) -> dict[str, Tree]:
    """The numbers of the state in the emitted code: A and T of each factor, then ζ."""
    group = problem.own_group.in_user_basis
    found: list[Tree] = []
    for offset, factor in group.places:
        rows = range(offset + 1, offset + factor.n + 1)
        found += [("entry", "A", i, j) for i in rows for j in rows if not factor.vectors]
        found += [("entry", "A", i, offset + factor.size) for i in rows if factor.affine]
    held = problem.lagrangian.held if problem.lagrangian else ()
    names = StateSpace(Graph(), problem.own_group, Options(), held=held).names
    zeta = [z for a, z in enumerate(coordinates(group), 1) if a not in held]
    return dict(zip(names, found + zeta, strict=True))


# The names of conserved quantities in emitted code, and their expressions: of a direction, or of
# a turn of R³, the component along its unit vector.

NAMES = {
    "time": "energy",
    "translation_space": "momentum",
    "rotation_space": "angular_momentum",
    "displacement_space": "screw_momentum",
    "deformation_space": "deformation_momentum",
    "boost": "centre",
    "translation_body": "body_momentum",
    "rotation_body": "body_angular_momentum",
    "displacement_body": "body_screw_momentum",
    "deformation_body": "body_deformation_momentum",
    "rotation_alone": "orbital_angular_momentum",
    "both": "combined_momentum",
    "moving": "time_dependent_integral",
}
"""What is kept by a symmetry of a kind."""

CIRCULATION = "circulation"
"""What is kept by a relabelling of a body that its group deforms, be it a turn or not."""


def named(found: SymmetriesFound) -> dict[str, Tree]:
    """Name → the quantity, in Π_a, h̃, t, the entries of g and the parameters.

    ``momentum_1`` …: along an axis, if all of a kind are; else numbered; alone without a number.
    """
    called = [
        (CIRCULATION, axis_of_relabelling(x))
        if found.of_points and relabels(x)
        else (NAMES[x.kind], axis(x))
        for x in found.symmetries
    ]
    many = Counter(base for base, _ in called)
    by_axis = {
        base: all(own) and len({*own}) == len(own)
        for base in many
        if (own := [a for b, a in called if b == base])
    }
    names, seen = {}, Counter[str]()
    for x, (base, place) in zip(found.symmetries, called, strict=True):
        seen[base] += 1
        number = f"_{place}" if by_axis[base] else f"_{seen[base]}" if many[base] > 1 else ""
        value, length = x.conserved(), length_of(x)
        plain = length == 1 or base == CIRCULATION
        names[base + number] = value if plain else ("div", value, length)
    return names


def length_of(x: Symmetry) -> Tree:
    """The length of the vector along which it shifts, or about which it turns R³, in the parameters
    that the vector has; 1 of any other."""
    shown = next((m for m in (*x.still, x.moving[0]) if full(m)), ())
    shifts = x.kind.startswith(("translation", "boost"))
    if not shifts and not x.kind.startswith(("rotation", "displacement")):
        return 1
    for offset, factor in x.group.places:
        rows = range(offset, offset + factor.n)
        pairs = [(i, offset + factor.n) for i in rows if factor.affine] if shifts else []
        if not shifts and factor.n == 3:
            pairs = [(i, j) for i in rows for j in rows if i < j]
        entries = [shown[i][j] for i, j in pairs if shown[i][j] != 0]
        if entries:
            square = by_state(add(*(("pow", y, 2) for y in entries)))
            return 1 if square == 1 else ("fun", "sqrt", square)
    return 1


def axis(x: Symmetry) -> str:
    """The number of the axis along which it shifts, or about which it turns; of more dimensions
    than three the two of the plane; empty where it is along none, or not of this kind."""
    (Y, X), moving = x.still, x.moving[0]
    shown = next((m for m in (Y, X, moving) if full(m)), ())
    places = [(i + 1, j + 1) for i, row in enumerate(shown) for j, y in enumerate(row) if y != 0]
    if x.kind.startswith(("translation", "boost")):
        return str(places[0][0]) if len(places) == 1 else ""
    if not x.kind.startswith("rotation") or len(places) != 2 or places[0] != places[1][::-1]:
        return ""
    return _axis_of_plane(x, *places[0])


def relabels(x: Symmetry) -> bool:
    """Of a body of points: does it change their labels alone, δA = −AX with XJ + JX̄ = 0?

    ½ Tr(Z J Z̄ C) is left as it is where Tr Z(XJ + JX̄)Z̄C = 0; with all Z = uv̄, ⟨u, v⟩ = 0, among
    the velocities, as where all maps that keep the volume are in the group, XJ + JX̄ = 0.
    """
    if x.kind not in ("rotation_body", "deformation_body"):
        return False
    X = x.still[1]
    return all(
        factor.keeps_no_more_than_volume
        for offset, factor in x.group.places
        if full([row[offset : offset + factor.size] for row in X])
    )


def axis_of_relabelling(x: Symmetry) -> str:
    """That of the skew W in X = WJ⁻¹, by the rows of X; empty where W turns more than a plane."""
    rows = [i for i, row in enumerate(x.still[1], 1) if any(by_state(y) != 0 for y in row)]
    return _axis_of_plane(x, *rows) if len(rows) == 2 else ""


def _axis_of_plane(x: Symmetry, i: int, j: int) -> str:
    """The number of the axis of R³ about which a plane turns, else the two numbers of the plane."""
    spatial = [factor.n for _, factor in x.group.places] == [3]
    return str(6 - i - j) if spatial else f"{i}{j}"
