"""How a motion is followed: the step, and its size or its tolerance; when its states are kept."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..code.languages import C
from ..code.options import DEPENDENT
from ..code.step.step_numbers import FIXED
from ..language.limits import STEPS_OF_A_MOTION
from ..language.near_names import did_you_mean, near_name
from .run import Array
from .start import MotionError

STEPS = C.steps
"""The steps that a motion can be followed by, the first one by default: those of C, which Python
has, too."""

ORDERS = DEPENDENT["order"][0]
"""The orders that the discrete step can have, the first one by default."""

LEAST_TOLERANCE, TOLERANCE, MOST_INSTANTS = 1e-15, 1e-9, 10_000_000


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
