"""The motion of a run: emitted steps from instant to instant, which stop at events."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Protocol

import numpy as np

from ..code.kinks import may_bend
from ..code.languages import C
from ..code.options import DEPENDENT
from ..code.program import Block
from ..code.step.step_numbers import FIXED
from ..language.limits import STEPS_OF_A_MOTION
from ..language.reserved import did_you_mean, near_name
from .first_numbers import MotionError
from .native import AT_EVENT, FAULTS, StepError
from .run import Array, Happening
from .signals import InputFunction, InputsInTime

# How a motion is followed: the step, and its size or its tolerance; when its states are kept.

STEPS = C.steps
"""The steps that a motion can be followed by, the first one by default: those of C, which Python
has, too."""

ORDERS = DEPENDENT["order"][0]
"""The orders that the discrete step can have, the first one by default."""

BENT = "vern9"
"""The default where what acts may bend: it sees that, which ``gauss``, of order 16, does not."""

LEAST_TOLERANCE, TOLERANCE, MOST_INSTANTS = 1e-15, 1e-9, 10_000_000


def step_of(problem: Mapping[str, Any], step: str | None, dt: float | None) -> str:
    """The step that is asked for, or the default for the problem of a record."""
    return step or (BENT if dt is None and may_bend(problem) else STEPS[0])


@dataclass(frozen=True)
class Method:
    """A step by name, in steps of size ``dt`` or, where that is ``None``, of their own for a
    tolerance; ``order``: of the discrete step alone, of ORDERS.

    ``MotionError`` for a step that there is not, a size or a tolerance that is no use.
    """

    step: str = STEPS[0]
    dt: float | None = None
    tol: float = TOLERANCE
    order: str = ""

    def __post_init__(self) -> None:
        if self.step not in STEPS:
            near = did_you_mean(near_name(self.step, [*STEPS]), after=" ")
            raise MotionError(f"no step {self.step[:40]!r}; {near}there is {', '.join(STEPS)}")
        if self.order and self.step != "discrete":
            raise MotionError(
                f"--order is that of --step discrete, not of {self.step}: leave it out"
            )
        if self.order not in ("", *ORDERS):
            raise MotionError(
                f"the order must be one of {', '.join(ORDERS)}, not {self.order[:40]}"
            )
        if self.dt is None and self.step in FIXED:
            raise MotionError(f"{self.step} has steps of one size: give --dt")
        if self.dt is not None and not (math.isfinite(self.dt) and self.dt > 0):
            raise MotionError(f"the step must have a size above 0, not {self.dt}")
        if not LEAST_TOLERANCE <= self.tol < 1:
            raise MotionError(
                f"the tolerance must be at least {LEAST_TOLERANCE:g}, which is near the rounding "
                f"of doubles, and below 1, not {self.tol}"
            )

    def __str__(self) -> str:
        step = self.step
        if step == "discrete":
            step += f" of order {self.order or ORDERS[0]}"
        return f"{step}, " + (f"dt {self.dt:g}" if self.dt else f"tol {self.tol:g}")


def instants(method: Method, duration: float, points: int) -> Array:
    """The times from 0 to ``duration`` at which states are kept, about ``points`` beside the first;
    with a fixed step these are ends of steps, and the last one may come after a shorter step.

    ``MotionError`` for no time, and for what would not end.
    """
    if not (math.isfinite(duration) and duration > 0):
        raise MotionError(f"the time must be above 0, not {duration}")
    if not 1 <= points <= MOST_INSTANTS:
        raise MotionError(f"between 1 and {MOST_INSTANTS} instants can be kept, not {points}")
    if method.dt is None:
        return np.linspace(0.0, duration, points + 1)
    if not duration / method.dt <= STEPS_OF_A_MOTION:
        raise MotionError(
            f"{duration / method.dt:.3g} steps of {method.dt:g} are more than "
            f"{STEPS_OF_A_MOTION:g}: take larger ones or a shorter time"
        )
    whole = math.floor(duration / method.dt * (1 + 1e-12))
    each = max(1, whole // points)
    times: Array = method.dt * np.arange(0, whole + 1, each, dtype=float)
    if duration - times[-1] <= 1e-9 * method.dt:
        times[-1] = duration if whole else 0.0
        return times if whole else np.array([0.0, duration])
    return np.concatenate([times, [duration]])


INTERRUPTED = "interrupted"
"""Why a run ended by Ctrl-C."""

SLIVER = 1e-9
"""The part of a step below which nothing is left of a time."""


class MotionUnderWay(Protocol):
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

    def hold(self, u: Array | InputFunction) -> None:
        """Make the next moves with other inputs."""

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
    does the motion end there?  ``driven``: its inputs in time, if they change."""

    def __init__(
        self,
        motion: MotionUnderWay,
        method: Method,
        ends: Mapping[str, bool],
        driven: InputsInTime | None = None,
    ):
        self.motion, self.method, self.ends, self.driven = motion, method, ends, driven
        self.happened: list[Happening] = []

    def reach(self, times: Array) -> tuple[Array, str]:
        """The states at increasing times, fewer where the motion must stop or Ctrl-C stops it, and
        why."""
        states: list[Array] = []
        why = ""
        try:
            for time in times.tolist():
                if why := self._with_inputs(time):
                    break
                states.append(self.motion.x.copy())
        except KeyboardInterrupt:
            why = INTERRUPTED
            self.motion.settle()
            self._note()
        return np.array(states).reshape(-1, len(self.motion.x)), why

    def _with_inputs(self, end: float) -> str:
        """Steps up to a time, by the inputs of each instant; why not, as below."""
        if self.driven is None:
            return self._until(end)
        for u, stop in self.driven.parts(self.motion.t, end):
            self.motion.hold(u)
            if why := self._until(stop):
                return why
        return ""

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


