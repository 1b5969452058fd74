"""Poinsot's motion, by Euler's equations that the text displays: the ellipsoid of inertia that
rolls on its plane, the polhode on it, and the herpolhode."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ..views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow
from ..views.figure.drawn_body import UNITS, cross, dot
from .sheets import AXES, TURN, Claims, Frame, Vector, View, beside, circle, euler, panel, solved

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
