"""The ellipsoids of inertia that stand for the body of a stated Lagrangian."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language.tree import Tree, replaced
from ...language.values import approximate
from ...record.as_json import decode
from .drawn_body import (
    LARGEST,
    ORIGIN,
    UNITS,
    BodyPart,
    DrawnSolid,
    ExpressionValues,
    Vector,
    cholesky,
)

SIZES = {"SO(3)": 3, "SE(3)": 4}
"""The factors that turn a body of space, and the size of their matrices."""
THINNEST = 0.02
"""The least thickness of an ellipsoid that is drawn, in its largest."""


def turns(offset: int) -> list[dict[tuple[int, int], int]]:
    """The entries of the matrices that turn about e_1, e_2, e_3, for the factor of a product whose
    entries begin at ``offset``, from 0."""
    pairs = ((offset + (i + 1) % 3, offset + (i + 2) % 3) for i in range(3))
    return [{(after, before): 1, (before, after): -1} for before, after in pairs]


def shifts(offset: int, n: int) -> list[dict[tuple[int, int], int]]:
    """Those of the matrices that shift along the first n axes."""
    return [{(offset + i, offset + n): 1} for i in range(n)]


def along(basis: Sequence[Any], wanted: Sequence[dict[tuple[int, int], int]]) -> list[int]:
    """The numbers, from 0, of the elements of a basis that have the entries wanted; −1 where it
    has none."""
    at = [{(i, j): x for i, row in enumerate(E) for j, x in enumerate(row) if x} for E in basis]
    return [at.index(x) if x in at else -1 for x in wanted]


def parts_of_inertia(problem: Mapping[str, Any], value: ExpressionValues) -> list[BodyPart]:
    """A part for each factor SO(3), SE(3) of the group of a record whose Lagrangian is stated: the
    homogeneous ellipsoid of its inertia, at the identity and the numbers at hand, and of mass 1
    where the Lagrangian tells none; no part where the group has other factors."""
    names = str(problem["group"]).split(" x ")
    stated = (problem.get("lagrangian") or {}).get("L")
    if stated is None or sum(SIZES.get(x, 0) for x in names) != problem["n"]:
        return []
    energy = decode(stated, "figure")
    basis = [[[*map(Fraction, row)] for row in E] for E in problem["basis"]]
    found, offset = [], 0
    for name in names:
        turning = along(basis, turns(offset))
        sliding = along(basis, shifts(offset, 3)) if name == "SE(3)" else []
        offset += SIZES[name]
        rows = _ellipsoid(energy, turning, sliding, value) if -1 not in turning else None
        if rows is None:
            return []
        columns = [(x, y, z) for x, y, z in zip(*rows, strict=True)]
        solid = DrawnSolid("ellipsoid", {"map": columns}, UNITS, ORIGIN)
        found.append(BodyPart(name, 3, name == "SO(3)", solids=[solid]))
    return found


def _ellipsoid(
    energy: Tree, turning: Sequence[int], sliding: Sequence[int], value: ExpressionValues
) -> list[Vector] | None:
    """The rows of a map of the unit ball to the ellipsoid: L L̄ = 5 J/m, with J = ½ tr I − I."""
    inertia = quadratic(energy, turning, value)
    masses = quadratic(energy, sliding, value) if sliding and -1 not in sliding else None
    if inertia is None or not 0 < (whole := sum(inertia[i][i] for i in range(3))) < LARGEST:
        return None
    m = sum(masses[i][i] for i in range(3)) / 3 if masses else 1.0
    scale = 5 / m if m > 0 else 5.0
    J = [
        [scale * ((i == j) * whole / 2 - x) for j, x in enumerate(row)]
        for i, row in enumerate(inertia)
    ]
    return cholesky(J, THINNEST**2 * max(abs(J[i][i]) for i in range(3)))


def quadratic(
    energy: Tree, places: Sequence[int], value: ExpressionValues
) -> list[list[float]] | None:
    """The matrix of the terms of a Lagrangian that are quadratic in some coordinates of the
    velocity, by its values at the identity; ``None`` where it has none there."""

    def at(*w: tuple[int, int]) -> float:
        moving = replaced(at_velocity(energy, dict(w)), "t", 0)
        found = approximate(moving, value.parameters)
        return float("nan") if found is None else found

    rest = at()
    one = {i: at((i, 1)) for i in places}
    rows = [
        [one[i] + at((i, -1)) - 2 * rest if i == j else at((i, 1), (j, 1)) - one[i] - one[j] + rest
         for j in places]
        for i in places
    ]  # fmt: skip
    return rows if all(x == x for r in rows for x in r) else None


def at_velocity(t: Tree, velocity: Mapping[int, int]) -> Tree:
    """A tree at the identity of the group, for some coordinates of the velocity, the others 0."""
    if not isinstance(t, tuple):
        return t
    if t[0] == "entry":
        return velocity.get(t[2] - 1, 0) if t[1] == "ζ" else int(len(t) == 4 and t[2] == t[3])
    return (t[0], *(at_velocity(part, velocity) for part in t[1:]))
