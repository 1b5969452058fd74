"""The body of a problem in numbers for a drawing, seen so that its points lie well apart."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, pairwise
from typing import Any

from ...language.tree import replaced
from ...language.values import approximate
from ...record.as_json import decode
from .drawing import Box, Dot, Label, Point, Stroke, from_segment

Vector = tuple[float, float, float]
Matrix = tuple[Vector, ...]
"""A matrix by its rows."""

ORIGIN: Vector = (0.0, 0.0, 0.0)
UNITS: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
TRANSLATING = ("SE(", "SAff(", "Aff(", "Sim(")
LARGEST = 1e30
"""The largest number that can be drawn; below its inverse a number is drawn as 0."""
MOMENTS = {"m": 1.0, "J_11": 1.0, "J_22": 0.8, "J_33": 0.6}
"""The moments that are drawn where the record has no default."""


@dataclass
class DrawnSolid:
    """A solid with its sizes as numbers, turned by R and shifted by s: the points R r + s."""

    kind: str
    sizes: dict[str, Any]
    rotation: Matrix
    shift: Vector


@dataclass
class BodyPart:
    """The part of a body that one factor of the group moves.

    ``fixed``: does the origin stay in place? ``points`` and ``places`` are numbered as in the
    record; ``centre`` is that of mass; ``moments``: m, c and J where nothing else is known.
    """

    name: str
    size: int
    fixed: bool
    points: dict[int, tuple[float, Vector]] = field(default_factory=dict)
    places: dict[int, Vector] = field(default_factory=dict)
    solids: list[DrawnSolid] = field(default_factory=list)
    moments: tuple[float, Vector, Matrix] | None = None
    centre: Vector | None = None


class ExpressionValues:
    """The values of a problem's expressions, at defaults of parameters or sample values."""

    def __init__(self, problem: Mapping[str, Any]) -> None:
        declared = problem["parameters"]
        known = {k: p["default"] if isinstance(p, Mapping) else p for k, p in declared.items()}
        moments = problem["body"]["kind"] == "moments"
        self.invented = any(x is None for k, x in known.items() if not (moments and k == "m"))
        values = {}
        for k, (name, default) in enumerate(known.items(), 1):
            own = MOMENTS.get(name, 0.0) if moments and name[:1] in "mcJ" else _sample_value(k)
            values[name] = own if default is None else float(default)
        self.parameters = values

    def of(self, data: Any) -> float:
        """The number of an expression, at the time 0; 1 where the values at hand give none."""
        try:
            found = _fraction(data)
            if found is None:
                found = approximate(replaced(decode(data, "figure"), "t", 0), self.parameters)
        except (ValueError, OverflowError, ZeroDivisionError):
            return 1.0
        if found is None or not abs(found) < LARGEST:
            return 1.0
        return found if abs(found) > 1 / LARGEST else 0.0

    def length(self, data: Any) -> float:
        """A positive number for an expression: its size, or 1."""
        return abs(self.of(data)) or 1.0

    def vector(self, data: Sequence[Any]) -> Vector:
        """The first three coordinates of a list of expressions, missing ones 0."""
        x, y, z = (*(self.of(entry) for entry in data[:3]), 0.0, 0.0, 0.0)[:3]
        return x, y, z


def _fraction(data: Any) -> float | None:
    """A number as the record has it, not decoded as an expression: a mesh has a hundred
    thousand."""
    if isinstance(data, (int, float)):
        return float(data)
    over, stroke, under = data.partition("/") if isinstance(data, str) else ("", "", "")
    return int(over) / int(under) if stroke and under.isdecimal() else None


def _sample_value(k: int) -> float:
    """A number between 0.4 and 1.2 for parameter k: multiples of the golden ratio, well apart."""
    return round(0.4 + 0.8 * (0.618034 * k % 1.0), 3)


