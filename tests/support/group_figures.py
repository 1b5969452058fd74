"""Figures of motions on other groups, and of steps, by the equations that the text displays.

Coadjoint orbits of three groups with the motions of the momentum on them; a hammer in flight, whose
centre of mass nobody put on its parabola; a closed curve that a fluid carries; steps of Moser and
Veselov beside those of a usual recipe.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from derive.language.tree import Tree
from derive.lecture.lecture_text import tree
from derive.lecture.sheets import (
    AXES,
    TURN,
    Claims,
    Frame,
    Vector,
    View,
    beside,
    euler,
    numbered,
    panel,
    solved,
)  # fmt: skip
from derive.views.figure.drawing import Dot, Label, Point, Scene, Stroke, arrow
from derive.views.figure.drawn_body import UNITS, scaled
from tests.support.picture_values import hat, nearest, value

# The momentum of a Lagrangian that is half a quadratic form of the velocity, on three groups.


@dataclass(frozen=True)
class Orbit:
    """A coadjoint orbit of a group: its ``name``, a ``basis`` of the Lie algebra, the ``metric`` of
    the Lagrangian on each of its elements, the ``radius`` and the third coordinate (``rise``) of
    its circles by a height, and its motions by their role and the angle and height where they
    start. On it x₁² + x₂² + ``bent`` x₃² is constant; its picture ends at the height ``end``, and 1
    is ``scale`` millimetres."""

    name: str
    basis: Sequence[Any]
    metric: Vector
    radius: Callable[[float], float]
    rise: Callable[[float], float]
    starts: Sequence[tuple[str, float, float]]
    bent: int
    end: float
    scale: float

    def surface(self, angle: float, height: float) -> Vector:
        """A point of the orbit."""
        r = self.radius(height)
        return r * math.cos(angle), r * math.sin(angle), self.rise(height)


def _matrices(*texts: str) -> list[Any]:
    """Square matrices, each from its numbers in the order of its rows."""
    numbers = ([float(x) for x in text.split()] for text in texts)
    return [np.reshape(x, (math.isqrt(len(x)), -1)) for x in numbers]


RIGHT = math.pi / 2
ROUND = [(AXES[0], 0.0, s * x) for s in (1, -1) for x in (0.3, 0.8)]
BACK = [(AXES[2], s * RIGHT, x) for s in (1, -1) for x in (0.25, 0.5)]
SPLIT = [(AXES[1], x, s * 0.004) for s in (1, -1) for x in (0.0, math.pi)]
"""Where motions start: where the energy is large, where it is small, and on the separatrices."""
ORBITS = (
    Orbit(
        "SO(3)",
        [hat(e) for e in np.eye(3)],
        (1.0, 2.0, 3.0),
        math.cos,
        math.sin,
        [
            *((AXES[0], s, x) for s in (0.0, math.pi) for x in (0.3, 0.6)),
            *((AXES[2], 0.0, s * x) for s in (1, -1) for x in (1.0, 1.3)),
            *((AXES[1], s * RIGHT, x * 0.004) for s in (1, -1) for x in (1, -1)),
        ],
        1,
        RIGHT,
        15.0,
    ),
    Orbit(
        "SE(2)",
        _matrices("0 0 1 0 0 0 0 0 0", "0 0 0 0 0 1 0 0 0", "0 -1 0 1 0 0 0 0 0"),
        (1.0, 2.2, 1.0),
        lambda _: 1.0,
        lambda height: height,
        [*ROUND, *BACK, *SPLIT],
        0,
        1.4,
        11.0,
    ),
    Orbit(
        "SL(2)",
        _matrices("1 0 0 -1", "0 1 1 0", "0 -1 1 0"),
        (1.0, 2.2, 1.0),
        math.cosh,
        math.sinh,
        [*ROUND, *BACK, *SPLIT],
        -1,
        1.1,
        10.0,
    ),
)
"""Of SO(3), of SE(2) by the impulses and the moment, and of SL(2) by the strains and the turn."""


LONG = 50.0
"""For how long a motion is followed at most."""


def on_orbit(claims: Claims, orbit: Orbit) -> Callable[[Vector], Vector]:
    """The rate of the momentum, by its components, as theorem @coadjoint gives it on each element
    of the basis, without a force."""
    rows = np.array([e.ravel() for e in orbit.basis])
    dual = np.linalg.solve(rows @ rows.T, rows).reshape(np.shape(orbit.basis))
    (equation,) = claims["left.coadjoint"]
    known: dict[Tree, Any] = {"Φ": np.zeros_like(dual[0])}

    def entry(momentum: Any, velocity: Any, element: Any) -> float:
        return float(value(equation.rhs, known | {"Π": momentum, "Z": velocity, "ξ′": element}))

    # it is linear in the momentum and in the velocity: its values on both bases tell it
    table = np.array([[[entry(p, z, e) for z in orbit.basis] for p in dual] for e in orbit.basis])

    def rate(x: Vector) -> Vector:
        momentum = np.array(x)
        return (*(table @ (momentum / orbit.metric) @ momentum),)

    return rate


def path_on_orbit(claims: Claims, orbit: Orbit, angle: float, height: float) -> list[Vector]:
    """A motion on an orbit, until it comes back to its start, or for as long as it takes from one
    end of a separatrix to the other."""
    start = orbit.surface(angle, height)
    rate, found = on_orbit(claims, orbit), [start, start]
    for part in (5, 1):  # most are short
        found = _closed([x for _, x in solved(rate, start, LONG / part, 1000 // part)])
        if found[0] == found[-1]:
            break
    return found


def _closed(path: list[Vector]) -> list[Vector]:
    """A path until it is back at its start, where it gets there."""
    far = [math.dist(x, path[0]) for x in path]
    for k in range(2, len(path)):
        if far[k] <= 1.2 * far[1] and far[k - 1] > far[k]:
            return [*path[:k], path[0]]
    return path


def momenta_on_orbits(claims: Claims) -> Scene:
    """The orbits beside one another, each with the names of its axes."""
    return beside(*(_orbit(claims, x) for x in ORBITS), gap=1)


def _orbit(claims: Claims, orbit: Orbit) -> Scene:
    view = View((19.5, 25.0), orbit.scale, 38.0, 25.0)

    def ahead(x: Vector) -> bool:
        """Is the outside turned to the eye? By the gradient of what is constant on the orbit."""
        return view.depth((x[0], x[1], orbit.bent * x[2])) > 0

    def drawn(curve: Sequence[Vector], role: str, pen: str = "line") -> list[Stroke]:
        return view.on_surface(curve, lambda x: x, ahead, role, pen)

    strokes = _outline(view, orbit)
    for role, angle, height in orbit.starts:
        strokes += drawn(path_on_orbit(claims, orbit, angle, height), role)
    labels = []
    reach = (1.0, 1.0, orbit.rise(orbit.end))
    for k in range(3):
        out = 8.0 if orbit.bent < 0 and k == 0 else 0.0  # beyond the rim, which is wider
        ends = (
            scaled(reach[k] + by / orbit.scale, UNITS[k]) for by in (0.0, 8 + out, 11.5 + 1.2 * out)
        )
        at, tip, far = map(view.at, ends)
        strokes += arrow(at, tip, "axis")
        labels.append(Label("Π", str(k + 1), at=far))
    labels.append(Label(orbit.name, name=True, at=(19.5, 2.0)))
    return panel((40, 53), strokes, labels)


def _outline(view: View, orbit: Orbit) -> list[Stroke]:
    """The outline of a sphere; of an orbit without end, where it turns away from the eye, between
    the circles at which its picture ends."""
    if orbit.bent > 0:
        return [view.outline()]
    found = []
    e, a = (math.radians(x) for x in (view.elevation, view.azimuth))
    for side in (1, -1):
        line = []
        for k in range(41):
            height = orbit.end * (k / 20 - 1)
            slope = -orbit.bent * orbit.rise(height) / orbit.radius(height)
            turned = math.acos(slope * math.tan(e))
            line.append(view.at(orbit.surface(a + side * turned, height)))
        found.append(Stroke(tuple(line), "support", "thin"))
    for height in (orbit.end, -orbit.end):
        circle = tuple(view.at(orbit.surface(x, height)) for x in TURN)
        found.append(Stroke(circle, "support", "thin"))
    return found


# A hammer in flight: the origin of the body is the end of its handle.

HANDLE, HEAD = (0.3, 0.1), ((0.025, 0.1, 0.025), 0.5)
"""Length and mass of the handle, a rod; sides and mass of the head, a box behind it."""
GRAVITY = np.array([0.0, -9.81, 0.0])
THROWN, TURNING, FLIGHT = (1.5, 3.3, 0.0), (0.0, 0.0, -10.0), 0.66
"""The velocity of the centre of mass at first, the angular velocity, and for how long it flies."""
SEEN = 7
"""How many pictures of it are drawn."""
BAR = 0.2
"""A length that is drawn beside it, in metres."""
BOX = ((0, -1), (1, -1), (1, 1), (0, 1), (0, -1))


def hammer() -> tuple[float, Any, Any]:
    """The mass of the hammer, its moment of order one and its tensor of inertia, about its origin:
    its handle is along the first axis, its head along the second."""
    (length, rod), (sides, block) = HANDLE, HEAD
    place = np.array([length + sides[0] / 2, 0.0, 0.0])
    J = np.diag([rod * length**2 / 3, 0, 0]) + block * np.diag(np.square(sides)) / 12
    J += block * np.outer(place, place)
    c = rod * np.array([length / 2, 0, 0]) + block * place
    return rod + block, c, np.trace(J) * np.eye(3) - J


def flight(claims: Claims, end: float, steps: int) -> list[tuple[float, Any, Any]]:
    """Time, A and T of the hammer, by Kirchhoff's equations, with its weight at its centre of
    mass: the velocities come from the momenta by those equations of the text that define them."""
    m, c, inertia = hammer()
    rates = [e.rhs for e in claims["se3.coadjoint"]]
    defined = [e.rhs for e in claims["se3.momenta"]]
    body = {tree("m"): m, tree("c"): c, tree("I"): inertia}

    def momenta(v: Any) -> Any:
        known = body | {tree("ζ"): v[:3], tree("w"): v[3:]}
        return np.concatenate([value(x, known) for x in defined])

    by_velocity = np.array([momenta(e) for e in np.eye(6)]).T

    def rate(x: Vector) -> Vector:
        A, P = np.reshape(x[:9], (3, 3)), np.array(x[12:])
        v = np.linalg.solve(by_velocity, P)
        weight = m * A.T @ GRAVITY
        known = {tree("ℓ_b"): P[:3], tree("p_b"): P[3:], tree("ζ"): v[:3], tree("w"): v[3:]}
        known |= {tree("F_b"): weight, tree("μ"): np.cross(c / m, weight)}
        moved = (A @ hat(v[:3]), A @ v[3:], *(value(x, known) for x in rates))
        return tuple(map(float, np.concatenate([y.ravel() for y in moved])))

    w = np.array(THROWN) - np.cross(TURNING, c / m)
    start = (*np.eye(3).ravel(), 0.0, 0.0, 0.0, *momenta(np.array([*TURNING, *w])))
    found = solved(rate, tuple(map(float, start)), end, steps)
    return [(t, np.reshape(x[:9], (3, 3)), np.array(x[9:12])) for t, x in found]


def hammer_thrown(claims: Claims) -> Scene:
    """The hammer at equal distances of time, the way of its centre of mass and that of the end of
    its handle."""
    m, c, _ = hammer()
    run, scale = flight(claims, FLIGHT, 240), 76.0
    (length, _), (sides, _) = HANDLE, HEAD

    def at(A: Any, T: Any, r: Any) -> Point:
        x = A @ r + T
        return 6.0 + scale * float(x[0]), 8.0 + scale * float(x[1])

    strokes, dots, labels = [], [], []
    for k in range(SEEN):
        _, A, T = run[k * (len(run) - 1) // (SEEN - 1)]
        corners = [(length + i * sides[0], j * sides[1] / 2, 0) for i, j in BOX]
        box = tuple(at(A, T, np.array(x)) for x in corners)
        rod = tuple(at(A, T, np.array([x, 0, 0])) for x in (0, length))
        strokes += [Stroke(box, "body", "wash"), Stroke(box, "body"), Stroke(rod, "body", "thick")]
        dots.append(Dot(at(A, T, c / m), 0.8, AXES[2]))
        if k == 0:
            labels.append(Label("O", at=at(A, T, np.array([-0.04, 0.0, 0.0]))))
    ways = ((c / m, AXES[2]), (np.zeros(3), AXES[0]))
    strokes += [Stroke(tuple(at(A, T, r) for _, A, T in run), role) for r, role in ways]
    bar = ((4.0, 48.0), (4.0 + BAR * scale, 48.0))
    strokes += [Stroke(bar, "axis"), *(Stroke(((x, y - 1), (x, y + 1)), "axis") for x, y in bar)]
    labels.append(Label(f"{BAR:g}", at=(4.0 + BAR * scale / 2, 51.0)))
    return panel((116, 64), strokes, labels, dots)


# A plane flow that does not depend on time, in a square vessel, and a closed curve that it carries.

MODES = ((1, 2, 1.0), (2, 1, 0.6))
"""Its stream function: a sum of sin(kx) sin(ly), k² + l² the same for all, with their factors."""
CIRCLE = (1.45, 1.45, 0.6)
"""The curve at first: its centre and its radius."""
MARKS, POINTS = (0.0, 0.8, 1.6), 240
"""When the curve is drawn; of how many points it is made."""


def velocity(x: Any, y: Any) -> tuple[Any, Any]:
    """The velocity of the flow at places: the derivatives of its stream function, turned."""
    u = sum(f * q * np.sin(k * x) * np.cos(q * y) for k, q, f in MODES)
    v = sum(-f * k * np.cos(k * x) * np.sin(q * y) for k, q, f in MODES)
    return u, v


def carried(end: float, steps: int) -> list[tuple[float, Any, Any]]:
    """The points of the curve over time: each has the velocity of the place where it is."""
    turn = 2 * math.pi * np.arange(POINTS) / POINTS

    def rate(z: Vector) -> Vector:
        return (*np.concatenate(velocity(*np.reshape(z, (2, POINTS)))),)

    start = (*(CIRCLE[0] + CIRCLE[2] * np.cos(turn)), *(CIRCLE[1] + CIRCLE[2] * np.sin(turn)))
    return [(t, *np.reshape(z, (2, POINTS))) for t, z in solved(rate, start, end, steps)]


STARTS = ((0.45, 0.4), (0.9, 0.7), (1.6, 0.6), (2.2, 2.7), (2.0, 2.3), (1.5, 2.5))


def _lines() -> Iterator[list[Vector]]:
    """Lines of the flow, by the motions of points."""
    for start in STARTS:
        yield _closed([z for _, z in solved(lambda z: velocity(*z), start, 12.0, 600)])


def along(x: Any, y: Any) -> tuple[float, float]:
    """The length of a closed curve, and the circulation of the flow along it: the scalar product of
    the velocity and the derivative of the curve, which its Fourier series gives, is summed."""
    order = np.fft.fftfreq(POINTS, 1 / POINTS) * 2j * math.pi
    dx, dy = (np.fft.ifft(order * np.fft.fft(c)).real for c in (x, y))
    u, v = velocity(x, y)
    return float(np.hypot(dx, dy).mean()), float((u * dx + v * dy).mean())


def carried_curve(_: Claims) -> Scene:
    """The curve at its times with lines of the flow, and its length and circulation beside."""
    run = carried(MARKS[-1], 160)
    shown = [_vessel(*x) for x in nearest(run, MARKS)]
    return beside(beside(*shown, gap=1), _along(run), gap=3)


def _vessel(t: float, x: Any, y: Any) -> Scene:
    frame = Frame((0.5, 6.0), (25.0, 25.0), high=(math.pi, math.pi))
    walls = [(a * math.pi, b * math.pi) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))]
    points = [*zip((*x, x[0]), (*y, y[0]), strict=True)]
    strokes = [frame.curve(walls, "support"), *(frame.curve(z, "axis", "thin") for z in _lines())]
    strokes += [frame.curve(points, AXES[2], pen) for pen in ("wash", "line")]
    return panel((26, 32), strokes, [Label(f"t = {t:g}", at=(13.0, 2.0))])


def _along(run: Sequence[tuple[float, Any, Any]]) -> Scene:
    told = [(t, *along(x, y)) for t, x, y in run]
    first = told[0]
    high = MARKS[-1], max(x[1] for x in told) / first[1]
    frame = Frame((7.0, 6.0), (24.0, 22.0), high=high)
    names = (Label("t"), Label("l/l₀, k/k₀"))
    strokes, labels = frame.axes(names, numbered(MARKS), numbered(range(4)))
    for k, role in ((1, AXES[0]), (2, AXES[2])):
        strokes.append(frame.curve([(x[0], x[k] / first[k]) for x in told], role))
    return panel((38, 37), strokes, labels)


# The solid in steps.

STEP, STEPPED, DOTS = 0.6, 100, 40
"""The length of a step, the number of steps on the right, and that on the sphere."""
STARTED = ((0.0, 0.35), (0.0, 1.25), (math.pi / 2, 0.08))
"""Where motions start on the sphere of the momentum."""
EXACT = 1e-13
INERTIA = (1.0, 2.0, 3.0)


def in_steps(claims: Claims, start: Vector, h: float, number: int) -> list[Vector]:
    """The momentum after each step of Moser and Veselov. The quaternion of a step is found from its
    momentum by the derivative at rest, 2h⁻¹I, as the text says."""
    rest, inertia = np.eye(3), np.diag(INERTIA)
    of_step, (turned,) = claims["steps.quaternion"][0].rhs, claims["steps.motion"]
    M, found = hat(np.array(start)), [start]
    for _ in range(number):
        x, q = np.zeros(3), 1.0
        missing = axial(M)
        while np.abs(missing).max() > EXACT:
            x = x + np.linalg.solve(2 / h * inertia, missing)
            q = math.sqrt(1 - x @ x)
            known = {tree("h"): h, tree("I"): inertia, tree("x₁"): x, tree("q₁"): q}
            missing = axial(M - value(of_step, known))
        W = (q * q - x @ x) * rest + 2 * np.outer(x, x) + 2 * q * hat(x)
        M = value(turned.rhs, {tree("W₀"): W, tree("M₀"): M})
        found.append((*map(float, axial(M)),))
    return found


def axial(M: Any) -> Any:
    """The vector of a skew matrix."""
    return np.array([M[2, 1], M[0, 2], M[1, 0]])


def momenta_in_steps(claims: Claims) -> Scene:
    """The steps on the sphere; beside, the length of the momentum by them and by the method of
    Runge and Kutta."""
    return beside(_stepped(claims), _lengths(claims), gap=3)


def _stepped(claims: Claims) -> Scene:
    view = View((25.0, 22.0), 17.0, 38.0, 25.0)
    strokes, dots = [view.outline()], []
    for role, start in zip((AXES[0], AXES[2], AXES[1]), STARTED, strict=True):
        strokes += view.on_sphere(path_on_orbit(claims, ORBITS[0], *start), role, "thin")
        stepped = in_steps(claims, ORBITS[0].surface(*start), STEP, DOTS)
        sized = zip(stepped, (1.0, *[0.55] * DOTS), strict=True)
        dots += [Dot(view.at(x), size, role) for x, size in sized if view.depth(x) > 0]
    axes, labels = view.named_axes()
    return panel((50, 51), [*strokes, *axes], labels, dots)


def _lengths(claims: Claims) -> Scene:
    first, end = ORBITS[0].surface(*STARTED[2]), STEP * STEPPED
    kept = [math.hypot(*x) for x in in_steps(claims, first, STEP, STEPPED)]
    spun = euler(claims, INERTIA)
    zeta, usual = tuple(x / m for x, m in zip(first, INERTIA, strict=True)), [1.0]
    for _ in range(STEPPED):
        zeta = tuple(x + STEP * y for x, y in zip(zeta, spun(zeta), strict=True))
        usual.append(math.hypot(*(x * m for x, m in zip(zeta, INERTIA, strict=True))))
    frame = Frame((9.0, 6.0), (54.0, 32.0), high=(end, 1.05 * max(usual)))
    times, ticks = (numbered(x) for x in (range(0, int(end) + 1, 20), range(int(max(usual)) + 1)))
    strokes, labels = frame.axes((Label("t"), Label("‖ℓ_b‖")), times, ticks)
    for name, lengths, role in (("Euler", usual, AXES[2]), ("Moser–Veselov", kept, AXES[1])):
        strokes.append(frame.curve([(k * STEP, x) for k, x in enumerate(lengths)], role))
        x, y = frame.at(0.3 * end, lengths[3 * STEPPED // 10])
        labels.append(Label(name, name=True, at=(x, y + (4 if lengths is usual else -4))))
    return panel((74, 46), strokes, labels)
