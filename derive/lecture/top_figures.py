"""The figures of the heavy top, by the equations that the text displays: its effective potential,
and the paths of its axis."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from ..language.derivatives import derivative
from ..language.tree import Tree
from ..views.figure.drawing import Label, Scene, Stroke, arrow
from .lecture_text import tree
from .sheets import AXES, TURN, Claims, Frame, Vector, View, beside, number, panel, solved

PARAMETERS = {"‘I_1’": 1.0, "‘I_3’": 0.4, "‘mgl’": 1.5}
SPIN, UPPER = 3.0, 0.6
"""The momentum about the axis; the cosine of the upper tilt, where the axis is at first."""
PRECESSIONS = {"waves": 0.27, "cusps": 0.0, "loops": -0.6}
"""Kind of a path → the rate of precession at first."""
TILT = tree("A₃₃")


@dataclass(frozen=True)
class Top:
    """A top whose axis is at its ``upper`` tilt at first, by its cosine, and precesses at the rate
    ``precession``; ``spin``: the momentum about the axis."""

    claims: Claims
    precession: float
    parameters: Mapping[Tree, float] = field(
        default_factory=lambda: {tree(x): y for x, y in PARAMETERS.items()}
    )
    spin: float = SPIN
    upper: float = UPPER

    @cached_property
    def constants(self) -> dict[Tree, float]:
        """Its parameters and what its motion keeps, by their letters."""
        found = {**self.parameters, tree("𝒥₂"): self.spin, TILT: self.upper}
        # the rate of precession is of degree 1 in 𝒥₁
        slow, fast = (self._of("heavy.connection", found | {tree("𝒥₁"): x}) for x in (0.0, 1.0))
        found[tree("𝒥₁")] = (self.precession - slow) / (fast - slow)
        found[tree("h̃")] = self._of("heavy.effective", found)
        return found

    def _of(self, label: str, values: Mapping[Tree, float]) -> float:
        return number(self.claims[label][0].rhs, values)

    def potential(self, u: float) -> float:
        """The effective potential where u is the cosine of the tilt."""
        return self._of("heavy.effective", self.constants | {TILT: u})

    @cached_property
    def lower(self) -> float:
        """The cosine of the lower tilt: the other root of the cubic in the well, by halving."""
        below, above = -1.0, self.upper - 1e-6
        for _ in range(60):
            middle = (below + above) / 2
            if self._of("heavy.quadrature", self.constants | {TILT: middle}) > 0:
                above = middle
            else:
                below = middle
        return above

    def motion(self, end: float, steps: int) -> list[tuple[float, Vector]]:
        """The cosine of the tilt, its rate, and the angle about the vertical over time."""
        slope = derivative(self.claims["heavy.quadrature"][0].rhs, TILT)

        def rate(x: Vector) -> Vector:
            values = self.constants | {TILT: x[0]}
            return x[1], number(slope, values) / 2, self._of("heavy.connection", values)

        return solved(rate, (self.upper, 0.0, 0.0), end, steps)

    def path(self) -> list[Vector]:
        """The end of the axis, for about one turn about the vertical."""
        points: list[Vector] = []
        for _, (u, _, angle) in self.motion(20.0, 1600):
            if angle > 2 * math.pi:
                break
            r = math.sqrt(1 - u * u)
            points.append((r * math.cos(angle), r * math.sin(angle), u))
        return points


def tilts(claims: Claims) -> Scene:
    """The effective potential of the top that draws loops, and the level of its energy."""
    top = Top(claims, PRECESSIONS["loops"])
    level, turns = top.constants[tree("h̃")], (top.lower, UPPER)
    reverse = top.constants[tree("𝒥₁")] / SPIN
    frame = Frame((10.0, 6.0), (80.0, 38.0), (-1.0, level - 1.1), (1.0, level + 2.4))
    grid = (k / 500 - 1 for k in range(1, 1000))
    curve = [(u, y) for u in grid if (y := top.potential(u)) < frame.high[1]]
    names = {-1.0: "−1", top.lower: "u₁", UPPER: "u₂", 1.0: "1"}
    strokes, labels = frame.axes((Label("A", "33"), Label("𝒱")), names, {level: "h̃"})
    strokes.append(frame.curve(curve, AXES[2]))
    strokes.append(frame.curve([(-1, level), (1, level)], "axis", "thin"))
    strokes.append(frame.curve([(u, level) for u in turns], AXES[2], "thick"))
    for u in turns:
        strokes.append(frame.curve([(u, frame.low[1]), (u, level)], "axis", "thin"))
    ends = [(reverse, frame.low[1]), (reverse, frame.high[1] - 0.6)]
    strokes.append(frame.curve(ends, "axis", "hidden"))
    x, y = frame.at(*ends[1])
    labels.append(Label("𝒥₁/𝒥₂", at=(x, y + 2.6)))
    return panel((102, 54), strokes, labels)


def top_paths(claims: Claims) -> Scene:
    """The paths of the axis on the sphere: waves, cusps, loops."""
    return beside(*(_path(Top(claims, x)) for x in PRECESSIONS.values()), gap=3)


def _path(top: Top) -> Scene:
    view = View((20.0, 19.0), 18.0, 195, 32)
    strokes = [view.outline(), *arrow(view.at((0, 0, 1)), view.at((0, 0, 1.35)), "axis")]
    for u in (top.lower, UPPER):
        strokes += view.on_sphere(_parallel(u), "axis", "thin")
    path: list[Stroke] = view.on_sphere(top.path(), AXES[2])
    return panel((40, 43), (*strokes, *path))


def _parallel(u: float) -> list[Vector]:
    """The circle of the sphere at a height."""
    r = math.sqrt(1 - u * u)
    return [(r * math.cos(x), r * math.sin(x), u) for x in TURN]
