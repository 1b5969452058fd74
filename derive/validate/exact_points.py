"""Exact points of a problem: the arguments of a call, and what the record says of the result.

The record's equations of motion and its energy are evaluated as the checker does it, by what their
names mean for the points of the body; π is the double next to it, as in the code.

Integrals over an ellipsoid are functions, whose values are those of the checker, sums over the same
random places as in the record.  The emitted function that computes them, by an iteration, is not
read: of its numbers nothing is known here but the arguments.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ..algebra.factor_charts import QUATERNION, FactorChart
from ..algebra.groups import Group
from ..algebra.samplers import RandomSource, Sampler, affine, blocks, by_cayley
from ..check.trials.potential_accounts import at_invariants, nodes
from ..check.trials.trial_points import AnyModel, TrialPoints, model_at, names_at
from ..check.values.arithmetic import EvaluationError
from ..check.values.draws import Locus, largest_degree
from ..check.values.evaluate import Environment, evaluate
from ..check.values.residue import Degree, DegreeSource, degrees
from ..language import rational as q
from ..language.rational import Matrix
from ..language.reserved import block_of, numbers_of_input, numbers_of_output, rate_of_mass
from ..record.record import Derivation, Equation, RecordError
from .chart import Chart, Numbers, ReducedChart, chart_of, circles
from .straight_line import Measured
from .terms import CodeError

PI = Fraction(math.pi)


@dataclass(frozen=True)
class ExactPoint:
    """An exact point: the ``arguments`` t, x and u of a call, g and Z = g⁻¹ġ behind them, and what
    the record says: the rates of x, the energy and, for a body turned in space, the tensor of
    inertia by its upper rows.

    ``elementary`` gives the values of elementary functions at this point, ``named`` those of names,
    ``circles`` those of cos and sin at the angles of the state.
    """

    parameters: Mapping[str, Fraction]
    arguments: Mapping[str, Any]
    g: Matrix
    Z: Matrix
    rates: Numbers
    energy: Fraction
    inertia: Numbers
    elementary: Any
    named: Environment
    circles: Mapping[tuple[str, Fraction], Any]


class Claims:
    """What a record says of the numbers of a chart: names, sizes, and values at exact points;
    ``size``: random integers are within ±size."""

    def __init__(self, d: Derivation, chart: Chart, size: int):
        self.record, self.chart, self.size = d, chart, size
        self._points: dict[tuple[str, tuple[str, ...]], ExactPoint] = {}
        self.scope = str(d.problem.get("group"))
        (group,) = TrialPoints(d.problem, 0).groups(self.scope)
        self.state = chart_of(group.in_user_basis, chart, d.problem)
        self.group = with_rational_charts(group, self.state.charts)

    @cached_property
    def at(self) -> Locus:
        """The motion, driven where its equations have inputs or damping; in the group itself where
        the state has not all entries of g."""
        inside = self.chart.state == "moving" or self.state.on_the_group
        motions = (s for s in self.record.steps if s.label.endswith(".motion"))
        return Locus(driven=any(s.driven for s in motions), inside=inside)

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        """The names of the numbers of u, in order."""
        found: list[str] = []
        for data in self.record.problem.get("inputs", []):
            size = self.group.dimension
            if data["kind"] in ("force", "torque"):
                size = self._factor(data).n
            found += numbers_of_input(data, size)
        return tuple(found)

    @cached_property
    def outputs(self) -> tuple[str, ...]:
        """The names of what is read off the motion, in order."""
        listed = self.record.problem.get("outputs", [])
        return tuple(x for data in listed for x in numbers_of_output(data, self._factor(data).n))

    def _factor(self, data: Mapping[str, Any]) -> Group:
        """What moves the place of a force or an output, or the block of a torque."""
        return self.group.places[block_of(self.record.problem, data) - 1][1]

    def point(self, seed: str, zero: tuple[str, ...] = ()) -> ExactPoint:
        """The point of a seed, some parameters 0; ``CodeError`` where the record has no value."""
        if (seed, zero) not in self._points:
            try:
                self._points[seed, zero] = self._point(seed, zero)
            except (EvaluationError, RecordError, ZeroDivisionError) as error:
                raise CodeError(f"the record has no value: {error}") from None
        return self._points[seed, zero]

    def _point(self, seed: str, zero: tuple[str, ...]) -> ExactPoint:
        random, problem = Random(seed), self.record.problem
        chosen = {"horizontal": True} if self.state.held else {}
        given = dict.fromkeys(zero, Fraction(0))
        model = model_at(
            problem, self.group, random, self.size, self.at, pi=PI, given=given, **chosen
        )
        env = names_at(model)
        x, rates = self._state_and_rates(model, env)
        angles = circles(self.state.charts.values(), model.g)
        if angles:
            model.elementary.values.update(angles)
        tensor = self._value("I", env)
        return ExactPoint(
            model.parameters,
            {"t": model.t, "x": x, "u": tuple(model.parameters[x] for x in self.inputs)},
            model.g,
            model.Z,
            rates,
            self._value("h̃", env),
            tuple(tensor[i][j] for i in range(3) for j in range(i, 3)) if tensor else (),
            model.elementary,
            env,
            angles,
        )

    def _state_and_rates(self, model: AnyModel, env: Environment) -> tuple[Numbers, Numbers]:
        """The numbers of the state, and what the record says of their rates."""
        acceleration = self._acceleration(env)
        if isinstance(self.state, ReducedChart):
            x = self.state.with_advected(model.Z, env.names.get("Γ"))
            return x, self.state.with_advected(acceleration, self._value("Γ̇", env))
        g_dot = self._homogeneous(self._value("Ȧ", env), self._value("Ṫ", env))
        masses = tuple(env.parameters[x] for x in self.state.stored)
        rates = tuple(env.parameters[rate_of_mass(x)] for x in self.state.stored)
        x = self.state.values(model.g, model.Z, masses)
        return x, self.state.rates(model.g, model.Z, g_dot, acceleration, rates)

    # -- the record --------------------------------------------------------------------------

    @cached_property
    def equations(self) -> dict[str, Equation]:
        """The recorded equations that the code is to compute, by their left sides."""
        names = ("Ȧ", "Ṫ", "ζ̇", "Ż", "ẇ", "Γ̇", "h̃", "I")
        found = {name: self.record.definition(name) for name in names}
        return {name: x[1] for name, x in found.items() if x is not None}

    @property
    def degree(self) -> int:
        """A bound on the degree of what the record computes, as a function of the draws."""
        env = names_at(self._graded_model)
        return (self.group.size + 1) * sum(
            largest_degree(e.rhs, env) for e in self.equations.values()
        )

    @cached_property
    def _graded_model(self) -> AnyModel:
        """A model of which the degrees alone are known."""
        return model_at(self.record.problem, self.group, DegreeSource(), self.size, self.at)

    @property
    def entry_degree(self) -> tuple[int, int]:
        """The degrees of numerator and denominator of a number of the state, also of its product
        with one that is drawn."""
        num, den = largest(degrees(q.flatten(self._graded_model.g)))
        return num + 1, den

    @property
    def moment_degree(self) -> tuple[int, int]:
        """The degrees of numerator and denominator of a parameter: of sums of m, m r and m r r̄,
        where these are the parameters."""
        return largest(degrees(self._graded_model.parameters.values()))

    def _value(self, name: str, env: Environment) -> Any:
        e = self.equations.get(name)
        return None if e is None else evaluate(e.rhs, env)

    def _acceleration(self, env: Environment) -> Matrix:
        """Ż as a matrix of the group's size, from what the record solves for."""
        w = self._value("ẇ", env)
        if "ζ̇" not in self.equations:
            return self._homogeneous(self._value("Ż", env), w)
        rate = self._value("ζ̇", env)
        coordinates = [x for (x,) in rate] if isinstance(rate, tuple) else [rate]
        shift = [x for (x,) in w] if w is not None else []
        return self.group.hat([*coordinates, *shift])

    def _homogeneous(self, linear: Any, shift: Any) -> Matrix:
        """[[linear, shift], [0, 0]], or the linear part alone; 0 stands for any zero."""
        n = self.group.n
        zero = q.scaled(Fraction(0), q.identity(n))
        linear = linear if isinstance(linear, tuple) else zero
        if not self.group.affine:
            return tuple(linear)
        column = shift if isinstance(shift, tuple) else ((Fraction(0),),) * n
        return q.bordered(linear, column, Fraction(0))


