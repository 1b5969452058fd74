"""What a trim is, an equilibrium under inputs, exact or enclosed; and the step that tells it.

The state and the inputs of which a trim is asked, and the emitted equations in any numbers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
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
from ...language.tree import Tree
from ...language.univariate import Number, grows, polynomial_tree, routh, tree
from ...problem.fields import called_here, entries, state_names
from ...problem.problem import Problem
from ...record.record import Step
from ...record.sentence import Prose
from ...walk.chapter import Chapter, Draft
from .cayley_chart import chart_slopes, conjugated, turned
from .equilibrium_steps import decimal, scientific
from .positions import axes_that_stay
from .stability import eigenvalues, eigenvalues_within, polynomial
from .steady_velocity import EXACTLY, FLOATS, SAME, Arithmetic, NoTrimError, Rates

Numbers = Mapping[str, Number]
Bounds = Mapping[str, tuple[Number, Number]]
ROUNDING = 1e-9
"""A sum of floats that is smaller, beside its terms, is 0."""


class Question:
    """The state and the inputs of which something is asked, and what is free in them; ``numbers``:
    those in which the equations are evaluated."""

    numbers: Arithmetic

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
        self.places = entries_of(problem.own_group)
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

    # -- the group ---------------------------------------------------------------------------------

    def element(self, x: Sequence[Any] | None = None) -> Matrix:
        """g, a matrix of the group's size, of a state."""
        g = [[*row] for row in q.identity(self.group.size)]
        for name, value in zip(self.program.state, x or self.x, strict=True):
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


def entries_of(group: Group) -> dict[str, tuple[int, int]]:
    """The names of the entries of g in the state → their places in it, from 0."""
    named = state_names(group).items()
    return {x: (t[2] - 1, t[3] - 1) for x, t in named if isinstance(t, tuple) and t[1] == "A"}


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


def told(trim: Trim, group: Group, steps: Iterable[Step], c: Chapter) -> Step:
    """The equations of motion once more, and what vanishes in them; ``steps``: of the record."""
    by_label = {s.label: s for s in steps}
    motion = next(s for x in ("explicit", "motion") if (s := by_label.get(c.label(x))))
    draft = (c.with_input() if motion.driven else c).draft("trim", "trim", motion)
    if isinstance(trim, EnclosedTrim):
        return draft.step(motion.equations, _says_enclosed(trim, group, draft))
    return draft.step(motion.equations, _says_exact(trim, group, draft))


def _says_exact(trim: Trim, group: Group, draft: Draft) -> Prose:
    point = _equations(_rows(trim.state, trim, group, ()))
    g: list[list[Any]] = [[*row] for row in q.identity(group.size)]
    for name, (i, j) in entries_of(group).items():
        g[i][j] = trim.state.get(name, g[i][j])
    Z = group.in_user_basis.hat([*_velocity(trim, group).values()])
    prose = axes_that_stay(q.matrix(g), Z, draft)
    prose += draft.claim("trim.rest" if trim.resting else "trim.steady", point=point)
    if trim.corner:
        prose += draft.claim("trim.corner")
    if trim.sought:
        names = (*(_named(x, group, trim) for x in (*trim.sought, *trim.free)),)
        turns = any(x not in trim.state for x in trim.sought)
        kind, more = "trim.isolated_with_turns" if turns else "trim.isolated", {}
        if turns and trim.along:
            kind, more = "trim.isolated_along", {"along": _along(trim, group)}
        prose += draft.claim(kind, numbers=("row", *names), **more)
    elif trim.free:
        inputs: Tree = ("row", *(("par", x) for x in trim.free))
        prose += draft.claim("trim.unique", inputs=inputs)
    polynomial = polynomial_tree(trim.characteristic, "λ")
    return prose + draft.claim(f"trim.{trim.verdict}", polynomial=polynomial)


def _says_enclosed(trim: EnclosedTrim, group: Group, draft: Draft) -> Prose:
    near = _equations((_named(x, group, trim), y) for x, y in trim.near.items())
    point, radius = _equations(_rows(trim.start, trim, group, trim.near)), scientific(trim.radius)
    kind, more = "trim.near_rest" if trim.resting else "trim.near_steady", {}
    if trim.along:
        kind, more = "trim.near_along", {"along": _along(trim, group)}
    prose = draft.claim(kind, near=near, point=point, radius=radius, **more)
    told = {x: decimal(y, trim.radius) for x, y in trim.state.items()}
    if trim.changed:
        entries = _equations((_named(x, group, trim), told[x]) for x in trim.changed)
        side = "trim.near_turned_on_the_left" if trim.right else "trim.near_turned"
        prose += draft.claim(side, entries=entries, radius=radius)
    if trim.along:
        moving = [(_named(x, group, trim), told[x]) for x in _velocity(trim, group) if told[x]]
        prose += draft.claim("trim.near_velocity", entries=_equations(moving), radius=radius)
    prose += draft.claim(f"trim.near_{trim.verdict}")
    return prose + _says_eigenvalues(trim, draft)


def _says_eigenvalues(trim: EnclosedTrim, draft: Draft) -> Prose:
    radius, values = eigenvalues_within(trim.matrix)
    if not values:
        return ()
    rows = tuple(("row", tree(re), tree(im)) for re, im in values)
    others = len(trim.matrix) - sum(1 + bool(im) for _, im in values)
    told: dict[str, Tree] = {"eigenvalues": ("matrix", *rows), "radius": scientific(radius)}
    return draft.claim("trim.near_eigenvalues", **told, others=others)


def _velocity(trim: Trim, group: Group) -> dict[str, Number]:
    return dict([*trim.state.items()][-group.dimension :])


def _along(trim: Trim, group: Group) -> Tree:
    return _equations((_named(x, group, trim), y) for x, y in trim.along.items())


def _equations(rows: Iterable[tuple[Tree, Number]]) -> Tree:
    return ("matrix", *(("row", x, tree(y)) for x, y in rows))


def _rows(
    state: Numbers, trim: Trim, group: Group, near: Collection[str]
) -> list[tuple[Tree, Number]]:
    """The exact numbers that are not those of g = 1, and 0, and all inputs that were found; where
    there are none, those of the velocity, else the first of g."""
    places = entries_of(group)
    found: list[tuple[Tree, Number]] = []
    for name, x in state.items():
        i, j = places.get(name, (0, 1))
        if x != int(i == j) and name not in near:
            found.append((_named(name, group, trim), x))
    inputs = {n: u for n, u in trim.inputs.items() if n not in near}
    found += [(("par", n), u) for n, u in inputs.items() if u or n in trim.free]
    still = [x for x in _velocity(trim, group) if x not in near] or [*state][:1]
    return found or [(_named(x, group, trim), state[x]) for x in still]


def _named(name: str, group: Group, trim: Trim) -> Tree:
    """A number of the state as a tree: an entry of A, T, ζ or w; of ξ for a turn of g; an input."""
    places, velocity = entries_of(group), [*_velocity(trim, group)]
    if name in trim.inputs:
        return ("par", name)
    if name in places:
        i, j = places[name]
        return ("entry", "T", i + 1) if name.startswith("T_") else ("entry", "A", i + 1, j + 1)
    if name not in velocity:
        return ("entry", "ξ", int(name.removeprefix("eta_")))
    a = velocity.index(name) + 1
    if name.startswith("w"):
        return ("entry", "w", a - len(velocity) + group.n)
    return ("entry", "ζ", a)
