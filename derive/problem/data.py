"""A problem as the record has it: plain data, trees as they are."""

from __future__ import annotations

from typing import Any

from .problem import Body, GivenBody, PointBody, Problem
from .solids import Solid


def data(problem: Problem) -> dict[str, Any]:
    """What the record says of the problem; trees as they are."""
    return {
        "name": problem.name,
        "title": problem.title,
        "group": problem.group.name if problem.group else "any group",
        "action": problem.action,
        "homogeneous": problem.homogeneous,
        "parameters": {
            k: {"default": p.default, "unit": p.unit, "meaning": p.meaning}
            for k, p in problem.parameters.items()
        },
        "body": _body_data(problem.body),
        "potentials": [p.plain() for p in problem.potentials],
        "inputs": [i.plain() for i in problem.inputs],
        "places": [{"at": list(p.at), "block": p.block} for p in problem.places],
        "damping": [d.plain() for d in problem.damping],
        **({"frame": dict(problem.frame)} if problem.frame else {}),
        **({"masses": "of any sign"} if problem.signed else {}),
    }


def _body_data(body: Body | None) -> dict[str, Any]:
    if isinstance(body, GivenBody):
        given = {"m": body.mass, "c": list(body.first), "J": [list(row) for row in body.second]}
        solids = [_solid_data(s) for s in body.solids]
        own = {"points": _points_data(body.points)} if body.points else {}
        return {"kind": "given", "given": given, "solids": solids, **own}
    if isinstance(body, PointBody):
        return {"kind": "points", "points": _points_data(body)}
    return {"kind": "moments" if body else "any"}


def _points_data(body: PointBody) -> list[dict[str, Any]]:
    blocks = body.blocks or (1,) * len(body.masses)
    points = zip(body.masses, body.positions, blocks, strict=True)
    return [{"mass": m, "at": list(r), "block": b} for m, r, b in points]


def _solid_data(s: Solid) -> dict[str, Any]:
    sizes: dict[str, Any] = dict(s.sizes)
    if s.mesh is not None:
        vertices, faces = s.mesh
        sizes = {"vertices": [list(v) for v in vertices], "faces": [list(f) for f in faces]}
    return {
        "kind": s.kind,
        "density": s.density,
        "sizes": {k: _listed(x) for k, x in sizes.items()},
        "rotation": [list(row) for row in s.rotation] if s.rotation else None,
        "shift": list(s.shift) if s.shift else None,
    }


def _listed(x: Any) -> Any:
    """Tuples of sizes as lists; a tree stays a tree."""
    if isinstance(x, tuple) and x and not isinstance(x[0], str):
        return [_listed(y) for y in x]
    return x
