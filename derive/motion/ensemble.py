"""Many motions of one problem by the emitted C, from starts and parameters that are drawn."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..language.expression import names
from ..problem.problem import Problem
from .emitted import Emitted
from .first_numbers import MotionError
from .native import AT_EVENT, CompileError, Integers, constants, ensemble
from .run import Array, called
from .signals import moving_inputs
from .simulate import has_inertia, require_mass, require_values
from .start import OFF_THE_GROUP, Start, start
from .trajectory import TOLERANCE, Method, instants, reflection, taken_to_group, why_unreached

UNITED = ("time", "state", "output")
"""The kinds of columns that an ensemble has."""

STEP = "vern9"
"""The step of ensembles."""


def require_steps_of_an_ensemble(
    step: str | None, dt: float | None, order: object = "", compiled: bool | None = None
) -> None:
    """``MotionError`` for a method that is not that of ensembles."""
    if step and step != STEP:
        raise MotionError(f"an ensemble is followed by {STEP}, not by {step[:40]}: leave it out")
    if order:
        raise MotionError(f"--order is that of --step discrete, not of {STEP}: leave it out")
    if dt is not None:
        raise MotionError("the motions of an ensemble have steps of their own: leave out the size")
    if compiled is False:
        raise MotionError("an ensemble is run by the emitted C alone")


def require_an_ensemble(vary: Any, seed: int | None, device: str | None = None) -> None:
    """``MotionError`` for what one motion has no use for."""
    if vary or seed is not None or device:
        given = "--device is" if device else "--vary and --seed are"
        raise MotionError(f"{given} for many motions: give --ensemble N, too")


STATUS = {
    0: "reached the end",
    1: "have parameters that no body has",
    2: "met equations without a finite value",
    3: "needed steps that became too short",
    -1: "were not followed",
}
"""The status of a motion → what it says of some; AT_EVENT + k, k from 0, is the end at a terminal
event of the file, in order."""

MOTIONS, BYTES = 4096, 64 * 2**20
"""The most motions that are followed at once, and the most memory that their states may take."""

TOGETHER, SECONDS = 256, 0.5
"""In lanes so many motions are followed by one core: who is among them is no matter of time, so
that the same ensemble has the same bits.  Ctrl-C is heard after calls of C that take about so
many seconds."""

MOST = 10**12
"""More motions than this are a mistake."""


@dataclass(frozen=True)
class Part:
    """Some motions: what is ``varied`` (motions, names), ``status`` (motions,), of STATUS,
    ``states`` (motions, instants, columns), the state and then what is read off it, of which those
    after an end are no numbers, and ``end`` (motions, 1 + columns), the time and these where one
    ends at an event, else no numbers; (motions, 0) for a file without terminal events."""

    varied: Array
    status: Integers
    states: Array
    end: Array

    def some(self, first: int, end: int) -> Part:
        """Those from one up to another, in the same memory."""
        return Part(*(x[first:end] for x in vars(self).values()))


@dataclass(frozen=True)
class Ensemble:
    """Motions as arrays, like those of :class:`Part`, at the instants ``t``; ``names``: of the
    columns of the states; ``facts``: what it was made of, as JSON has it, with the laws by which it
    varies."""

    facts: Mapping[str, Any]
    names: tuple[str, ...]
    t: Array
    varied: Array
    status: Integers
    states: Array
    end: Array

    @property
    def varied_names(self) -> tuple[str, ...]:
        """The names of what is varied."""
        return tuple(name for name, _ in self.facts["varied"])

    @property
    def at_event(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Did it end at a terminal event? (motions,)"""
        return self.status >= AT_EVENT

    def __getitem__(self, name: str) -> Array:
        """What is varied by its name, (motions,), or a column of the states, (motions, instants);
        ``KeyError`` says which there are. A name that is both is that of the states."""
        if (name := called(self.facts, name)) in self.names:
            return self.states[..., self.names.index(name)]
        if name in self.varied_names:
            return self.varied[:, self.varied_names.index(name)]
        known = ", ".join(dict.fromkeys((*self.names, *self.varied_names)))
        raise KeyError(f"no {name!r:.60}; there are {known}")

    def __repr__(self) -> str:
        name, good = self.facts.get("problem", "?"), int((self.status == 0).sum())
        return f"<ensemble of {name}: {len(self.status)} motions, {good} to t = {self.t[-1]:g}>"


