"""A motion of emitted Python under way, as that of :mod:`derive.native.motion_in_c` is of C."""

from __future__ import annotations

import math
from copy import copy
from types import ModuleType
from typing import Any

from ..native.motion_in_c import FAULTS, StepError
from .run import Array


class MotionInPython:
    """A motion under way, by a step of the emitted module ``code``, with constants and inputs."""

    def __init__(self, code: ModuleType, step: str, k: Array, u: Array, x: Array):
        self._code, self._step, self._numbers = code, step, (k, u)
        self._motion = code.begin(0.0, x)

    def __copy__(self) -> MotionInPython:
        """The motion as it is now, whatever becomes of this one."""
        other = object.__new__(type(self))
        other.__dict__ |= self.__dict__ | {"_motion": copy(self._motion)}
        return other

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

    def move_to(self, t: float, tol: float, *, most: float = math.inf) -> None:
        """Move up to a time, in steps of their own size, at most so many; ``StepError``."""
        step = self._of(f"{self._step}_step")
        while self.left(t) and most > 0:
            self._told(self._code.towards(step, self._motion, *self._numbers, t, tol))
            most -= 1

    def _of(self, name: str) -> Any:
        return getattr(self._code, name)

    def _told(self, status: int) -> None:
        if status:
            raise StepError(FAULTS[status].format(self.t))
