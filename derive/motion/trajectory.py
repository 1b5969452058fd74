"""The motion of a run: emitted steps from instant to instant, which stop at events."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Protocol

import numpy as np

from ..native.motion_in_c import StepError
from .method import Method
from .run import Array, Happening

INTERRUPTED = "interrupted"
"""Why a run ended by Ctrl-C."""

SLIVER = 1e-9
"""The part of a step below which nothing is left of a time."""


class Moved(Protocol):
    """A motion under way, in C or in Python."""

    @property
    def t(self) -> float:
        """The time."""

    @property
    def x(self) -> Array:
        """The state."""

    @property
    def event(self) -> str:
        """The name of the event at which it stands, else empty."""

    @property
    def rising(self) -> bool:
        """Is that reached from below?"""

    @property
    def evaluations(self) -> int:
        """How often its stages have asked for the rates."""

    def left(self, t: float) -> float:
        """The time up to another."""

    def move(self, h: float, n: int = 1) -> object:
        """Make n steps of size h; ``StepError``."""

    def move_to(self, t: float, tol: float) -> object:
        """Move up to a time or an event, in steps of their own size; ``StepError``."""

    def watch(self, t: float, h: float) -> object:
        """Move up to a time or an event, in steps of size h; ``StepError``."""

    def settle(self) -> None:
        """Be at a time in the state of that time, after a move that Ctrl-C has cut short."""


class Trajectory:
    """A motion under way, and the events that ``happened`` on it; ``ends``: name of an event →
    does the motion end there?"""

    def __init__(self, motion: Moved, method: Method, ends: Mapping[str, bool]):
        self.motion, self.method, self.ends = motion, method, ends
        self.happened: list[Happening] = []

    def reach(self, times: Array) -> tuple[Array, str]:
        """The states at increasing times, fewer where the motion must stop or Ctrl-C stops it, and
        why."""
        states: list[Array] = []
        why = ""
        try:
            for time in times.tolist():
                if why := self._until(time):
                    break
                states.append(self.motion.x.copy())
        except KeyboardInterrupt:
            why = INTERRUPTED
            self.motion.settle()
            self._note()
        return np.array(states).reshape(-1, len(self.motion.x)), why

    def _until(self, end: float) -> str:
        """Steps up to a time; why not, where that fails or an event ends the motion."""
        try:
            while name := self._event(end):
                self._note()
                if self.ends[name]:
                    return f"event {name}"
        except StepError as error:
            return str(error)
        return ""

    def _note(self) -> None:
        """Note the event at which the motion stands, if it does and that is not yet noted."""
        m = self.motion
        if m.event and (m.t, m.event) not in ((x.t, x.name) for x in self.happened[-1:]):
            direction = "rising" if m.rising else "falling"
            self.happened.append(Happening(m.event, m.t, direction, self.ends[m.event], m.x.copy()))

    def _event(self, end: float) -> str:
        """The event to which steps lead, the last of which may be shorter, or "" at a time."""
        m, h = self.motion, self.method.dt
        if h is None:
            m.move_to(end, self.method.tol)
        elif self.ends:
            m.watch(end, h)
        else:
            m.move(h, math.floor(m.left(end) / h + SLIVER))
            if m.left(end) > SLIVER * h:
                m.move(m.left(end))
        return m.event
