"""The functions of a state beside the equations, by what they mean: ``project`` and ``defect``,
``to_matrix`` and ``from_matrix``, ``conserved``, the Jacobians, the functions in momenta; and its
names.

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
η̇ = δζ + [Z, η].  On a quotient it is one modulo those of its symmetries, by which a state and its
motion change as g exp(εn) does; without g what the numbers of a state change by.

The momenta and the Poisson tensor are the checker's; their rates, the derivative of the emitted
``momentum`` along the emitted ``rhs``.  A step of Newton's method leaves the velocity alone where
it is right, and its derivative by the velocity vanishes there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any

from ..algebra.factor_charts import QUATERNION, FactorChart
from ..algebra.families import group
from ..algebra.groups import Group, names_by_block
from ..check.claims.spectra_and_residues import residues
from ..check.trials.phase_point import PhasePoint
from ..check.values.arithmetic import EPS, part
from ..language import rational as q
from ..language.rational import Matrix
from .chart import EPSILON, ReducedChart, StateChart
from .exact_points import Claims, ExactPoint
from .straight_line import Measured
from .terms import Array, CodeError, DiffersError, Machine, Module

PRIME = 2**61 - 1
"""The prime modulo which ranks are counted: they are no larger than the true ones."""

Run = Callable[[str, Sequence[Any]], Sequence[Any]]
"""(name, state) → the numbers of ``project``, or the summands of ``defect``, at a state."""


def compare_drift(
    run: Run, draw: Callable[[], Fraction], state: StateChart, point: ExactPoint
) -> str:
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
    if not state.tangent(g, point.Z, slopes(moved)):
        raise DiffersError("project: a change that leaves the group is not taken back")
    seen = [slopes(run("defect", y)) for y in each_moved(x)]
    on_it = 2 * state.group.dimension - len(state.held) + len(state.stored)
    if q.rank(residues(seen, PRIME)) != len(x) - on_it:
        raise DiffersError("defect: it does not see all that leaves the group")
    return "project, defect"


def slopes(numbers: Iterable[Any]) -> list[Any]:
    """The derivatives of nilpotent numbers."""
    return [part(y, EPS) for y in numbers]


def is_named(g: Group) -> bool:
    """Is the group one of the named ones, all of whose relations are known?"""
    try:
        return group(g.name).basis == g.basis
    except ValueError:
        return False


def each_moved(x: Sequence[Any]) -> Iterator[list[Any]]:
    """Numbers of which each in turn is moved, by a nilpotent one."""
    for i in range(len(x)):
        yield [y + EPSILON if i == j else y for j, y in enumerate(x)]


Require = Callable[[str, Sequence[str], Sequence[Any], Sequence[Any]], None]
RunSized = Callable[[str, Sequence[Any], int], Sequence[Any]]
"""(name, state, how many numbers it gives) → these numbers."""


def plain(state: StateChart) -> StateChart:
    """The chart of the same states with matrices alone."""
    return replace(state, chart=replace(state.chart, attitude="matrix"))


def compare_attitude(
    run: RunSized, require_equal: Require, state: StateChart, point: ExactPoint
) -> tuple[str, ...]:
    """The names of the two functions, or of the first where angles count turns, each found right at
    the turns of a point."""
    matrices = plain(state)
    quaternions = [x for x in state.charts.values() if x.kind == QUATERNION]
    names = ("to_matrix", "from_matrix")[: 1 + (len(quaternions) == len(state.charts))]
    for g in (point.g, *(g for chart in quaternions for g in turned(point.g, chart))):
        there, here = matrices.values(g, point.Z), state.values(g, point.Z)
        found = run("to_matrix", here, len(there))
        require_equal("to_matrix", matrices.names, found, there)
        if "from_matrix" in names:
            require_equal("from_matrix", state.names, run("from_matrix", there, len(here)), here)
    return names


def turned(g: Matrix, chart: FactorChart) -> Iterator[Matrix]:
    """The elements whose quaternion of a chart has that of g but for the signs of its vector: D A D
    for the diagonal matrices D of signs, and their transposes."""
    rows = range(chart.offset, chart.offset + chart.size)
    for signs in product((1, -1), repeat=2):
        D = dict(zip(rows, (1, *signs), strict=True))
        for A in (g, q.transposed(g)):
            found = [[*row] for row in g]
            for i in rows:
                for j in rows:
                    found[i][j] = D[i] * A[i][j] * D[j]
            yield q.matrix(found)


def exact_root(name: str, x: Any) -> Any:
    """√x of the square of a fraction; ``CodeError`` for other functions and other numbers."""
    x = Measured.of(x)
    value = Fraction(x.value)
    if name != "sqrt" or value < 0:
        raise CodeError(f"{name} of {float(value):.3g} has no place here")
    root = q.root(value)
    if root is None:
        raise CodeError("the root of a number that is no square")
    return Measured(root, x.num, x.den)


Numbers = Sequence[Any]
Given = Mapping[str, Any]
"""What functions are given at a point: t, and the numbers of x, u, p and k."""


def compare_conserved(
    machine: Machine, given: Given, x: Numbers, draw: Callable[[], Fraction], count: int
) -> str:
    """The name of the function that was found right at a state x; ``DiffersError`` where one of its
    ``count`` numbers is not kept, or is none."""
    at = {**given, "x": x, "u": [Fraction(0)] * len(given["u"])}
    rates = machine.numbers("rhs", at, len(x), "dx")
    ahead = [y + EPSILON * v for y, v in zip(x, rates, strict=True)]
    later = {**at, "x": ahead, "t": at["t"] + EPSILON}
    beside = {**at, "x": [y + EPSILON * draw() for y in x]}
    kept, other = (slopes(machine.numbers("conserved", y, count)) for y in (later, beside))
    for i, (along, off) in enumerate(zip(kept, other, strict=True)):
        if along:
            raise DiffersError(f"conserved: number {i} of it is not kept")
        if not off:
            raise DiffersError(f"conserved: number {i} of it says nothing of the state")
    return "conserved"


ZERO = Fraction(0)


@dataclass(frozen=True)
class ExactJacobians:
    """The derivatives of the rates at one point, and of so many ``outputs``."""

    machine: Machine
    state: StateChart
    point: ExactPoint
    given: Given
    outputs: int = 0

    @property
    def columns(self) -> Mapping[str, Iterator[list[Fraction]]]:
        """Name of a Jacobian → the columns of its matrix D, computed one by one."""
        moves = (*self._varied(), *(self._along(*x) for x in self.symmetries))
        return {
            "jacobian": self._state(),
            "jacobian_inputs": map(self._rates_column, self._beside("u")),
            "jacobian_parameters": map(self._rates_column, self._constants()),
            "jacobian_raw": map(slopes, map(self._rates, self._beside("x"))),
            "jacobian_raw_inputs": map(slopes, map(self._rates, self._beside("u"))),
            "variations": map(slopes, moves),
            "jacobian_outputs": (self._read({"x": x}) for x in self._varied()),
            "jacobian_outputs_inputs": map(self._read, self._beside("u")),
            "jacobian_outputs_raw": map(self._read, self._beside("x")),
        }

    def _varied(self) -> Iterator[Sequence[Any]]:
        """The state, in nilpotent numbers, along η = E_a, then δζ = E_a, then by its masses; where
        there is no g by each of its numbers."""
        if isinstance(self.state, ReducedChart):
            yield from each_moved(self.given["x"])
            return
        none, free = q.scaled(ZERO, self.point.Z), self._free(self.state.group.basis)
        for eta, change in (*((e, none) for e in free), *((none, e) for e in free)):
            yield self._along(eta, change)
        yield from self._heavier()

    def _free(self, listed: Sequence[Any]) -> list[Any]:
        """What belongs to coordinates that are not held."""
        return [x for a, x in enumerate(listed, 1) if a not in self.state.held]

    @cached_property
    def symmetries(self) -> list[tuple[Matrix, Matrix]]:
        """η = n and δZ = ±[Z, n] of each direction n without kinetic energy, with what keeps δZ
        where it is held: of one direction ζ is 1 there, and of the others 0."""
        group, found = self.state.group, list[tuple[Matrix, Matrix]]()
        if not self.state.held:
            return found
        model: Any = self.point.named.names.model  # type: ignore[attr-defined]
        null = [group.hat(n) for n in q.nullspace(model.second_derivatives)]
        for n in null:
            moved = q.bracket(n, self.point.Z) if self.state.right else q.bracket(self.point.Z, n)
            along = group.nearest(moved)
            for a, x in zip(self.state.held, null, strict=True):
                moved = q.minus(moved, q.scaled(along[a - 1], x))
            found.append((n, moved))
        return found

    def _modulo(self, eta: Sequence[Fraction], rest: Sequence[Fraction]) -> list[Fraction]:
        """The coordinates of a variation that are left where a combination of symmetries takes away
        those of η that are held."""
        found = [*self._free(eta), *rest]
        for a, pair in zip(self.state.held, self.symmetries, strict=True):
            own = [y for x in pair for y in self._free(self.state.group.nearest(x))]
            found = [x - eta[a - 1] * y for x, y in zip(found, own, strict=True)]
        return found

    def _along(self, eta: Matrix, change: Matrix) -> Sequence[Any]:
        """The state along η and δζ, with its own masses."""
        moved = self.state.varied(self.point.g, self.point.Z, eta, change)
        x, count = self.given["x"], len(self.state.stored)
        return [*moved[: len(x) - count], *x[len(x) - count :]]

    def _heavier(self) -> Iterator[Sequence[Any]]:
        """The state with each of its masses in turn moved."""
        x, count = self.given["x"], len(self.state.stored)
        yield from [*each_moved(x)][len(x) - count :]

    def _rates_of(self, back: Matrix, Z: Matrix, rates: Sequence[Any]) -> list[Fraction]:
        """What the rates of the velocity, and of masses, change by."""
        count = len(self.state.stored)
        masses = rates[len(rates) - count :]
        return slopes([*self.state.acceleration(Z, back, tuple(rates)), *masses])

    def _beside(self, array: str) -> Iterator[Given]:
        """An array with each of its numbers in turn moved."""
        return ({array: x} for x in each_moved(self.given[array]))

    def _constants(self) -> Iterator[Given]:
        """The constants with each of the parameters in turn moved."""
        for p in each_moved(self.given["p"]):
            yield {"k": self.machine.numbers("constants", {"p": p}, len(self.given["k"]), "k")}

    def _read(self, changed: Given) -> list[Fraction]:
        given = {**self.given, **changed}
        return slopes(self.machine.numbers("outputs", given, self.outputs))

    def _state(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the state: (η̇, δζ̇) for η = E_a, then for δζ = E_a, then
        by masses."""
        if isinstance(self.state, ReducedChart):
            yield from map(self._rates_column, self._beside("x"))
            return
        group, Z = self.state.group, self.point.Z
        none, free = q.scaled(ZERO, Z), self._free(group.basis)
        for e in free:
            turn = group.nearest(q.bracket(Z, e) if self.state.right else q.bracket(e, Z))
            yield self._modulo(turn, self._rates_along(e, none))
        for e in free:
            yield self._modulo(group.nearest(e), self._rates_along(none, e))
        yield from map(self._rates_column, ({"x": x} for x in self._heavier()))

    def _rates_along(self, eta: Matrix, change: Matrix) -> list[Fraction]:
        """δζ̇ for δg = g η and δZ = ``change``."""
        x = self._along(eta, change)
        Z = q.plus(self.point.Z, q.scaled(EPSILON, change))
        undone = q.minus(q.identity(len(eta)), q.scaled(EPSILON, eta))
        back = q.times(undone, q.inverted(self.point.g))
        return self._rates_of(back, Z, self._rates({"x": x}))

    def _rates_column(self, changed: Given) -> list[Fraction]:
        """The column (0, δζ̇) where arguments of ``rhs`` have the changed values."""
        if isinstance(self.state, ReducedChart):
            return slopes(self._rates(changed))
        found = self._rates_of(q.inverted(self.point.g), self.point.Z, self._rates(changed))
        return [ZERO] * len(self._free(self.state.group.basis)) + found

    def _rates(self, changed: Given) -> tuple[Any, ...]:
        given = {**self.given, **changed}
        return (*self.machine.numbers("rhs", given, len(self.point.rates), "dx"),)


