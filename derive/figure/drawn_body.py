"""The body of a problem in numbers, for a drawing: expressions at the parameters' defaults."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..language.values import approximate
from ..record.as_json import decode

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


class Numbers:
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
        """The number of an expression; 1 where the values at hand give none."""
        try:
            found = _fraction(data)
            if found is None:
                found = approximate(decode(data, "figure"), self.parameters)
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


def parts(problem: Mapping[str, Any], value: Numbers) -> list[BodyPart]:
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
    m, c, J = _moments(problem, value)
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


def _moments(problem: Mapping[str, Any], value: Numbers) -> tuple[float, Sequence[Any], Any]:
    """The mass m as a number, c and J as expressions of the record."""
    body = problem["body"]
    if body["kind"] == "given":
        given = body["given"]
        return value.of(given["m"]), given["c"], given["J"]
    span = range(1, 1 + sum(f"c_{i}" in problem["parameters"] for i in range(1, 10)))
    rows = [[["par", f"J_{min(i, j)}{max(i, j)}"] for j in span] for i in span]
    return value.of(["par", "m"]), [["par", f"c_{i}"] for i in span], rows


def _solid(data: Mapping[str, Any], value: Numbers) -> DrawnSolid:
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
    L = [[0.0] * 3 for _ in range(3)]
    for i in range(3):
        for j in range(i + 1):
            rest = Q[i][j] - sum(L[i][k] * L[j][k] for k in range(j))
            L[i][j] = max(rest, 1e-12) ** 0.5 if i == j else rest / L[j][j]
        before = (sum(L[i][k] * rows[k][c] for k in range(i)) for c in range(3))
        rows.append([(float(i == c) - x) / L[i][i] for c, x in enumerate(before)])
    return [(x, y, z) for x, y, z in rows]


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """⟨a, b⟩."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def plus(a: Vector, b: Vector, s: float = 1.0) -> Vector:
    """a + s b."""
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


def scaled(s: float, a: Vector) -> Vector:
    """s a."""
    return s * a[0], s * a[1], s * a[2]


def cross(a: Vector, b: Vector) -> Vector:
    """a ∧ b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def image(A: Matrix, v: Vector) -> Vector:
    """A v."""
    return dot(A[0], v), dot(A[1], v), dot(A[2], v)
