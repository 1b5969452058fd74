"""The exact points at which the steps of a record are tried: made once, and shared by its steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.groups import Group
from ..algebra.samplers import Source
from ..language.show import show
from ..record.record import ANY_GROUP, Equation, RecordError, Step
from . import discrete_model
from .discrete_model import DiscreteModel
from .equation_sides import claim_grade
from .evaluate import Environment
from .grades import DegreeSource, Grade
from .lagrangian import lagrangian_values
from .lagrangian.lagrangian_model import LagrangianModel
from .locus import Locus, locus_of
from .meaning import environment
from .model import Model
from .problem_group import group_of
from .residue import ResidueSource, random_prime
from .torus import torus_model
from .torus.elements import WEIGHTS
from .torus.torus_group import torus_of
from .trial_groups import TRIED, groups_with_relations

SIZE = 2**128
"""The random integers of a point are of at most this absolute value."""

AnyModel = Model | LagrangianModel
Place = tuple[AnyModel, Environment]


def action_of(problem: Mapping[str, Any]) -> str:
    """The action of a record's problem, "linear" or "affine"; ``RecordError`` for anything else."""
    action = problem.get("action")
    if action not in TRIED:
        raise RecordError("record, problem: key 'action' must be linear or affine")
    return str(action)


def model_at(
    problem: Mapping[str, Any], g: Group, source: Source, size: int, at: Locus, **chosen: Any
) -> AnyModel:
    """A random model at a locus; ``chosen``: what is drawn otherwise (:class:`Model`)."""
    if "lagrangian" in problem:
        return LagrangianModel(problem, g, source, size, at, **chosen)
    for name, value in (*at.field, *at.field_prime):
        text = f"{show(name)} = {show(value)}"
        raise RecordError(
            f"the hypothesis {text[:80]} is not one that can be tried: a field on the group is "
            "given where no points give the Lagrangian"
        )
    if "discrete" in problem:
        own = {} if chosen.get("generic") else problem
        return DiscreteModel(own, g, source, size, at, **chosen)
    return Model({} if chosen.get("generic") else problem, g, source, size, at, **chosen)


def names_at(model: AnyModel) -> Environment:
    """The environment of the names at a model."""
    if isinstance(model, LagrangianModel):
        return lagrangian_values.environment(model)
    if isinstance(model, DiscreteModel):
        return discrete_model.environment(model)
    return environment(model)


def side_of(problem: Mapping[str, Any]) -> str:
    """The trivialisation of a Lagrangian that no points give; "" for any other problem."""
    return str(problem.get("lagrangian", {}).get("trivialisation", ""))


class TrialPoints:
    """The points of one record: exact ones, and beside each one in degrees alone."""

    def __init__(self, problem: Mapping[str, Any], seed: int | str):
        self.problem, self.seed = problem, seed
        self._places: dict[tuple[str, Locus, int], Place] = {}
        self._graded_points: dict[tuple[str, Locus], Place] = {}

    def groups(self, scope: str, *, driven: bool = False) -> tuple[Group, ...]:
        """The groups on which a step of this scope, with inputs (``driven``) or without, is tried;
        ``RecordError`` for a scope that is neither any group nor the problem's."""
        own = self._problem_group
        if scope == ANY_GROUP:
            if driven:
                raise RecordError("an input is of a problem, not of any group")
            return groups_with_relations(action_of(self.problem))
        if own is None or scope != own.name:
            raise RecordError(f"scope {scope!r} is neither {ANY_GROUP!r} nor the problem's group")
        return (own,)

    @cached_property
    def _problem_group(self) -> Group | None:
        return group_of(self.problem)

    @cached_property
    def _kind(self) -> str:
        """What kind of point is drawn, for those that records share."""
        return "discrete" if "discrete" in self.problem else side_of(self.problem)

    @cached_property
    def _prime(self) -> int:
        return random_prime(Random(f"{self.seed} prime"))

    def environment(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Environment:
        """The names at the point of :meth:`point`."""
        return self.point(g, step, size, equation)[1]

    def environments(self, step: Step) -> Iterator[tuple[Group, Environment]]:
        """Each group of a step, with the names at the point where the step is tried on it."""
        for g in self.groups(step.scope, driven=step.driven):
            yield g, self.environment(g, step)

    def point(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Place:
        """A random exact point, its model and its names, the same for all steps with the same
        hypotheses.

        ``equation``: one that may hold for all accelerations. About any group the numbers are
        residues, unless they are small.
        """
        at, generic = locus_of(step, equation), step.scope == ANY_GROUP
        key = g.name + step.scope, at, size
        if key not in self._places:
            random = Random(f"{self.seed} {g.name} {step.scope} {at.as_text} {size}")
            source = ResidueSource(random, self._prime) if generic and size == SIZE else random
            self._places[key] = self._place(g, source, size, at, generic=generic)
        return self._places[key]

    def graded_point(self, g: Group, step: Step, equation: Equation | None = None) -> Place:
        """A point like :meth:`point` of which the degrees alone are known."""
        at = locus_of(step, equation)
        generic = step.scope == ANY_GROUP
        known = _GRADED_POINTS if generic else self._graded_points
        key = g.name + self._kind, at
        if key not in known:
            known[key] = self._place(g, DegreeSource(), SIZE, at, generic=generic)
        return known[key]

    def _place(self, g: Group, source: Source, size: int, at: Locus, *, generic: bool) -> Place:
        """A random model at which the hypotheses of a step hold, and its names."""
        if "torus" in self.problem and not generic:
            fluid: Any = torus_model.TorusModel(
                torus_of(self.problem), source, size, free=at.free_acceleration
            )
            return fluid, torus_model.environment(fluid)
        model = model_at(self.problem, g, source, size, at, generic=generic)
        return model, names_at(model)

    def grade(self, g: Group, step: Step, equation: Equation) -> tuple[int, Grade]:
        """The degree of an equation on a group, and the grade of its numerators."""
        key = g.name + self._kind, locus_of(step, equation), equation
        known = _GRADES if step.scope == ANY_GROUP else {}
        if key not in known:
            if len(known) > MOST_GRADES:
                known.clear()
            known[key] = claim_grade(equation, self.graded_point(g, step, equation)[1])
        return known[key]

    def coincidence(self, scope: str) -> int:
        """The degree of two different arguments of elementary functions being equal by chance; of
        what is compared at all points of a lattice. About any group there are neither."""
        if scope == ANY_GROUP:
            return 0
        if "torus" in self.problem:
            return WEIGHTS
        largest = max((m.elementary.largest for m, _ in self._graded_points.values()), default=0)
        distinct = max((len(m.elementary.values) for m, _ in self._places.values()), default=0)
        return distinct**2 * largest


MOST_GRADES = 10_000
_GRADED_POINTS: dict[tuple[str, Locus], Place] = {}
_GRADES: dict[tuple[str, Locus, Equation], tuple[int, Grade]] = {}
"""Points and degrees for any group, the same for all records."""
