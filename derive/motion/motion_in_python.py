"""A motion of emitted Python under way, as that of :mod:`derive.native.motion_in_c` is of C."""

from __future__ import annotations

from types import ModuleType
from typing import Any

from ..native.motion_in_c import AT_EVENT, FAULTS, StepError
from .run import Array


class MotionInPython:
    """A motion under way, by a step of the emitted module ``code``, with constants and inputs."""

    def __init__(self, code: ModuleType, step: str, k: Array, u: Array, x: Array):
        self._code, self._step, self._numbers = code, step, (k, u)
        self._motion, self.event = code.begin(0.0, x), ""
        self._sure = 0.0, x  # time and state at the end of the last move

    @property
    def t(self) -> float:
        """The time."""
        return float(self._motion.t)

    @property
    def x(self) -> Array:
        """The state."""
        found: Array = self._motion.x
        return found

    @property
    def h(self) -> float:
        """The last step."""
        return float(self._motion.h)

    @property
    def rising(self) -> bool:
        """Is the event reached from below?"""
        return bool(self._motion.rising)

    @property
    def evaluations(self) -> int:
        """How often its stages have asked for the rates."""
        return int(self._motion.evaluations)

    def left(self, t: float) -> float:
        """The time up to another, in as many digits as the motion has."""
        return float(t - self._motion.t - self._motion.t_low)

    def dense(self, t: float) -> Array:
        """The state at a time within the last step, by the polynomial of its method."""
        found: Array = self._code.dense(self._motion, t)
        return found

    def move(self, h: float, n: int = 1) -> None:
        """Make n steps of size h; ``StepError``."""
        self._told(self._of(self._step)(self._motion, *self._numbers, h, n))

    def move_to(self, t: float, tol: float) -> None:
        """Move up to a time or an event, in steps of their own size; ``StepError``."""
        self._told(self._of(f"{self._step}_to")(self._motion, *self._numbers, t, tol))

    def watch(self, t: float, h: float) -> None:
        """Move up to a time or an event, in steps of size h; ``StepError``."""
        step = self._of(self._step)
        self._told(self._code.watch(step, self._motion, *self._numbers, t, h))

    def settle(self) -> None:
        """Be where the last move has ended, after one that Ctrl-C has stopped on the way."""
        begun = self._code.begin(*self._sure)
        begun.evaluations = self.evaluations
        self._motion, self.event = begun, ""

    def _of(self, name: str) -> Any:
        return getattr(self._code, name)

    def _told(self, status: int) -> None:
        self.event = self._code.EVENTS[self._motion.event] if status == AT_EVENT else ""
        self._sure = self.t, self.x.copy()
        if status and not self.event:
            raise StepError(FAULTS[status].format(self.t))
