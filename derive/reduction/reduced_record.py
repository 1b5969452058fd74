"""Routh's reduction of a problem as a record: L̃, its momenta, then the steps of the reduction."""

from __future__ import annotations

from dataclasses import dataclass

from ..record.as_json import encode
from ..record.record import Derivation, Step
from ..symmetries.found import Found
from ..walk.chapter import Chapter
from ..walk.head import problem_data, symbols
from ..walk.lie import expressed
from ..walk.lie.any_lagrangian import AnyLagrangian
from ..walk.lie.basis import of_element
from ..walk.lineage import traced
from ..walk.regularity import supposing_all
from ..walk.stages import Values
from .commuting import chosen
from .quadrature import Quadrature, quadrature_of
from .routhian import Routhian
from .told_reduction import told


@dataclass(frozen=True)
class Reduction:
    """The reduction of a problem, the quadrature that is left, if one is, and its record."""

    routhian: Routhian
    quadrature: Quadrature | None
    record: Derivation


def record_of(found: Found, general: Values) -> Reduction:
    """The record of a reduction; ``general``: the road of any Lagrangian.  ``ProblemError`` where
    there is nothing to reduce by."""
    problem, group = found.problem, found.problem.group
    assert group is not None
    taken = chosen(found)
    routhian = Routhian(found, taken)
    c = Chapter(problem.name, group.name)
    road: AnyLagrangian = general["lagrangian"]
    basis = of_element(problem, group, road, c)
    own = expressed.expressed(problem, group, road, basis, c)
    left = quadrature_of(routhian)
    last = told(routhian, left, (*own.steps, basis.last), c)
    steps = supposing_all(traced((*general["steps"], *basis.steps, *own.steps, *last)))
    data = problem_data(problem) | {"symmetries": [encode(x.displacement) for x in taken]}
    names = symbols(steps, problem, fields=len(taken))
    return Reduction(routhian, left, Derivation(data, names, steps))


def shown(record: Derivation) -> list[Step]:
    """The steps of the reduction."""
    first = next(k for k, s in enumerate(record.steps) if s.label.endswith(".momentum_1"))
    return [*record.steps[first:]]
