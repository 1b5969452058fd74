"""What a trim is, an equilibrium under inputs, exact or enclosed.

The state and the inputs of which a trim is asked, and the emitted equations in any numbers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ...algebra.groups import Group
from ...code.program import Program
from ...language import rational as q
from ...language.intervals import characteristic, signs_of_real_parts
from ...language.rational import Matrix
from ...language.reserved import suffixed
from ...language.univariate import Number, grows, routh
from ...problem.fields import called_here, element, entries, entry_places
from ...problem.problem import Problem
from .stability import eigenvalues, polynomial
from .steady_velocity import EXACTLY, FLOATS, SAME, Arithmetic, NoTrimError, Rates

Numbers = Mapping[str, Number]
Bounds = Mapping[str, tuple[Number, Number]]
ROUNDING = 1e-9
"""A sum of floats that is smaller, beside its terms, is 0."""


class Question:
    """The state and the inputs of which something is asked, and what is free in them; ``numbers``:
    those in which the equations are evaluated; ``little``: what is put in the place of a root that
    is 0, of which a change ``of_first_order`` is seen."""

    numbers: Arithmetic
    little: Fraction
    of_first_order: Callable[[Any], bool]

    def __init__(
        self,
        problem: Problem,
        program: Program,
        at: Mapping[str, Number],
        free: Sequence[str] | None,
        bounds: Bounds,
        along: Numbers,
    ):
        self.group: Group = problem.own_group.in_user_basis
        self.program, self.d = program, program.dimension
        self.right = program.variation.startswith("eta")
        self.places = entry_places(self.group)
        self.require()
        velocity = program.state[-self.d :]
        self.turns = {suffixed("eta", a + 1): a for a in range(self.d)}
        own = program.by_block
        at = program.by_state(at, NoTrimError)
        free = [own.get(x, x) for x in free or ()]
        self.bounds = program.by_state(bounds, NoTrimError)
        self.along = program.by_state(along, NoTrimError)
        self.require_names((*at, *self.bounds, *self.along), ())
        self.require_names(free, self.turns)
        wanted = free or [x for x in program.inputs if x not in at]
        self.free = tuple(x for x in wanted if x in program.inputs)
        self.sought = tuple(x for x in wanted if x not in program.inputs)
        if twice := [x for x, n in Counter(wanted).items() if n > 1]:
            raise NoTrimError(f"--free {twice[0]}: named more than once")
        if fixed := [x for x in self.sought if x not in (*velocity, *self.turns)]:
            raise NoTrimError(
                f"--free {fixed[0]}: of g, which --at gives, as A_11=4/5 with all that change so; "
                "inputs, velocities and turns from there, as eta_1, are found"
            )
        if other := [x for x in self.along if x not in velocity]:
            raise NoTrimError(f"--along {other[0]}: no velocity; these are {entries(velocity)}")
        self.velocities = [x for x in self.sought if x in velocity]
        self.near = {x: float(at[x]) for x in (*self.velocities, *self.free) if x in at}
        if 0 < sum(x in at for x in self.velocities) < len(self.velocities):
            raise NoTrimError("--at gives some of the velocities that are free: give all or none")
        one = q.identity(self.group.size)
        start = {x: one[i][j] for x, (i, j) in self.places.items()}
        self.x: list[Number] = [at.get(n, start.get(n, Fraction(0))) for n in program.state]
        held = {n: y for n, y in at.items() if n not in self.free}
        self.u: list[Number] = [held.get(n, Fraction(0)) for n in program.inputs]
        g, self.beside = self.element(), [*self.x]
        Y = self.group.hat([self.along.get(x, Fraction(0)) for x in velocity])
        first, last = (g, q.inverted(g)) if self.right else (q.inverted(g), g)
        self.seen = q.times(q.times(first, Y), last) if self.along else ()
        self._add(self.x, self.seen)

    def _add(self, x: list[Any], seen: Matrix) -> None:
        """Let the velocity in a state have a part more, that is seen from g."""
        for a, more in enumerate(self.group.nearest(seen) if seen else (), len(x) - self.d):
            x[a] += more

    @cached_property
    def k(self) -> list[Any]:
        """The constants of the program, in the numbers of the question."""
        p = [self.numbers.of(Fraction(str(x[1]))) for x in self.program.parameters]
        try:
            return self.program.functions["constants"].values({"p": p}, self.numbers.call)
        except ZeroDivisionError:
            raise NoTrimError("no body has these parameters: its mass matrix is singular") from None

    def require_names(self, names: Iterable[str], more: Iterable[str]) -> None:
        """``NoTrimError`` where one is no number of the state and no input, and is not in more."""
        known = (*self.program.state, *self.program.inputs, *more)
        for name in names:
            if name not in known:
                told = f"; these are {entries((*known, *self.program.by_block))}"
                near = called_here(name, known, self.group, known) or told
                raise NoTrimError(f"{name} is no number of the state and no input{near}")

    def require(self) -> None:
        """``NoTrimError`` where this has no numbers, or has the time in it."""
        program = self.program
        if missing := [x[0] for x in program.parameters if x[1] is None]:
            raise NoTrimError(f"a trim is of numbers, and {missing[0]} has no default")
        if any(x.array == "t" for x in program.functions["rhs"].loads):
            raise NoTrimError("what acts depends on the time: nothing is steady")

    # -- what is free ------------------------------------------------------------------------------

    def unknown(self) -> Rates:
        """ζ̇ as a function of the velocities, turns of g and inputs that are free."""
        turns = [x for x in self.sought if x in self.turns]
        names = (*self.velocities, *turns, *self.free)
        sizes = len(self.velocities), len(turns)
        between = {x: (float(a), float(b)) for x, (a, b) in self.bounds.items() if x in names}
        return Rates(names, *sizes, self._free_rates, self._free_slopes, between, self._allowed)

    def _allowed(self, y: Sequence[float]) -> bool:
        numbers = (z for part in self.at(y) for z in part)
        names = (*self.program.state, *self.program.inputs)
        return not self.outside(dict(zip(names, numbers, strict=True)), SAME)

    def outside(self, numbers: Mapping[str, Any], radius: Any) -> list[str]:
        """The names of which numbers are out of bounds, by more than a radius."""
        return [
            name
            for name, (low, high) in self.bounds.items()
            if float(numbers[name] - low) < -radius or float(numbers[name] - high) > radius
        ]

    def at(self, y: Sequence[Any]) -> tuple[list[Any], list[Any]]:
        """The state and the inputs with these velocities, turns of g and inputs in them."""
        x, u, turns = [*self.beside], [*self.u], self._turned(y)
        if turns:
            there = turned(self.group, self.element(), turns, right=self.right)
            for i, name in enumerate(self.program.state[: -self.d]):
                row, column = self.places[name]
                x[i] = there[row][column]
        for name, value in zip(self.velocities, y, strict=False):
            x[self.program.state.index(name)] = value
        for name, value in zip(self.free, y[len(y) - len(self.free) :], strict=True):
            u[self.program.inputs.index(name)] = value
        self._add(x, self._seen(turns))
        return x, u

    def _seen(self, turns: Sequence[Any]) -> Matrix:
        """The part of the velocity that ``along`` gives in space, from where g turns to."""
        if not self.seen or not turns:
            return self.seen
        return conjugated(self.group, self.seen, turns, right=self.right)

    def _turned(self, y: Sequence[Any]) -> list[Any]:
        """η of the turn of g; none where it does not turn."""
        turns = [self.turns[x] for x in self.sought if x in self.turns]
        by = dict(zip(turns, y[len(self.velocities) :], strict=False))
        return [by.get(a, Fraction(0)) for a in range(self.d)] if turns else []

    def _free_rates(self, y: Sequence[Any], numbers: Arithmetic) -> list[Any]:
        return self.evaluated("rhs", *self.at(y), numbers)[-self.d :]

    def _free_slopes(self, y: Sequence[Any], numbers: Arithmetic) -> list[list[Any]]:
        x, u = self.at(y)
        D = self._rows(self.evaluated("jacobian", x, u, numbers))[self.d :]
        by_inputs = self.evaluated("jacobian_inputs", x, u, numbers) if self.free else []
        n, first, turns = len(u), self.d - len(x), self._turned(y)
        chart = chart_slopes(self.group, turns, right=self.right) if turns else ()
        turning = [self.turns[x] for x in self.sought if x in self.turns]
        along = {a: self._variation(chart[a], turns) for a in turning}
        places = [self.program.state.index(x) + self.d + first for x in self.velocities]
        inputs = [self.program.inputs.index(x) for x in self.free]
        return [
            [
                *(row[i] for i in places),
                *(q.dot(row, along[a]) for a in turning),
                *(by_inputs[n * (self.d + b) + i] for i in inputs),
            ]
            for b, row in enumerate(D)
        ]

    def _variation(self, xi: Sequence[Any], turns: Sequence[Any]) -> tuple[Any, ...]:
        """(η, δζ) of δg = gξ, on the right ξg: what is seen of space changes by [Z, ξ], or −."""
        if not self.seen:
            return (*xi, *[Fraction(0)] * self.d)
        moved = q.bracket(self._seen(turns), self.group.hat(xi))
        return (*xi, *self.group.nearest(q.scaled(-1 if self.right else 1, moved)))

    # -- the emitted equations ---------------------------------------------------------------------

    def evaluated(
        self, name: str, x: Sequence[Any], u: Sequence[Any], numbers: Arithmetic | None = None
    ) -> list[Any]:
        """What an emitted function gives in a state, with inputs."""
        numbers = numbers or self.numbers
        arrays = {key: [*map(numbers.of, y)] for key, y in (("x", x), ("k", self.k), ("u", u))}
        return self.program.functions[name].values(arrays, numbers.call)

    def with_more(self, more: Numbers) -> list[Number]:
        """All inputs, with some more."""
        pairs = zip(self.program.inputs, self.u, strict=True)
        return [x + more.get(name, 0) for name, x in pairs]

    def rates(self, more: Numbers) -> list[Any]:
        """ζ̇ in the state, with some inputs more."""
        return self.evaluated("rhs", self.x, self.with_more(more))[-self.d :]

    def changed(self, held: Sequence[Number], more: Numbers) -> tuple[Number, ...]:
        """What ζ̇ is more with some inputs more."""
        return tuple(y - x for x, y in zip(held, self.rates(more), strict=True))

    def linear(self, x: Sequence[Any], u: Sequence[Any]) -> Matrix:
        """D in a state, with inputs."""
        return self._rows(self.evaluated("jacobian", x, u))

    def _rows(self, found: Sequence[Any]) -> Matrix:
        """D of what ``jacobian`` gives: the rates, then its rows."""
        n = 2 * self.d
        entries = found[len(self.program.state) :]
        return tuple(tuple(entries[n * i : n * i + n]) for i in range(n))

    def require_rest(self, told: Sequence[str]) -> None:
        """``NoTrimError`` where nothing is free and rates ζ̇ are not 0; ``told``: each as text, ""
        for 0."""
        pairs = zip(self.program.state[-self.d :], told, strict=True)
        if moved := [f"d{name}/dt is {x}" for name, x in pairs if x]:
            others = "" if len(moved) == self.d else ", all other rates of the velocity are 0"
            raise NoTrimError(f"no trim: {', '.join(moved)}{others}; no input is free")

    def require_slopes(self, x: Sequence[Any], u: Sequence[Any]) -> bool:
        """Is a root 0 in a state?  ``NoTrimError`` where the rates change to the first order with
        a little in its place: they have no derivative then."""
        met: list[str] = []

        def call(name: str, x: Any) -> Any:
            if x != 0 or name not in ("sqrt", "abs"):
                return self.numbers.call(name, x)
            met.append(name)
            return self.numbers.of(self.little)

        bent = self.evaluated("rhs", x, u, replace(self.numbers, call=call))
        changes = (z - y for y, z in zip(self.evaluated("rhs", x, u), bent, strict=True))
        for name, change in [*zip(self.program.state, changes, strict=True)][-self.d :]:
            if self.of_first_order(change):
                raise NoTrimError(
                    f"d{name}/dt has no derivative there: a root is 0, and not a factor of what is"
                )
        return bool(met)

    # -- the group ---------------------------------------------------------------------------------

    def element(self, x: Sequence[Any] | None = None) -> Matrix:
        """g of a state."""
        return element(self.group, dict(zip(self.program.state, x or self.x, strict=True)))

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

    def require_steady(self, x: Sequence[Any], u: Sequence[Any]) -> None:
        """``NoTrimError`` where ζ̇ may change as g moves on: its derivative along the motion at a
        random element.  In floats, as roots there are of any numbers; the checker is exact."""
        g, other = self.element(x), self.group.sample(Random(1))
        h = q.times(other, q.inverted(g)) if self.right else q.times(q.inverted(other), g)
        Z = self.group.hat(x[-self.d :])
        eta = self.group.nearest(q.times(q.times(h, Z), q.inverted(h)))
        entries = {x: other[i][j] for x, (i, j) in self.places.items()}
        there = [entries.get(n, y) for n, y in zip(self.program.state, x, strict=True)]
        below = self._rows(self.evaluated("jacobian", there, u, FLOATS))[self.d :]
        for name, row in zip(self.program.state[-self.d :], below, strict=True):
            terms = [a * float(b) for a, b in zip(row[: self.d], eta, strict=True)]
            if abs(sum(terms)) > ROUNDING * sum(map(abs, terms)):
                raise NoTrimError(
                    f"no steady motion is proved: d{name}/dt is 0 now, but what acts may be "
                    "other where g goes"
                )


@dataclass(frozen=True)
class Trim:
    """An equilibrium under inputs.  ``state``, ``inputs``: name → number; ``free``: the names of
    those inputs that were found, ``sought``: of the velocities and turns of g; ``matrix``: D of the
    equations linearised in (η, δζ), (2d, 2d), the inputs held; ``resting``: is the velocity 0?
    ``corner``: is a root 0 there, which has no derivative?  ``along``: the part of the velocity
    that is given in space."""

    state: Numbers
    inputs: Numbers
    free: tuple[str, ...]
    sought: tuple[str, ...]
    matrix: Matrix
    resting: bool
    corner: bool
    along: Numbers

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
        return "stable" if routh(self.characteristic) > 0 else "open"

    @property
    def eigenvalues(self) -> tuple[complex, ...]:
        """About those of the matrix, in 1/s."""
        return eigenvalues(self.matrix)


@dataclass(frozen=True)
class EnclosedTrim(Trim):
    """One of which is proved that it is the only one within a ``radius`` of ``near``, velocities,
    turns of g and inputs by name, and of the exact numbers of ``start``; narrow bounds of these, of
    entries of g ``changed`` and what changes with them stand in ``state`` and ``inputs``, and
    ``matrix`` is one of intervals; ``right``: does ξ stand before g?"""

    near: Numbers
    start: Numbers
    changed: tuple[str, ...]
    radius: Fraction
    right: bool

    @cached_property
    def characteristic(self) -> tuple[Number, ...]:
        """About the characteristic polynomial of the matrix, from the highest power."""
        return tuple(x.middle for x in characteristic(self.matrix))

    @property
    def verdict(self) -> str:
        """What is proved with the inputs held: "stable", "unstable" or "open"."""
        found = signs_of_real_parts(characteristic(self.matrix))
        return {"negative": "stable", "positive": "unstable", "unknown": "open"}[found]


# -- elements near one by Cayley's transform C(η) = (1 − ½η)⁻¹(1 + ½η), rational in η --------------


def turned(group: Group, g: Matrix, eta: Sequence[Any], *, right: bool) -> Matrix:
    """g C(η), ``right``: C(η) g, for the d coordinates η; an element where Cayley's transforms are,
    as of orthogonal groups and of those with translations."""
    C = _cayley(group, eta)
    return q.times(C, g) if right else q.times(g, C)


def conjugated(group: Group, z: Matrix, eta: Sequence[Any], *, right: bool) -> Matrix:
    """C⁻¹zC, ``right``: CzC⁻¹: what is z seen from g is this from g turned."""
    first, last = (_cayley(group, x) for x in (eta, [-x for x in eta]))
    return q.times(q.times(first, z), last) if right else q.times(q.times(last, z), first)


def chart_slopes(group: Group, eta: Sequence[Any], *, right: bool) -> Matrix:
    """Row a: the coordinates of C⁻¹∂C/∂η_a, ``right``: of ∂C/∂η_a C⁻¹."""
    less, more = _halves(group, eta)
    back, one = _inverted(less), q.identity(group.size)
    C = q.times(back, more)
    undone, rows = _inverted(C), []
    for E in group.basis:
        dC = q.times(back, q.times(q.scaled(Fraction(1, 2), E), q.plus(C, one)))
        rows.append(group.nearest(q.times(dC, undone) if right else q.times(undone, dC)))
    return tuple(rows)


def _cayley(group: Group, eta: Sequence[Any]) -> Matrix:
    less, more = _halves(group, eta)
    return q.times(_inverted(less), more)


def _inverted(a: Matrix) -> Matrix:
    """The inverse; ``NoTrimError`` where Cayley's transform has none, as those of SL(n) may."""
    if (found := q.inverse(a)) is None:
        raise NoTrimError(
            "no trim is found: where Newton's method leads no element is Cayley's transform of a "
            "turn; give numbers near it by --at for g, or free others"
        )
    return found


def _halves(group: Group, eta: Sequence[Any]) -> tuple[Matrix, Matrix]:
    """1 − ½η and 1 + ½η."""
    one, half = q.identity(group.size), q.scaled(Fraction(1, 2), group.hat(eta))
    return q.plus(one, q.scaled(Fraction(-1), half)), q.plus(one, half)