@dataclass(frozen=True)
class Plan:
    """What is asked for: n motions from 0 to ``duration``, kept at ``points`` instants after the
    start, and there, too, if these are several; the start is by ``given``, ``exponent`` and
    ``project`` as that of a run; ``device``: ``cuda``, or else over all cores.

    ``MotionError`` for what is no plan.
    """

    n: int
    varied: tuple[VariedNumber, ...]
    duration: float
    points: int = 1
    tol: float = TOLERANCE
    seed: int = 0
    given: Mapping[str, float] = field(default_factory=dict)
    exponent: Sequence[float] = ()
    project: bool = False
    device: str = ""

    def __post_init__(self) -> None:
        if not 1 <= self.n <= MOST:
            raise MotionError(f"an ensemble has between 1 and {MOST:g} motions, not {self.n}")
        if not self.varied:
            raise MotionError("an ensemble needs what differs from motion to motion: --vary NAME=…")
        twice = [x.name for k, x in enumerate(self.varied) if x.name in self.names[:k]]
        if twice:
            raise MotionError(f"{twice[0]} is varied twice: leave one out")
        Method(STEP, None, self.tol)

    @property
    def names(self) -> list[str]:
        """The names of what is varied."""
        return [x.name for x in self.varied]

    @property
    def times(self) -> Array:
        """The instants that are kept: the end, or of several the start, too."""
        found = instants(Method(STEP), self.duration, self.points)
        return found[1:] if self.points == 1 else found


