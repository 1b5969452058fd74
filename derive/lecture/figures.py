"""The figures of the lecture, as scenes: no picture is drawn that is not computed here, and motions
are those of the equations that the text displays."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from ..views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow
from ..views.figure.drawn_body import UNITS, plus, scaled
from .group_figures import carried_curve, hammer_thrown, momenta_in_steps, momenta_on_orbits
from .motion_figures import ellipse, poinsot, tetrahedron, tilts, top_paths
from .sheets import AXES, TURN, Claims, Frame, Vector, View, beside, euler, numbered, panel, solved

LEVELS = (0.1, 0.3, 0.55, 0.8)
"""Where on the way from an axis to the separatrices the polhodes are."""


@dataclass(frozen=True)
class Spun:
    """A body that turns near its middle axis: its principal moments, of a plate if none are given,
    λ₃ = λ₁ + λ₂, its angular velocity at first, for how long it is followed and in how many steps,
    and the marks of the axes of its picture."""

    moments: Vector = (1.0, 2.0, 3.0)
    start: Vector = (0.002, 0.5, 0.0)
    end: float = 110.0
    steps: int = 1100
    largest: float = 0.55
    times: Mapping[float, str] = field(default_factory=lambda: numbered((0.0, 40.0, 80.0)))
    speeds: Mapping[float, str] = field(default_factory=lambda: numbered((0.5, 0.0, -0.5)))


RACKET = Spun()


def polhodes(claims: Claims, body: Spun = RACKET) -> Scene:
    """The polhodes on their sphere, and the flip of the racket, or of another body, beside."""
    return beside(_sphere(body), _flip(claims, body), gap=3)


def _sphere(body: Spun) -> Scene:
    """The curves in which the sphere ‖ℓ‖ = 1 meets ellipsoids Σ ℓ_i²/λ_i = 2h, seen from outside;
    those behind are pale."""
    view = View((27.0, 25.0), 20.0, 42, 24)
    strokes = [view.outline()]
    for role, curve in _curves(body):
        strokes += view.on_sphere(curve, role)
    axes, labels = view.named_axes()
    return panel((60, 57), [*strokes, *axes], labels)


def _curves(body: Spun = RACKET) -> Iterable[tuple[str, list[Vector]]]:
    """Polhodes about the ends of the first and third axis, and the separatrices."""
    a, b, c = (1 / x for x in body.moments)
    turn = [(math.sin(x), math.cos(x)) for x in TURN]
    for sign in (1.0, -1.0):
        for level in LEVELS:
            # a − 2h = (a − b) ℓ₂² + (a − c) ℓ₃², up to (a − b) at the separatrices
            second, third = math.sqrt(level), math.sqrt(level * (a - b) / (a - c))
            yield AXES[0], [_on_sphere(0, sign, second * s, third * k) for s, k in turn]
            # 2h − c = (a − c) ℓ₁² + (b − c) ℓ₂², up to (b − c)
            first, second = math.sqrt(level * (b - c) / (a - c)), math.sqrt(level)
            yield AXES[2], [_on_sphere(2, sign, first * s, second * k) for s, k in turn]
        # 2h = b: two great circles, (a − b) ℓ₁² = (b − c) ℓ₃²
        tilt = math.atan2(math.sqrt(b - c), sign * math.sqrt(a - b))
        yield AXES[1], [(k * math.sin(tilt), s, k * math.cos(tilt)) for s, k in turn]


def _on_sphere(axis: int, sign: float, x: float, y: float) -> Vector:
    """The point of the sphere with two coordinates, those after ``axis`` in the order 1, 2, 3."""
    rest = sign * math.sqrt(1 - x * x - y * y)
    return (rest, x, y) if axis == 0 else (x, y, rest)


def racket(claims: Claims, body: Spun = RACKET) -> list[tuple[float, Vector]]:
    """The angular velocity in the body by Euler's equations, near the middle axis, over time."""
    return solved(euler(claims, body.moments), body.start, body.end, body.steps, each=4)


def _flip(claims: Claims, body: Spun) -> Scene:
    """The three components of the angular velocity over time."""
    frame = Frame((9.0, 6.0), (46.0, 36.0), (0.0, -body.largest), (body.end, body.largest))
    strokes, labels = frame.axes((Label("t"), Label("ζ", "i")), body.times, body.speeds, 0)
    motion = racket(claims, body)
    for k in range(3):
        strokes.append(frame.curve(((t, zeta[k]) for t, zeta in motion), AXES[k]))
    return panel((63, 49), strokes, labels)


