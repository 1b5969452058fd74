"""The effective potential that symmetries leave of a motion, about where its energy lets it go."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..language.suffixed import suffixed
from ..language.tree import Tree, replaced
from ..language.values import value
from .run import Array

FIRST = 32
"""In so many parts the window is cut before V is known to bend."""
PIXEL = 5e-4
"""The part of a picture's width, and of its height, by which what is drawn may be off."""

EDGE = 1 - 1e-9
"""An entry of a rotation lies between −1 and 1, where V may have poles."""

Bounds = tuple[float, float]
ROTATION: Bounds = (-EDGE, EDGE)

SHOWN = 2.0
"""So many depths of the well a picture is high."""

BEYOND, STEADY = 0.4, 0.05
"""So much of the well is shown on each side of it; and so far about a motion that stays where it
is, to rounding, which has no well."""


@dataclass(frozen=True)
class OneDegree:
    """What symmetries leave of a problem where it is one degree of freedom: ``V``, the effective
    potential, a tree in the ``entry`` of g, the momenta 𝒥_1, 𝒥_2, … and the parameters; what the
    ``momenta`` are called among what the motion keeps; is the entry that of a rotation: it
    ``turns``?"""

    entry: tuple[int, int]
    V: Tree
    momenta: tuple[str, ...]
    turns: bool = True

    @property
    def name(self) -> str:
        """The entry as a column of a run."""
        return suffixed("A", *self.entry)

    def along(self, run: Mapping[str, Array], numbers: Mapping[str, float]) -> dict[str, Any]:
        """V at some u, an entry of g, for the momenta of the first row of a run, given by
        its columns: between the turning points of its energy, and a little beyond; empty where
        there is none."""
        if not {*self.momenta} <= {*run}:
            return {}
        first = {**numbers, **{x: float(run[x][0]) for x in self.momenta}}
        at, energy = run[self.name], float(run["energy"][0])
        try:
            low, high = float(at.min()), float(at.max())
            bounds = ROTATION if self.turns else beside(low, high)
            well = turning_points(lambda u: self._value(u, first), energy, low, high, bounds)
            u, V = curve(lambda u: self._value(u, first), energy, *window(*well, bounds))
        except (ArithmeticError, ValueError):
            return {}
        return {"entry": self.name, "u": u.tolist(), "V": V.tolist()}

    def _value(self, u: Any, numbers: Mapping[str, float]) -> Any:
        i, j = self.entry
        known: dict[Tree, Any] = {("entry", "A", i, j): u}
        known |= {("at", "𝒥", k): numbers[x] for k, x in enumerate(self.momenta, 1)}
        tree = self.V
        for k, x in enumerate(known):
            tree = replaced(tree, x, ("par", f"_{k}"))
        values = {**numbers, **{f"_{k}": x for k, x in enumerate(known.values())}}
        return value(tree, {"π": math.pi}, values, None, float)


def beside(low: float, high: float) -> Bounds:
    """As far beyond a motion as it went: an entry of no rotation has no bounds of its own."""
    wide = max(high - low, STEADY)
    return low - wide, high + wide


def turning_points(
    V: Callable[[float], float], energy: float, low: float, high: float, bounds: Bounds = ROTATION
) -> tuple[float, float]:
    """The ends of the well {V ≤ energy}, within bounds, in which a motion was between ``low`` and
    ``high``."""
    step = max(1e-3 * (high - low), 1e-9)
    low, high = (min(max(x, bounds[0]), bounds[1]) for x in (low, high))
    return _end(V, energy, low, -step, bounds), _end(V, energy, high, step, bounds)


def _end(
    V: Callable[[float], float], energy: float, u: float, step: float, bounds: Bounds
) -> float:
    """The end of the well on one side of u: steps, each twice the last, then halves."""
    inside, outside = u, u + step
    while bounds[0] < outside < bounds[1] and V(outside) <= energy:
        inside, outside, step = outside, outside + 2 * step, 2 * step
    outside = min(max(outside, bounds[0]), bounds[1])
    if V(outside) <= energy:
        return outside
    for _ in range(60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if V(middle) <= energy else (inside, middle)
    return inside


def window(low: float, high: float, bounds: Bounds = ROTATION) -> Bounds:
    """From a little below a well to a little above it."""
    wide = high - low
    more = BEYOND * wide if wide > 1e-7 else STEADY
    return max(bounds[0], low - more), min(bounds[1], high + more)


def curve(V: Callable[[Any], Any], energy: float, low: float, high: float) -> tuple[Array, Array]:
    """Places and the values of V there, the nearer to one another the more it bends: intervals are
    halved until the middle of the curve is within a pixel of the chord, or their ends are;
    ``ArithmeticError`` where V has no value."""

    def at(u: Array) -> Array:
        found = np.array(np.broadcast_to(V(u), u.shape), float)
        if not np.isfinite(found).all():
            raise ArithmeticError
        return found

    u = np.linspace(low, high, FIRST + 1)
    values = at(u)
    left = np.arange(FIRST)  # the places where intervals begin that are to be halved
    while left.size:
        middles = (u[left] + u[left + 1]) / 2
        found = at(middles)
        least = float(values.min())
        deep = (energy - least) or float(np.ptp(values)) or 1.0

        def scaled(u: Array, V: Array, least: float = least, deep: float = deep) -> Array:
            """Places in a picture of width and height 1; what is far above it ends there."""
            return np.array([u / (high - low), np.minimum((V - least) / deep, SHOWN) / SHOWN])

        start, end = scaled(u[left], values[left]), scaled(u[left + 1], values[left + 1])
        chord, bent = end - start, scaled(middles, found) - start
        long = np.hypot(*chord)
        away = np.abs(chord[0] * bent[1] - chord[1] * bent[0]) / long
        halved = (away > PIXEL) & (long > PIXEL)
        places = np.searchsorted(u, middles)
        u, values = np.insert(u, places, middles), np.insert(values, places, found)
        new = np.searchsorted(u, middles[halved])
        left = np.sort(np.concatenate([new - 1, new]))
    return u, values
