"""The functions of a state beside the equations, by what they mean: ``project`` and ``defect``,
``to_matrix`` and ``from_matrix``, ``conserved``, the Jacobians, and the functions in momenta.

If ``project``, a Newton step back to the group, keeps every state of the group, and its derivative
there takes any change of a state to one that is tangent to the group, then of an error ε it leaves
O(ε²).  ``defect`` is a sum of sizes: each vanishes on the group, and together they see every change
that is not tangent to it.

``from_matrix`` asks for signs of products of the numbers of the quaternion, and is one rational
function, but for the root of a square, where none of them changes.  So it is tried with each choice
of the signs of the vector, the scalar being positive.

Along the exact rates the numbers of ``conserved`` do not change, elsewhere each does.  The rates
are those of ``rhs``, which has been found equal to the record, without inputs.

The Jacobians are derivatives of what ``rhs`` computes, by nilpotent numbers.  A variation is δg =
g η and δζ; η̇ = δζ − [Z, η], and δζ̇ is the derivative of the rates; on the right δg = η g and
η̇ = δζ + [Z, η].

The momenta and the Poisson tensor are the checker's; their rates, the derivative of the emitted
``momentum`` along the emitted ``rhs``.  A step of Newton's method leaves the velocity alone where
it is right, and its derivative by the velocity vanishes there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from math import isqrt
from typing import Any

from ..algebra.families import group
from ..algebra.groups import Group
from ..check.trials.phase_point import PhasePoint
from ..check.values.arithmetic import EPS, part
from ..check.values.residue import Residue
from ..language import rational as q
from ..language.rational import Matrix
from .chart import EPSILON, ReducedChart, StateChart
from .exact_points import Point
from .straight_line import Measured
from .terms import Array, CodeError, DiffersError, Machine

PRIME = 2**61 - 1
"""The prime modulo which ranks are counted: they are no larger than the true ones."""

Run = Callable[[str, Sequence[Any]], Sequence[Any]]
"""(name, state) → the numbers of ``project``, or the summands of ``defect``, at a state."""


def compare_drift(run: Run, draw: Callable[[], Fraction], state: StateChart, point: Point) -> str:
    """The functions that were found right at a point, as text for a report; ``DiffersError`` where
    one is wrong.

    Of a group that is given by its basis neither random elements nor all relations are known: there
    both are tried at its unit, and no more is asked than that they leave it alone.
    """
    named = is_named(state.group)
    g = point.g if named else q.identity(state.group.size)
    x = list(state.values(g, point.Z))
    if list(run("project", x)) != x:
        raise DiffersError("project: a state of the group is changed")
    if any(run("defect", x)):
        raise DiffersError("defect: it does not vanish on the group")
    if not named:
        return "project, defect (at the unit of the group)"
    moved = run("project", [a + EPSILON * draw() for a in x])
    if not state.tangent(g, point.Z, [part(y, EPS) for y in moved]):
        raise DiffersError("project: a change that leaves the group is not taken back")
    slopes = []
    for i in range(len(x)):
        beside = [a + EPSILON * Fraction(i == j) for j, a in enumerate(x)]
        slopes.append([part(y, EPS) for y in run("defect", beside)])
    if rank(slopes) != len(x) - 2 * state.group.dimension + len(state.held):
        raise DiffersError("defect: it does not see all that leaves the group")
    return "project, defect"


def is_named(g: Group) -> bool:
    """Is the group one of the named ones, all of whose relations are known?"""
    try:
        return group(g.name).basis == g.basis
    except ValueError:
        return False


def rank(rows: Sequence[Sequence[Fraction]]) -> int:
    """The rank of a matrix modulo the prime."""
    one = Residue(1, PRIME)
    return q.rank(tuple(tuple(one * x for x in row) for row in rows))


Require = Callable[[str, Sequence[str], Sequence[Any], Sequence[Any]], None]
RunSized = Callable[[str, Sequence[Any], int], Sequence[Any]]
"""(name, state, how many numbers it gives) → these numbers."""


def compare_attitude(
    run: RunSized, require_equal: Require, state: StateChart, point: Point
) -> tuple[str, str]:
    """The names of the two functions, each found right at the turns of a point."""
    plain = replace(state, chart=replace(state.chart, attitude="matrix"))
    for g in turned(point.g):
        there, here = plain.values(g, point.Z), state.values(g, point.Z)
        found = run("to_matrix", here, len(there))
        require_equal("to_matrix", plain.names, found, there)
        require_equal("from_matrix", state.names, run("from_matrix", there, len(here)), here)
    return "to_matrix", "from_matrix"


def turned(g: Matrix) -> Iterator[Matrix]:
    """The displacements whose quaternion has that of g but for the signs of its vector: D A D for
    the diagonal matrices D of signs, and their transposes."""
    n = 3
    for signs in product((1, -1), repeat=2):
        D = (1, *signs)
        A = tuple(tuple(D[i] * g[i][j] * D[j] for j in range(n)) for i in range(n))
        for linear in (A, q.transposed(A)):
            rows = (tuple(linear[i]) + tuple(g[i][n:]) for i in range(n))
            yield (*rows, *g[n:])


def exact_root(name: str, x: Any) -> Any:
    """√x of the square of a fraction; ``CodeError`` for other functions and other numbers."""
    x = Measured.of(x)
    value = Fraction(x.value)
    if name != "sqrt" or value < 0:
        raise CodeError(f"{name} of {float(value):.3g} has no place here")
    root = Fraction(isqrt(value.numerator), isqrt(value.denominator))
    if root * root != value:
        raise CodeError("the root of a number that is no square")
    return Measured(root, x.num, x.den)


Numbers = Sequence[Any]


def compare_conserved(
    machine: Machine,
    point: Point,
    x: Numbers,
    k: Numbers,
    draw: Callable[[], Fraction],
    count: int,
) -> str:
    """The name of the function that was found right at a state x; ``DiffersError`` where one of its
    ``count`` numbers is not kept, or is none."""
    at = {**point.arguments, "x": x}

    def run(name: str, changed: Mapping[str, Any], **size: int) -> list[Any]:
        arrays: dict[str, Any] = {"x": x, "k": k, "u": [Fraction(0)] * len(at["u"]), **changed}
        t = arrays.pop("t", at["t"])
        arguments = {x: Array(values, x) for x, values in arrays.items()}
        return [
            y for found in machine.call(name, {"t": t, **arguments}, **size).values() for y in found
        ]

    rates = run("rhs", {}, dx=len(x))
    later = {"x": [y + EPSILON * v for y, v in zip(x, rates, strict=True)]}
    kept = run("conserved", later | {"t": at["t"] + EPSILON}, out=count)
    beside = run("conserved", {"x": [y + EPSILON * draw() for y in x]}, out=count)
    for i, (along, off) in enumerate(zip(kept, beside, strict=True)):
        if part(along, EPS):
            raise DiffersError(f"conserved: number {i} of it is not kept")
        if not part(off, EPS):
            raise DiffersError(f"conserved: number {i} of it says nothing of the state")
    return "conserved"


ZERO = Fraction(0)


@dataclass(frozen=True)
class ExactJacobians:
    """The derivatives of the rates at one point, and of so many ``outputs``; ``p``, ``k``: its
    parameters and constants."""

    machine: Machine
    state: StateChart
    point: Point
    p: Sequence[Fraction]
    k: Sequence[Fraction]
    outputs: int = 0

    @property
    def columns(self) -> Mapping[str, Iterator[list[Fraction]]]:
        """Name of a Jacobian → the columns of its matrix D, computed one by one."""
        return {
            "jacobian": self._state(),
            "jacobian_inputs": self._inputs(),
            "jacobian_parameters": self._parameters(),
            "jacobian_raw": self._rates_by("x"),
            "jacobian_raw_inputs": self._rates_by("u"),
            "variations": self._variations(),
            "jacobian_outputs": self._outputs_along(),
            "jacobian_outputs_inputs": self._outputs_by("u"),
            "jacobian_outputs_raw": self._outputs_by("x"),
        }

    def _varied(self) -> Iterator[Sequence[Any]]:
        """The state, in nilpotent numbers, along η = E_a, then along δζ = E_a."""
        none, basis = q.scaled(ZERO, self.point.Z), self.state.group.basis
        for pairs in (((e, none) for e in basis), ((none, e) for e in basis)):
            for eta, change in pairs:
                yield self.state.varied(self.point.g, self.point.Z, eta, change)

    def _variations(self) -> Iterator[list[Fraction]]:
        """The columns of the derivative of the numbers of the state along these."""
        return ([part(y, EPS) for y in x] for x in self._varied())

    def _outputs_along(self) -> Iterator[list[Fraction]]:
        """The columns of the derivative of ``outputs`` along these."""
        return (self._read({"x": x}) for x in self._varied())

    def _outputs_by(self, array: str) -> Iterator[list[Fraction]]:
        """The columns of the derivative of ``outputs`` by the numbers of an array."""
        return map(self._read, self._beside(array))

    def _beside(self, array: str) -> Iterator[dict[str, list[Any]]]:
        """An array with each of its numbers in turn moved, by a nilpotent one."""
        given = self.point.arguments[array]
        for j in range(len(given)):
            yield {array: [y + EPSILON if i == j else y for i, y in enumerate(given)]}

    def _read(self, changed: Mapping[str, Sequence[Any]]) -> list[Fraction]:
        return [part(y, EPS) for y in self._called("outputs", "out", self.outputs, changed)]

    def _state(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the state: (η̇, δζ̇) for η = E_a, then for δζ = E_a."""
        group, Z = self.state.group, self.point.Z
        none = q.scaled(ZERO, Z)
        for e in group.basis:
            turn = group.nearest(q.bracket(Z, e) if self.state.right else q.bracket(e, Z))
            yield [*turn, *self._rates_along(e, none)]
        for a, e in enumerate(group.basis):
            yield [*(Fraction(a == b) for b in range(group.dimension)), *self._rates_along(none, e)]

    def _rates_along(self, eta: Matrix, change: Matrix) -> list[Fraction]:
        """δζ̇ for δg = g η and δZ = ``change``."""
        x = self.state.varied(self.point.g, self.point.Z, eta, change)
        rates = self._rates({"x": x})
        Z = q.plus(self.point.Z, q.scaled(EPSILON, change))
        back = q.times(q.minus(q.identity(len(eta)), q.scaled(EPSILON, eta)), self._inverse())
        return [part(y, EPS) for y in self.state.acceleration(Z, back, rates)]

    def _rates_by(self, array: str) -> Iterator[list[Fraction]]:
        """The columns of the derivative of ``rhs`` by the numbers of an array."""
        return ([part(y, EPS) for y in self._rates(x)] for x in self._beside(array))

    def _inputs(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the inputs u."""
        return map(self._rates_column, self._beside("u"))

    def _parameters(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the parameters p."""
        for j in range(len(self.p)):
            p = [y + EPSILON if i == j else y for i, y in enumerate(self.p)]
            k = self.machine.call("constants", {"p": Array(p, "p")}, k=len(self.k))["k"]
            yield self._rates_column({"k": k})

    def _rates_column(self, changed: Mapping[str, Sequence[Any]]) -> list[Fraction]:
        """The column (0, δζ̇) where arguments of ``rhs`` have the changed values."""
        rates = self._rates(changed)
        found = self.state.acceleration(self.point.Z, self._inverse(), rates)
        return [ZERO] * len(found) + [part(y, EPS) for y in found]

    def _inverse(self) -> Matrix:
        found = q.inverse(self.point.g)
        assert found is not None
        return found

    def _rates(self, changed: Mapping[str, Sequence[Any]]) -> tuple[Any, ...]:
        return self._called("rhs", "dx", len(self.point.rates), changed)

    def _called(
        self, name: str, array: str, size: int, changed: Mapping[str, Sequence[Any]]
    ) -> tuple[Any, ...]:
        """What a function writes where arguments have the changed values."""
        values = {
            "x": self.point.arguments["x"],
            "u": self.point.arguments["u"],
            "k": self.k,
            **changed,
        }
        arguments = {x: Array(numbers, x) for x, numbers in values.items()}
        given = {"t": self.point.arguments["t"], **arguments}
        return tuple(self.machine.call(name, given, **{array: size})[array])


Call = Callable[..., dict[str, list[Any]]]


@dataclass(frozen=True)
class MomentumFunctions:
    """The comparison at one point. ``call``: runs a function of the module with arguments;
    ``plain``: the machine for other numbers; ``require``: refuses numbers that differ; ``draw``: a
    random number."""

    call: Call
    plain: Machine
    require: Require
    draw: Callable[[], Any]
    point: Point
    chart: Any

    def compare(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """The names of the functions, each found right."""
        x, size = self.point.arguments["x"], len(self.point.rates)
        model: PhasePoint = self.point.named.names.model  # type: ignore[attr-defined]
        # Π_a by its meaning; of points, p_b after it
        momenta = [part(z, 0) for z in model.momenta(model.t, model.g, model.Z)]
        y = self.call("momentum", arguments, out=size)["out"]
        self._same("momentum", y, self._with(x, momenta))
        there = {**arguments, "y": Array(y, "y")}
        found, moved = ["momentum"], self._rate_along_motion(arguments)
        if "velocity_step" in self.plain.module.functions:
            step = self.call("velocity_step", there, out=size)["out"]
            self._same("velocity_step", step, x)
            self._same("velocity_step", self._varied_step(arguments), [0] * size)
            rates = "momentum_rates"
            found += ["velocity_step"]
        else:
            back = self.call("velocity", there, out=size)["out"]
            self._same("velocity", back, x)
            rates = "momentum_rhs"
            found += ["velocity"]
        self._same(rates, self.call(rates, there, dy=size)["dy"], moved)
        tensor = q.flatten(model.brackets())
        self._same("poisson", self.call("poisson", there, out=len(tensor))["out"], tensor)
        return (*found, rates, "poisson")

    @property
    def _velocity(self) -> range:
        """Where the velocity is in the state."""
        d, size = self.chart.group.dimension, len(self.point.rates)
        return range(d) if isinstance(self.chart, ReducedChart) else range(size - d, size)

    def _with(self, x: Sequence[Any], values: Sequence[Any]) -> list[Any]:
        new = dict(zip(self._velocity, values, strict=True))
        return [new.get(i, z) for i, z in enumerate(x)]

    def _rate_along_motion(self, arguments: Mapping[str, Any]) -> list[Any]:
        """The derivative of ``momentum`` along ``rhs``, as fractions."""
        x = [a + EPSILON * b for a, b in self._pairs(self.point.rates)]
        out = self._plain("momentum", arguments, t=self.point.arguments["t"] + EPSILON, x=x)
        return [part(z, EPS) for z in out]

    def _varied_step(self, arguments: Mapping[str, Any]) -> list[Any]:
        """The derivative of a step of Newton's method by the velocity that it begins with."""
        y = [part(z, 0) for z in self._plain("momentum", arguments)]
        change = self._with([0] * len(y), [self.draw() for _ in self._velocity])
        x = [a + EPSILON * b for a, b in self._pairs(change)]
        return [part(z, EPS) for z in self._plain("velocity_step", arguments, x=x, y=y)]

    def _pairs(self, change: Sequence[Any]) -> list[tuple[Any, Any]]:
        return [*zip(self.point.arguments["x"], change, strict=True)]

    def _plain(self, name: str, arguments: Mapping[str, Any], **changed: Any) -> list[Any]:
        """What a function writes, without counting degrees."""
        k = [getattr(z, "value", z) for z in arguments["k"].values]
        given = {**self.point.arguments, "k": k, **changed}
        arrays = {a: z if a == "t" else Array(z, a) for a, z in given.items()}
        return self.plain.call(name, arrays, out=len(self.point.rates))["out"]

    def _same(self, name: str, found: Sequence[Any], wanted: Sequence[Any]) -> None:
        names = [f"number {i}" for i in range(len(wanted))]
        self.require(name, names, found, wanted)
