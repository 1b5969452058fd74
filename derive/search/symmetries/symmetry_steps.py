"""The symmetries of a problem as a record: L̃ and its momenta, then a step for each symmetry."""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra.groups import Group
from ...language.tree import Tree, add, neg
from ...problem.problem import Problem
from ...record.record import Derivation, Equation, Step, stated
from ...walk.chapter import Chapter, Values, phrase, say
from ...walk.lie import expressed
from ...walk.lie.expressed import of_element
from ...walk.spine.head import recorded
from .found_symmetries import Central, SymmetriesFound
from .symmetry import ON_FORM, Symmetry


@dataclass(frozen=True)
class Symmetries:
    """The symmetries of a problem, and their record."""

    found: SymmetriesFound
    record: Derivation


def record_of(found: SymmetriesFound, general: Values) -> Derivation:
    """The record of the symmetries of a problem; ``general``: the road of any Lagrangian."""
    c, group, before, (*_, basis) = expressed_on_basis(found.problem, general)
    whole = _summary(found, c)
    steps = [*before, whole]
    for k, x in enumerate(found.symmetries, 1):
        steps.append(_symmetry(x, f"conserved_{k}", group, (whole, basis), c))
    steps += [_central(found, x, whole, c) for x in found.central]
    return recorded(found.problem, steps)


def expressed_on_basis(
    problem: Problem, general: Values
) -> tuple[Chapter, Group, tuple[Step, ...], tuple[Step, ...]]:
    """The chapter and the group of a problem, the steps up to its L̃ on a basis, and the last of
    these: of L̃, of its momenta, of its energy and of the basis."""
    group, road = problem.group, general["lagrangian"]
    assert group is not None
    c = Chapter(problem.name, group.name)
    basis = of_element(problem, group, road, c)
    own = expressed.expressed(problem, group, road, basis, c).steps
    return c, group, (*general["steps"], *basis.steps, *own), (*own, basis.last)


def _summary(found: SymmetriesFound, c: Chapter) -> Step:
    """How many symmetries there are, of which kind; and why the motion keeps something by each."""
    draft = c.draft("symmetries", "kernel")
    modulo = bool(found.lagrangian.held)
    if not found.dimension:
        (count,) = draft.claim("symmetries.none")
    else:
        key = f"symmetries.algebra{'_modulo' if modulo else ''}"
        (count,) = draft.claim(key, dimension=found.dimension)
    prose = say("symmetries.all", count=count) + (say("symmetries.modulo") if modulo else ())
    if found.integrand:
        prose += say("symmetries.integrand", **vars(found.integrand))
    if found.functions:
        prose += draft.claim("symmetries.open", functions=("row", *found.functions))
    return draft.step(stated("dϖ(δy, X) = 0"), prose + say("symmetries.kernel"))


def _symmetry(
    x: Symmetry, label: str, group: Group, made_from: tuple[Step, ...], c: Chapter
) -> Step:
    """A symmetry: its field, what it does to L̃, ϖ of it, and what the motion keeps."""
    draft = c.draft(label, "conservation")
    draft.depends_on(*made_from[: 2 if x.terms else 1])
    field = [Equation("δt", x.tau), Equation("δA", x.displacement)]
    momenta: list[Tree] = [("at", "Π", a) for a in range(1, group.dimension + 1)]
    equations = [*field, Equation(("call", "δ", "L̃"), x.rate)]
    equations.append(Equation(add(ON_FORM, neg(x.F)), x.conserved(momenta, "h̃")))
    equations.append(Equation(("call", "d/dt", add(ON_FORM, neg(x.F))), 0))
    name = phrase(f"symmetries.{x.kind}")
    prose = say("symmetries.exact" if x.exact else "symmetries.up_to", kind=name)
    return draft.step(equations, prose, where=field)


def _central(found: SymmetriesFound, pair: Central, whole: Step, c: Chapter) -> Step:
    """Two symmetries that commute, and the number that dϖ of them is."""
    names = [f"conserved_{k + 1}" for k in (pair.first, pair.second)]
    draft = c.draft("_and_".join(names), "exterior derivative")
    draft.depends_on(whole)
    one, two = (found.symmetries[k] for k in (pair.first, pair.second))
    fields = [
        *(Equation("δt", one.tau), Equation("δA", one.displacement)),
        *(Equation("δ′t", two.tau), Equation("δ′A", two.displacement)),
    ]
    equation = Equation(stated("dϖ(δy, δ′y) = 0")[0].lhs, pair.number)
    kinds = {name: phrase(f"symmetries.{x.kind}") for name, x in (("first", one), ("second", two))}
    return draft.step([*fields, equation], say("symmetries.central", **kinds), where=fields)