# A motion of emitted Python under way, as that of ``motion.native`` is of C.


class MotionInPython:
    """A motion under way, by a step of the emitted module ``code``, with constants and inputs."""

    def __init__(self, code: ModuleType, step: str, k: Array, u: Array, x: Array):
        self._code, self._step = code, step
        self._numbers: tuple[Array, Array | InputFunction] = k, u
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

    def hold(self, u: Array | InputFunction) -> None:
        """Make the next moves with other inputs."""
        self._numbers = self._numbers[0], u

    def left(self, t: float) -> float:
        """The time up to another, in as many digits as the motion has."""
        return float(t - self._motion.t - self._motion.t_low)

    def move(self, h: float, n: int = 1) -> None:
        """Make n steps of size h; ``StepError``."""
        self._ended(self._of(self._step)(self._motion, *self._numbers, h, n))

    def move_to(self, t: float, tol: float) -> None:
        """Move up to a time or an event, in steps of their own size; ``StepError``."""
        self._ended(self._of(f"{self._step}_to")(self._motion, *self._numbers, t, tol))

    def watch(self, t: float, h: float) -> None:
        """Move up to a time or an event, in steps of size h; ``StepError``."""
        step = self._of(self._step)
        self._ended(self._code.watch(step, self._motion, *self._numbers, t, h))

    def settle(self) -> None:
        """Be where the last move has ended, after one that Ctrl-C has stopped on the way."""
        begun = self._code.begin(*self._sure)
        begun.evaluations = self.evaluations
        self._motion, self.event = begun, ""

    def _of(self, name: str) -> Any:
        return getattr(self._code, name)

    def _ended(self, status: int) -> None:
        self.event = self._code.EVENTS[self._motion.event] if status == AT_EVENT else ""
        self._sure = self.t, self.x.copy()
        if status and not self.event:
            raise StepError(FAULTS[status].format(self.t))


# Is an element in the part of its group that motions reach?  Relations alone do not tell: that
# ĀA = 1 holds for reflections, too.  And Newton's method to the group, which stays in that part.

SINGULAR = 1e-12
"""A determinant that is not larger is 0 to rounding."""

STEPS_ALONG, LARGEST = 200, 0.9
"""So many Newton steps at most, X = A⁻¹ΔA no larger: 1 + X is then invertible, and of a form that
is orthogonal it is positive and commutes with ĀA, so that the rotation in A = RP stays."""

CONVERGED = 1e-9
"""A step that is smaller is the last one."""


def determinants(block: Block, x: Array) -> Array:
    """det A of one block, of states (…, size of the state)."""
    with np.errstate(all="ignore"):
        return np.asarray(np.linalg.det(_matrix(block, x)), dtype=float)


def _matrix(block: Block, x: Array) -> Array:
    n = round(len(block.places) ** 0.5)
    return x[..., list(block.places)].reshape(*x.shape[:-1], n, n)


def reflection(blocks: Sequence[Block], x: Array) -> str:
    """That a state, or the first such of many, is a reflection, in words; empty where none is."""
    for block in blocks:
        found = determinants(block, x)
        if block.turns and (found < 0).any():
            det = float(np.extract(found < 0, found)[0])
            return f"det A = {det:.3g}: a reflection is no element of {block.group}"
    return ""


def not_near(blocks: Sequence[Block], x: Array) -> str:
    """That a state is on no side from which ``project`` reaches the group, in words, or empty."""
    found = [float(determinants(block, x)) for block in blocks]
    return next((f"det A = {det:.3g} is not above 0" for det in found if not det > SINGULAR), "")


def why_unreached(blocks: Sequence[Block], x: Array) -> str:
    """Why Newton's method finds no element of the group from a state, in words."""
    return not_near(blocks, x) or "it is too far off for Newton's method"


def taken_to_group(project: Callable[[Array], Array], blocks: Sequence[Block], x: Array) -> Array:
    """States (…, size of the state) after Newton's method in steps of bounded size, ``project`` or
    a part of it each; among rotations the nearest to their A."""
    with np.errstate(all="ignore"):
        for _ in range(STEPS_ALONG):
            step = np.asarray(project(x), dtype=float) - x
            if not np.isfinite(step).all():
                break
            part = np.ones(x.shape[:-1])
            for block in blocks:
                A, change = (_matrix(block, y) for y in (x, step))
                size = np.linalg.norm(np.linalg.pinv(A) @ change, 2, axis=(-2, -1))
                part = np.minimum(part, LARGEST / size)
            x = x + part[..., None] * step
            if np.abs(step).max() < CONVERGED * max(1.0, np.abs(x).max()):
                break  # the error is now the square of that
    return x
