"""A run: a motion as a table, a row an instant, with names, units and what it was made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .emitted_code import KINDS, Column

__all__ = ("KINDS", "Array", "Column", "Happening", "Run")

Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Happening:
    """An event that happened: its name, when, "rising" or "falling", did it end the run, and the
    state then."""

    name: str
    t: float
    direction: str
    terminal: bool
    state: Array

    def plain(self) -> dict[str, Any]:
        """As JSON has it."""
        return {**vars(self), "state": self.state.tolist()}


@dataclass(frozen=True)
class Run:
    """A motion of one problem.

    ``table``: (instants, columns), the first column the time; ``facts``: what it was made of, as
    JSON has it: the name of the problem, its title, group and hash, ``unsought`` (why nothing but
    the energy stands as what is kept, if so), ``filled`` (does the body fill a solid),
    ``parameters`` (name → number), ``method`` (the step, its tolerance or size), ``language`` (in
    which it was run, C or Python), ``evaluations`` (of the rate), ``vanishing`` (what it keeps that
    is 0 in any state with these parameters), ``ended`` (empty, or why it stopped too soon),
    ``events`` (those that happened), ``body`` and ``potential`` (what pictures need).
    """

    columns: tuple[Column, ...]
    table: Array
    facts: Mapping[str, Any] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns."""
        return tuple(x.name for x in self.columns)

    def __getitem__(self, name: str) -> Array:
        """A column by its name; ``KeyError`` says which there are."""
        if name not in self.names:
            raise KeyError(f"no column {name!r:.60}; there are {', '.join(self.names)}")
        return self.table[:, self.names.index(name)]

    def of_kind(self, kind: str) -> dict[str, Array]:
        """Name → column, of all columns of a kind."""
        return {x.name: self[x.name] for x in self.columns if x.kind == kind}

    @property
    def t(self) -> Array:
        """The instants."""
        return self.table[:, 0]

    @property
    def states(self) -> Array:
        """The states, (instants, size of the state)."""
        return self.table[:, [k for k, x in enumerate(self.columns) if x.kind == "state"]]

    @property
    def ended(self) -> str:
        """Why the motion stopped before its time; empty where it did not."""
        return str(self.facts.get("ended", ""))

    @property
    def events(self) -> tuple[Happening, ...]:
        """The events that happened, in order of time."""
        listed = self.facts.get("events", ())
        return tuple(Happening(**{**x, "state": np.array(x["state"], dtype=float)}) for x in listed)

    def __repr__(self) -> str:
        name, rows = self.facts.get("problem", "?"), len(self.table)
        span = f", t = {self.t[0]:g} … {self.t[-1]:g}" if rows else ""
        return f"<run of {name}: {rows} instant{'s' * (rows != 1)}{span}>"
