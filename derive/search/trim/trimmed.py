"""Which inputs keep the velocity of a state as it is: solved exactly, in the emitted equations.

Where inputs act linearly, which is tried at other ones, ζ̇ = a + Bu.  At rest, Z = 0, nothing moves
then.  Else g moves on by exp(tY), Y = gZg⁻¹ (on the right g⁻¹Zg), and keeps ζ̇ = 0 where ζ̇ at this
velocity and with these inputs is the same at g and at exp(tY)g for every g; which is tried at a
random exact one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ...algebra.groups import Group
from ...code.program import Program
from ...language import rational as q
from ...language.limits import Refused
from ...language.rational import Matrix
from ...language.reserved import did_you_mean, near_name
from ...language.tree import nodes
from ...language.univariate import Number, grows, routh
from ...problem.fields import state_names
from ...problem.problem import Problem
from ..equilibria.stability import eigenvalues, polynomial

Numbers = Mapping[str, Fraction]
EXACT = 2**40
"""A number of a program with a larger power of two below is one that has no fraction, as π."""


class NoTrimError(Refused, ValueError):
    """There is none, or there are many, or the question is none: the message says which."""


@dataclass(frozen=True)
class Trim:
    """An equilibrium under inputs.  ``state``, ``inputs``: name → number; ``free``: the names of
    those inputs that were found; ``matrix``: D of the equations linearised in (η, δζ), (2d, 2d),
    the inputs held; ``resting``: is the velocity 0?"""

    state: Numbers
    inputs: Numbers
    free: tuple[str, ...]
    matrix: Matrix
    resting: bool

    @cached_property
    def characteristic(self) -> tuple[Fraction, ...]:
        """The characteristic polynomial of the matrix, from the highest power."""
        return tuple(map(Fraction, polynomial(self.matrix)))  # type: ignore[arg-type]

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", by the real parts of all eigenvalues,
        "unstable", or "open" for nothing."""
        if grows(self.characteristic[::-1]):
            return "unstable"
        return "stable" if routh(self.characteristic) else "open"

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About those of the matrix, in 1/s."""
        return eigenvalues(self.matrix)


def trimmed(
    problem: Problem, program: Program, at: Mapping[str, Number], free: Sequence[str] | None = None
) -> Trim:
    """The inputs ``free``, or all that are not given, for a state and other inputs: those ``at``
    has, else g = 1 and 0.  ``program``: with its jacobian.  ``NoTrimError``."""
    numbers = {x: y for x, y in at.items() if isinstance(y, (int, Fraction))}
    if others := [f"{x} is {y}" for x, y in at.items() if x not in numbers]:
        raise NoTrimError(f"{others[0]}: give a rational number")
    return _Question(problem, program, numbers, free).answered()


class _Question:
    """The state and the inputs of which something is asked."""

    def __init__(
        self,
        problem: Problem,
        program: Program,
        at: Mapping[str, Fraction],
        free: Sequence[str] | None,
    ):
        assert problem.group
        self.group: Group = problem.group.in_user_basis
        self.program, self.d = program, program.dimension
        self.right = program.variation.startswith("eta")
        self.places = entries_of(problem.group)
        self.require()
        names = (*program.state, *program.inputs)
        for name in (*at, *(free or ())):
            if name not in names:
                near = did_you_mean(near_name(name, names), "; ")
                raise NoTrimError(f"{name} is no number of the state and no input{near}")
        self.free = (*(free or (x for x in program.inputs if x not in at)),)
        for name in self.free:
            if name not in program.inputs:
                raise NoTrimError(f"--free {name}: of the state; inputs alone are found")
            if name in at:
                raise NoTrimError(f"{name} is given by --at, and free: leave out one")
        one = q.identity(self.group.size)
        start = {x: one[i][j] for x, (i, j) in self.places.items()}
        self.x = [Fraction(at.get(n, start.get(n, 0))) for n in program.state]
        self.u = [Fraction(at.get(n, 0)) for n in program.inputs]
        p = [Fraction(str(x[1])) for x in program.parameters]
        try:
            self.k = program.functions["constants"].values({"p": p}, _no_function)
        except ZeroDivisionError:
            raise NoTrimError("no body has these parameters: its mass matrix is singular") from None
        self.Z = self.group.hat(self.x[-self.d :])

    def require(self) -> None:
        """``NoTrimError`` where this has no exact numbers, or has the time in it."""
        program = self.program
        if missing := [x[0] for x in program.parameters if x[1] is None]:
            raise NoTrimError(f"a trim is of numbers, and {missing[0]} has no default")
        below = [x.denominator for x in program.numbers()]
        exact = all(x < EXACT or x & (x - 1) for x in below)
        functions = program.functions["rhs"].calls() | program.functions["constants"].calls()
        inside = (x for e in program.functions["rhs"].expressions for x in nodes(e))
        functions |= {"abs" for x in inside if isinstance(x, tuple) and x[0] == "abs"}
        if functions or not exact:
            what = ", ".join(sorted(functions)) or "π, or a root,"
            raise NoTrimError(f"a trim is exact, and {what} is in the equations")
        if any(x.array == "t" for x in program.functions["rhs"].loads):
            raise NoTrimError("what acts depends on the time: nothing is steady")

    def answered(self) -> Trim:
        """The trim; ``NoTrimError`` where there is none, or there are many."""
        self.require_element()
        held = self.rates({})
        columns = tuple(self.changed(held, {name: Fraction(1)}) for name in self.free)
        by = {name: Fraction(k * k + 3, 7) for k, name in enumerate(self.free)}
        together = q.times((tuple(by.values()),), columns)[0] if columns else self.changed(held, by)
        if self.changed(held, by) != together:
            raise NoTrimError("inputs do not act linearly: give these by --at, or leave them out")
        found = self.solved(columns, held)
        u = self.with_more(found)
        if moving := any(self.x[-self.d :]):
            self.require_steady(u)
        return Trim(
            dict(zip(self.program.state, self.x, strict=True)),
            dict(zip(self.program.inputs, u, strict=True)),
            self.free,
            self.linear(self.x, u),
            not moving,
        )

    def solved(self, columns: Matrix, held: Sequence[Fraction]) -> dict[str, Fraction]:
        """The free inputs by name, of which each moves ζ̇ by a row of ``columns``."""
        velocity = self.program.state[-self.d :]
        for row in q.nullspace(columns) if columns else q.identity(self.d):
            if left := q.dot(row, held):
                scale = next(x for x in row if x)
                terms = " + ".join(
                    (f"({x / scale}) " if x != scale else "") + f"d{n}/dt"
                    for x, n in zip(row, velocity, strict=True)
                    if x
                )
                free = ", ".join(self.free)
                verb = "are" if len(self.free) > 1 else "is"
                whatever = f"whatever {free} {verb}" if free else "no input is free"
                raise NoTrimError(f"no trim: {terms} is {left / scale}, {whatever}")
        if not columns:
            return {}
        if many := q.nullspace(q.transposed(columns)):
            along = "; ".join(f"({', '.join(map(str, x))})" for x in many)
            raise NoTrimError(
                f"many trims: a family of dimension {len(many)}, for multiples of {along} of "
                f"({', '.join(self.free)}) change nothing; give {len(many)} of these by --at"
            )
        u = q.solve(q.transposed(columns), q.column([-x for x in held]))
        assert u
        return dict(zip(self.free, (x for (x,) in u), strict=True))

    # -- the emitted equations ---------------------------------------------------------------------

    def _values(self, name: str, x: Sequence[Fraction], u: Sequence[Fraction]) -> list[Any]:
        arrays = {"x": x, "k": self.k, "u": u}
        return self.program.functions[name].values(arrays, _no_function)

    def with_more(self, more: Numbers) -> list[Fraction]:
        """All inputs, with some more."""
        pairs = zip(self.program.inputs, self.u, strict=True)
        return [x + more.get(name, 0) for name, x in pairs]

    def rates(self, more: Numbers) -> list[Any]:
        """ζ̇ in the state, with some inputs more."""
        return self._values("rhs", self.x, self.with_more(more))[-self.d :]

    def changed(self, held: Sequence[Fraction], more: Numbers) -> tuple[Fraction, ...]:
        """What ζ̇ is more with some inputs more."""
        return tuple(y - x for x, y in zip(held, self.rates(more), strict=True))

    def linear(self, x: Sequence[Fraction], u: Sequence[Fraction]) -> Matrix:
        """D in a state, with inputs."""
        found, n = self._values("jacobian", x, u)[len(x) :], 2 * self.d
        return tuple(tuple(found[n * i : n * i + n]) for i in range(n))

    # -- the group ---------------------------------------------------------------------------------

    def element(self) -> Matrix:
        """g, a matrix of the group's size."""
        g = [[*row] for row in q.identity(self.group.size)]
        for name, value in zip(self.program.state, self.x, strict=True):
            if name in self.places:
                i, j = self.places[name]
                g[i][j] = value
        return q.matrix(g)

    def require_element(self) -> None:
        """``NoTrimError`` where g is off the group by its relations, or these are not all."""
        g, whole = self.element(), self.program.functions.get("defect")
        if g == q.identity(self.group.size):
            return
        off = whole.values({"x": self.x}, _no_function)[0] if whole else 0
        blocks = (
            tuple(row[k : k + factor.n] for row in g[k : k + factor.n])
            for k, factor in self.group.places
        )
        if off or any(q.determinant(a) <= 0 for a in blocks):
            raise NoTrimError(f"no element of {self.group.name} has the entries that --at gives")
        if self.group.larger:
            raise NoTrimError(f"of {self.group.name}, g = 1 alone is proved to be an element")

    def require_steady(self, u: Sequence[Fraction]) -> None:
        """``NoTrimError`` where ζ̇ may change as g moves on."""
        g, other = self.element(), self.group.sample(Random(1))
        h = q.times(other, inverse(g)) if self.right else q.times(inverse(other), g)
        eta = self.group.nearest(q.times(q.times(h, self.Z), inverse(h)))
        entries = {x: other[i][j] for x, (i, j) in self.places.items()}
        x = [entries.get(n, y) for n, y in zip(self.program.state, self.x, strict=True)]
        below = self.linear(x, u)[self.d :]
        for name, row in zip(self.program.state[-self.d :], below, strict=True):
            if q.dot(row[: self.d], eta):
                raise NoTrimError(
                    f"no steady motion is proved: d{name}/dt is 0 now, but what acts may be "
                    "other where g goes"
                )


def entries_of(group: Group) -> dict[str, tuple[int, int]]:
    """The names of the entries of g in the state → their places in it, from 0."""
    named = state_names(group).items()
    return {x: (t[2] - 1, t[3] - 1) for x, t in named if isinstance(t, tuple) and t[1] == "A"}


def inverse(g: Matrix) -> Matrix:
    """g⁻¹."""
    found = q.inverse(g)
    assert found
    return found


def _no_function(name: str, x: Any) -> Any:
    """The absolute values and the tests for 0 of constants; no other function is left."""
    return Fraction(int(x == 0)) if name == "none" else abs(x)
