"""Events: the instants at which an expression of the state becomes 0.

A change of sign is looked for on the collocation polynomial of each step, at SAMPLES places, and
located there.  The polynomial is of order 9, the steps are of order 16: the
instant is then corrected by Newton's method on steps that end there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from ..language.expression import names
from ..language.near_names import did_you_mean, near_name
from ..language.values import value
from ..schema.followed import Event
from .run import Array, Happening
from .start import MotionError, Start

SAMPLES = 16
"""Parts of a step at whose ends an expression is taken: two changes of sign in one are not seen."""

NEWTON, EXACT = 8, 1e-15
"""The most corrections of an instant, and a relative one that is too small to go on from."""


Within = Callable[[float], Array]
"""The state at a part of a step, from 0 to 1."""


class Moment(Protocol):
    """A motion at the beginning or at the end of a step."""

    t: float
    x: Array

    def after(self, h: float) -> Array:
        """The state a step of size h later."""


class Watch:
    """The events of a motion: those that have ``happened``, in order of time."""

    def __init__(self, events: Sequence[Event], state: Sequence[str], inputs: Sequence[str],
                 begin: Start):  # fmt: skip
        self.events, self.state = events, state
        self.held: Mapping[str, Any] = {
            **begin.parameters, **dict(zip(inputs, begin.u.tolist(), strict=True))
        }  # fmt: skip
        self.happened: list[Happening] = []
        self._require_known()
        self.last = [self.value(event, 0.0, begin.x) for event in events]
        for event, first in zip(events, self.last, strict=True):
            if not np.isfinite(first):
                raise MotionError(f"event {event.name}: no finite value at the start")

    def _require_known(self) -> None:
        known = [*self.state, *self.held]
        for event in self.events:
            for name in names(event.when):
                if name not in known:
                    near = did_you_mean(near_name(name, known), after=" ")
                    raise MotionError(
                        f"event {event.name}: no {name[:40]!r} in the state, the parameters or the "
                        f"inputs{'; ' * bool(near)}{near.rstrip()}"
                    )

    def value(self, event: Event, t: Any, x: Array) -> Any:
        """The expression of an event at times and states (…, size of the state)."""
        numbers = {**self.held, **{name: x[..., k] for k, name in enumerate(self.state)}}
        try:
            with np.errstate(all="ignore"):
                found = value(event.when, {"π": math.pi, "t": t}, numbers, _elementary, float)
        except (ArithmeticError, ValueError):  # of parameters alone, as 1/k for k = 0
            found = math.nan
        return np.broadcast_to(np.asarray(found, dtype=float), x.shape[:-1])

    def ended_by(self, past: Moment, now: Moment, within: Within) -> Happening | None:
        """Note what happened on a step, up to a terminal event, which is returned."""
        step = _Step(self, past, now.t - past.t, within)
        theta = np.linspace(0, 1, SAMPLES + 1)
        found = []
        for k, event in enumerate(self.events):
            g = step.dense(event, theta).copy()
            # what two steps share is the same for both: nothing is seen twice, or not at all
            g[0], g[-1] = self.last[k], self.value(event, now.t, now.x)
            self.last[k] = g[-1]
            for i, direction in _changes(g):
                if event.direction in ("both", direction):
                    found.append(step.located(event, theta[i], theta[i + 1], direction))
        for one in sorted(found, key=lambda x: x.t):
            self.happened.append(one)
            if one.terminal:
                return one
        return None

    def quiet(self, t: Array, x: Array) -> int:
        """How many of some steps are without an event, by times and states at the ends of SAMPLES
        parts of each, up to the first that may have one; these are then past."""
        g = [np.append(self.last[k], self.value(e, t, x)) for k, e in enumerate(self.events)]
        first = min((i for one in g for i, _ in _changes(one)[:1]), default=len(t))
        steps = first // SAMPLES
        self.last = [one[steps * SAMPLES] for one in g]
        return steps


class _Step:
    """A step of size h from ``past``, on its polynomial ``within``."""

    def __init__(self, watch: Watch, past: Moment, h: float, within: Within):
        self.watch, self.past, self.h, self.within = watch, past, h, within

    def dense(self, event: Event, theta: Array) -> Array:
        """The expression on the polynomial."""
        x = np.array([self.within(part) for part in theta])
        found: Array = self.watch.value(event, self.past.t + theta * self.h, x)
        return found

    def located(self, event: Event, a: float, b: float, direction: str) -> Happening:
        """The change of sign between two places of the step."""
        for _ in range(13):  # SAMPLES^-13 is below rounding
            theta = np.linspace(a, b, SAMPLES + 1)
            i = next((i for i, _ in _changes(self.dense(event, theta))), SAMPLES - 1)
            a, b = theta[i], theta[i + 1]
        tau, x = self._corrected(event, b)
        return Happening(event.name, self.past.t + tau, direction, event.terminal, x)

    def _corrected(self, event: Event, theta: float) -> tuple[float, Array]:
        """Time from the start of the step, and state, by the slope on the polynomial."""
        near = theta + np.array([-1e-3, 1e-3])
        low, high = self.dense(event, near)
        slope = (high - low) / (2e-3 * self.h)
        tau = first = float(theta * self.h)
        for _ in range(NEWTON):
            x = self.past.after(tau)
            change = float(self.watch.value(event, self.past.t + tau, x)) / slope if slope else 0.0
            new = min(max(tau - change, 0.0), self.h)
            if not abs(new - first) < self.h / SAMPLES:  # it only touches 0
                return first, self.past.after(first)
            tau = new
            if abs(change) <= EXACT * (self.past.t + self.h):
                break
        return tau, self.past.after(tau)


def _changes(g: Array) -> list[tuple[int, str]]:
    """Where 0 is reached from below or from above, between g[i] and g[i + 1]."""
    before, after = g[:-1], g[1:]
    up, down = (before < 0) & (after >= 0), (before > 0) & (after <= 0)
    return [(int(i), "rising" if up[i] else "falling") for i in np.flatnonzero(up | down)]


def _elementary(name: str, x: Any) -> Any:
    return getattr(np, {"atan": "arctan"}.get(name, name))(x)
