"""The motion of a run: emitted steps from instant to instant, with a watch on events."""

from __future__ import annotations

import math
from contextlib import suppress
from copy import copy
from typing import Protocol

import numpy as np

from ..code.step.step_numbers import LEAST
from ..native.motion_in_c import Motion, StepError
from .method import Method
from .run import Array
from .watch import SAMPLES, Watch

SLIVER = 1e-9
"""The part of a step below which nothing is left of a time."""


NUMBERS = 2**18
"""Numbers of the states that are watched at once, 2 MB of them."""


class Moved(Protocol):
    """A motion under way, in C or in Python."""

    @property
    def t(self) -> float:
        """The time."""

    @property
    def x(self) -> Array:
        """The state."""

    @property
    def h(self) -> float:
        """The last step."""

    @property
    def evaluations(self) -> int:
        """How often its stages have asked for the rates."""

    def left(self, t: float) -> float:
        """The time up to another."""

    def dense(self, t: float) -> Array:
        """The state at a time within the last step."""

    def move(self, h: float, n: int = 1) -> object:
        """Make n steps of size h; ``StepError``."""

    def move_to(self, t: float, tol: float, *, most: float = math.inf) -> object:
        """Move up to a time, in at most so many steps; ``StepError``."""


class Trajectory:
    """A motion under way: ``t`` and ``x``."""

    def __init__(self, motion: Moved, method: Method, watch: Watch):
        self.motion, self.method, self.watch = motion, method, watch
        self.t, self.x = motion.t, motion.x
        self._many = 2

    def reach(self, times: Array) -> tuple[Array, str]:
        """The states at increasing times, fewer where the motion must stop, and why."""
        states: list[Array] = []
        for time in times.tolist():
            if why := self._until(time):
                return np.array(states).reshape(-1, len(self.x)), why
            states.append(self.x)
        return np.array(states), ""

    def _until(self, end: float) -> str:
        """Steps up to a time; why not, where that fails or an event ends the motion."""
        try:
            while not self._is_at(end):
                if not self.watch.events:
                    self._steps(end)
                    self._note()
                    continue
                if self._quiet(end):
                    continue
                past = copy(self)
                self._step(end)
                self._note()
                if last := self.watch.ended_by(past, self, self._within):
                    self.t, self.x = last.t, last.state
                    return f"event {last.name}"
        except StepError as error:
            return str(error)
        return ""

    def _quiet(self, end: float) -> int:
        """Steps of one size towards a time, in C, up to one that may have an event; how many.

        They are twice as many as the last time, or one after an event.
        """
        h = self.method.dt
        if h is None or not isinstance(self.motion, Motion):
            return 0
        most = max(1, NUMBERS // (SAMPLES * len(self.x)))
        n = min(self._many, most, math.floor(self.motion.left(end) / h + SLIVER))
        if n < 2:
            self._many = max(self._many, 2)
            return 0
        past, seen = copy(self.motion), self.motion.watched(h, n, SAMPLES)
        steps = self.watch.quiet(*seen)
        self._many = 2 * self._many if steps == n else 1
        if steps < n:
            self.motion = past
            self.motion.move(h, steps)
        self._note()
        return steps

    def _note(self) -> None:
        self.t, self.x = self.motion.t, self.motion.x.copy()

    def _is_at(self, end: float) -> bool:
        return self.motion.left(end) <= SLIVER * (self.method.dt or 0.0)

    def _steps(self, end: float) -> None:
        """All steps up to a time, the last one of which may be shorter."""
        h = self.method.dt
        if h is None:
            self.motion.move_to(end, self.method.tol)
            return
        self.motion.move(h, math.floor(self.motion.left(end) / h + SLIVER))
        if not self._is_at(end):
            self.motion.move(self.motion.left(end))

    def _step(self, end: float) -> None:
        """One step towards a time."""
        if self.method.dt is None:
            self.motion.move_to(end, self.method.tol, most=1)
            return
        past, h = self.motion, min(self.method.dt, self.motion.left(end))
        self.motion = copy(past)
        self.motion.move(h)
        while self.motion.h < h * (1 - SLIVER) and h > LEAST * end:  # made in parts: one of them
            self.motion, h = copy(past), h / 2
            self.motion.move(h)

    def _within(self, part: float) -> Array:
        """The state at a part of the last step."""
        return self.motion.dense(self.t + (part - 1) * self.motion.h)

    def __copy__(self) -> Trajectory:
        """The motion as it is now, whatever becomes of this one."""
        other = object.__new__(type(self))
        other.__dict__ |= self.__dict__ | {"motion": copy(self.motion)}
        return other

    def after(self, h: float) -> Array:
        """The state a step of size h later, or the state at hand where that step cannot be made."""
        later = copy(self.motion)
        with suppress(StepError):
            later.move(h)
        return later.x