Call = Callable[..., dict[str, list[Any]]]


@dataclass(frozen=True)
class FunctionsCalled:
    """What is called and compared at one point. ``call``: runs a function of the module with
    arguments; ``plain``: the machine for other numbers, without counting degrees, and what it is
    ``given``; ``require``: refuses numbers that differ; ``draw``: a random number."""

    call: Call
    plain: Machine
    given: Given
    require: Require
    draw: Callable[[], Any]
    point: ExactPoint
    chart: Any

    def _same(self, name: str, found: Sequence[Any], wanted: Sequence[Any]) -> None:
        names = [f"number {i}" for i in range(len(wanted))]
        self.require(name, names, found, wanted)


@dataclass(frozen=True)
class MomentumFunctions(FunctionsCalled):
    """The comparison of the functions in momenta at one point."""

    def compare(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """The names of the functions, each found right."""
        x, size = self.point.arguments["x"], len(self.point.rates)
        model: PhasePoint = self.point.named.names.model  # type: ignore[attr-defined]
        # Π_a by its meaning; of points, p_b after it
        momenta = [part(z, 0) for z in model.momenta(model.t, model.g, model.Z)]
        y = self.call("momentum", arguments, out=size)["out"]
        self._same("momentum", y, self._with(x, momenta))
        there = {**arguments, "y": Array(y, "y")}
        found, moved = ["momentum"], self._rate_along_motion()
        if "velocity_step" in self.plain.module.functions:
            step = self.call("velocity_step", there, out=size)["out"]
            self._same("velocity_step", step, x)
            self._same("velocity_step", self._varied_step(), [0] * size)
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

    def _rate_along_motion(self) -> list[Any]:
        """The derivative of ``momentum`` along ``rhs``, as fractions."""
        t, x = self.given["t"] + EPSILON, self._moved(self.point.rates)
        return slopes(self._plain("momentum", t=t, x=x))

    def _varied_step(self) -> list[Any]:
        """The derivative of a step of Newton's method by the velocity that it begins with."""
        y = [part(z, 0) for z in self._plain("momentum")]
        x = self._moved(self._with([0] * len(y), [self.draw() for _ in self._velocity]))
        return slopes(self._plain("velocity_step", x=x, y=y))

    def _moved(self, change: Sequence[Any]) -> list[Any]:
        """The state, moved by a multiple of a nilpotent number."""
        pairs = zip(self.given["x"], change, strict=True)
        return [a + EPSILON * b for a, b in pairs]

    def _plain(self, name: str, **changed: Any) -> list[Any]:
        return self.plain.numbers(name, {**self.given, **changed}, len(self.point.rates))


def require_defaults(
    listed: Sequence[str], found: Mapping[str, Any], declared: Mapping[str, Any]
) -> None:
    """``DiffersError`` where the defaults of the parameters are not those of the record."""
    recorded = {x: declared[x]["default"] for x in listed}
    defaults = {x: value for x, value in recorded.items() if value is not None}
    if {x: float(y) for x, y in found.items()} != defaults:
        raise DiffersError("the defaults of the parameters are not those of the record")


def compare_names(m: Module, claims: Claims) -> None:
    """``DiffersError`` where one of the lists is not what record and chart make it."""
    called = names_by_block(claims.group)
    own = (
        ("state", claims.state.names),
        ("state_by_block", tuple(called.get(x, x) for x in claims.state.names)),
        ("inputs", claims.inputs),
        ("outputs", claims.outputs),
    )
    for what, names in own:
        if (getattr(m, what) or names) != names:
            raise DiffersError(f"the names of {what} are not {', '.join(names) or 'none'}")
    declared, listed = claims.record.problem["parameters"], m.parameters or ()
    if listed != tuple(x for x in declared if x in listed):
        raise DiffersError("the parameters are not those of the record, in its order")
    sizes = {
        "STATE": len(claims.state.names),
        "INPUTS": len(claims.inputs),
        "PARAMETERS": len(listed),
        "ALGEBRA": claims.group.dimension,
    }
    if claims.outputs:
        sizes["OUTPUTS"] = len(claims.outputs)
    if claims.state.on_the_group:
        sizes["MATRIX"] = len(plain(claims.state).names)
    for what, size in sizes.items():
        if m.sizes.get(what, size) != size:
            raise DiffersError(f"the size {what} is {m.sizes[what]}, not {size}")
    if m.defaults is not None:
        require_defaults(listed, m.defaults, declared)
    if m.basis is not None and m.basis != claims.state.group.basis:
        raise DiffersError("the basis is not that of the record")
