"""What keeps its volume, by the equations that the text displays: four points at three times, with
the multiplier over time, and an ellipse of fluid with its pressure."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from itertools import combinations
from typing import Any

import numpy as np

from ..language.tree import Tree
from ..views.figure.drawing import Dot, Label, Scene, Stroke
from .sheets import AXES, TURN, Claims, Frame, Vector, View, beside, panel, solved

PLACES = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / 2
MASSES, SPRING = (1.0, 1.0, 1.0, 2.0), 1.5
"""Of the points; the stiffness of the springs between each two of them, of length 0."""
VELOCITY = np.array([[0.9, 0.5, 0.0], [-0.2, -0.5, 0.6], [0.3, 0.0, -0.4]])
"""Z at first, of trace 0; A is 1."""
END, STEPS = 6.0, 1200
TIMES = (0.0, 1.0, 2.0)
"""When the tetrahedron is drawn."""


def value(t: Tree, of: Mapping[Tree, Any]) -> Any:
    """The value of an expression of numbers and square matrices, by those ``of`` its letters."""
    if not isinstance(t, tuple):
        return of[t] if t in of else float(t)
    if t[0] == "pow":
        return np.linalg.matrix_power(value(t[1], of), t[2])
    parts = [value(x, of) for x in t[1:]]
    match t[0]:
        case "add":
            return sum(parts)
        case "mul":
            return reduce(np.dot, parts)
        case "div":
            return parts[0] / parts[1]
        case "inv":
            return np.linalg.inv(parts[0])
        case "T":
            return parts[0].T
        case "tr":
            return np.trace(parts[0])
    raise ValueError(f"no value for the operator {t[0]!r}")


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
    run = motion(claims, moments(), VELOCITY, END)
    shown = [min(run, key=lambda x: abs(x[0] - t)) for t in TIMES]
    places = [_placed(A, t) for t, A, _ in shown]
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
    dots = [
        Dot(view.at(r), 0.55 * m ** (1 / 3), "body") for m, r in zip(MASSES, moved, strict=True)
    ]
    return panel((25, 36), strokes, [Label(f"t = {t:g}", at=(12.5, 2.0))], dots)


def _faces(eye: Any, corners: Any, k: int) -> bool:
    """Is the face of a tetrahedron that is opposite to a corner turned to the eye?"""
    a, b, c = (corners[i] for i in range(4) if i != k)
    normal = np.cross(b - a, c - a)
    return bool(normal @ eye * (normal @ (corners[k] - a)) < 0)


def _multiplier(curve: list[tuple[float, float]]) -> Scene:
    (end, _), (low, high) = curve[-1], ([f(y for _, y in curve) for f in (min, max)])
    frame = Frame((7.0, 6.0), (32.0, 22.0), (0.0, min(low, 0.0)), (end, high))
    times = {float(t): f"{t}" for t in range(0, int(end) + 1, 2)}
    strokes, labels = frame.axes((Label("t"), Label("θ")), times, {0.0: "0"})
    strokes.append(frame.curve([(0, 0), (end, 0)], "axis", "thin"))
    strokes.append(frame.curve(curve, AXES[0]))
    return panel((46, 36), strokes, labels)


# An ellipse of a homogeneous fluid, in the plane: J is a multiple of 1, here 1, and nothing acts.

STRAIN = np.array([[0.55, 0.2], [-0.25, -0.55]])
"""Its Z at first, a circle's."""
SPREAD, LEVELS = 4.0, (0.0, 0.25, 0.5, 0.75)
"""For how long it is followed; the levels of the pressure, as parts of that in the middle."""


def ellipse(claims: Claims) -> Scene:
    """The ellipse at three times, with lines of equal pressure, and θ beside."""
    run = motion(claims, {"J": np.eye(2), "K": np.zeros((2, 2))}, STRAIN, SPREAD)
    shown = [min(run, key=lambda x: abs(x[0] - t)) for t in TIMES]
    places = [_fluid(A, t) for t, A, _ in shown]
    return beside(beside(*places, gap=0), _multiplier([(t, y) for t, _, y in run]), gap=3)


def _fluid(A: Any, t: float) -> Scene:
    """Images of the circles ‖r‖² = 1 − p/p₀."""
    centre, scale = (13.0, 16.0), 5.0
    strokes = []
    for level in LEVELS:
        r = (1 - level) ** 0.5
        moved = (A @ (r * np.cos(x), r * np.sin(x)) for x in TURN)
        points = tuple((centre[0] + scale * x, centre[1] + scale * y) for x, y in moved)
        strokes += [Stroke(points, AXES[0], "wash"), Stroke(points, AXES[0], "thin")]
    return panel((26, 28), strokes, [Label(f"t = {t:g}", at=(13.0, 4.0))])
