"""Inputs in time: a table, each row of which is held up to the time of the next one."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..language.reserved import did_you_mean, near_name
from .first_numbers import MotionError
from .run import Array

TIME = "t"
"""The column of the times."""


@dataclass(frozen=True)
class Signals:
    """Inputs ``names`` in time: ``times`` (rows,), which increase, and ``values`` (rows, names)."""

    names: tuple[str, ...]
    times: Array
    values: Array

    @classmethod
    def of(cls, columns: Mapping[str, Sequence[float]], where: str) -> Signals:
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
        return cls(names, times, values)

    def among(self, inputs: Sequence[str], first: Array, where: str) -> HeldInputs:
        """The rows with all ``inputs``, the others as they are at ``first``; ``MotionError`` for a
        name that is none."""
        for name in self.names:
            if name not in inputs:
                near = did_you_mean(near_name(name, [*inputs]), after=" ").rstrip()
                has = ", ".join(inputs) or "none"
                raise MotionError(f"{where}: no input {name[:40]!r}; {near or f'there is {has}'}")
        rows = np.tile(first, (len(self.times), 1))
        rows[:, [[*inputs].index(x) for x in self.names]] = self.values
        return HeldInputs(self.times, rows)


@dataclass(frozen=True)
class HeldInputs:
    """All inputs, (rows, inputs), each row from its time on."""

    times: Array
    rows: Array

    def at(self, t: Array | float) -> Array:
        """The inputs at times, (…, inputs); at a time of the table those of its row."""
        found: Array = self.rows[np.searchsorted(self.times, t, side="right") - 1]
        return found

    def parts(self, begin: float, end: float) -> Iterator[tuple[Array, float]]:
        """The inputs from one time to another, with the time up to which they are held."""
        between = self.times[(self.times > begin) & (self.times < end)]
        for start, stop in zip([begin, *between], [*between, end], strict=True):
            yield self.at(start), float(stop)


def read(given: str | Path | Mapping[str, Any]) -> tuple[Signals, str]:
    """The signals of a .csv file with a line of names, or of columns by name, and what they are
    called in a message; ``MotionError``."""
    if isinstance(given, Mapping):
        columns = {str(x): np.asarray(y, dtype=float).ravel().tolist() for x, y in given.items()}
        return Signals.of(columns, "inputs"), "inputs"
    where = str(given)
    try:
        with Path(given).open(newline="", encoding="utf-8") as file:
            rows = [x for x in csv.reader(file) if x and not x[0].startswith("#")]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise MotionError(f"{where}: cannot be read: {error}") from None
    if not rows:
        raise MotionError(f"{where}: an empty file; its first line names t and the inputs")
    names = [x.strip() for x in rows[0]]
    if len({*names}) < len(names):
        raise MotionError(f"{where}: two columns of one name")
    return Signals.of(_columns(names, rows[1:], where), where), where


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
