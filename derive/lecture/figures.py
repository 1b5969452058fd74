"""The figures of the lecture, as scenes: those of the course as they were computed and rounded, and
the polhodes and the flip of a body, by the equations that the text displays."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from ..views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow
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


# The whole theory in one picture: a body, and what the group makes of it.


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


def bow(start: Point, width: int) -> tuple[list[Stroke], Label]:
    """The arrow of A from the reference body to the body at a time, with its letter."""
    x, y = start
    points = [(x + k, y + width * math.sin(math.pi * k / width) / 6) for k in range(width - 2)]
    strokes = [Stroke(tuple(points), "axis"), *arrow(points[-1], (x + width, y - 0.4), "axis")]
    return strokes, Label("A", at=(x + width / 2, y + width / 6 + 2.5))


Figure = Callable[[Claims], Scene]
PICTURES = Path(__file__).with_name("pictures")


def recorded(file: Path) -> Scene:
    """A figure of the course, as ``tests.support.lecture_figures`` draws it by the equations that
    the text displays and rounds it, in hundredths of a millimetre: the same on every machine."""
    told = json.loads(file.read_text(encoding="utf-8"))

    def at(x: int, y: int) -> Point:
        return x / 100, y / 100

    strokes = (Stroke(tuple(map(at, x[::2], x[1::2])), *of) for *of, x in told["strokes"])
    dots = (Dot(at(x, y), radius / 100, role) for role, radius, x, y in told["dots"])
    labels = (replace(Label(*of), at=at(x, y)) for *of, x, y in told["labels"])
    return panel(at(*told["size"]), strokes, labels, dots)


FIGURES: dict[str, Figure] = {
    x.stem: partial(lambda file, _: recorded(file), x) for x in sorted(PICTURES.glob("*.json"))
}
"""The figures of the course by the labels of their blocks."""
