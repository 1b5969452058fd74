"""The functions and lists of an emitted file against the record, without tolerance.

A rational function that is not zero vanishes at a random point with probability at most
degree / size (Schwartz–Zippel); points are added until all of them at once are improbable enough.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from random import Random
from typing import Any

from ..check.lagrangian.lagrangian_model import LagrangianModel
from ..check.trials.model import Model
from ..language import rational as q
from ..record.as_json import to_json
from .chart import ReducedChart
from .discrete_functions import DiscreteFunctions
from .exact_points import Claims, ExactPoint, WithIntegrals
from .functions_of_state import (
    ExactJacobians,
    Given,
    MomentumFunctions,
    compare_attitude,
    compare_conserved,
    compare_drift,
    compare_names,
    each_moved,
    exact_root,
    is_named,
    slopes,
)
from .straight_line import (
    Measured,
    MeasuredElementary,
    require_straight_line,
    summands,
    tested_parameters,
    with_roots,
)
from .terms import Array, CodeError, DiffersError, Literals, Machine, Module, run

SIZE = 2**128
"""The random integers of a point are of at most this absolute value."""

BOUND, FEWEST, MOST = 1e-40, 2, 20
"""Points are added until a false pass is less probable than BOUND: at least FEWEST, at most
MOST."""


INSIDE = 2**40
"""The random integers of elements of a group that is known by its basis alone."""

DERIVATIVE_DEGREE = 16
"""Times the size of the group, this bounds what a derivative and its way to coordinates add to a
degree, as a factor."""


@dataclass(frozen=True)
class Agreement:
    """The names of the ``functions`` that equal the record at so many ``points``; ``bound`` on the
    probability of a false pass.

    ``rounded``: the decimals that stand for the number that they are nearest to. ``unread``: the
    constants that none of the functions reads, so that nothing is known of them.
    """

    functions: tuple[str, ...]
    points: int
    bound: float
    rounded: tuple[str, ...]
    unread: tuple[str, ...]


def compare(
    module: Module,
    claims: Claims,
    exact: Iterable[Fraction] = (),
    text: str = "",
    bound: float = BOUND,
    kind: type[FileAtPoint] | None = None,
) -> Agreement:
    """The verdict on a module whose functions equal the record; ``CodeError`` where it cannot be
    read, or differs.

    ``exact``: the numbers that decimals may stand for. The points are drawn from a hash of the
    record and of ``text``, that of the files: they are the same at every run, and whoever writes a
    file cannot aim it at them. ``kind``: the comparison at one point.
    """
    kind = kind or FileAtPoint
    compare_names(module, claims)
    functions = {name: with_roots(f) for name, f in module.functions.items()}
    module = replace(module, functions=functions)
    literal = Literals(exact)
    drawn_from = to_json(claims.record) + text
    digest = hashlib.sha256(drawn_from.encode("utf-8", "surrogatepass")).hexdigest()
    first = kind(module, claims, literal, claims.point(f"{digest} 0"), measured=True)
    found = first.compare_all()
    one, points = min(1.0, first.degree / claims.size), 1
    while points < FEWEST or one**points >= bound:
        if points == MOST:
            raise CodeError("its degree is too large for a proof")
        kind(module, claims, literal, claims.point(f"{digest} {points}")).compare_all()
        points += 1
    for zero in _tested_sets(module):
        _compare_at_zero(kind, module, claims, literal, digest, zero)
    size = module.sizes.get("CONSTANTS", 0)
    unread = tuple(f"k[{i}]" for i in range(size) if i not in first.read)
    return Agreement(found, points, one**points, tuple(sorted(literal.rounded)), unread)


def _tested_sets(module: Module) -> list[tuple[str, ...]]:
    """The sets of parameters to be tried as 0, where the code branches on that: each that it tests
    alone, and all at once."""
    found = sorted({i for f in module.functions.values() for i in tested_parameters(f)})
    names = tuple((module.parameters or ())[i] for i in found)
    return list(dict.fromkeys([*((x,) for x in names), names])) if names else []


def _compare_at_zero(
    kind: type[FileAtPoint],
    module: Module,
    claims: Claims,
    literal: Literals,
    seed: str,
    zero: tuple[str, ...],
) -> None:
    """Compare at a point where these parameters are 0, if the record has values there."""
    try:
        point = claims.point(f"{seed} zero", zero)
    except CodeError:
        return
    kind(module, claims, literal, point).compare_all()


class FileAtPoint:
    """The comparison of one module with the record at one exact point; ``measured``: its degrees
    are found as well."""

    def __init__(
        self,
        module: Module,
        claims: Claims,
        literal: Literals,
        point: ExactPoint,
        *,
        measured: bool = False,
    ):
        self.module, self.claims, self.literal = module, claims, literal
        self.measured, self.point = measured, point
        self.random = Random(str(point.rates))
        circles = dict.fromkeys(self.point.circles, claims.entry_degree)
        self.elementary = MeasuredElementary(self.point.elementary, circles)
        values = self.elementary if measured else self.point.elementary
        drawn = point.elementary.value if hasattr(point.elementary, "value") else values
        whole = WithIntegrals(values, drawn, measured)
        self.machine = Machine(module, whole, literal)
        self.plain = Machine(module, WithIntegrals(point.elementary, drawn), literal)
        self.read: set[int] = set()
        self.largest = 0

    @property
    def degree(self) -> int:
        """A bound on the degree of a difference, and of what makes two arguments of elementary
        functions equal by chance."""
        record = self.claims.degree
        pairs = self.elementary.calls * len(self.point.elementary.values)
        own = DERIVATIVE_DEGREE * self.claims.group.size * self.largest
        return own + record + pairs * (self.elementary.largest + record)

    def compare_all(self) -> tuple[str, ...]:
        """The names of the module's functions, once each has been found equal to the record's;
        ``CodeError`` else."""
        self.require_straight()
        arguments, point, found = self._arguments(), self.point, ["constants", "rhs", "energy"]
        self._compared("rhs", arguments, "dx", self._rates, point.rates)
        self._compared("energy", arguments, "value", ("the energy",), (point.energy,))
        if "rhs_batch" in self.module.functions:
            self._batches(arguments)
            found.append("rhs_batch")
        if "inertia" in self.module.functions:
            names = tuple(f"I_{i}{j}" for i in range(1, 4) for j in range(i, 4))
            found.append(self._compared("inertia", arguments, "value", names, point.inertia))
        if "project" in self.module.functions:
            drift = partial(self._drift_numbers, arguments)
            found.append(compare_drift(drift, self._draw, self.claims.state, point))
        if "jacobian_project" in self.module.functions:
            found.append(self._slopes_of_project(arguments))
        if "to_matrix" in self.module.functions:
            own = self._attitude, self._require_equal, self.claims.state
            found += compare_attitude(*own, point)
        if "multiplier" in self.module.functions:
            theta = (point.named.names["θ"],)
            found.append(self._compared("multiplier", arguments, "value", ("theta",), theta))
        if "conserved" in self.module.functions:
            found.append(self._conserved(arguments))
        if "outputs" in self.module.functions:
            names = self.claims.outputs
            wanted = [point.named.parameters[name] for name in names]
            found.append(self._compared("outputs", arguments, "out", names, wanted))
        if "bias" in self.module.functions:
            found += self._dynamics(arguments)
        found += self._discrete(arguments)
        return (*found, *self._in_momenta(arguments), *self._jacobians(arguments))

    def require_straight(self) -> None:
        """``CodeError`` for a function with loops or branches."""
        for f in self.module.functions.values():
            require_straight_line(f)

    @property
    def _rates(self) -> tuple[str, ...]:
        return tuple(f"the rate of {x}" for x in self.claims.state.names)

    def _arguments(self) -> dict[str, Any]:
        """The arguments that the functions may take at the point: t, x, u, p and the constants k
        that the module computes."""
        arguments, listed = self.point.arguments, self.module.parameters or ()
        p = self._array([self.point.parameters[x] for x in listed], "p", self.claims.moment_degree)
        k = self._call("constants", {"p": p}, k=self.module.sizes.get("CONSTANTS", 0))["k"]
        return {
            "t": self._measured([arguments["t"]], (1, 0))[0],
            "x": self._array(arguments["x"], "x", self.claims.entry_degree),
            "u": self._array(arguments["u"], "u", (1, 0)),
            "p": p,
            "k": Array(k, "k"),
        }

    def _measured(self, values: Iterable[Any], degrees: tuple[int, int]) -> list[Any]:
        return [Measured(x, *degrees) if self.measured else x for x in values]

    def _array(self, values: Iterable[Any], name: str, degrees: tuple[int, int]) -> Array:
        return Array(self._measured(values, degrees), name)

    def _call(self, name: str, arguments: Mapping[str, Any], **sizes: int) -> dict[str, list[Any]]:
        """The arrays that a function writes, or returns, as lists by name."""
        try:
            found = self.machine.call(name, arguments, **sizes)
        except CodeError as error:
            raise type(error)(f"{name}: {error}") from None
        if "k" in arguments:
            self.read |= arguments["k"].read
        self._measure([x for values in found.values() for x in values])
        return found

    def _compared(
        self,
        name: str,
        arguments: Mapping[str, Any],
        array: str,
        names: Sequence[str],
        wanted: Sequence[Any],
    ) -> str:
        """The name of a function that writes the array that is wanted; else ``DiffersError``."""
        found = self._call(name, arguments, **{array: len(wanted)})[array]
        self._require_equal(name, names, found, wanted)
        return name

    def _measure(self, values: Iterable[Any]) -> None:
        """Take the degrees of these values into account."""
        degrees = (x.degree for x in values if isinstance(x, Measured))
        self.largest = max([self.largest, *degrees])

    def _batches(self, arguments: Mapping[str, Any]) -> None:
        """``rhs_batch`` on three numbers of states."""
        for count in (1, self.random.randint(2, 3), self.random.randint(4, 9)):
            self._batch(arguments, count)

    def _batch(self, arguments: Mapping[str, Any], count: int) -> None:
        """Compare ``rhs_batch`` with ``rhs`` on ``count`` states: that of the point, and random
        ones.

        An index is made of n and s by sums and products alone, so three counts tell two apart.
        """
        size, degrees = len(self.point.rates), {"x": self.claims.entry_degree, "u": (1, 0)}
        states = [dict(arguments) for _ in range(count)]
        for other in states[1:]:
            for name, d in degrees.items():
                drawn = [self._draw() for _ in arguments[name].values]
                other[name] = self._array(drawn, name, d)
        both = dict(arguments) | {"n": len(states)}
        for name in degrees:
            rows = zip(*(x[name].values for x in states), strict=True)
            both[name] = Array([x for row in rows for x in row], name)
        found = self._call("rhs_batch", both, dx=len(states) * size)["dx"]
        self._require_equal("rhs_batch", self._rates, found[:: len(states)], self.point.rates)
        for s, other in enumerate(states[1:], 1):
            rates = self._call("rhs", other, dx=size)["dx"]
            self._require_equal("rhs_batch", self._rates, found[s :: len(states)], rates)

    def _drift_numbers(
        self, arguments: Mapping[str, Any], name: str, x: Sequence[Any]
    ) -> Sequence[Any]:
        """The numbers of ``project`` at the state x, or the summands of ``defect`` there."""
        exact = all(isinstance(y, Fraction) for y in x)
        state = self._array(x, "x", self.claims.entry_degree) if exact else Array(x, "x")
        arguments, function = {**arguments, "x": state}, self.module.functions.get("defect")
        if name == "project":
            found = self._call(name, arguments, out=len(x))["out"]
        elif function is None:
            raise CodeError("defect: there is no such function")
        else:
            elementary, literal = self.machine.elementary, self.machine.literal
            found = run(summands(function), arguments, elementary, literal)
            self._measure(found)
        return [getattr(y, "value", y) for y in found]

    def _slopes_of_project(self, arguments: Mapping[str, Any]) -> str:
        """Compare ``jacobian_project`` with the derivative of ``project`` at a state off the
        group, from where a step is taken there."""
        x = [self._draw() for _ in self.point.rates]
        moved = (self._drift_numbers(arguments, "project", y) for y in each_moved(x))
        columns = [*map(slopes, moved)]
        there = {**arguments, "x": self._array(x, "x", self.claims.entry_degree)}
        D = [y for row in zip(*columns, strict=True) for y in row]
        names = [f"entry {i}" for i in range(len(D))]
        return self._compared("jacobian_project", there, "D", names, D)

    def _attitude(self, name: str, x: Sequence[Any], size: int) -> Sequence[Any]:
        """The numbers of ``to_matrix`` at the state x, or of ``from_matrix`` at z."""
        letter = "z" if name == "from_matrix" else "x"
        given = {letter: self._array(x, letter, self.claims.entry_degree)}
        exact = self.point.circles

        def elementary(function: str, y: Any) -> Any:
            at = (function, getattr(y, "value", y))
            if at not in exact:
                return exact_root(function, y)
            return Measured(exact[at], *self.claims.entry_degree)

        found = Machine(self.module, elementary, self.literal).call(name, given, out=size)["out"]
        self._measure(found)
        return found

    def _draw(self) -> Fraction:
        return Fraction(self.random.randint(1, self.claims.size))

    def _conserved(self, arguments: Mapping[str, Any]) -> str:
        """Compare what ``conserved`` gives at the point with what it gives a moment later."""
        count = self.module.sizes.get("CONSERVED", -1)
        self._call("conserved", arguments, out=count)
        given = self._given(arguments)
        return compare_conserved(self.plain, given, self._inside(), self._draw, count)

    def _given(self, arguments: Mapping[str, Any]) -> Given:
        """The arguments as numbers without degrees."""
        arrays = {a: [getattr(x, "value", x) for x in arguments[a].values] for a in ("p", "k")}
        return {**self.point.arguments, **arrays}

    def _inside(self) -> Sequence[Any]:
        """The state of the point; where its g is any matrix, one with an element of the group."""
        state, point = self.claims.state, self.point
        if isinstance(state, ReducedChart) or is_named(state.group) or state.on_the_group:
            return tuple(point.arguments["x"])
        return state.values(state.group.sample_inside(self.random, INSIDE), point.Z)

    def _in_momenta(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """The names of the functions in momenta, where there are some, each found right."""
        if "momentum" not in self.module.functions:
            return ()
        return MomentumFunctions(*self._own(arguments)).compare(arguments)

    def _own(self, arguments: Mapping[str, Any]) -> tuple[Any, Any, Any, Any, Any, Any, Any]:
        """What :class:`FunctionsCalled` are made of."""
        called = self._call, self.plain, self._given(arguments), self._require_equal
        return (*called, self._draw, self.point, self.claims.state)

    def _dynamics(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """Compare the mass matrix with the checker's metric, the bias with −M ζ̇, and the inverse
        with M a + b, b the bias of the module where no input acts."""
        group, point = self.claims.state.group, self.point
        model = getattr(point.named.names, "model", None)
        assert isinstance(model, (Model, LagrangianModel))
        columns = q.transposed(tuple(map(model.group.nearest, group.basis)))
        M = q.times(q.transposed(columns), q.times(model.metric, columns))
        names = [f"entry {i}" for i in range(len(M) ** 2)]
        self._compared("mass_matrix", arguments, "D", names, q.flatten(M))
        rates = q.times(M, q.column(self._accelerations))
        self._compared("bias", arguments, "out", names[: len(M)], [-x for (x,) in rates])
        if "inverse" not in self.module.functions:  # where an input is divided by
            return "mass_matrix", "bias"
        none = [Fraction(0) for _ in self.claims.inputs]
        unforced = {**arguments, "u": self._array(none, "u", (0, 0))}
        wanted = [self._draw() for _ in M]
        given = {**arguments, "dzeta": self._array(wanted, "dzeta", (1, 0))}
        left = self._call("bias", unforced, out=len(M))["out"]
        pushed = q.flatten(q.times(M, q.column(wanted)))
        sums = [x + getattr(y, "value", y) for x, y in zip(pushed, left, strict=True)]
        self._compared("inverse", given, "Q", names[: len(M)], sums)
        return "mass_matrix", "bias", "inverse"

    @property
    def _accelerations(self) -> Sequence[Any]:
        """The rates of the velocity, in the basis of the state."""
        state, point = self.claims.state, self.point
        if isinstance(state, ReducedChart):
            return point.rates[: state.group.dimension]
        return state.acceleration(point.Z, q.inverted(point.g), point.rates)

    def _discrete(self, arguments: Mapping[str, Any]) -> tuple[str, ...]:
        """The names of the functions of a discrete step, where there is one, each found right."""
        if "step_momentum" not in self.module.functions:
            return ()
        moments, entry = self.claims.moment_degree, self.claims.entry_degree
        most = DERIVATIVE_DEGREE * self.claims.group.size**2 * (sum(moments) + sum(entry))

        def measured(values: Sequence[Any], name: str) -> Array:
            return self._array(values, name, (most, most))

        return DiscreteFunctions(*self._own(arguments), measured).compare(arguments)

    def _jacobians(self, arguments: Mapping[str, Any]) -> list[str]:
        """The names of the module's Jacobians, each found equal to exact derivatives of ``rhs``."""
        own = self.plain, self.claims.state, self.point, self._given(arguments)
        columns = ExactJacobians(*own, len(self.claims.outputs)).columns
        found = [name for name in columns if name in self.module.functions]
        for name in found:
            D = [x for row in zip(*columns[name], strict=True) for x in row]
            rates = {"dx": len(self.point.rates)} if name == "jacobian" else {}
            values = self._call(name, arguments, **rates, D=len(D))
            if rates:
                self._require_equal(name, self._rates, values["dx"], self.point.rates)
            self._require_equal(name, [f"entry {i} of D" for i in range(len(D))], values["D"], D)
        return found

    def _require_equal(
        self, function: str, names: Sequence[str], found: Sequence[Any], wanted: Sequence[Any]
    ) -> None:
        """``DiffersError`` where numbers, of these names, are not those of the record."""
        if len(found) != len(wanted):
            raise DiffersError(f"{function}: {len(found)} numbers, the record has {len(wanted)}")
        for name, x, y in zip(names, found, wanted, strict=True):
            if x != y:
                values = " and ".join(as_text(v) for v in (x, y))
                if as_text(x) == as_text(y):
                    off = getattr(x, "value", x) - getattr(y, "value", y)
                    values += f", {as_text(off)} apart"
                raise DiffersError(f"{function}: {name} differs from the record's: {values}")


def as_text(x: Any) -> str:
    """A number as short text, by its first six digits: numbers with one text may differ."""
    value = Fraction(getattr(x, "value", x))
    return f"{float(value):.6g} …" if abs(value) < Fraction(10) ** 300 else "a large number"
