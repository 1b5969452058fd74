"""The figures of the course, computed: python -m tests.support.lecture_figures.

The racket of the first is a drawing, and only there.  The heavy top: its effective potential, and
the paths of its axis.  What keeps its volume: four points at three times, with the multiplier over
time, and an ellipse of fluid with its pressure.  Motions are those of the equations that the text
displays; what is written is rounded, and without the points that are on a line with others.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from derive.language.derivatives import derivative
from derive.language.tree import Tree
from derive.lecture import fresh_numbers
from derive.lecture.document import claims_of
from derive.lecture.figures import PICTURES, polhodes
from derive.lecture.fresh_numbers import TILT
from derive.lecture.lecture_text import chapters, tree
from derive.lecture.motion_figures import poinsot
from derive.lecture.sheets import (
    AXES,
    TURN,
    Claims,
    Frame,
    Vector,
    View,
    beside,
    numbered,
    panel,
    solved,
)  # fmt: skip
from derive.views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow, from_segment
from tests.support.group_figures import (
    carried_curve,
    hammer_thrown,
    momenta_in_steps,
    momenta_on_orbits,
)
from tests.support.picture_values import nearest, value

PARAMETERS = {"‘I_1’": 1.0, "‘I_3’": 0.4, "‘mgl’": 1.5}
SPIN, UPPER = 3.0, 0.6
"""The momentum about the axis; the cosine of the upper tilt, where the axis is at first."""
PRECESSIONS = {"waves": 0.27, "cusps": 0.0, "loops": -0.6}
"""Kind of a path → the rate of precession at first."""


class Top(fresh_numbers.Top):
    """A top with its motion."""

    def potential(self, u: float) -> float:
        """The effective potential where u is the cosine of the tilt."""
        return self._of("heavy.effective", self.constants | {TILT: u})

    def motion(self, end: float, steps: int) -> list[tuple[float, Vector]]:
        """The cosine of the tilt, its rate, and the angle about the vertical over time."""
        slope = derivative(self.claims["heavy.quadrature"][0].rhs, TILT)

        def rate(x: Vector) -> Vector:
            values = self.constants | {TILT: x[0]}
            return x[1], float(value(slope, values)) / 2, self._of("heavy.connection", values)

        return solved(rate, (self.upper, 0.0, 0.0), end, steps)

    def path(self) -> list[Vector]:
        """The end of the axis, for about one turn about the vertical."""
        points: list[Vector] = []
        for _, (u, _, angle) in self.motion(20.0, 1600):
            if angle > 2 * math.pi:
                break
            points.append(_on_parallel(u, angle))
        return points


def top(claims: Claims, precession: float) -> Top:
    """The top of the figures, by its rate of precession at first."""
    return Top(claims, precession, {tree(x): y for x, y in PARAMETERS.items()}, SPIN, UPPER)


def tilts(claims: Claims) -> Scene:
    """The effective potential of the top that draws loops, and the level of its energy."""
    at = top(claims, PRECESSIONS["loops"])
    level, turns = at.constants[tree("h̃")], (at.lower, UPPER)
    reverse = at.constants[tree("𝒥₁")] / SPIN
    frame = Frame((10.0, 6.0), (80.0, 38.0), (-1.0, level - 1.1), (1.0, level + 2.4))
    grid = (k / 500 - 1 for k in range(1, 1000))
    curve = [(u, y) for u in grid if (y := at.potential(u)) < frame.high[1]]
    names = {-1.0: "−1", at.lower: "u₁", UPPER: "u₂", 1.0: "1"}
    strokes, labels = frame.axes((Label("A", "33"), Label("𝒱")), names, {level: "h̃"}, level)
    strokes.append(frame.curve(curve, AXES[2]))
    strokes.append(frame.curve([(u, level) for u in turns], AXES[2], "thick"))
    uprights = [frame.curve([(u, frame.low[1]), (u, level)], "axis", "thin") for u in turns]
    ends = [(reverse, frame.low[1]), (reverse, frame.high[1] - 0.6)]
    strokes += [*uprights, frame.curve(ends, "axis", "hidden")]
    x, y = frame.at(*ends[1])
    labels.append(Label("𝒥₁/𝒥₂", at=(x, y + 2.6)))
    return panel((102, 54), strokes, labels)


def top_paths(claims: Claims) -> Scene:
    """The paths of the axis on the sphere: waves, cusps, loops."""
    return beside(*(_path_of_axis(top(claims, x)) for x in PRECESSIONS.values()), gap=3)


def _path_of_axis(top: Top) -> Scene:
    view = View((20.0, 19.0), 18.0, 195, 32)
    strokes = [view.outline(), *arrow(view.at((0, 0, 1)), view.at((0, 0, 1.35)), "axis")]
    for u in (top.lower, UPPER):
        parallel = [_on_parallel(u, x) for x in TURN]
        strokes += view.on_sphere(parallel, "axis", "thin")
    return panel((40, 43), (*strokes, *view.on_sphere(top.path(), AXES[2])))


def _on_parallel(u: float, angle: float) -> Vector:
    """The point of the sphere at a height and an angle about the vertical."""
    r = math.sqrt(1 - u * u)
    return r * math.cos(angle), r * math.sin(angle), u


PLACES = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / 2
MASSES, SPRING = (1.0, 1.0, 1.0, 2.0), 1.5
"""Of the points; the stiffness of the springs between each two of them, of length 0."""
VELOCITY = np.array([[0.9, 0.5, 0.0], [-0.2, -0.5, 0.6], [0.3, 0.0, -0.4]])
"""Z at first, of trace 0; A is 1."""
END, STEPS = 6.0, 1200
TIMES = (0.0, 1.0, 2.0)
"""When the tetrahedron is drawn."""


def moments() -> dict[Tree, Any]:
    """J of the points, and K of the springs: Σ k d d̄ over the pairs."""
    J = sum(m * np.outer(r, r) for m, r in zip(MASSES, PLACES, strict=True))
    apart = [a - b for a, b in combinations(PLACES, 2)]
    return {"J": J, "K": sum(SPRING * np.outer(d, d) for d in apart)}


def multiplier(claims: Claims, known: Mapping[Tree, Any], A: Any, alpha: Any) -> dict[Tree, Any]:
    """All letters in a state, θ among them."""
    at = {**known, "A": A, "C": A.T @ A, "Z": np.linalg.solve(A, alpha)}
    return at | {"θ": value(claims["sl3.space"][0].rhs, at)}


def motion(
    claims: Claims, known: Mapping[Tree, Any], velocity: Any, end: float
) -> list[tuple[float, Any, float]]:
    """Time, A and θ, from A = 1 with a velocity; ``known``: J and K."""
    n = len(velocity)

    def split(x: Vector) -> tuple[Any, Any]:
        A, alpha = np.reshape(x, (2, n, n))
        return A, alpha

    def rate(x: Vector) -> Vector:
        A, alpha = split(x)
        at = multiplier(claims, known, A, alpha)
        return (*alpha.ravel(), *value(claims["sl3.space"][1].rhs, at).ravel())

    start = (*np.eye(n).ravel(), *np.ravel(velocity))
    found = ((t, *split(x)) for t, x in solved(rate, start, end, STEPS, each=4))
    return [(t, A, float(multiplier(claims, known, A, v)["θ"])) for t, A, v in found]


def tetrahedron(claims: Claims) -> Scene:
    """The tetrahedron at its times, and θ beside."""
    return _at_times(motion(claims, moments(), VELOCITY, END), _placed)


def _at_times(run: Sequence[tuple[float, Any, float]], drawn: Callable[..., Scene]) -> Scene:
    """What moves, ``drawn`` at its times, and θ beside."""
    places = [drawn(A, t) for t, A, _ in nearest(run, TIMES)]
    return beside(beside(*places, gap=0), _multiplier([(t, y) for t, _, y in run]), gap=3)


def _placed(A: Any, t: float) -> Scene:
    """The points at a time, and what joins them; an edge is pale behind the two faces at it."""
    view = View((12.5, 17.5), 11.0, 25, 18)
    moved = [tuple(map(float, A @ r)) for r in PLACES]
    eye = np.array([view.depth(x) for x in np.eye(3).tolist()])
    strokes = []
    for i, j in combinations(range(4), 2):
        ahead = any(_faces(eye, np.array(moved), k) for k in range(4) if k not in (i, j))
        ends = (view.at(moved[i]), view.at(moved[j]))
        strokes.append(Stroke(ends, AXES[0], "line" if ahead else "hidden"))
    masses = zip(MASSES, moved, strict=True)
    dots = [Dot(view.at(r), 0.55 * m ** (1 / 3), "body") for m, r in masses]
    return panel((25, 36), strokes, [Label(f"t = {t:g}", at=(12.5, 2.0))], dots)


def _faces(eye: Any, corners: Any, k: int) -> bool:
    """Is the face of a tetrahedron that is opposite to a corner turned to the eye?"""
    a, b, c = (corners[i] for i in range(4) if i != k)
    normal = np.cross(b - a, c - a)
    return bool(normal @ eye * (normal @ (corners[k] - a)) < 0)


def _multiplier(curve: list[tuple[float, float]]) -> Scene:
    (end, _), (low, high) = curve[-1], ([f(y for _, y in curve) for f in (min, max)])
    frame = Frame((7.0, 6.0), (32.0, 22.0), (0.0, min(low, 0.0)), (end, high))
    times = numbered(range(0, int(end) + 1, 2))
    unit = 10.0 ** math.floor(math.log10(high))
    levels = numbered((0.0, unit * math.floor(high / unit)))
    strokes, labels = frame.axes((Label("t"), Label("θ")), times, levels, 0)
    strokes.append(frame.curve(curve, AXES[0]))
    return panel((46, 36), strokes, labels)


# An ellipse of a homogeneous fluid, in the plane: J is a multiple of 1, here 1, and nothing acts.

STRAIN = np.array([[0.55, 0.2], [-0.25, -0.55]])
"""Its Z at first, a circle's."""
SPREAD, LEVELS = 4.0, (0.0, 0.25, 0.5, 0.75)
"""For how long it is followed; the levels of the pressure, as parts of that in the middle."""


