"""Inputs in time: tables whose rows are held or joined by lines, expressions, functions."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..language.expression import names
from ..language.reserved import did_you_mean, near_name
from ..language.values import approximate
from ..problem.force_reader import measured
from ..problem.problem import Problem
from ..schema.motion_kinds import Signal
from .emitted_code import base_units
from .first_numbers import MotionError
from .run import Array
from .start import Start

TIME = "t"
"""The column of the times."""

InputFunction = Callable[[float, Array], Array]
"""The inputs at a time and a state."""
Given = str | Path | Mapping[str, Any] | Callable[[float, Array], Any]
"""Inputs as a user says them: a .csv file, columns by name, or a function of time and state that
gives all of them, or some by name."""


@dataclass(frozen=True)
class Signals:
    """Inputs ``names`` in time: ``times`` (rows,), which increase, and ``values`` (rows, names),
    each held up to the next or, if they are ``linear``, joined by straight lines."""

    names: tuple[str, ...]
    times: Array
    values: Array
    linear: bool = False

    @classmethod
    def of(
        cls, columns: Mapping[str, Sequence[float]], where: str, *, linear: bool = False
    ) -> Signals:
        """Those of columns by name, one of which has the times; ``MotionError`` for no such."""
        if TIME not in columns:
            raise MotionError(f"{where}: no column {TIME!r} of times; it has {', '.join(columns)}")
        names = tuple(x for x in columns if x != TIME)
        if not names:
            raise MotionError(f"{where}: no column but the times: name one as an input")
        lengths = {len(x) for x in columns.values()}
        if lengths == {0} or len(lengths) > 1:
            raise MotionError(f"{where}: expected columns of one length, with a row at least")
        times, *rows = (np.array(columns[x], dtype=float) for x in (TIME, *names))
        values = np.column_stack(rows)
        for k, row in enumerate(np.column_stack([times, values]).tolist(), 1):
            for name, number in zip((TIME, *names), row, strict=True):
                if not math.isfinite(number):
                    raise MotionError(f"{where}, row {k}, {name}: {number} is no finite number")
        if not (np.diff(times) > 0).all():
            k = int(np.argmin(np.diff(times) > 0)) + 2
            raise MotionError(
                f"{where}, row {k}: t = {times[k - 1]:g} does not come after {times[k - 2]:g}"
            )
        if times[0] > 0:
            raise MotionError(f"{where}: the first time is {times[0]:g}: a motion begins at t = 0")
        return cls(names, times, values, linear)

    def lines(self, times: Array) -> tuple[Array, Array]:
        """The values at some times, its own among them, and their rates up to the next."""
        rates = np.zeros_like(self.values)
        if self.linear:
            rates[:-1] = np.diff(self.values, axis=0) / np.diff(self.times)[:, None]
        k = np.maximum(np.searchsorted(self.times, times, side="right") - 1, 0)
        return self.values[k] + (times - self.times[k])[:, None] * rates[k], rates[k]


@dataclass(frozen=True)
class LinearSignal:
    """Inputs with constant ``rates`` (inputs,): those at the time ``begin`` are ``values``."""

    begin: float
    values: Array
    rates: Array

    def __call__(self, t: float, x: Array) -> Array:
        """The inputs at a time."""
        del x
        return self.values + (t - self.begin) * self.rates


Change = Callable[[float, Array, Array], None]
"""Writes some of the inputs at a time and a state, which come first, over those that come last."""


@dataclass(frozen=True)
class InputsInTime:
    """All inputs, (rows, inputs), each row from its time on, with its ``rates``; and what else
    ``changes`` them, in this order."""

    times: Array
    rows: Array
    rates: Array
    changes: tuple[Change, ...] = ()

    def at(self, t: float, x: Array) -> Array:
        """The inputs (inputs,) at a time of the table those of its row, and a state."""
        found: Array = self._of(self._row(t))(t, x)
        return found

    def parts(self, begin: float, end: float) -> Iterator[tuple[Array | InputFunction, float]]:
        """The inputs from one time to another, an array where they are held, with the time up to
        which they are so."""
        between = self.times[(self.times > begin) & (self.times < end)].tolist()
        for start, stop in zip([begin, *between], [*between, end], strict=True):
            k = self._row(start)
            held = not self.changes and not self.rates[k].any()
            yield self.rows[k] if held else self._of(k), stop

    def _row(self, t: float) -> int:
        return max(int(np.searchsorted(self.times, t, side="right")) - 1, 0)

    def _of(self, k: int) -> InputFunction:
        """The inputs from a row on, as a function."""
        line = LinearSignal(float(self.times[k]), self.rows[k], self.rates[k])
        if not self.changes:
            return line

        def inputs(t: float, x: Array) -> Array:
            u = line(t, x)
            for change in self.changes:
                change(t, x, u)
            return u

        return inputs


def inputs_in_time(
    problem: Problem,
    inputs: Sequence[str],
    first: Array,
    parameters: Mapping[str, float],
    said: Collection[str],
    given: Given | None,
    *,
    linear: bool = False,
) -> InputsInTime | None:
    """The ``inputs`` by the signals of a problem, but of those that are ``said`` to be held, and by
    what is ``given``, which wins; the others as they are at ``first``; ``None`` where all are held.
    ``MotionError`` for what is no such table, and for a name that is none or is ``said``, too."""
    if linear and (given is None or callable(given)):
        raise MotionError("--linear joins the rows of --input: give a table, or leave it out")
    table = None
    if given is not None and not callable(given):
        table, where = _table(given, problem, inputs, linear=linear)
        if both := next((x for x in table.names if x in said), ""):
            raise MotionError(
                f"{where}: {both} has a column, and is set to a number too, which would hold it: "
                "leave out one of both"
            )
    held = {*said, *(table.names if table else ())}
    listed: list[Signals] = []
    changes: list[Change] = []
    for k, signal in enumerate(problem.signals, 1):
        if signal.input not in held:
            where = f"{problem.name}, signal {k}"
            if signal.u is not None:
                changes.append(_expressed(signal, inputs, parameters, where))
            else:
                listed.append(_sampled(signal, parameters, where))
    if table:
        listed.append(table)
    if callable(given):
        changes.append(_asked(given, inputs))
    if not listed and not changes:
        return None
    times = np.unique(np.concatenate([[0.0], *(x.times for x in listed)]))
    rows, rates = np.tile(first, (len(times), 1)), np.zeros((len(times), len(first)))
    for x in listed:
        columns = [[*inputs].index(name) for name in x.names]
        rows[:, columns], rates[:, columns] = x.lines(times)
    return InputsInTime(times, rows, rates, tuple(changes))


def moving_inputs(
    problem: Problem,
    inputs: Sequence[str],
    begin: Start,
    given: Collection[str],
    varied: Collection[str],
) -> dict[str, float]:
    """Those of the ``inputs`` that signals of a problem change, but for those ``given`` or varied,
    which are held, with what they are at the start, of parameters that are varied by defaults."""
    stated = {x: problem.parameters[x].default for x in {*varied} & {*problem.parameters}}
    numbers = {**begin.parameters, **{x: y for x, y in stated.items() if y is not None}}
    said = {*given, *varied}
    driven = inputs_in_time(problem, inputs, begin.u, numbers, said, None)
    u = dict(zip(inputs, driven.at(0.0, begin.x).tolist() if driven else (), strict=False))
    return {x.input: u[x.input] for x in problem.signals if x.input not in said}


def _table(
    given: str | Path | Mapping[str, Any], problem: Problem, inputs: Sequence[str], *, linear: bool
) -> tuple[Signals, str]:
    """The table that is given, of numbers of the inputs, and what it is called in a message."""
    table, where, said = read(given, linear=linear)
    for name in table.names:
        if name not in inputs:
            near = did_you_mean(near_name(name, [*inputs]), after=" ").rstrip()
            has = ", ".join(inputs) or "none"
            raise MotionError(f"{where}: no input {name[:40]!r}; {near or f'there is {has}'}")
    units = {TIME: "s"} | units_of_inputs(problem)
    for name in {*said} & {*units}:
        same = said[name].replace(" ", "") == units[name].replace(" ", "")  # N m as Nm
        if not same and measured(said[name]) != measured(units[name]):
            told = f"{name} is in {units[name]}, not in {said[name][:20]!r}"
            raise MotionError(f"{where}: {told}: convert the column")
    return table, where


def units_of_inputs(problem: Problem) -> dict[str, str]:
    """The units of inputs, of those that are known: of a force or a torque along numbers where the
    parameters are in units of SI."""
    found: dict[str, str] = {}
    for x in problem.inputs if base_units(problem) >= {"kg", "m", "s"} else ():
        known = {"force": "N", "torque": "N m"}.get(x.kind)
        if known and not any(names(t) for t in getattr(x, "direction", None) or ()):
            found |= dict.fromkeys(problem.numbers_of(x), known)
    return found


def _sampled(signal: Signal, parameters: Mapping[str, float], where: str) -> Signals:
    """The table of a signal of a problem file."""
    found = {
        name: [approximate(t, parameters, float) for t in trees or ()]
        for name, trees in ((TIME, signal.times), (signal.input, signal.samples))
    }
    columns = {name: [math.nan if x is None else x for x in row] for name, row in found.items()}
    return Signals.of(columns, where, linear=not signal.hold)


def _expressed(
    signal: Signal, inputs: Sequence[str], parameters: Mapping[str, float], where: str
) -> Change:
    """The expression of a signal of a problem file, as numbers."""
    i, u = [*inputs].index(signal.input), signal.u
    assert u is not None

    @lru_cache(maxsize=64)  # the iterations of a step ask at the same few times
    def number(t: float) -> float:
        found = approximate(u, {**parameters, TIME: t}, float)
        if found is None or not math.isfinite(found):
            raise MotionError(f"{where}, u: no finite number at t = {t:.9g}")
        return found

    def change(t: float, x: Array, to: Array) -> None:
        del x
        to[i] = number(float(t))

    return change


def _asked(function: Callable[[float, Array], Any], inputs: Sequence[str]) -> Change:
    """A function of time and state, whose numbers are looked at."""
    if not inputs:
        raise MotionError("inputs: the problem has no [[input]]; leave them out")
    places = {name: i for i, name in enumerate(inputs)}

    def change(t: float, x: Array, u: Array) -> None:
        found = function(float(t), np.array(x))
        if isinstance(found, Mapping):
            for name, number in found.items():
                if name not in places:
                    raise MotionError(f"inputs: no input {str(name)[:40]!r}; {has}")
                u[places[name]] = number
        elif np.shape(found) == u.shape:
            u[:] = found
        else:
            raise MotionError(f"inputs: expected {len(u)} numbers, or some by name; {has}")
        if not np.isfinite(u).all():
            raise MotionError(f"inputs: no finite number at t = {t:.9g}")

    has = f"there is {', '.join(inputs) or 'none'}"
    return change


HEAD = re.compile(r"(.*?)\s*\[(.*)\]")
"""A name with its unit, as files of runs have it."""


def read(
    given: str | Path | Mapping[str, Any], *, linear: bool = False
) -> tuple[Signals, str, dict[str, str]]:
    """The signals of a .csv file with a line of names, or of columns by name, what they are called
    in a message, and the units that stand beside names; ``MotionError``."""
    if isinstance(given, Mapping):
        columns = {str(x): np.asarray(y, dtype=float).ravel().tolist() for x, y in given.items()}
        return Signals.of(columns, "inputs", linear=linear), "inputs", {}
    where = str(given)
    try:
        with Path(given).open(newline="", encoding="utf-8-sig") as file:
            rows = [x for x in csv.reader(file) if x and not x[0].startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        told = getattr(error, "strerror", None) or f"no text of UTF-8 with commas: {error}"
        raise MotionError(f"{where}: {told}") from None
    if not rows:
        raise MotionError(f"{where}: an empty file; its first line names t and the inputs")
    heads = [HEAD.fullmatch(x.strip()) for x in rows[0]]
    named = [x[1] if x else y.strip() for x, y in zip(heads, rows[0], strict=True)]
    if len({*named}) < len(named):
        raise MotionError(f"{where}: two columns of one name")
    found = Signals.of(_columns(named, rows[1:], where), where, linear=linear)
    return found, where, {x[1]: x[2].strip() for x in heads if x and x[2].strip()}


def _columns(
    names: Sequence[str], rows: Sequence[Sequence[str]], where: str
) -> dict[str, list[float]]:
    """The numbers of a file by the names of their columns."""
    found: dict[str, list[float]] = {name: [] for name in names}
    for k, row in enumerate(rows, 1):
        if len(row) != len(names):
            raise MotionError(f"{where}, row {k}: {len(row)} numbers under {len(names)} names")
        for name, text in zip(names, row, strict=True):
            try:
                found[name].append(float(text))
            except ValueError:
                told = f"{text[:40]!r} is no number"
                raise MotionError(f"{where}, row {k}, {name}: {told}") from None
    return found
