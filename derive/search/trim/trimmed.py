"""Which inputs keep the velocity of a state as it is: solved exactly, in the emitted equations.

Where inputs act linearly, which is tried at other ones, ζ̇ = a + Bu.  At rest, Z = 0, nothing moves
then.  Else g moves on by exp(tY), Y = gZg⁻¹ (on the right g⁻¹Zg), and keeps ζ̇ = 0 where ζ̇ at this
velocity and with these inputs is the same at g and at exp(tY)g for every g; which is tried at a
random exact one.

Numbers are of one quadratic field, so that a speed ‖v‖ = √(v·v) is exact.  Where s = √q is 0 it has
no derivative: F(x, s) has then that of F(x, 0) where ∂F/∂s = 0 in the point, as ‖v‖v, and what is
left is small with its differences, which is all that Lyapunov's theorems need.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ...algebra.groups import Group
from ...code.program import Program
from ...language import rational as q
from ...language.rational import Matrix
from ...language.univariate import Number, Quadratic, RootError, grows, root, routh
from ...problem.fields import entries, state_names
from ...problem.problem import Problem
from ...schema.table import nearest
from ..equilibria.stability import eigenvalues, polynomial
from .cayley_chart import slopes as chart_slopes
from .cayley_chart import turned
from .steady_velocity import FLOATS, Arithmetic, NoTrimError, Rates, exact, solutions

Numbers = Mapping[str, Number]
EXACT = 2**40
"""A number of a program with a larger power of two below is one that has no fraction, as π."""
ROUNDING = 1e-9
"""A sum of floats that is smaller, beside its terms, is 0."""
PRIME = 2**61 - 1
"""p, in the place of a root that is 0: F(x, p) − F(x, 0) is 0 modulo p² where ∂F/∂s is 0."""


@dataclass(frozen=True)
class Trim:
    """An equilibrium under inputs.  ``state``, ``inputs``: name → number; ``free``: the names of
    those inputs that were found, ``sought``: of the velocities and turns of g; ``matrix``: D of the
    equations linearised in (η, δζ), (2d, 2d), the inputs held; ``resting``: is the velocity 0?
    ``corner``: is a root 0 there, which has no derivative?"""

    state: Numbers
    inputs: Numbers
    free: tuple[str, ...]
    sought: tuple[str, ...]
    matrix: Matrix
    resting: bool
    corner: bool

    @cached_property
    def characteristic(self) -> tuple[Number, ...]:
        """The characteristic polynomial of the matrix, from the highest power."""
        return polynomial(self.matrix)

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
    """The inputs, velocities and turns of g ``free``, or all inputs that are not given, for a state
    and other inputs: those ``at`` has, else g = 1 and 0; ``program``: with its jacobian.
    ``NoTrimError`` where there is none, or several."""
    try:
        return _Question(problem, program, at, free).answered()
    except RootError as error:
        raise NoTrimError(
            f"a trim is in numbers of one square root, and meets others: {error}"
        ) from None
    except ZeroDivisionError:
        raise NoTrimError("what acts has no value in this state: it divides by 0") from None


class _Question:
    """The state and the inputs of which something is asked."""

    def __init__(
        self,
        problem: Problem,
        program: Program,
        at: Mapping[str, Number],
        free: Sequence[str] | None,
    ):
        assert problem.group
        self.group: Group = problem.group.in_user_basis
        self.program, self.d = program, program.dimension
        self.right = program.variation.startswith("eta")
        self.places = entries_of(problem.group)
        self.require()
        velocity = program.state[-self.d :]
        self.turns = {x.replace("zeta", "eta"): a for a, x in enumerate(velocity) if "zeta" in x}
        self.require_names(at, ())
        self.require_names(free or (), self.turns)
        wanted = free or [x for x in program.inputs if x not in at]
        self.free = tuple(x for x in wanted if x in program.inputs)
        self.sought = tuple(x for x in wanted if x not in program.inputs)
        if given := [x for x in self.free if x in at]:
            raise NoTrimError(f"{given[0]} is given by --at, and free: leave out one")
        if fixed := [x for x in self.sought if x not in (*velocity, *self.turns)]:
            raise NoTrimError(
                f"--free {fixed[0]}: of g, which --at gives, as A_11=4/5 with all that change so; "
                "inputs, velocities and turns from there, as eta_1, are found"
            )
        self.velocities = [x for x in self.sought if x in velocity]
        self.near = [float(at[x]) for x in self.velocities if x in at]
        if 0 < len(self.near) < len(self.velocities):
            raise NoTrimError("--at gives some of the velocities that are free: give all or none")
        one = q.identity(self.group.size)
        start = {x: one[i][j] for x, (i, j) in self.places.items()}
        self.x: list[Number] = [at.get(n, start.get(n, Fraction(0))) for n in program.state]
        self.u: list[Number] = [at.get(n, Fraction(0)) for n in program.inputs]
        p = [Fraction(str(x[1])) for x in program.parameters]
        try:
            self.k = program.functions["constants"].values({"p": p}, EXACTLY.call)
        except ZeroDivisionError:
            raise NoTrimError("no body has these parameters: its mass matrix is singular") from None

    def require_names(self, names: Iterable[str], more: Iterable[str]) -> None:
        """``NoTrimError`` where one is no number of the state and no input, and is not in more."""
        known = (*self.program.state, *self.program.inputs, *more)
        for name in names:
            if name not in known:
                near = nearest(name, known) or f"; these are {entries(known)}"
                raise NoTrimError(f"{name} is no number of the state and no input{near}")

    def require(self) -> None:
        """``NoTrimError`` where this has no exact numbers, or has the time in it."""
        program = self.program
        if missing := [x[0] for x in program.parameters if x[1] is None]:
            raise NoTrimError(f"a trim is of numbers, and {missing[0]} has no default")
        below = [x.denominator for x in program.numbers()]
        fractions = all(x < EXACT or x & (x - 1) for x in below)
        functions = program.functions["rhs"].calls() | program.functions["constants"].calls()
        if (functions := functions - {"sqrt", "abs"}) or not fractions:
            what = ", ".join(sorted(functions)) or "π, or a root,"
            verb = "are" if len(functions) > 1 else "is"
            out = "; let parameters stand for their values" if functions else ""
            raise NoTrimError(f"a trim is exact, and {what} {verb} in the equations{out}")
        if any(x.array == "t" for x in program.functions["rhs"].loads):
            raise NoTrimError("what acts depends on the time: nothing is steady")

    def answered(self) -> Trim:
        """The trim; ``NoTrimError`` where there is none, or there are many."""
        self.require_element()
        if self.sought:
            self.find_state()
            self.require_element()
        held = self.rates({})
        columns = tuple(self.changed(held, {name: Fraction(1)}) for name in self.free)
        by = {name: Fraction(k * k + 3, 7) for k, name in enumerate(self.free)}
        together = q.times((tuple(by.values()),), columns)[0] if columns else self.changed(held, by)
        if self.changed(held, by) != together:
            raise NoTrimError("inputs do not act linearly: give these by --at, or leave them out")
        u = self.with_more(self.solved(columns, held))
        if moving := any(self.x[-self.d :]):
            self.require_steady(u)
        return Trim(
            dict(zip(self.program.state, self.x, strict=True)),
            dict(zip(self.program.inputs, u, strict=True)),
            self.free,
            self.sought,
            self.linear(self.x, u),
            not moving,
            self.has_corner(u),
        )

    def find_state(self) -> None:
        """Put those velocities, and turns of g, in the state with which, and with free inputs, its
        rates vanish."""
        program, g = self.program, self.element()
        places = [program.state.index(x) for x in self.velocities]
        turns = [self.turns[x] for x in self.sought if x in self.turns]
        inputs = [program.inputs.index(x) for x in self.free]
        n = len(places) + len(turns)

        def eta(y: Sequence[Any]) -> list[Any]:
            by = dict(zip(turns, y[len(places) : n], strict=True))
            return [by.get(a, Fraction(0)) for a in range(self.d)]

        def at(y: Sequence[Any]) -> tuple[list[Any], list[Any]]:
            x, u = [*self.x], [*self.u]
            if turns:
                there = turned(self.group, g, eta(y), right=self.right)
                for i, name in enumerate(program.state[: -self.d]):
                    row, column = self.places[name]
                    x[i] = there[row][column]
            for i, value in zip(places, y, strict=False):
                x[i] = value
            for i, value in zip(inputs, y[n:], strict=True):
                u[i] = value
            return x, u

        def rates(y: Sequence[Any], numbers: Arithmetic) -> list[Any]:
            return self._values("rhs", *at(y), numbers)[-self.d :]

        def slopes(y: Sequence[Any], numbers: Arithmetic) -> list[list[Any]]:
            x, u = at(y)
            D = self._rows(self._values("jacobian", x, u, numbers))[self.d :]
            first = self.d - len(x)
            chart = chart_slopes(self.group, eta(y), right=self.right) if turns else ()
            more = [
                rates([*y[: n + k], y[n + k] + 1, *y[n + k + 1 :]], numbers)
                for k, _ in enumerate(inputs)
            ]
            held = rates(y, numbers)
            return [
                [
                    *(row[self.d + first + i] for i in places),
                    *(q.dot(row[: self.d], chart[a]) for a in turns),
                    *(m[b] - held[b] for m in more),
                ]
                for b, row in enumerate(D)
            ]

        names = (*self.velocities, *(x for x in self.sought if x in self.turns), *self.free)
        y = exact(names, solutions(Rates(names, len(places), rates, slopes), self.near))
        self.x, self.u = at(y)
        if any(self.rates({})):
            told = ", ".join(f"{x} = {float(v):.8g}" for x, v in zip(names, y, strict=True))
            raise NoTrimError(f"near {told} a rate is small, and not 0 in numbers of a square root")
        if q.rank(q.matrix(slopes(y, EXACTLY))) < len(y):
            raise NoTrimError("many trims: others are near this one; free fewer")
        for i in inputs:  # they are found once more, linearly
            self.u[i] = Fraction(0)

    def has_corner(self, u: Sequence[Number]) -> bool:
        """Is a root 0 in the state?  ``NoTrimError`` where the rates have no derivative then."""
        met: list[str] = []

        def call(name: str, x: Any) -> Any:
            if x == 0 and name in ("sqrt", "abs"):
                met.append(name)
            return _function(PRIME)(name, x)

        bending = replace(EXACTLY, call=call)
        held, bent = (self._values("rhs", self.x, u, f) for f in (EXACTLY, bending))
        triples = zip(self.program.state, held, bent, strict=True)
        for name, x, y in [*triples][-self.d :]:
            by = (y - x) / PRIME
            parts = (by.a, by.b) if isinstance(by, Quadratic) else (by,)
            if any(part.numerator % PRIME for part in parts):
                raise NoTrimError(
                    f"d{name}/dt has no derivative there: a root is 0, and not a factor of what is"
                )
        return bool(met)

    def solved(self, columns: Matrix, held: Sequence[Number]) -> dict[str, Number]:
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

    def _values(
        self, name: str, x: Sequence[Any], u: Sequence[Any], numbers: Arithmetic | None = None
    ) -> list[Any]:
        numbers = numbers or EXACTLY
        arrays = {key: [*map(numbers.of, y)] for key, y in (("x", x), ("k", self.k), ("u", u))}
        return self.program.functions[name].values(arrays, numbers.call)

    def with_more(self, more: Numbers) -> list[Number]:
        """All inputs, with some more."""
        pairs = zip(self.program.inputs, self.u, strict=True)
        return [x + more.get(name, 0) for name, x in pairs]

    def rates(self, more: Numbers) -> list[Any]:
        """ζ̇ in the state, with some inputs more."""
        return self._values("rhs", self.x, self.with_more(more))[-self.d :]

    def changed(self, held: Sequence[Number], more: Numbers) -> tuple[Number, ...]:
        """What ζ̇ is more with some inputs more."""
        return tuple(y - x for x, y in zip(held, self.rates(more), strict=True))

    def linear(self, x: Sequence[Number], u: Sequence[Number]) -> Matrix:
        """D in a state, with inputs."""
        return self._rows(self._values("jacobian", x, u))

    def _rows(self, found: Sequence[Any]) -> Matrix:
        """D of what ``jacobian`` gives: the rates, then its rows."""
        n = 2 * self.d
        entries = found[len(self.program.state) :]
        return tuple(tuple(entries[n * i : n * i + n]) for i in range(n))

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
        off = whole.values({"x": self.x}, EXACTLY.call)[0] if whole else 0
        blocks = (
            tuple(row[k : k + factor.n] for row in g[k : k + factor.n])
            for k, factor in self.group.places
        )
        if off or any(q.determinant(a) <= 0 for a in blocks):
            raise NoTrimError(f"no element of {self.group.name} has the entries that --at gives")
        if self.group.larger:
            raise NoTrimError(f"of {self.group.name}, g = 1 alone is proved to be an element")

    def require_steady(self, u: Sequence[Number]) -> None:
        """``NoTrimError`` where ζ̇ may change as g moves on: its derivative along the motion at a
        random element.  In floats, as roots there are of any numbers; the checker is exact."""
        g, other = self.element(), self.group.sample(Random(1))
        h = q.times(other, q.inverted(g)) if self.right else q.times(q.inverted(other), g)
        Z = self.group.hat(self.x[-self.d :])
        eta = self.group.nearest(q.times(q.times(h, Z), q.inverted(h)))
        entries = {x: other[i][j] for x, (i, j) in self.places.items()}
        x = [entries.get(n, y) for n, y in zip(self.program.state, self.x, strict=True)]
        below = self._rows(self._values("jacobian", x, u, FLOATS))[self.d :]
        for name, row in zip(self.program.state[-self.d :], below, strict=True):
            terms = [a * float(b) for a, b in zip(row[: self.d], eta, strict=True)]
            if abs(sum(terms)) > ROUNDING * sum(map(abs, terms)):
                raise NoTrimError(
                    f"no steady motion is proved: d{name}/dt is 0 now, but what acts may be "
                    "other where g goes"
                )


def entries_of(group: Group) -> dict[str, tuple[int, int]]:
    """The names of the entries of g in the state → their places in it, from 0."""
    named = state_names(group).items()
    return {x: (t[2] - 1, t[3] - 1) for x, t in named if isinstance(t, tuple) and t[1] == "A"}


def _function(corner: int) -> Callable[[str, Any], Any]:
    """The functions of exact numbers, roots and absolute values, ``corner`` where these are 0; and
    the tests for 0 of constants."""

    def call(name: str, x: Any) -> Any:
        if name == "none":
            return Fraction(int(x == 0))
        if x == 0:
            return Fraction(corner)
        return root(x) if name == "sqrt" else x if x > 0 else -x

    return call


EXACTLY = Arithmetic(lambda x: x, _function(0))
"""In fractions, and in numbers with one square root."""