def parts(problem: Mapping[str, Any], value: ExpressionValues) -> list[BodyPart]:
    """The parts of the body, one for each factor of the group; none for a text about any group
    or a given Lagrangian."""
    body = problem["body"]
    if body["kind"] in ("any", "none"):
        return []
    masses = body.get("points", [])
    names = str(problem["group"]).split(" x ") if masses else [str(problem["group"])]
    moving = problem["action"] == "affine" or bool(problem["homogeneous"])
    found = [BodyPart(x, 0, not (moving or x.startswith(TRANSLATING))) for x in names]
    for i, p in enumerate(masses, 1):
        part = found[p["block"] - 1]
        part.size = len(p["at"])
        part.points[i] = value.of(p["mass"]), value.vector(p["at"])
    for i, p in enumerate(problem["places"], len(masses) + 1):
        found[p["block"] - 1].places[i] = value.vector(p["at"])
    for part in found:
        part.centre = _centre(part.points.values())
    if body["kind"] == "points":
        return found
    whole = found[0]
    whole.solids = [_solid(s, value) for s in body.get("solids", [])]
    mass, c, J = moments_of(problem)
    m = value.of(mass)
    whole.size = len(c)
    whole.centre = scaled(1 / m, value.vector(c)) if m > 0 else None
    if not whole.solids and not whole.points:
        whole.moments = m, value.vector(c), tuple(value.vector(row) for row in J[:3])
    return found


def _centre(points: Iterable[tuple[float, Vector]]) -> Vector | None:
    pairs = list(points)
    total = sum(m for m, _ in pairs)
    if total <= 0:
        return None
    x, y, z = (sum(m * r[i] for m, r in pairs) / total for i in range(3))
    return x, y, z


def moments_of(problem: Mapping[str, Any]) -> tuple[Any, list[Any], list[Any]]:
    """m, c and J of a body that is more than points, as expressions of the record."""
    body, names = problem["body"], problem["parameters"]
    if body["kind"] == "given":
        given = body["given"]
        return given["m"], given["c"], given["J"]
    span = range(1, 1 + sum(f"c_{i}" in names for i in range(1, 10)))
    rows = [[["par", f"J_{min(i, j)}{max(i, j)}"] for j in span] for i in span]
    return ["par", "m"] if "m" in names else 1, [["par", f"c_{i}"] for i in span], rows


def _solid(data: Mapping[str, Any], value: ExpressionValues) -> DrawnSolid:
    sizes: dict[str, Any] = {}
    for key, size in data["sizes"].items():
        if key == "faces":
            sizes[key] = [tuple(face) for face in size]
        elif key == "vertices":
            sizes[key] = [value.vector(v) for v in size]
        elif key in ("sides", "semi_axes"):
            sizes[key] = [value.length(x) for x in size]
        elif key == "quadric":
            sizes["map"] = _image_of_ball([[value.of(x) for x in row[:3]] for row in size[:3]])
        elif key == "inner":
            sizes[key] = abs(value.of(size))
        else:
            sizes[key] = value.length(size)
    rotation = tuple(value.vector(row) for row in data["rotation"] or UNITS)
    return DrawnSolid(data["kind"], sizes, rotation, value.vector(data["shift"] or (0, 0, 0)))


def _image_of_ball(Q: list[list[float]]) -> list[Vector]:
    """The columns of a map of the unit ball to ⟨r, Q r⟩ ≤ 1, L̄⁻¹ for Q = L L̄; 1 for what Q has
    not of R³."""
    Q = [[*row, *[0.0] * (3 - len(row))] for row in Q]
    Q += [[float(i == j) for j in range(3)] for i in range(len(Q), 3)]
    rows: list[list[float]] = []  # of L⁻¹, each orthogonal to those before it in the metric Q⁻¹
    L = cholesky(Q, 1e-12)
    for i in range(3):
        before = (sum(L[i][k] * rows[k][c] for k in range(i)) for c in range(3))
        rows.append([(float(i == c) - x) / L[i][i] for c, x in enumerate(before)])
    return [(x, y, z) for x, y, z in rows]


def cholesky(Q: Sequence[Sequence[float]], least: float) -> list[Vector]:
    """The rows of L, lower triangular, with L L̄ = Q, a 3 × 3 matrix; ``least`` > 0: the least
    square on the diagonal of L, where Q is not positive."""
    L = [[0.0] * 3 for _ in range(3)]
    for i in range(3):
        for j in range(i + 1):
            rest = Q[i][j] - sum(L[i][k] * L[j][k] for k in range(j))
            L[i][j] = max(rest, least) ** 0.5 if i == j else rest / L[j][j]
    return [(x, y, z) for x, y, z in L]


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """⟨a, b⟩."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plus(a: Vector, b: Vector, s: float = 1.0) -> Vector:
    """a + s b."""
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


def scaled(s: float, a: Vector) -> Vector:
    """s a."""
    return s * a[0], s * a[1], s * a[2]


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    """a ∧ b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def image(A: Matrix, v: Vector) -> Vector:
    """A v."""
    return dot(A[0], v), dot(A[1], v), dot(A[2], v)


