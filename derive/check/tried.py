"""The points at which the steps of a record are tried: made once, and shared by its steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.groups import Group
from ..algebra.samplers import Source
from ..record.record import Equation, RecordError, Step
from ..record.vocabulary import ANY_GROUP
from .assumed import Assumed, assumed
from .counted import Degrees, Grade
from .differ import graded
from .evaluate import Environment
from .header import group_of
from .meaning import environment
from .model import Model
from .panel import PANELS, panel
from .residue import Residues, prime

SIZE = 2**128
"""Random parameters are integers of at most this absolute value."""

Place = tuple[Model, Environment]


def action_of(problem: Mapping[str, Any]) -> str:
    """Linear or affine."""
    action = problem.get("action")
    if action not in PANELS:
        raise RecordError("record, problem: key 'action' must be linear or affine")
    return str(action)


def modelled(
    problem: Mapping[str, Any], g: Group, source: Source, at: Assumed, size: int, *, opaque: bool
) -> Model:
    """A point where what a step assumes is so."""
    return Model(
        {} if opaque else problem,
        g,
        source,
        size,
        principal=at.principal,
        driven=at.driven,
        along=at.along,
        contracted=at.contracted,
        coasting=at.coasting,
        still=at.still,
        opaque=opaque,
    )


class Tried:
    """Those of one record: exact ones, and one in degrees alone for each."""

    def __init__(self, problem: Mapping[str, Any], seed: int | str):
        self.problem, self.seed = problem, seed
        self._places: dict[tuple[str, Assumed, int], Place] = {}
        self._counted: dict[tuple[str, Assumed], Place] = {}

    def groups(self, scope: str, *, driven: bool = False) -> tuple[Group, ...]:
        """The groups on which a step of this scope, with inputs or without, is tried."""
        own = self._own
        if scope == ANY_GROUP:
            if driven:
                raise RecordError("an input is of a problem, not of any group")
            return panel(action_of(self.problem))
        if own is None or scope != own.name:
            raise RecordError(f"scope {scope!r} is neither {ANY_GROUP!r} nor the problem's group")
        return (own,)

    @cached_property
    def _own(self) -> Group | None:
        return group_of(self.problem)

    @cached_property
    def _prime(self) -> int:
        return prime(Random(f"{self.seed} prime"))

    def environment(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Environment:
        """A random exact point, the same for all equations of a kind."""
        return self.point(g, step, size, equation)[1]

    def environments(self, step: Step) -> Iterator[tuple[Group, Environment]]:
        """The exact points at which a step is tried."""
        for g in self.groups(step.scope, driven=step.driven):
            yield g, self.environment(g, step)

    def point(
        self, g: Group, step: Step, size: int = SIZE, equation: Equation | None = None
    ) -> Place:
        """The same with the model; an equation may hold for all accelerations.

        About any group a number is its residue, unless it is small.
        """
        at, opaque = assumed(step, equation), step.scope == ANY_GROUP
        key = g.name + step.scope, at, size
        if key not in self._places:
            random = Random(f"{self.seed} {g.name} {step.scope} {at.said} {size}")
            source = Residues(random, self._prime) if opaque and size == SIZE else random
            model = modelled(self.problem, g, source, at, size, opaque=opaque)
            self._places[key] = model, environment(model)
        return self._places[key]

    def counted(self, g: Group, step: Step, equation: Equation | None = None) -> Place:
        """A point of which the degrees alone are known."""
        at = assumed(step, equation)
        opaque = step.scope == ANY_GROUP
        known, key = _COUNTED if opaque else self._counted, (g.name, at)
        if key not in known:
            model = modelled(self.problem, g, Degrees(), at, SIZE, opaque=opaque)
            known[key] = model, environment(model)
        return known[key]

    def graded(self, g: Group, step: Step, equation: Equation) -> tuple[int, Grade]:
        """The degree of a claim, and the grade of its numerators."""
        key = g.name, assumed(step, equation), equation
        known = _GRADED if step.scope == ANY_GROUP else {}
        if key not in known:
            if len(known) > MOST:
                known.clear()
            known[key] = graded(equation, self.counted(g, step, equation)[1])
        return known[key]

    @property
    def coincidence(self) -> int:
        """The degree of what makes arguments of functions equal that are not, by chance."""
        largest = max((m.elementary.largest for m, _ in self._counted.values()), default=0)
        distinct = max((len(m.elementary.values) for m, _ in self._places.values()), default=0)
        return distinct**2 * largest


MOST = 10_000
_COUNTED: dict[tuple[str, Assumed], Place] = {}
_GRADED: dict[tuple[str, Assumed, Equation], tuple[int, Grade]] = {}
"""About any group they are the same for all records."""
