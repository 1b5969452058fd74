"""Work and precision: the seconds of a method against the error at the end of a motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import exp, inf, isfinite, log

from ..peers.cases import Array

Run = Callable[[float], tuple[float, Array]]
"""From a tolerance or number of steps: seconds, the state at the end."""


LONGEST, FINEST = 4.0, 3e-13
"""The seconds of a run, or the error, after which a slow method is asked for no finer one."""


@dataclass
class Curve:
    """A method on a form of a motion, with the parameters of its sweep from fine to coarse.

    A ``slow`` one is run once; the others again and again, in turn, for the least of their times.
    """

    method: str
    form: str
    run: Run
    error: Callable[[Array], float]
    parameters: Sequence[float]
    slow: bool = False
    seconds: list[float] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)

    def sweep(self) -> None:
        """Every parameter once more."""
        if not self.errors:
            self.seconds = [inf] * len(self.parameters)
            self.errors = [inf] * len(self.parameters)
        for i, parameter in reversed([*enumerate(self.parameters)]):
            seconds, end = self.run(parameter)
            self.seconds[i] = min(self.seconds[i], seconds)
            self.errors[i] = self.error(end) if isfinite(seconds) else inf
            if self.slow and (seconds > LONGEST or self.errors[i] < FINEST):
                break

    def at(self, goal: float) -> float:
        """The seconds for an error: where the curve, from its fine end, goes above it; infinite
        where it never is below."""
        points = [*zip(self.seconds, self.errors, strict=True)]
        below = [i for i, (_, error) in enumerate(points) if error <= goal]
        if not below:
            return inf
        last = below[0]  # what is finer was not run, or is rounding
        while last + 1 < len(points) and points[last + 1][1] <= goal:
            last += 1
        seconds, error = points[last]
        if last + 1 == len(points) or not isfinite(points[last + 1][1]):
            return seconds
        later, larger = points[last + 1]
        part = log(goal / max(error, 1e-18)) / log(larger / max(error, 1e-18))
        return exp(log(seconds) + part * (log(later) - log(seconds)))

    @property
    def record(self) -> list[dict[str, object]]:
        """Its points, as ``derive plot --kind precision`` reads them."""
        return [
            {"method": f"{self.method}, {self.form}", "work": t, "error": max(e, 1e-17)}
            for t, e in zip(self.seconds, self.errors, strict=True)
            if isfinite(t) and isfinite(e)
        ]


def interleaved(curves: Sequence[Curve], rounds: int) -> None:
    """The sweeps in turn, the fast ones in every round."""
    for r in range(rounds):
        for curve in curves:
            if r == 0 or not curve.slow:
                curve.sweep()


def best(curves: Sequence[Curve], names: Sequence[str], goal: float) -> float:
    """The least seconds for an error, by any of some methods in any form."""
    return min((c.at(goal) for c in curves if c.method in names), default=inf)
