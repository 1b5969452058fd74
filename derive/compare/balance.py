"""M a + b of our equations at the rates a of a user's: what is left over, and the terms of b."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from types import ModuleType
from typing import Any

import numpy as np

from ..code.program import Program
from ..language.limits import Refused
from ..language.tree import nodes, replaced
from ..language.values import approximate
from ..problem.problem import Problem
from ..schema.body_kinds import by_block
from ..schema.force_kinds import Acting
from .cross_products import hats, through
from .opened import ADDED, Opened, Slot, called
from .users_code import Array

Made = Callable[[Problem, bool], tuple[Program, ModuleType]]
"""The program of a problem, with its dynamics or without, and its Python."""
Part = Callable[[Mapping[str, float]], Array]
"""A part of M a + b for all parameters by name."""
FLAT = 1e-8
"""With a singular value so much less than those of ours, a mass matrix is that of no body."""
EXACT, LEAST = 1e-9, 1e-4
"""What is left of an explained difference, relative to the largest term; so much of that at least
where the difference is small."""


@lru_cache(maxsize=256)
def constants(module: ModuleType, *numbers: float) -> Array:
    """The constants of a code for its parameters; ``ValueError`` where no body has them."""
    found: Array = module.constants([*numbers])
    return found


@dataclass(frozen=True)
class Term:
    """A term of M a = Σ terms at each state, (N, d), in words of its rows; ``part``: is it only one
    of another term?  ``at``: the same at other states, where the attitude stands in it; ``arm``:
    where its force acts, along the axes of the body; ``of``: less the same for any parameters."""

    values: Array
    name: Callable[[str], str]
    centre: Array | None = None
    part: bool = False
    at: Callable[[Array], Array] | None = None
    arm: Array | None = None
    is_input: bool = False
    of: Part | None = None


@dataclass
class Balance:
    """Our equations with a parameter for every number, at the states of a comparison.

    ``x`` (N, state), ``u`` (N, inputs), ``t`` (N,), ``a`` (N, d): the user's rates of the velocity.
    ``parameters``: those of the problem by name; ``rows``: names of sets of rows → which;
    ``moving``: where the velocity stands in the state.
    ``changed``: numbers that are others in a hypothesis; ``more``: what it leaves besides.
    ``part``, ``block``: of a factor of a product by itself, its rows of ζ and its number.
    """

    code: ModuleType
    opened: Opened
    make: Made
    parameters: Mapping[str, float]
    t: Array
    x: Array
    u: Array
    a: Array
    rows: Mapping[str, list[int]]
    moving: slice
    changed: Mapping[str, float] = field(default_factory=dict)
    more: Array | float = 0.0
    codes: list[tuple[Problem, ModuleType | None]] = field(default_factory=list)
    part: slice = field(default_factory=lambda: slice(None))
    block: int = 0

    def k(self, values: Mapping[str, float], code: ModuleType | None = None) -> Array:
        """The constants for all parameters by name; ``ValueError`` where no body has them."""
        module = code or self.code
        return constants(module, *(values[name] for name in module.PARAMETERS))

    def values(self, own: Mapping[str, float] | None = None) -> dict[str, float]:
        """All parameters for those of the problem, some of which may be others."""
        if own is None:
            return dict(self._values)
        return {**self.opened.values({**self.parameters, **own}), **self.changed}

    @cached_property
    def _values(self) -> dict[str, float]:
        return self.values({})

    @cached_property
    def unexplained(self) -> Array:
        """What is left by its own numbers."""
        return self.left(self.values())

    def left(self, values: Mapping[str, float]) -> Array:
        """M a + b, (N, d), 0 where these parameters make our equations the user's; ``ValueError``
        where no body has them."""
        b = self.code.bias(self.t, self.x, self.k(values), self.u)[:, self.part]
        found: Array = self.of_mass(values) + b + self.more
        return found

    def mass(self, values: Mapping[str, float]) -> Array:
        """The mass matrix at each state for all parameters by name."""
        M = np.asarray(self.code.mass_matrix(self.t, self.x, self.k(values)))
        return M[:, self.part, self.part]

    def checked(self, left: Array, own: Array) -> Array:
        """What is left with another mass matrix, by the rates that it stands for; ∞ for a mass that
        is near 0, which explains nothing."""
        M = self.mass(self.values())
        least, known = (np.linalg.svd(x, compute_uv=False).min() for x in (own, M))
        if not least > FLAT * known:
            return np.full_like(left, np.inf)
        found: Array = (M @ np.linalg.solve(own, left[:, :, None]))[:, :, 0]
        return found

    @property
    def is_frame(self) -> bool:
        """Is the velocity ω, then v, of a body that moves in space or in the plane?"""
        return [*self.rows.values()] in ([[0, 1, 2], [3, 4, 5]], [[0], [1, 2]])

    def centre(self) -> Array | None:
        """The centre of mass of a body that moves in space or in the plane, at each state."""
        return self.mass_and_centre()[1] if self.is_frame else None

    def mass_and_centre(self) -> tuple[Array, Array | None]:
        """The mass of the body, (N,), and where its centre is along its axes, (N, n), at each
        state."""
        problem = self.opened.problem
        several = problem.group is not None and bool(problem.group.factors)
        bodies = by_block(problem.body) if problem.body else {}
        if several is not bool(self.block) or (self.block or 1) not in bodies:
            return np.zeros(0), None
        own, known = bodies[self.block or 1].moments(), self.values()
        trees, columns = (own.m, *own.c), {x: self.code.STATE.index(x) for x in problem.stored}
        timed = any("t" in nodes(x) for x in trees)

        @cache
        def at(t: float, *stored: float) -> list[float | None]:
            now = [replaced(x, "t", Fraction(t)) for x in trees] if timed else trees
            here = {**known, **dict(zip(columns, stored, strict=True))}
            return [approximate(x, here, float) for x in now]

        rows = zip(self.t * timed, self.x[:, [*columns.values()]], strict=True)
        found = [at(float(t), *x.tolist()) for t, x in rows]
        if any(None in x or not x[0] for x in found):
            return np.zeros(0), None
        m, *c = np.array(found, float).T
        return m, np.stack(c, axis=1) / m[:, None]

    def about_centre(self) -> Array | None:
        """What takes M a = Σ terms of a body in space to moments about its centre of mass, at each
        state (N, 6, 6); ``None`` where these are the same."""
        r = self.centre()
        if r is None or not r.any() or r.shape[1] != 3:
            return None
        found = np.tile(np.eye(6), (len(r), 1, 1))
        found[:, :3, 3:] = -hats(r)  # less r × force
        return found

    def columns(self, letter: str) -> list[int]:
        """Where the entries of A, or of T, are in a state."""
        begins = f"{letter}{self.block or ''}_"
        return [i for i, x in enumerate(self.code.STATE) if x.startswith(begins)]

    def turns(self) -> Array:
        """The matrices A of the states, (N, n, n)."""
        entries = self.columns("A")
        n = math.isqrt(len(entries))
        found: Array = self.x[:, entries].reshape(len(self.x), n, n)
        return found

    def velocities(self) -> tuple[Array, Array]:
        """ω and v of a body at each state."""
        w, v = np.split(self.x[:, self.moving], [len(self.rows["moment"])], axis=1)
        return w, v

    def with_velocities(self, w: Array, v: Array) -> Array:
        """The states with others."""
        x = self.x.copy()
        x[:, self.moving] = np.hstack([w, v])
        return x

    def kind(self, rows: list[int]) -> str:
        """Of which set some rows are, where there are two."""
        kinds = self.rows.items() if len(self.rows) > 1 else ()
        return next((x for x, own in kinds if {*rows} <= {*own}), "")

    @cached_property
    def named(self) -> dict[str, float]:
        """The numbers of the problem by what they are called, but for 0 and ±1."""
        slots = {x.words: self.values()[x.name] for x in self.opened.slots}
        every = {**self.parameters, **slots}
        return {name: x for name, x in every.items() if abs(x) not in (0, 1)}

    def alike(self, slot: Slot) -> Mapping[str, float]:
        """The numbers of one key with a number, in words."""
        same = (x for x in self.opened.slots if x.key == slot.key)
        return {self.words(x): self.values()[x.name] + self.operator.get(x.name, 0) for x in same}

    def words(self, slot: Slot) -> str:
        """What is called so with what it is added to, where there is a number of this."""
        return slot.words.removeprefix(ADDED if slot.name in self.operator else "")

    @cached_property
    def operator(self) -> dict[str, float]:
        """The entries of an operator that is the same in every state, by the parameters of what is
        added to them."""
        M = self.mass(self.values())
        names = self.opened.entries("operator")
        alike = np.ptp(M, axis=0).max() <= EXACT * np.abs(M).max()
        upper = M[0][np.triu_indices(M.shape[1])].tolist()
        return dict(zip(names, upper, strict=True)) if names and alike else {}

    def arm(self, table: Any) -> Array | None:
        """Where a force acts, along the axes of the body; none where it is not at one place."""
        if table in self.opened.problem.potentials and table.kind == "gravity":
            return self.centre()
        on = getattr(table, "between", None) or getattr(table, "on", None) or ()
        ends = on if isinstance(on, tuple) else (on,)
        listed = (*self.opened.problem.points, *self.opened.problem.places)
        ends = tuple(i for i in ends if self.block in (0, listed[i - 1].block))
        if len(ends) != 1 or not self.is_frame:
            return None
        at = [approximate(x, self.values(), float) for x in listed[ends[0] - 1].at]
        return None if None in at else np.array(at, float)

    def transposed(self) -> Array | None:
        """The states with the transpose of A; none where there is no A."""
        if not (entries := self.columns("A")):
            return None
        x = self.x.copy()
        x[:, entries] = self.turns().transpose(0, 2, 1).reshape(len(x), -1)
        return x

    def size(self) -> Array:
        """The size of the terms of each row, (d,), and less where the difference is hardly more
        than EXACT of it: a cause leaves a thousandth of that at most."""
        M, b = self.mass(self.values()), self.bias(self.x, self.u)
        known = self.code.rhs(self.t, self.x, self.k(self.values()), self.u)[:, self.moving]
        found = np.abs(b) + through(np.abs(M), np.abs(self.a) + np.abs(known))
        size: Array = np.maximum(found.max(axis=0), 1e-3 * found.max())
        part = float((np.abs(self.unexplained) / size).max())
        return size * min(1.0, max(1e-3 * part / EXACT, LEAST))

    def bias(self, x: Array, u: Array, code: ModuleType | None = None) -> Array:
        """The bias b at some states and inputs, by the values of the problem."""
        module = code or self.code
        found: Array = module.bias(self.t, x, self.k(self._values, module), u)
        return found[:, self.part]

    def terms(self) -> Iterator[Term]:
        """What stands in M a = Σ terms: inputs, forces, damping, potentials, then what is left, by
        its degree in the velocity."""
        yield from self._given_terms()
        rest = self.bare()
        if rest is not None:
            yield from self._by_degree(rest)

    def _given_terms(self) -> Iterator[Term]:
        """What acts by each input and by each table of the problem."""
        problem, own = self.opened.problem, self.bias(self.x, self.u)

        def given(x: Array) -> Array:
            return own if x is self.x else self.bias(x, self.u)

        for i, name in enumerate(self.code.INPUTS):
            u = self.u.copy()
            u[:, i] = 0

            def pushed(x: Array, u: Array = u) -> Array:
                return self.bias(x, u) - given(x)

            table = next((x for x in problem.inputs if name in problem.numbers_of(x)), None)
            word, arm = _of(f"the input {name}"), self.arm(table)
            yield Term(pushed(self.x), word, at=pushed, arm=arm, is_input=True)
        for key in ("forces", "damping", "potentials"):
            listed: tuple[Any, ...] = getattr(problem, key)
            for i, table in enumerate(listed):
                idle = (_idle(table),) if key == "forces" else ()
                code = self.without({key: (*listed[:i], *idle, *listed[i + 1 :])})
                if code is None:
                    continue
                name = called(problem, table)

                # u is kept: what a force makes of an input is its own
                def acting(x: Array, code: ModuleType = code) -> Array:
                    return self.bias(x, self.u, code) - given(x)

                about, arm = self._centre(table), self.arm(table)
                part = self._acting(code)
                yield Term(acting(self.x), _of(name), about, at=acting, arm=arm, of=part)
                if key != "potentials":
                    yield from self._by_velocities(code, name)

    def _by_degree(self, rest: ModuleType) -> Iterator[Term]:
        """What is left where nothing acts, by its degree in the velocity."""
        d, bare = self.a.shape[1], self.u * 0

        def at(part: slice, sign: float = 1.0) -> Array:
            return self.bias(self.moved(part, sign), bare, rest)

        still, every = at(slice(0)), slice(None)

        def square(part: slice) -> Array:
            return still - (at(part) + at(part, sign=-1.0)) / 2

        resting = self._idle_at(rest, self.moved(slice(0)))
        yield Term(-still, _of("the force of the place in ℓ"), of=resting)
        linear = (at(every) - at(every, sign=-1.0)) / 2
        yield Term(-linear, _of("the part linear in the velocity (gyroscopic)"))
        turning = len(self.rows["moment"])
        if turning == d:
            yield Term(square(every), lambda _: "ω × Iω" if d == 3 else f"{SQUARES} the velocity")
            return
        of_w, of_v = square(slice(0, turning)), square(slice(turning, d))
        yield Term(of_w, lambda row: "ω × (ω × c)" if row == "force" else "ω × Iω")
        yield Term(of_v, _of(f"{SQUARES} v"))
        crossed = square(every) - of_w - of_v
        alone = np.abs(crossed[:, :turning]).max() <= EXACT * np.abs(crossed).max()
        both = "ω × Mv" if alone else "the product of ω and v"
        yield Term(crossed, lambda row: "ω × Mv" if row == "force" else both)

    def _acting(self, without: ModuleType) -> Part:
        """What a force adds to b, by the code that lacks it."""

        def part(values: Mapping[str, float]) -> Array:
            k, less = self.k(values), self.k(values, without)
            bare: Array = without.bias(self.t, self.x, less, self.u)
            return np.asarray(self.code.bias(self.t, self.x, k, self.u) - bare)[:, self.part]

        return part

    def of_mass(self, values: Mapping[str, float]) -> Array:
        """M a."""
        return through(self.mass(values), self.a)

    def of_momentum(self) -> Part | None:
        """What is left of b without inputs, forces and potentials."""
        rest = self.bare()
        return None if rest is None else self._idle_at(rest, self.x)

    def _idle_at(self, rest: ModuleType, x: Array) -> Part:
        """The bias of the code on which nothing acts, at some states."""

        def part(values: Mapping[str, float]) -> Array:
            found: Array = rest.bias(self.t, x, self.k(values, rest), 0 * self.u)
            return found[:, self.part]

        return part

    def bare(self) -> ModuleType | None:
        """The code of the problem on which nothing acts."""
        idle = tuple(map(_idle, self.opened.problem.forces))
        return self.without({"forces": idle, "damping": (), "potentials": ()})

    def without(self, fewer: Any, problem: Problem | None = None) -> ModuleType | None:
        """The code of the problem that lacks something, made once; none where it has no walk."""
        of = replace(problem or self.opened.problem, **fewer)
        if found := [code for made, code in self.codes if made == of]:
            return found[0]
        try:
            code = self.make(of, True)[1]
        except Refused:
            code = None
        self.codes.append((of, code))
        return code

    def together(self) -> Iterator[Term]:
        """All inputs as one term, where there are several."""
        if self.u.shape[1] > 1:
            u = self.u
            yield Term(
                self.bias(self.x, 0 * u) - self.bias(self.x, u),
                lambda row: f"the {row or 'load'} of all inputs",
            )

    def moved(self, part: slice | list[int], sign: float = 1.0) -> Array:
        """The states with some of the velocity alone."""
        x, own = self.x.copy(), self.x[:, self.moving]
        x[:, self.moving] = 0
        x[:, self.moving][:, part] = sign * own[:, part]
        return x

    def _by_velocities(self, without: ModuleType, name: str) -> Iterator[Term]:
        """The parts of a force that ω and v make alone; ``without``: the code that lacks it."""
        turning = len(self.rows["moment"])
        if turning < self.a.shape[1]:
            for word, part in (("ω", slice(0, turning)), ("v", slice(turning, None))):
                x = self.moved(part)
                values = self.bias(x, self.u, without) - self.bias(x, self.u)
                yield Term(values, _of(f"the part by {word} of {name}"), part=True)

    def _centre(self, table: Any) -> Array | None:
        """The vector to the body's origin from the centre of a force, (N, 3)."""
        if not (entries := self.columns("T")):
            return None
        T = self.x[:, entries]
        known = self.values()
        places = [known.get(x[1]) if x[0] == "par" else None for x in getattr(table, "centre", ())]
        return T - np.array(places, float) if places and None not in places else T


def _idle(force: Acting) -> Acting:
    """A force that is 0: where inputs are numbers of forces alone, a record has one."""
    own: dict[str, Any] = {key: (0,) * len(getattr(force, key)) for key in force.expressed}
    return replace(force, **own)


SQUARES = "the part quadratic in"


def _of(name: str) -> Callable[[str], str]:
    """The words of a term in some rows; a moment is its own."""
    rows = () if name.startswith("the moment") else ("moment", "force")
    return lambda row: f"the {row} of {name}" if row in rows else name


def exact(left: Array, size: Array) -> bool:
    """Is nothing left, to rounding?"""
    return bool(np.isfinite(left).all() and (np.abs(left) <= EXACT * size).all())