# The whole theory in one picture: a racket, and what the group makes of it.

HEAD = [(1.15 + 0.75 * math.cos(x), 0.55 * math.sin(x), 0.0) for x in TURN]
HANDLE = [(-0.15, 0.07, 0.0), (-1.25, 0.07, 0.0), (-1.25, -0.07, 0.0), (-0.15, -0.07, 0.0)]
THROAT = [[(-0.15, s * 0.07, 0.0), (0.62, s * 0.39, 0.0)] for s in (1.0, -1.0)]
POINT = HEAD[20]
"""One of the points of the body."""


def _strings() -> Iterable[list[Vector]]:
    """The strings of the head, along and across it."""
    for k in range(-3, 4):
        y, x = 0.16 * k, 0.2 * k
        along, across = (math.sqrt(1 - r * r) for r in (y / 0.55, x / 0.75))
        yield [(1.15 + s * 0.75 * along, y, 0.0) for s in (1.0, -1.0)]
        yield [(1.15 + x, s * 0.55 * across, 0.0) for s in (1.0, -1.0)]


def _turned(axis: int, angle: float) -> Callable[[Sequence[float]], Vector]:
    """The rotation about a coordinate axis by an angle in degrees."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    i, j = (axis + 1) % 3, (axis + 2) % 3

    def turned(v: Sequence[float]) -> Vector:
        found = [*v]
        found[i], found[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
        return tuple(found)

    return turned


def displacement(v: Sequence[float]) -> Vector:
    """The rotation A of the picture."""
    return _turned(2, 20)(_turned(1, -42)(_turned(0, -50)(v)))


def _racket_at(centre: Point, move: Callable[[Sequence[float]], Vector], letter: str) -> Scene:
    """The racket, moved, with its axes, whose names follow ``letter``."""
    view = View(centre, 15.5, -55, 24)

    def stroke(points: Iterable[Vector], role: str, pen: str = "line") -> Stroke:
        return Stroke(tuple(view.at(move(x)) for x in points), role, pen)

    strokes = [stroke(HEAD, "body", "wash"), *(stroke(x, "body", "thin") for x in _strings())]
    strokes += (stroke(x, "body") for x in (HEAD, *THROAT))
    strokes += (stroke(HANDLE, "body", "wash"), stroke((*HANDLE, HANDLE[0]), "body"))
    labels = []
    for k, length in enumerate((2.3, 1.0, 1.0)):
        tip, far = (view.at(move(scaled(length + more, UNITS[k]))) for more in (0, 0.22))
        strokes += arrow(centre, tip, AXES[k])
        labels.append(Label(f"{letter}e", str(k + 1), at=far))
    outside = plus(scaled(1.12, POINT), UNITS[1], 0.24)
    labels.append(Label(f"{letter}r", "i", at=view.at(move(outside))))
    labels.append(Label("O", at=(centre[0] + 0.5, centre[1] - 3.2)))
    dots = [Dot(centre, 0.6, "body"), Dot(view.at(move(POINT)), 0.75, "body")]
    return panel((62, 46), strokes, labels, dots)


def theory(_: Claims) -> Scene:
    """The reference body, and the body at a time; the rotation that carries one to the other."""
    both = beside(
        _racket_at((22.0, 18.0), lambda v: (*v,), ""),
        _racket_at((26.0, 14.0), displacement, "A"),
        gap=0,
    )
    strokes, label = bow((52.0, 38.0), 24)
    return panel(
        (both.width, both.height + 2), (*both.strokes, *strokes), (*both.labels, label), both.dots
    )


def bow(start: Point, width: int) -> tuple[list[Stroke], Label]:
    """The arrow of A from the reference body to the body at a time, with its letter."""
    x, y = start
    points = [(x + k, y + width * math.sin(math.pi * k / width) / 6) for k in range(width - 2)]
    strokes = [Stroke(tuple(points), "axis"), *arrow(points[-1], (x + width, y - 0.4), "axis")]
    return strokes, Label("A", at=(x + width / 2, y + width / 6 + 2.5))


Figure = Callable[[Claims], Scene]
FIGURES: dict[str, Figure] = {
    "theory": theory,
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
"""The figures by the labels of their blocks."""