def largest(found: Iterable[Degree]) -> tuple[int, int]:
    """The largest degree of the numerators, and of the denominators."""
    pairs = [(x.numerator.degree, x.denominator.degree) for x in found]
    return max((x for x, _ in pairs), default=1), max((x for _, x in pairs), default=0)


def with_rational_charts(group: Group, charts: Mapping[int, FactorChart]) -> Group:
    """The group with a sampler of elements whose charts by quaternions are rational."""
    turned = {k for k, chart in charts.items() if chart.kind == QUATERNION}
    if not turned:
        return group
    samplers = [
        rational_quaternions(factor) if k in turned else factor.sampler
        for k, (_, factor) in enumerate(group.places)
    ]
    return replace(group, sampler=blocks(samplers) if group.factors else samplers[0])


def rational_quaternions(group: Group) -> Sampler:
    """A sampler of rotations whose quaternion is rational, squares of Cayley transforms; with any
    translation where there are some."""
    basis = tuple(group.linear_part(e) for e in group.linear_basis)
    root = by_cayley(basis)

    def turns(random: RandomSource, size: int) -> Matrix:
        a = root(random, size)
        return q.times(a, a)

    return affine(turns, group.n) if group.affine else turns


NAME = "ellipsoid"
BUNDLES = {
    NAME: ((0, 1), (0, 3), (1, 3), (2, 3)),
    f"{NAME}_slopes": tuple((k, 5) for k in range(5)),
}
"""Function → the exponents k and 2s of its integrals ∫ u^k P^(−s) du."""
MOST = 5
"""So many has one at most."""


@dataclass(frozen=True)
class WithIntegrals:
    """Elementary functions, and those of ``BUNDLES`` of three numbers, of whose results
    ``ellipsoid_k`` is one; ``drawn``: random numbers by a name and k; ``measured``: do numbers
    carry degrees?"""

    elementary: Callable[[str, Any], Any]
    drawn: Callable[[str, int], Any]
    measured: bool = False

    def __call__(self, name: str, *x: Any) -> Any:
        """The value of a function."""
        if name in BUNDLES:
            return BUNDLES[name], x
        if not name.startswith(NAME):
            return self.elementary(name, *x)
        pairs = ((self._number(w), self._number(u)) for w, u in nodes(self.drawn))
        ((exponents, invariants),), place = x, int(name.removeprefix(f"{NAME}_"))
        if place >= len(exponents):
            raise CodeError(f"of the integrals there is none at place {place}")
        k, halves = exponents[place]
        return at_invariants(pairs, invariants, k, halves, lambda y: self.elementary("sqrt", y))

    def _number(self, x: Any) -> Any:
        return Measured(x, 1) if self.measured else x