# The direction from which a body is seen: one in which its points and axes lie well apart.

Segment = tuple[Vector, Vector]
AZIMUTH, ELEVATION = 30, 21
"""The preferred direction in degrees, from the axis that comes forward."""
ENOUGH = 0.2
"""The clearance, in sizes of the body, above which all views are as good."""
MOST = 14


@dataclass(frozen=True)
class View:
    """A direction of view, by three unit vectors: right and up on the paper, and towards the
    reader; ``flat``: the plane seen as it is."""

    right: Vector
    up: Vector
    towards: Vector
    flat: bool = False

    def __call__(self, p: Vector) -> Point:
        """The place of a point on the paper, before it is scaled."""
        return dot(self.right, p), dot(self.up, p)


FLAT = View(*UNITS, flat=True)


def upright(gravity: Vector) -> tuple[Vector, Vector, Vector]:
    """The axes forward, right and up: the one nearest to gravity goes up, else the third."""
    k = max(range(3), key=lambda i: (abs(gravity[i]), i))
    first, second = UNITS[(k + 1) % 3], UNITS[(k + 2) % 3]
    if gravity[k] > 0:
        return second, first, scaled(-1.0, UNITS[k])
    return first, second, UNITS[k]


def ranked(
    bodies: Sequence[tuple[Sequence[Vector], Sequence[Segment]]],
    size: float,
    gravity: Vector,
) -> list[View]:
    """Views, best first: the farther apart the nearest marks and lines of a body are."""
    axes = upright(gravity)
    thinned = [([*dict.fromkeys(marks)][:MOST], lines[:MOST]) for marks, lines in bodies]

    def score(angles: tuple[int, int]) -> float:
        view = seen_from(*angles, axes)
        nearest = (min(_distances(view, *body), default=math.inf) for body in thinned)
        clear = min(nearest, default=1.0) / size
        azimuth, elevation = angles
        preference = 0.001 * abs(azimuth - AZIMUTH) + 0.003 * abs(elevation - ELEVATION)
        return min(clear, ENOUGH) - preference

    every = [(a, e) for a in range(14, 77, 4) for e in range(12, 41, 4)]
    return [seen_from(*angles, axes) for angles in sorted(every, key=score, reverse=True)]


def seen_from(azimuth: float, elevation: float, axes: Sequence[Vector] = UNITS) -> View:
    """The view from a direction in degrees, around and above; ``axes``: forward, aside, up."""
    ahead, aside, above = axes
    a, e = math.radians(azimuth), math.radians(elevation)
    level = plus(scaled(math.cos(a), ahead), aside, math.sin(a))
    right = plus(scaled(-math.sin(a), ahead), aside, math.cos(a))
    up = plus(scaled(-math.sin(e), level), above, math.cos(e))
    return View(right, up, plus(scaled(math.cos(e), level), above, math.sin(e)))


def _distances(view: View, marks: Sequence[Vector], lines: Sequence[Segment]) -> Iterator[float]:
    joined = {frozenset(line) for line in lines}
    for a, b in combinations(marks, 2):
        yield math.dist(view(a), view(b)) * (0.6 if frozenset((a, b)) in joined else 1.0)
    for p in marks:
        for a, b in lines:
            if p not in (a, b) and not _between(p, a, b):
                yield 2.2 * from_segment(view(p), view(a), view(b))


def _between(p: Vector, a: Vector, b: Vector) -> bool:
    """Is p on the segment from a to b itself, in space?"""
    return math.dist(a, p) + math.dist(p, b) < (1 + 1e-9) * math.dist(a, b)


# The placement of labels: beside what they name, free of each other and of the lines.

