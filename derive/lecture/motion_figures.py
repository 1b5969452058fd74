"""Figures of motions, by the equations that the text displays.

The heavy top: its effective potential, and the paths of its axis.  What keeps its volume: four
points at three times, with the multiplier over time, and an ellipse of fluid with its pressure.
Poinsot's motion: the ellipsoid of inertia that rolls on its plane, the polhode on it, and the
herpolhode.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from ..language.derivatives import derivative
from ..language.tree import Tree
from ..views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow
from ..views.figure.drawn_body import UNITS, cross, dot
from .lecture_text import tree
from .sheets import (
    AXES,
    TURN,
    Claims,
    Frame,
    Vector,
    View,
    beside,
    circle,
    euler,
    nearest,
    numbered,
    panel,
    solved,
    value,
)  # fmt: skip

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
        return float(value(self.claims[label][0].rhs, values))

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


def tilts(claims: Claims) -> Scene:
    """The effective potential of the top that draws loops, and the level of its energy."""
    top = Top(claims, PRECESSIONS["loops"])
    level, turns = top.constants[tree("h̃")], (top.lower, UPPER)
    reverse = top.constants[tree("𝒥₁")] / SPIN
    frame = Frame((10.0, 6.0), (80.0, 38.0), (-1.0, level - 1.1), (1.0, level + 2.4))
    grid = (k / 500 - 1 for k in range(1, 1000))
    curve = [(u, y) for u in grid if (y := top.potential(u)) < frame.high[1]]
    names = {-1.0: "−1", top.lower: "u₁", UPPER: "u₂", 1.0: "1"}
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
    return beside(*(_path_of_axis(Top(claims, x)) for x in PRECESSIONS.values()), gap=3)


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


MOMENTS = (1.0, 2.0, 3.0)
"""The principal moments of inertia, of a plate: λ₃ = λ₁ + λ₂."""
START = (0.78, 0.42, 0.3)
"""The angular velocity in the body at first."""
ROLLED, DRAWN = 14.0, 75.0
"""For how long it is followed on the left, and on the right."""
LONGEST = 1.6
"""An axis of the ellipsoid that is longer is drawn as long, and all else smaller with it."""
SEEN = 75.0, 20.0
"""From where the left is seen, in degrees."""
BESIDE_IT = -1.3, 0.35
"""Where the angular momentum stands on the plane, clear of the ellipsoid."""


def _unit(v: Sequence[float]) -> Vector:
    length = math.sqrt(dot(v, v))
    return tuple(x / length for x in v)


def _momentum(zeta: Sequence[float], moments: Vector) -> Vector:
    return tuple(x * y for x, y in zip(moments, zeta, strict=True))


def rolling(
    claims: Claims, end: float, steps: int, moments: Vector = MOMENTS
) -> list[tuple[Vector, Vector]]:
    """The angular velocity in the body, and an axis of space there that is orthogonal to the
    angular momentum, over time: a row r of A, whose rate by Ȧ = A j(ζ) is r ∧ ζ."""
    spun = euler(claims, moments)

    def rate(x: Vector) -> Vector:
        return (*spun(x[:3]), *cross(x[3:], x[:3]))

    first = _unit(cross(_momentum(START, moments), (0.0, 0.0, 1.0)))
    return [(x[:3], x[3:]) for _, x in solved(rate, (*START, *first), end, steps)]


def in_space(
    zeta: Vector, row: Vector, moments: Vector = MOMENTS
) -> Callable[[Sequence[float]], Vector]:
    """Where a vector of the body is in axes of space: two horizontal ones, and the third against
    the angular momentum, so that the plane is below."""
    down = _unit(_momentum(zeta, moments))
    second = cross(row, down)
    return lambda v: (dot(v, row), dot(v, second), -dot(v, down))


def herpolhode(motion: Sequence[tuple[Vector, Vector]], moments: Vector) -> list[Point]:
    """The point of contact in its plane, over time."""
    return [(x, y) for x, y, _ in (in_space(*m, moments)(m[0]) for m in motion)]


def poinsot(claims: Claims, moments: Vector = MOMENTS) -> Scene:
    """The ellipsoid on its plane; the herpolhode beside."""
    return beside(_ellipsoid(claims, moments), _herpolhode_between_circles(claims, moments), gap=5)


def _ellipsoid(claims: Claims, moments: Vector) -> Scene:
    motion = rolling(claims, ROLLED, 900, moments)
    placed = in_space(*motion[0], moments)
    height = placed(START)[2]
    level = math.sqrt(dot(START, _momentum(START, moments)))
    axes = [level / math.sqrt(x) for x in moments]
    view = View((32.0, 31.0), 16.0 * min(1.0, LONGEST / max(axes)), *SEEN)

    def image(u: Sequence[float]) -> Vector:
        """A point of the sphere of radius 1 on the ellipsoid, in space."""
        return placed([a * x for a, x in zip(axes, u, strict=True)])

    seen = tuple(view.depth(image([float(i == k) for i in range(3)])) for k in range(3))
    # the normal at the image of u is that of u/a, so that it is in front where ⟨u, seen/a²⟩ > 0
    eye = tuple(x / a**2 for x, a in zip(seen, axes, strict=True))

    def front(u: Sequence[float]) -> bool:
        return dot(u, eye) > 0

    corners = [(x * 1.5, y * 1.5, height) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    plane = Stroke(tuple(view.at(x) for x in corners), "support", "wash")
    edge = Stroke((*plane.points, plane.points[0]), "support", "thin")
    path = [(*p, height) for p in herpolhode(motion, moments)]
    strokes = [plane, edge, Stroke(tuple(map(view.at, path)), AXES[2])]
    strokes.append(_outline(view, image, eye))
    for k in range(3):
        circles = [_combined(UNITS[k - 2], UNITS[k - 1], x) for x in TURN]
        strokes += view.on_surface(circles, image, front, "axis", "thin")
    polhode = [tuple(x / a for x, a in zip(m[0], axes, strict=True)) for m in motion]
    strokes += view.on_surface(polhode, image, front, "body")
    centre, contact = view.at((0.0, 0.0, 0.0)), view.at(placed(START))
    head, foot = (view.at((*BESIDE_IT, x)) for x in (height / 5, height))
    strokes.append(Stroke((centre, view.at((0.0, 0.0, height))), "axis", "hidden"))
    strokes += [*arrow(centre, contact, "axis"), *arrow(head, foot, "axis")]
    labels = [
        Label("ℓ", at=(head[0] + 2.2, (head[1] + foot[1]) / 2)),
        Label("Aζ", at=(contact[0] - 3.8, contact[1] - 4.0)),
        Label("O", at=(view.centre[0] - 2.6, view.centre[1] + 1.4)),
    ]
    return panel((66, 54), strokes, labels, [Dot(view.centre, 0.6, "body")])


def _combined(a: Vector, b: Vector, angle: float) -> Vector:
    """The unit vector at an angle from a towards b, which are orthogonal unit vectors."""
    return tuple(math.cos(angle) * x + math.sin(angle) * y for x, y in zip(a, b, strict=True))


def _outline(view: View, image: Callable[[Vector], Vector], eye: Vector) -> Stroke:
    """The outline of the ellipsoid: the image of the great circle orthogonal to ``eye``."""
    first = _unit(cross(eye, UNITS[2]))
    second = _unit(cross(eye, first))
    turned = (_combined(first, second, x) for x in TURN)
    return Stroke(tuple(view.at(image(u)) for u in turned), "body", "thin")


def _herpolhode_between_circles(claims: Claims, moments: Vector) -> Scene:
    """The herpolhode between the two circles that it touches."""
    path = herpolhode(rolling(claims, DRAWN, 4500, moments), moments)
    radii = [math.hypot(*p) for p in path]
    scale, centre = 20.0 / max(radii), (22.0, 22.0)
    strokes = [circle(centre, scale * r) for r in (min(radii), max(radii))]
    strokes.append(Frame(centre, (scale, scale)).curve(path[::3], AXES[2], "thin"))
    return panel((44, 44), strokes, (), [Dot(centre, 0.5, "axis")])
