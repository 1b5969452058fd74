"""What pictures of a run need of its body, in numbers, in its own frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..figure.drawn_body import Numbers, parts
from ..figure.shapes import Curve, Shape

ROUND_KINDS = ("ball", "ellipsoid", "hollow_ball")
SIGHT = (0.75, 0.5, 0.43)


def outline(problem: Mapping[str, Any], parameters: Mapping[str, float]) -> dict[str, list[Any]]:
    """What there is of a body in R³ that one group moves: its ``points``; its ``ellipsoids``, each
    the rows of a map of the unit ball and a shift; its other ``solids``, convex, each the lines of
    its edges and rims.  A mesh is left out."""
    declared = {
        name: {**dict(about), "default": parameters.get(name, about["default"])}
        for name, about in problem["parameters"].items()
    }
    found = parts({**problem, "parameters": declared}, Numbers({**problem, "parameters": declared}))
    if len(found) != 1 or found[0].size != 3:
        return {}
    (body,) = found
    shapes = [Shape(x, SIGHT) for x in body.solids if x.kind != "mesh"]
    ellipsoids = [
        [[list(row) for row in zip(*x.columns, strict=True)], list(x.shift)]
        for x in shapes
        if x.kind in ROUND_KINDS
    ]
    solids = [
        [[list(p) for p in _short(c.points)] for c in _edges(x)]
        for x in shapes
        if x.kind not in ROUND_KINDS
    ]
    points = [list(r) for _, r in body.points.values()]
    return {"points": points, "ellipsoids": ellipsoids, "solids": solids}


def _edges(shape: Shape) -> list[Curve]:
    """The edges and rims of a solid, without contours, which turn with the body; the apex of a cone
    as one of no length."""
    curves = [*shape.curves()]
    if shape.kind == "cylinder":
        return curves[:2]
    if shape.kind == "cone":
        apex = shape.to_body((0.0, 0.0, 1.0))
        return [curves[0], Curve((apex, apex, apex))]
    return curves


def _short(points: tuple[Any, ...]) -> list[Any]:
    """A straight line by its ends, a curve by every other of its points."""
    first, middle, last = points[0], points[len(points) // 2], points[-1]
    bend = max(abs(x + z - 2 * y) for x, y, z in zip(first, middle, last, strict=True))
    return [first, last] if bend < 1e-9 else [*points[::2]]