def ellipse(claims: Claims) -> Scene:
    """The ellipse at three times, with lines of equal pressure, and θ beside."""
    still: dict[Tree, Any] = {"J": np.eye(2), "K": np.zeros((2, 2))}
    return _at_times(motion(claims, still, STRAIN, SPREAD), _fluid)


def _fluid(A: Any, t: float) -> Scene:
    """Images of the circles ‖r‖² = 1 − p/p₀."""
    frame, strokes = Frame((13.0, 16.0), (5.0, 5.0)), []
    for level in LEVELS:
        r = (1 - level) ** 0.5
        moved = [A @ (r * np.cos(x), r * np.sin(x)) for x in TURN]
        strokes += [frame.curve(moved, AXES[0], pen) for pen in ("wash", "thin")]
    return panel((26, 28), strokes, [Label(f"t = {t:g}", at=(13.0, 4.0))])


# The whole theory in one picture: a racket, and what the group makes of it.

DRAWN: dict[str, Callable[[Claims], Scene]] = {
    "polhodes": polhodes,
    "rolling": poinsot,
    "tilts": tilts,
    "paths": top_paths,
    "tetrahedron": tetrahedron,
    "ellipse": ellipse,
    "three_groups": momenta_on_orbits,
    "thrown": hammer_thrown,
    "carried": carried_curve,
    "stepped": momenta_in_steps,
}
CLOSE = 0.01
"""How far from a line, in millimetres, a point may be that is left out."""


