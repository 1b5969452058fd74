"""The symmetries of a problem, all of the kind that is searched, as data."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from ..algebra.groups import Group
from ..code.graph import Graph
from ..code.options import Options
from ..code.state import StateSpace
from ..language.tree import Tree, coefficient, mul, neg, nodes, terms
from ..problem.moved_entries import element
from ..problem.null_directions import along, hessian, null_directions
from ..problem.problem import Problem, ProblemError
from ..problem.state_names import coordinates
from ..record.record import Derivation
from ..schema.body_kinds import Place, Point
from ..schema.kinds.self_gravity import SelfGravity
from ..schema.lagrangian_kinds import Lagrangian
from .conditions import Conditions
from .field_brackets import Brackets, cocycle
from .scalar_lagrangian import Integrand, by_state, with_scalar_lagrangian
from .search import Search
from .symmetry import Symmetry, of_solution
from .tree_matrices import negative, plus, times

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
class Found:
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
        assert self.problem.lagrangian is not None
        return self.problem.lagrangian

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


def symmetries_of(problem: Problem, record: Derivation, *, of_integrand: bool = False) -> Found:
    """All symmetries of a problem; ``ProblemError`` where it has no Lagrangian of its own.

    ``of_integrand``: may L̃ have the integrand of an integral in its place?
    """
    integral = of_integrand and any(isinstance(p, SelfGravity) for p in problem.potentials)
    integrand = Integrand.beside(problem.parameters) if integral else None
    scalar = with_scalar_lagrangian(problem, record, integrand)
    of_points = problem.lagrangian is None
    system = Conditions(scalar)
    search, state = Search(system), emitted_state(problem)
    found = [of_solution(x, system.unknowns, system.group, system.side) for x in search.solutions()]
    told = [k for k, x in enumerate(found) if not says_nothing(x, scalar)]
    if integrand:
        integrand.require_unused(t for x in found for t in (x.displacement, x.F))
    order = sorted(told, key=lambda k: (ORDER.index(found[k].kind), -k))
    listed = tuple(found[k] for k in order)
    if not listed:
        return Found(scalar, (), system.open_functions, (), state, (), integrand, of_points)
    commuting = [(i, j) for i, j in Brackets(search).commuting() if {i, j} <= {*told}]
    pairs = [
        _oriented(order.index(i), order.index(j), number)
        for i, j in commuting
        if (number := cocycle(found[i], found[j])) != 0
    ]
    central = tuple(sorted(pairs, key=lambda x: (x.first, x.second)))
    places = tuple(frozenset((order.index(i), order.index(j))) for i, j in commuting)
    return Found(
        scalar, listed, system.open_functions, central, state, places, integrand, of_points
    )


def kept_with_damping(problem: Problem, record: Derivation) -> Found:
    """The symmetries of L̃ whose quantities the motion of a damped problem keeps: they shift no
    instant and move damped points r_i by constants w_i, 0 or not.  The forces −κ_i v_i change what
    is kept by the symmetry at the rate −Σ κ_i ⟨v_i, w_i⟩, so that with Σ κ_i ⟨r_i, w_i⟩ it is kept
    again.  ``ProblemError`` where none is so."""
    found = symmetries_of(replace(problem, damping=()), record, of_integrand=True)
    group = found.problem.group
    assert group is not None
    assert problem.group is not None
    points: tuple[Point | Place, ...] = (*problem.points, *problem.places)
    listed = [(x.coefficient, points[i - 1]) for x in problem.damping for i in x.on]
    damped = [
        (kappa, (*problem.group.in_block(p.block, p.at, 1), 1)[: group.size]) for kappa, p in listed
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
    given, group = problem.lagrangian, problem.group
    assert given is not None
    assert group is not None
    if not given.held:
        return False
    second = hessian(given.L, coordinates(group))
    momenta: list[Tree] = [("at", "Π", a) for a in range(1, group.dimension + 1)]
    for k, direction in zip(given.held, null_directions(second) or (), strict=True):
        others = [0 if a == k - 1 else y for a, y in enumerate(direction)]
        momenta[k - 1] = neg(along(momenta, tuple(map(Fraction, others))))
    return by_state(x.conserved(momenta, "h̃")) == 0


def _oriented(i: int, j: int, number: Tree) -> Central:
    """The pair in the order in which the first term of the number is positive."""
    if coefficient(terms(number)[0])[0] < 0:
        return Central(j, i, by_state(neg(number)))
    return Central(i, j, number)


def emitted_state(problem: Problem) -> dict[str, Tree]:
    """The numbers of the state in the emitted code: A and T of each factor, then ζ."""
    assert problem.group is not None
    group = problem.group.stated
    found: list[Tree] = []
    for offset, factor in group.places:
        rows = range(offset + 1, offset + factor.n + 1)
        found += [("entry", "A", i, j) for i in rows for j in rows]
        found += [("entry", "A", i, offset + factor.size) for i in rows if factor.affine]
    held = problem.lagrangian.held if problem.lagrangian else ()
    names = StateSpace(Graph(), problem.group, Options(), held=held).names
    zeta = [z for a, z in enumerate(coordinates(group), 1) if a not in held]
    return dict(zip(names, found + zeta, strict=True))