class EnsembleMotions:
    """The motions of a plan: ``parts``, in order, each when it is asked for; ``facts``.

    ``MotionError`` where there is no compiler, for names that mean nothing, and for starts that are
    off the group.
    """

    def __init__(self, code: Emitted, problem: Problem, plan: Plan):
        varied = code.program.by_state({x.name: x for x in plan.varied}, MotionError)
        plan = replace(
            plan,
            varied=tuple(replace(x, name=name) for name, x in varied.items()),
            given=code.program.by_state(plan.given, MotionError),
        )
        self.code, self.problem, self.plan, self.t = code, problem, plan, plan.times
        first = dict(
            zip(plan.names, ParameterDraws(plan.varied, plan.seed).next(1)[0], strict=True)
        )
        self.first = self._start(first)
        named = code.program.inputs, self.first, plan.given, plan.names
        for name, at in moving_inputs(problem, *named).items():
            why = f"the [[signal]] of {name} is for one motion: hold it, as --set {name}={at:.9g}"
            raise MotionError(f"{code.name}: {why}")
        stated = {name for t in problem.initial.trees() for name in names(t)}
        require_values(code, self.first)
        require_mass(code, problem, self.first, plan.duration)
        self.one_by_one = bool(stated & {*plan.names})  # the start is an expression of them
        if plan.device and code.events:
            raise MotionError(
                f"{code.name}: terminal events are not looked for on a graphics card: "
                "leave out --device"
            )
        try:
            self.library = code.ensemble_on_card if plan.device else code.compiled_ensemble
        except CompileError as error:
            by = "on a graphics card by CUDA" if plan.device else "by the emitted C"
            raise MotionError(f"{code.name}: an ensemble is run {by}: {error}") from None

    @property
    def facts(self) -> dict[str, Any]:
        """What an ensemble says of itself."""
        fixed = {x: v for x, v in self.first.parameters.items() if x not in self.plan.names}
        return {
            **self.code.facts,
            "motions": self.plan.n,
            "parameters": fixed,
            "varied": [[x.name, str(x)] for x in self.plan.varied],
            "seed": self.plan.seed,
            "method": str(Method(STEP, None, self.plan.tol)),
            "ends": [x.name for x in self.code.events],
            "units": self._units,
            **({"outputs": [*self.code.program.outputs]} if self.code.program.outputs else {}),
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Those of the state, then those of what is read off it."""
        return (*self.code.program.state, *self.code.program.outputs)

    @property
    def _units(self) -> dict[str, str]:
        """The units of the time, the state, what is read off it and what is varied, of those that
        have one."""
        stated = {x.name: x.unit for x in self.code.columns() if x.kind in UNITED}
        given = self.problem.parameters
        stated |= {x: given[x].unit for x in self.plan.names if x in given}
        return {name: unit for name, unit in stated.items() if unit}

    @property
    def said(self) -> dict[int, str]:
        """STATUS, with the events."""
        ends = enumerate(self.code.events, AT_EVENT)
        return STATUS | {k: f"ended at event {x.name}" for k, x in ends}

    @property
    def none(self) -> Part:
        """No motions."""
        state, names = len(self.names), len(self.plan.names)
        width = (1 + state) * bool(self.code.events)
        shapes = (0, names), (0,), (0, len(self.t), state), (0, width)
        varied, status, states, end = map(np.empty, shapes)
        return Part(varied, status.astype(np.intc), states, end)

    @property
    def size(self) -> int:
        """The motions of a part, but for the last one; on a graphics card as many as BYTES."""
        most = BYTES // (8 * len(self.t) * len(self.names))
        return max(1, most if self.plan.device else min(MOTIONS, most))

    @property
    def count(self) -> int:
        """How many parts there are."""
        return -(-self.plan.n // self.size)

    def parts(self, stopped: Callable[[], bool] = lambda: False) -> Iterator[Part]:
        """The motions, ``size`` at a time; where they are ``stopped`` no more, the last time those
        that are done."""
        draws = ParameterDraws(self.plan.varied, self.plan.seed)
        for first in range(0, self.plan.n, self.size):
            yield self._part(first, draws.next(min(self.size, self.plan.n - first)), stopped)

    def _part(self, first: int, draws: Array, stopped: Callable[[], bool]) -> Part:
        """The motions of some draws, by calls that take about SECONDS; on a card by one."""
        n, state, width = len(draws), len(self.names), self.none.end.shape[1]
        states, end = np.full((n, len(self.t), state), math.nan), np.full((n, width), math.nan)
        part = Part(draws, np.zeros(n, dtype=np.intc), states, end)
        unit, done = 1 if self.code.events else TOGETHER, 0
        count = n if self.plan.device else unit * (os.cpu_count() or 1)
        while done < n and not stopped():
            begun = time.monotonic()
            self._follow(first + done, part.some(done, done + count))
            done = min(n, done + count)
            pace = SECONDS / max(time.monotonic() - begun, SECONDS / 8)
            count = max(1, int(count * pace) // unit) * unit
        return part.some(0, done)

    def joined(self, parts: Sequence[Part]) -> Ensemble:
        """All that is in some parts."""
        joined = [np.concatenate([getattr(x, y) for x in parts]) for y in vars(parts[0])]
        return Ensemble(self.facts, self.names, self.t, *joined)

    def _start(self, numbers: Mapping[str, float]) -> Start:
        given = {**self.plan.given, **numbers}
        return start(self.code.program, self.problem, given, self.plan.exponent)

    def _starts(self, draws: Array) -> tuple[Array, Array, Array]:
        """States, parameters and inputs, a row a motion."""
        if self.one_by_one:
            rows = [self._start(dict(zip(self.plan.names, x, strict=True))) for x in draws.tolist()]
            x, p, u = (np.array([getattr(row, y) for row in rows]) for y in "xpu")
            return x, p, u
        program, found = self.code.program, []
        listed = (program.state, [x[0] for x in program.parameters], program.inputs)
        for names_of, own in zip(listed, (self.first.x, self.first.p, self.first.u), strict=True):
            rows_of = np.tile(own, (len(draws), 1))
            for k, name in enumerate(self.plan.names):
                if name in names_of:
                    rows_of[:, [*names_of].index(name)] = draws[:, k]
            found.append(rows_of)
        return found[0], found[1], found[2]

    def _on_the_group(self, x: Array, first: int) -> Array:
        """The states, taken to the group if that is asked for; ``MotionError`` for one off it."""
        code = self.code
        if "defect" not in code.program.functions:
            return x
        if fault := reflection(code.program.blocks, x):
            raise MotionError(f"{code.name}: a motion starts off the group: {fault}")
        begun = x
        if self.plan.project:
            x = taken_to_group(code.python.project, code.program.blocks, x)
        off = np.asarray(code.python.defect(x))
        if not (off <= OFF_THE_GROUP).all():
            worst = int(np.flatnonzero(~(off <= OFF_THE_GROUP))[0])
            why = f"with a defect of {off[worst]:.3g}: --project takes it there"
            if self.plan.project:
                why = why_unreached(code.program.blocks, begun[worst])
            raise MotionError(f"{code.name}: motion {first + worst} starts off the group, {why}")
        return x

    def _follow(self, first: int, part: Part) -> None:
        """Follow some motions by what is varied, and put the rest into their part."""
        x, p, u = self._starts(part.varied)
        x = self._on_the_group(x, first)
        k, wrong = constants(self.library, p, len(self.code.program.constants))
        size = x.shape[1]
        status, states = part.status, part.states[..., :size]
        regular = [has_inertia(self.code, self.problem, *pair) for pair in zip(x, p, strict=True)]
        status[:] = (wrong != 0) | ~np.array(regular)
        h, before = np.zeros(len(x)), 0.0
        for j, t in enumerate(self.t.tolist()):
            if t == 0:
                states[status == 0, j] = x[status == 0]
                continue
            on, places = self._going_on(status)
            # copies of those that go on
            own, step, ended = x[on], h[on], [np.empty(len(on))] * bool(self.code.events)
            span = before, t
            told = ensemble(self.library, own, k[on], u[on], span, self.plan.tol, step, *ended)
            mine, before = on == places, t
            status[on[mine]], h[on[mine]], x[on[mine]] = told[mine], step[mine], own[mine]
            for times in ended:
                stops = told >= AT_EVENT
                part.end[on[stops], : 1 + size] = np.column_stack([times, own])[stops]
            states[status == 0, j] = x[status == 0]
        if self.code.program.outputs:
            self._read_off(part, k, u)

    def _read_off(self, part: Part, k: Array, u: Array) -> None:
        """Put what is read off the motions beside their states; ``k``, ``u``: their constants and
        inputs, a row a motion."""
        size, read = len(self.first.x), self.code.python.outputs
        for j, t in enumerate(self.t.tolist()):
            on = np.isfinite(part.states[:, j, :size]).all(axis=1)
            part.states[on, j, size:] = read(t, part.states[on, j, :size], k[on], u[on])
        for i in np.flatnonzero(part.status >= AT_EVENT):  # each at its own time
            t, x = float(part.end[i, 0]), part.end[i, 1 : 1 + size]
            part.end[i, 1 + size :] = read(t, x, k[i], u[i])

    def _going_on(self, status: Integers) -> tuple[Integers, Integers]:
        """The motions that go on, each in its place among the others of its TOGETHER, and the
        places; where a motion does not go on, the first one that does stands in its place."""
        places, on = np.arange(len(status), dtype=np.intc), status == 0
        if self.code.events or on.all():
            return places[on], places[on]
        groups = [places[k : k + TOGETHER] for k in range(0, len(places), TOGETHER)]
        groups = [x for x in groups if on[x].any()]
        filled = [np.where(on[x], x, x[on[x]][0]) for x in groups]
        none: list[Integers] = [places[:0]]
        return np.concatenate(none + filled), np.concatenate(none + groups)


# What differs from motion to motion of an ensemble: numbers drawn by a law, by a seed.


@dataclass(frozen=True)
class VariedNumber:
    """A number by name, uniform between ``a`` and ``b``, or ``normal`` with mean ``a`` and standard
    deviation ``b``.

    ``MotionError`` for a law that is none.
    """

    name: str
    a: float
    b: float
    normal: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.a) and math.isfinite(self.b)):
            raise MotionError(f"{self.name} is varied by what is no finite number")
        if self.normal and self.b < 0:
            raise MotionError(f"{self.name} is varied with a deviation of {self.b:g}, below 0")
        if not self.normal and self.a > self.b:
            raise MotionError(f"{self.name} is varied from {self.a:g} to {self.b:g}, which is less")

    def __str__(self) -> str:
        if self.normal:
            return f"{self.name} normal, mean {self.a:g}, deviation {self.b:g}"
        return f"{self.name} from {self.a:g} to {self.b:g}"

    def drawn(self, source: np.random.Generator, n: int) -> Array:
        """The next n numbers of a source."""
        if self.normal:
            return self.a + self.b * source.standard_normal(n)
        return self.a + (self.b - self.a) * source.random(n)


def laws(given: Mapping[str, Any]) -> tuple[VariedNumber, ...]:
    """Name → (low, high) or ("normal", mean, deviation), as Python gives it."""
    if not isinstance(given, Mapping):
        raise MotionError('vary: expected laws by name, as {"zeta_1": (0, 0.5)}')
    return tuple(_law(name, x) for name, x in given.items())


def _law(name: str, numbers: Sequence[Any]) -> VariedNumber:
    try:
        normal = len(numbers) == 3 and numbers[0] == "normal"
        a, b = map(float, numbers[normal:])
    except (TypeError, ValueError):
        raise MotionError(
            f'{name} is varied by (low, high) or ("normal", mean, deviation), not {numbers!r:.40}'
        ) from None
    return VariedNumber(name, a, b, normal)


class ParameterDraws:
    """The numbers of one motion after the other: each name has a source of its own, so that they
    are the same whatever the size of the parts in which they are drawn."""

    def __init__(self, varied: Sequence[VariedNumber], seed: int):
        self._each = [(x, np.random.default_rng([seed, k])) for k, x in enumerate(varied)]

    def next(self, n: int) -> Array:
        """Those of the next n motions, (n, varied)."""
        return np.stack([x.drawn(source, n) for x, source in self._each], axis=1)
