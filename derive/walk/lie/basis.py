"""The basis of 𝔤 in which a Lagrangian is expressed: coordinates, brackets, and how what it depends
on moves with the group."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from ...algebra.groups import Group
from ...language.tree import Tree, add, mul, plain
from ...problem.moved_entries import EntriesOfElement, Moved
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import Prose, listed
from ..chapter import Chapter
from ..coordinates import basis_equations
from ..wording import phrase, say
from .any_lagrangian import AnyLagrangian


@dataclass(frozen=True)
class Basis:
    """``moved``: the entries on which L̃ depends; ``rates``: equations that say how they move with
    time, which the step ``last`` has found."""

    moved: Moved
    rates: tuple[Equation, ...]
    last: Step
    brackets: tuple[Step, ...]
    steps: tuple[Step, ...]


def of_element(problem: Problem, group: Group, general: AnyLagrangian, c: Chapter) -> Basis:
    """Z = Σ ζ_a E_a, and Ȧ by it; [E_a, E_b]."""
    assert problem.lagrangian is not None
    draft = c.draft("coordinates", "coordinates")
    draft.depends_on(general["second_order"])
    rates = (Equation("Ȧ", general.velocity),)
    place = draft.step([*basis_equations(group), *rates], say("coordinates.basis") + _names(group))
    told = brackets(group, c)
    moved = EntriesOfElement(group, problem.lagrangian.trivialisation)
    return Basis(moved, rates, place, told, (place, *told))


def _names(group: Group) -> Prose:
    """Where in A what the names of the problem stand for is, where that is not A itself."""
    if len(group.places) < 2:
        (_, whole), *_ = group.places
        return say("coordinates.column") if whole.affine else ()
    blocks = [
        phrase("coordinates.block_and_column", name=f"A{k}", row=str(at + 1), column=f"T{k}")
        if factor.affine
        else phrase("coordinates.block", name=f"A{k}", row=str(at + 1))
        for k, (at, factor) in enumerate(group.places, 1)
    ]
    return say("coordinates.blocks", blocks=listed("{first}; {second}", blocks))


def brackets(group: Group, c: Chapter, *, shown: bool = True) -> tuple[Step, ...]:
    """[E_a, E_b] where it is not 0, after E_a as matrices where these are not many; ``shown``: are
    they those of the problem?"""
    table, span = group.structure_constants, range(group.dimension)
    listed = [
        Equation(("bracket", member("E", a), member("E", b)), _combined(table[a][b], "E"))
        for a in span
        for b in span
        if a < b and any(table[a][b])
    ]
    few = shown and group.dimension * group.size**2 <= MOST
    basis = _matrices(group) if few else []
    if not basis and not listed:
        return ()
    about = say("algebra.brackets" if listed else "algebra.abelian")
    prose = (say("algebra.matrices") if basis else ()) + about
    return (c.draft("algebra", "relation").step([*basis, *listed], prose),)


MOST = 160
"""So many entries have the matrices of a basis at most that are shown: those of SO(5) have 250,
those of SE(3) 96, those of GL(3) 81."""


def _matrices(group: Group) -> list[Equation]:
    """E_a as matrices."""
    return [
        Equation(member("E", a), ("matrix", *(("row", *map(plain, row)) for row in e)))
        for a, e in enumerate(group.basis)
    ]


def member(family: str, a: int) -> Tree:
    """The member of a family for E_a; a from 0."""
    return ("at", family, a + 1)


def _combined(coefficients: Iterable[Fraction], family: str) -> Tree:
    """Σ x_k Y_k over a family."""
    return add(*(mul(plain(x), member(family, k)) for k, x in enumerate(coefficients) if x))
