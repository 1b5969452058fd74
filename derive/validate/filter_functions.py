"""The code of an estimate with the covariance of its error against the record, at exact points.

Nothing of the record's steps is taken: f is that of the problem, 𝒜 the derivative of the rates of
the error near 1, a column of G the derivative of f by one input, seen from the estimate, and
Ṗ = 𝒜P + P𝒜ᵀ + GQGᵀ their products, with Q the densities of the problem (the checker's model).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.samplers import Source
from ..check.kinematics.kinematics_model import KinematicsModel
from ..check.trials.trial_points import TrialPoints
from ..check.values.arithmetic import EPS, nilpotent, part
from ..check.values.draws import Locus
from ..check.values.evaluate import evaluate
from ..check.values.residue import DegreeSource, degrees
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import suffixed
from ..record.as_json import decode
from ..record.record import Derivation
from .chart import Chart, Numbers, StateChart
from .compare import Comparison
from .exact_points import largest


@dataclass(frozen=True)
class FilterPoint:
    """An exact point: the ``arguments`` t, x and u of a call, and what is true there: the rates of
    x, 𝒜 and G by rows; the state has no angles, and so no ``circles``."""

    parameters: Mapping[str, Any]
    arguments: Mapping[str, Any]
    rates: Numbers
    generator: Numbers
    noise: Numbers
    elementary: Any
    circles: Mapping[tuple[str, Fraction], Any] = field(default_factory=dict)


@dataclass(frozen=True)
class FilterChart(StateChart):
    """The entries of the estimate that vary, then the upper triangle of P by rows."""

    @property
    def triangle(self) -> list[tuple[int, int]]:
        """The places of P in the state, from 0."""
        d = range(self.group.dimension)
        return [(a, b) for a in d for b in d if a <= b]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the numbers of the state, in order."""
        entries = tuple(name for name, _, _ in self.entries)
        return (*entries, *(suffixed("P", a + 1, b + 1) for a, b in self.triangle))

    def numbers(self, g: Matrix, P: Matrix) -> Numbers:
        """Those of a matrix of the group's size and a symmetric one."""
        return (*(g[i][j] for _, i, j in self.entries), *(P[a][b] for a, b in self.triangle))


class FilterClaims:
    """What is true of an estimate of kinematics: names, and values at exact points; ``size``:
    random integers are within ±size."""

    outputs: tuple[str, ...] = ()

    def __init__(self, d: Derivation, size: int):
        self.record, self.size = d, size
        given = d.problem["kinematics"]
        (group,) = TrialPoints(d.problem, 0).groups(str(d.problem.get("group")))
        self.group, self.left = group, given["error"] == "left"
        self.state = FilterChart(group, Chart(state="moving"), right=not self.left)
        self.inputs = tuple(str(x) for x in given["inputs"])
        self.noise = [decode(x, "problem, noise") for x in given.get("noise", ())]

    def point(self, seed: str, zero: tuple[str, ...] = ()) -> FilterPoint:
        """The point of a seed, some parameters 0."""
        return self._point(Random(seed), zero)

    def _point(self, source: Source, zero: tuple[str, ...] = ()) -> FilterPoint:
        model = KinematicsModel(self.record.problem, self.group, source, self.size, Locus())
        model.parameters |= dict.fromkeys(zero, Fraction(0))
        d, estimate = range(self.group.dimension), model.estimate
        triangle = {x: model.draw() for x in self.state.triangle}
        P = tuple(tuple(triangle[min(a, b), max(a, b)] for b in d) for a in d)
        generator = model.generator(left=self.left)
        columns = [self._column(model, x) for x in self.inputs]
        moved = q.times(generator, P)
        rate = q.plus(moved, q.transposed(moved))
        for t, column in zip(self.noise, columns, strict=False):
            square = q.times(q.column(column), (column,))
            rate = q.plus(rate, q.scaled(evaluate(t, model.expressions), square))
        return FilterPoint(
            model.parameters,
            {
                "t": model.t,
                "x": self.state.numbers(estimate, P),
                "u": tuple(model.parameters[x] for x in self.inputs),
            },
            self.state.numbers(model.velocity(estimate), rate),
            q.flatten(generator),
            q.flatten(q.transposed(q.matrix(columns))),
            model.elementary,
        )

    def _column(self, model: KinematicsModel, name: str) -> tuple[Any, ...]:
        """What a noise of 1 on an input adds to the rate of the error, on the basis."""
        ahead = {**model.parameters, name: model.parameters[name] + nilpotent(EPS)}
        slope = part(model.velocity(model.estimate, ahead), EPS)
        back = q.inverted(model.estimate)
        seen = q.times(back, slope) if self.left else q.times(slope, back)
        return self.group.nearest(seen)

    @cached_property
    def _graded(self) -> FilterPoint:
        """A point of which the degrees alone are known."""
        return self._point(DegreeSource())

    @property
    def degree(self) -> int:
        """A bound on the degree of what is true, as a function of the draws."""
        p = self._graded
        every = degrees((*p.rates, *p.generator, *p.noise))
        return max((x.total_degree for x in every), default=1)

    @property
    def entry_degree(self) -> tuple[int, int]:
        """The degrees of numerator and denominator of a number of the state."""
        return largest(degrees(self._graded.arguments["x"]))

    moment_degree = (1, 0)
    """Those of a parameter."""


class FilterComparison(Comparison):
    """The comparison of the code of an estimate with the record at one exact point."""

    claims: Any
    point: Any

    def compare_all(self) -> tuple[str, ...]:
        """The names of the functions, once each has been found equal; ``CodeError`` else."""
        self.require_straight()
        arguments, point, found = self._arguments(), self.point, ["constants", "rhs"]
        self._compared("rhs", arguments, "dx", self._rates, point.rates)
        if "rhs_batch" in self.module.functions:
            self._batches(arguments)
            found.append("rhs_batch")
        for name, wanted in (("error_generator", point.generator), ("error_noise", point.noise)):
            told = [f"number {k} of D" for k, _ in enumerate(wanted)]
            self._compared(name, arguments, "D", told, wanted)
            found.append(name)
        return (*found,)
