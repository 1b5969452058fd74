"""What is drawn at random for a model before it has points: parameters, π, functions."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from ..algebra.groups import Group
from ..algebra.samplers import Source
from ..language.rational import Matrix
from ..language.suffixed import suffixed
from .elementary_values import ElementaryValues
from .evaluate import Environment
from .grades import DegreeSource, Graded, indeterminate
from .residue import ResidueSource

SPARE = 2
"""So many points more than are needed, where the problem leaves them open: no equation may hold by
a symmetry of few points."""


class Draws:
    """The random numbers of a model before it has points, and the values of the problem's own
    expressions in them.

    ``size``: integers are drawn within ±size. ``generic``: the potential is left open, and with it
    inputs and places. ``pi``: the value of π, as in code, where roots of numbers are numbers like
    others; else any number. ``few``: no spare points; ``zero``: the names of parameters that
    vanish.
    """

    def __init__(
        self,
        problem: Mapping[str, Any],
        group: Group,
        random: Source,
        size: int,
        *,
        generic: bool = False,
        pi: Fraction | None = None,
        few: bool = False,
        zero: Collection[str] = (),
    ):
        self.problem, self.group, self.random, self.size = problem, group, random, size
        self.generic, self.spare, self.n = generic, 0 if few else SPARE, group.n
        self.parameters = {x: self.draw(positive=True) for x in problem.get("parameters", {})}
        self.parameters |= dict.fromkeys(zero, Fraction(0))
        exact = pi is None and not isinstance(random, ResidueSource)
        self.elementary = ElementaryValues(lambda: self.draw(positive=True), exact=exact)
        self.graded = isinstance(random, DegreeSource)
        self.unit = indeterminate(0, 1) if self.graded else Fraction(1)
        self.pi = self.draw(positive=True) if pi is None else pi

    def draw(self, *, positive: bool = False, slots: int = 0) -> Any:
        """A random integer of the ring drawn from, ``positive`` from 1 on; ``slots``: counted as an
        entry of a tensor of so many indices."""
        x = Fraction(1) * self.random.randint(1 if positive else -self.size, self.size)
        return indeterminate(slots) if isinstance(x, Graded) else x

    def place(self) -> tuple[Any, ...]:
        """A random point of space, n numbers."""
        return tuple(self.draw(slots=1) for _ in range(self.n))

    def algebra(self) -> Matrix:
        """A random element of 𝔤, as a matrix of the group's size."""
        return self.group.hat([self.draw(slots=2) for _ in self.group.basis])

    @cached_property
    def expressions(self) -> Environment:
        """The environment of the problem's own expressions, in its parameters and π."""
        return Environment(
            self.n, {"π": self.pi}, parameters=self.parameters, elementary=self.elementary
        )

    def name_inputs(
        self, covector: Sequence[Any], forces: Sequence[Sequence[Any]]
    ) -> dict[str, Any]:
        """The numbers of the inputs by their names in the problem, ``thrust_3``: entries of the
        ``forces``, and the values of the ``covector`` on the basis that the problem states."""
        found: dict[str, Any] = {}
        for data, force in zip(self.inputs_of("force"), forces, strict=True):
            found |= {suffixed(data["name"], k): x for k, x in enumerate(force, 1)}
        for data in self.inputs_of("covector"):
            for a, e in enumerate(self.group.stated.basis, 1):
                parts = zip(self.group.nearest(e), covector, strict=True)
                found[suffixed(data["name"], a)] = sum((x * u for x, u in parts), Fraction(0))
        return found

    def inputs_of(self, kind: str) -> list[Mapping[str, Any]]:
        """The inputs of a kind, "force" or "covector"; none where the potential is left open."""
        if self.generic:
            return []
        return [i for i in self.problem.get("inputs", []) if i["kind"] == kind]