def thinned(points: Sequence[Point]) -> Sequence[Point]:
    """The points of a curve without those near the lines between others (Ramer, Douglas and
    Peucker)."""
    far = [from_segment(p, points[0], points[-1]) for p in points]
    k = far.index(max(far))
    if far[k] <= CLOSE:
        return points[:: max(1, len(points) - 1)]
    return [*thinned(points[: k + 1])[:-1], *thinned(points[k:])]


def written(scene: Scene) -> str:
    """A figure as it is committed, in hundredths of a millimetre; a line for each part."""

    def at(p: Point) -> list[int]:
        return [round(100 * x) for x in p]

    told: dict[str, list[Any]] = {"size": at((scene.width, scene.height))}
    told["strokes"] = [
        [s.role, s.pen, [x for p in thinned(s.points) for x in at(p)]] for s in scene.strokes
    ]
    told["dots"] = [[d.role, *at((d.radius, *d.at))] for d in scene.dots]
    told["labels"] = [[x.base, x.index, x.name, *at(x.at)] for x in scene.labels]
    lines = json.dumps(told, ensure_ascii=False, separators=(",", ":"))
    return lines.replace("]],[", "]],\n[") + "\n"


if __name__ == "__main__":
    claims = claims_of(chapters())
    for label, drawn in DRAWN.items():
        (PICTURES / f"{label}.json").write_text(written(drawn(claims)), encoding="utf-8")
