"""The body of a problem as a page draws it: places of the state, and trees of parameters.

A tree is as the record has it, which the page evaluates: so the body follows its parameters.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from ...algebra.groups import Group
from ...language.reserved import waves
from ...problem.fields import entry_places
from ..figure.drawn_body import UNITS, ExpressionValues, moments_of
from ..figure.scene import along, shifts, turns
from ..figure.shapes import stretches

DIGITS = 4
"""Of the places of a mesh."""

Data = Any
"""Numbers and trees, in lists and by names, as JSON has them."""


def moving_body(
    problem: Mapping[str, Any],
    group: Group | None,
    state: Sequence[str],
    angles: Collection[str] = (),
) -> Data:
    """What is drawn of the problem of a record: ``parts``, one for each factor of the group that
    moves points of the plane or of space, none where one of them does not; ``springs`` between
    them; ``gravity``; ``polhode``, the places of an angular velocity in the state; ``stretches``:
    can it become flat, as volumes are not kept? ``waves``: the coefficients of the vorticity of a
    fluid on the torus, where there is one. What is among the ``angles`` of the state moves nothing
    from its place."""
    none = {"parts": [], "springs": [], "gravity": [0, 0, 0], "polhode": [], "turns": False}
    none["stretches"] = False
    if "torus" in problem:
        none["waves"] = waves(state)
    if group is None or any(factor.n not in (2, 3) for _, factor in group.places):
        return none
    group = group.in_user_basis
    at = element(group, state)
    if not at:
        return none
    moved = [x for x in at if state[x[2]] not in angles]
    parts = [_part(problem, k, moved, group, state) for k in range(len(group.places))]
    home = {i: k for k, part in enumerate(parts) for i, *_ in part["points"]}
    springs = [p["between"] for p in problem["potentials"] if "between" in p]
    turning = _turning(group, state, {place for _, _, place in at})
    return {
        "parts": parts,
        "springs": [[home[i], i, home[j], j] for i, j in springs if i in home and j in home],
        "gravity": _gravity(problem),
        "planar": all(part["n"] == 2 for part in parts),
        "polhode": turning,
        "stretches": any(sum(E[i][i] for i in range(len(E))) for E in group.basis),
        "turns": bool(turning) and len(state) - len(at) == 3,
    }


def element(group: Group | None, state: Sequence[str]) -> list[list[int]]:
    """The entries of the element of the group in the state: row, column, place, from 0."""
    places = entry_places(group) if group else {}
    return [[*places[name], k] for k, name in enumerate(state) if name in places]


def _turning(group: Group, state: Sequence[str], at: set[int]) -> list[int]:
    """The places of the velocity that turns about e_1, e_2, e_3 of the first factor; none where
    these are not among the basis."""
    velocity = [k for k in range(len(state)) if k not in at]
    if len(velocity) != len(group.basis):
        return []
    found = _along(group, velocity, turns(group.places[0][0]))
    return found if -1 not in found else []


def _along(group: Group, places: Sequence[int], wanted: Sequence[Any]) -> list[int]:
    """Of places of the coordinates in a basis those of the elements wanted; −1 where it has not
    such an element."""
    return [places[k] if k >= 0 else -1 for k in along(group.basis, wanted)]


def _gravity(problem: Mapping[str, Any]) -> Data:
    """The sum of the accelerations of gravity, in R³."""
    total: list[list[Any]] = [[], [], []]
    for p in problem["potentials"]:
        for i, g in enumerate(p["g"][:3] if p["kind"] == "gravity" else ()):
            total[i].append(g)
    return [["add", 0, 0, *x] for x in total]


def _part(
    problem: Mapping[str, Any],
    k: int,
    at: Sequence[Sequence[int]],
    group: Group,
    state: Sequence[str],
) -> Data:
    """What factor k of the group moves; all of the body where it is no product of points. Of a
    Lagrangian alone, the places of the velocities that turn it and move it along its axes, by
    which the energy tells its inertia."""
    offset, factor = group.places[k]
    body, n = problem["body"], factor.n
    where = {(i - offset, j - offset): place for i, j, place in at}
    own = [
        where.get((i, j if j < 3 else n), -1) if i < n else -1 for i in range(3) for j in range(4)
    ]
    points = [
        [i, p["mass"], p["at"]]
        for i, p in enumerate(body.get("points", []), 1)
        if p["block"] == k + 1
    ]
    before = len(body.get("points", []))
    points += [
        [i, 0, p["at"]] for i, p in enumerate(problem["places"], before + 1) if p["block"] == k + 1
    ]
    ids = [i for i, *_ in points]
    whole = k == 0 and body["kind"] in OF_MOMENTS
    potentials = problem["potentials"]
    attractions = [p for p in potentials if p["kind"] == "attraction"]
    linear = [[E[offset + i][offset : offset + n] for i in range(n)] for E in group.basis]
    named = {name: s for s, name in enumerate(state)}
    velocity = [named.get(f"zeta_{a}", -1) for a in range(1, len(group.basis) + 1)]
    inertia = {
        "turning": _along(group, velocity, turns(offset)),
        "sliding": _along(group, velocity, shifts(offset, n)),
    }
    return {
        "n": n,
        **(inertia if body["kind"] == "none" else {}),
        "map": [own[4 * i : 4 * i + 4] for i in range(3)],
        "fixed": not any((i, n) in where for i in range(n)),
        "deforms": any(A[i][j] + A[j][i] for A in linear for i in range(n) for j in range(n)),
        "points": points,
        "solids": [_solid(s, problem) for s in body.get("solids", [])] if k == 0 else [],
        "moments": dict(zip("mcJ", moments_of(problem), strict=True)) if whole else None,
        "attractions": [
            {"centre": p["centre"], "on": [i for i, _ in p["on"]] if "on" in p else ids}
            for p in attractions
        ],
        "anchors": [
            {"on": p["on"], "at": p["anchor"]}
            for p in potentials
            if p.get("on") in ids and "anchor" in p
        ],
    }


OF_MOMENTS = ("given", "moments")
"""The kinds of bodies that are more than points."""


def _solid(solid: Mapping[str, Any], problem: Mapping[str, Any]) -> Data:
    """A solid as the image of a shape: columns of the map, and a shift; a mesh by its places."""
    kind, s = solid["kind"], solid["sizes"]
    R, shift = solid["rotation"] or UNITS, solid["shift"] or [0, 0, 0]
    if kind == "mesh":
        return _mesh(solid, ExpressionValues(problem))
    if "quadric" in s:
        return {"shape": "ball", "quadric": s["quadric"], "shift": shift}
    if kind == "tetrahedron":
        first, *others = (
            [_sum(x, y) for x, y in zip(_image(R, v), shift, strict=True)] for v in s["vertices"]
        )
        columns = [[_sum(x, ["mul", -1, y]) for x, y in zip(v, first, strict=True)] for v in others]
        return {"shape": kind, "columns": columns, "shift": first}
    stretch = stretches(kind, s, lambda x: ["mul", "1/2", x])
    columns = [[_product(row[j], stretch[j]) for row in R] for j in range(3)]
    return {"shape": kind if kind in SHAPES else "ball", "columns": columns, "shift": shift}


SHAPES = ("box", "cylinder", "cone")
"""The shapes that are no image of a ball or of a simplex."""


def _image(R: Sequence[Sequence[Any]], v: Sequence[Any]) -> list[Data]:
    return [["add", *(["mul", r, x] for r, x in zip(row, v, strict=True))] for row in R]


def _sum(x: Data, y: Data) -> Data:
    return ["add", x, y]


def _product(x: Data, y: Data) -> Data:
    return 0 if x == 0 else y if x == 1 else ["mul", x, y]


def _mesh(solid: Mapping[str, Any], value: ExpressionValues) -> Data:
    """A mesh with its places at the defaults, thinned out where it has very many faces."""
    import numpy as np

    from ..figure.meshes import simplified

    R = np.array([value.vector(row) for row in solid["rotation"] or UNITS])
    own = np.array([value.vector(v) for v in solid["sizes"]["vertices"]])
    own = own @ R.T + np.array(value.vector(solid["shift"] or (0, 0, 0)))
    points, faces = simplified(own, np.array(solid["sizes"]["faces"], dtype=int))
    digits = DIGITS - int(np.floor(np.log10(np.abs(points).max() or 1.0)))
    return {"vertices": np.round(points, digits).tolist(), "faces": faces.tolist()}