STEP = 0.6
"""The distance, in millimetres, of the points by which lines are seen."""
WEIGHTS = {"line": 2.2, "dashed": 1.6, "thin": 1.2, "hidden": 0.8, "solid": 3.0, "wash": 0.0}
CROWD = 1000
"""The most points of lines near a label that are looked at; of more, each counts for several."""
OPTIONAL = 14.0
"""The largest cost at which an optional label is placed."""


@dataclass(frozen=True)
class Wish:
    """A label to be placed, the place that it names, how far from that to stay, and in which
    direction to look first.

    ``optional``: may it be left out where it would be in the way?
    """

    label: Label
    at: Point
    gap: float
    towards: Point = (0.0, 0.0)
    optional: bool = False


def placed(
    wishes: Sequence[Wish], strokes: Sequence[Stroke], dots: Sequence[Dot]
) -> tuple[Label, ...]:
    """The labels in order, each at the place of least cost among lines, dots and labels."""
    ink = [(p, WEIGHTS[s.pen]) for s in strokes if WEIGHTS[s.pen] for p in _along(s.points)]
    found: list[Label] = []
    for wish in wishes:
        near = [(p, w) for p, w in ink if math.dist(p, wish.at) < 22]
        step = 1 + len(near) // CROWD
        near = [(p, w * step) for p, w in near[::step]]
        boxes = [label.box for label in found]
        cost, choice = math.inf, wish.label
        for label in _choices(wish):
            least = _distance_cost(label, wish)
            if least < cost:
                least += _overlap_cost(label, dots, boxes)
            if least < cost and (whole := least + _line_cost(label, near)) < cost:
                cost, choice = whole, label
        if not (wish.optional and cost > OPTIONAL):
            found.append(choice)
    return tuple(found)


def _choices(wish: Wish) -> Iterator[Label]:
    """A label at its possible places: sixteen directions, nearest first, so far out at last that
    some place is free."""
    w, h = wish.label.half
    for more in (0.0, 0.9, 2.0, 3.5, 6.0, 9.0, 13.0, 18.0, 26.0, 36.0):
        for k in range(16):
            x, y = math.cos(math.pi * k / 8), math.sin(math.pi * k / 8)
            far = wish.gap + more
            yield replace(
                wish.label, at=(wish.at[0] + x * (far + w), wish.at[1] + y * (far + h * 0.9))
            )
        if more >= 3.5 and wish.optional:
            return


def _distance_cost(label: Label, wish: Wish) -> float:
    """The cost of a label's distance from what it names, and of an unwished direction."""
    dx, dy = label.at[0] - wish.at[0], label.at[1] - wish.at[1]
    w, h = label.half
    cost = 1.8 * math.hypot(max(0.0, abs(dx) - w), max(0.0, abs(dy) - h))
    length = math.hypot(*wish.towards) * math.hypot(dx, dy)
    if length:
        cost += 2.5 * (1 - (dx * wish.towards[0] + dy * wish.towards[1]) / length)
    return cost


def _overlap_cost(label: Label, dots: Sequence[Dot], boxes: Sequence[Box]) -> float:
    """The cost of the dots and labels that a label would cover."""
    box = label.box
    cost = sum(60.0 for d in dots if _contains(box, d.at, d.radius + 0.3))
    return cost + sum(1000.0 for other in boxes if overlap(box, other, 0.4))


def _line_cost(label: Label, ink: Sequence[tuple[Point, float]]) -> float:
    """The cost of the lines that a label would cover."""
    left, bottom, right, top = label.box
    left, bottom, right, top = left - 0.35, bottom - 0.35, right + 0.35, top + 0.35
    return sum(weight for (x, y), weight in ink if left < x < right and bottom < y < top)


def _contains(box: Box, p: Point, margin: float) -> bool:
    left, bottom, right, top = box
    return left - margin < p[0] < right + margin and bottom - margin < p[1] < top + margin


def overlap(a: Box, b: Box, margin: float = 0.0) -> bool:
    """Do two boxes come nearer to each other than ``margin``?"""
    return (
        a[0] < b[2] + margin
        and b[0] < a[2] + margin
        and a[1] < b[3] + margin
        and b[1] < a[3] + margin
    )


def _along(points: Sequence[Point]) -> Iterator[Point]:
    for a, b in pairwise(points):
        n = max(1, math.ceil(math.dist(a, b) / STEP))
        yield from ((a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n) for k in range(n))
    yield from points[-1:]
