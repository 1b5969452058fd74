"""The figures of the lecture, as scenes: no picture is drawn that is not computed here."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

from ..views.figure.drawing import Label, Point, Scene, Stroke, arrow

RADIUS = 24.0
"""Of the sphere, in millimetres."""
MARGIN, LABEL = 16.0, 1.5
AZIMUTH, ELEVATION = math.radians(42), math.radians(24)
MOMENTS = (1.0, 2.0, 2.6)
"""The principal moments of inertia of the body whose polhodes are drawn."""
LEVELS = (0.1, 0.3, 0.55, 0.8)
"""Where on the way from an axis to the separatrices its polhodes are."""
STEPS = 180
Vector = tuple[float, float, float]


def polhodes() -> Scene:
    """The curves in which the sphere ‖ℓ‖ = 1 meets ellipsoids Σ ℓ_i²/λ_i = 2h, seen from outside;
    those behind are pale."""
    centre = RADIUS + MARGIN
    strokes = [Stroke((*_circle(centre),), "support", "thin")]
    for role, curve in _curves():
        for run, front in _runs(curve):
            points = tuple(_seen(x, centre) for x in run)
            strokes.append(Stroke(points, role, "line" if front else "hidden"))
    labels = []
    for k in range(3):
        axis = tuple(float(k == i) for i in range(3))
        tip = tuple(LABEL * x for x in axis)
        strokes += arrow(_seen(axis, centre), _seen(tip, centre), AXES[k])
        far = tuple((LABEL + 0.14) * x for x in axis)
        labels.append(Label("e", str(k + 1), at=_seen(far, centre)))
    size = 2 * centre
    return Scene(size, size, tuple(strokes), (), tuple(labels), "", ())


AXES = ("first", "second", "third")
"""The role of what belongs to each axis."""


def _curves() -> Iterable[tuple[str, list[Vector]]]:
    """Polhodes about the ends of the first and third axis, and the separatrices."""
    a, b, c = (1 / x for x in MOMENTS)
    for sign in (1.0, -1.0):
        for level in LEVELS:
            # a − 2h = (a − b) ℓ₂² + (a − c) ℓ₃², up to (a − b) at the separatrices
            second, third = math.sqrt(level), math.sqrt(level * (a - b) / (a - c))
            yield AXES[0], [_on_sphere(0, sign, second * s, third * k) for s, k in _turn()]
            # 2h − c = (a − c) ℓ₁² + (b − c) ℓ₂², up to (b − c)
            first, second = math.sqrt(level * (b - c) / (a - c)), math.sqrt(level)
            yield AXES[2], [_on_sphere(2, sign, first * s, second * k) for s, k in _turn()]
        # 2h = b: two great circles, (a − b) ℓ₁² = (b − c) ℓ₃²
        tilt = math.atan2(math.sqrt(b - c), sign * math.sqrt(a - b))
        yield AXES[1], [(k * math.sin(tilt), s, k * math.cos(tilt)) for s, k in _turn()]


def _turn() -> Iterable[Point]:
    angles = (2 * math.pi * k / STEPS for k in range(STEPS + 1))
    return [(math.sin(x), math.cos(x)) for x in angles]


def _on_sphere(axis: int, sign: float, x: float, y: float) -> Vector:
    """The point of the sphere with two coordinates, those after ``axis`` in the order 1, 2, 3."""
    rest = sign * math.sqrt(1 - x * x - y * y)
    return (rest, x, y) if axis == 0 else (x, y, rest)


def _depth(v: Sequence[float]) -> float:
    """How near to the eye a point is."""
    across = math.cos(AZIMUTH) * v[0] + math.sin(AZIMUTH) * v[1]
    return math.cos(ELEVATION) * across + math.sin(ELEVATION) * v[2]


def _seen(v: Sequence[float], centre: float) -> Point:
    """Where a point is on the sheet."""
    along = -math.sin(AZIMUTH) * v[0] + math.cos(AZIMUTH) * v[1]
    across = math.cos(AZIMUTH) * v[0] + math.sin(AZIMUTH) * v[1]
    up = math.cos(ELEVATION) * v[2] - math.sin(ELEVATION) * across
    return centre + RADIUS * along, centre + RADIUS * up


def _circle(centre: float) -> Iterable[Point]:
    return [(centre + RADIUS * s, centre + RADIUS * k) for s, k in _turn()]


def _runs(curve: Sequence[Vector]) -> Iterable[tuple[list[Vector], bool]]:
    """A curve cut where it passes behind the sphere; each run goes to where the next begins."""
    run = [curve[0]]
    for x, y in pairwise(curve):
        run.append(y)
        if (_depth(x) > 0) != (_depth(y) > 0):
            yield run, _depth(x) > 0
            run = [y]
    yield run, _depth(curve[-1]) > 0


FIGURES = {"polhodes": polhodes}
"""The figures by the labels of their blocks."""
