"""The tables [[potential]], [[input]] and [[damping]] of a problem file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..algebra.groups import Group
from ..language.reserved import PLACE
from ..language.tree import Tree, replaced, subtrees
from ..schema.kind import Potential
from ..schema.kinds import kinds
from .bodies import rotation
from .fields import (
    LIKE_A_PLACE,
    choice,
    expression,
    identifier,
    known,
    missing,
    text,
    vector,
    whole,
)
from .inertia import is_negative
from .problem import (
    Body,
    CovectorInput,
    Damping,
    ForceInput,
    GivenBody,
    Input,
    Parameter,
    Place,
    PointBody,
    ProblemError,
)

AXES = "xyz"
Vector = tuple[Tree, ...]
Rows = tuple[Vector, ...]
Found = Mapping[str, Any]
"""What has been read of a table."""


@dataclass
class Points:
    """The points that forces may act on: those with a mass, then the places without.

    ``heavy``: the body has mass outside these points.
    """

    group: Group | None
    masses: int
    blocks: tuple[int, ...]
    parameters: Mapping[str, Any]
    places: list[Place] = field(default_factory=list)
    heavy: bool = False

    def factor(self, block: int) -> tuple[int, Group]:
        """The first row and the group of a block."""
        assert self.group is not None
        return self.group.places[block - 1]

    def block(self, i: int) -> int:
        """The block of point i."""
        return self.places[i - self.masses - 1].block if i > self.masses else self.blocks[i - 1]

    def size(self, i: int) -> int:
        """How many coordinates point i has in space."""
        return self.factor(self.block(i))[1].n

    def point(self, value: Any, where: str) -> int:
        """A point by its number."""
        if not self.masses:
            raise ProblemError(f"{where}: there are no [[point]] tables to number")
        return whole(value, 1, self.masses, where)

    def attached(self, data: Mapping[str, Any], where: str) -> int:
        """The point of ``on``, or a new place at ``at``."""
        if "on" in data:
            if "at" in data:
                raise ProblemError(f"{where}: give either 'on' or 'at'")
            return self.point(data["on"], f"{where}, on")
        assert self.group is not None
        most = len(self.group.places)
        block = whole(data.get("block", 1), 1, most, f"{where}, block")
        n = self.factor(block)[1].n
        self.places.append(Place(vector(missing(data, "at", where), n, f"{where}, at"), block))
        return self.masses + len(self.places)


def potential(data: Mapping[str, Any], where: str, points: Points) -> Potential:
    """One table [[potential]]."""
    kind = choice(data, "kind", tuple(kinds()), where)
    if points.group is None:
        raise ProblemError(f"{where}: a text about any group has no potential of its own")
    own = kinds()[kind]
    known(data, {"kind", *own.names()}, where)
    return own.read(data, where, FileReader(points))


@dataclass
class FileReader:
    """Reads the table of a potential (:class:`Reader`): a method for each type of a key."""

    points: Points

    def fail(self, message: str) -> ProblemError:
        """The error of a file."""
        return ProblemError(message)

    def has(self, table: Mapping[str, Any], key: str) -> bool:
        """Does the table say it?"""
        return key in table

    def meets(self, need: str, kind: str, where: str) -> None:
        """``points alone``: nothing else has mass; ``one space``: all blocks are of one dimension,
        or the points where there are some."""
        at = self.points
        if need == "points alone" and (not at.masses or at.heavy):
            raise ProblemError(f"{where}: {kind} needs a body of [[point]] tables alone")
        if need == "one space" and len(self._sizes()) > 1:
            more = "; use 'expression'" if kind == "gravity" else ""
            raise ProblemError(f"{where}: {kind} needs blocks of one dimension{more}")
        g = at.group
        assert g is not None
        if need == "rotations" and ("orthogonal" not in g.relations or g.factors):
            raise ProblemError(
                f"{where}: {kind} needs one group whose linear parts are rotations, as SO(3) or "
                f"SE(3); those of {g.name} are others"
            )
        if need == "affine of R^3" and (g.n != 3 or not g.free_translations or g.factors):
            raise ProblemError(
                f"{where}: {kind} needs a group with all translations of R^3, as SE(3) or Aff(3)"
            )

    def _sizes(self) -> set[int]:
        assert self.points.group is not None
        return {g.n for _, g in self.points.group.places}

    def scalar(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> Tree:
        """An expression of the parameters."""
        return expression(missing(table, key, where), f"{where}, {key}")

    def vector(self, table: Mapping[str, Any], key: str, where: str, found: Found) -> Vector:
        """Of the space of the end that is given, or of all points."""
        n = self.points.size(found["on"]) if found.get("on") else max(self._sizes())
        return vector(missing(table, key, where), n, f"{where}, {key}")

    def energy(self, table: Mapping[str, Any], key: str, where: str, found: Found) -> Tree:
        """An expression of places in space, with one at least."""
        U = _placed(self.scalar(table, key, where, found), where, self.points)
        if not any(x[0] == "at" for _, x in subtrees(U) if isinstance(x, tuple)):
            raise ProblemError(
                f"{where}, {key}: no place of a point, as r1_x, so no force; leave it out"
            )
        return U

    def pair(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> tuple[int, int]:
        """Two points, in spaces of one dimension."""
        ends, at = table[key], self.points
        if not isinstance(ends, list) or len(ends) != 2:
            raise ProblemError(f"{where}: key {key!r} must be two points")
        i, j = (at.point(x, f"{where}, {key}") for x in ends)
        if i == j:
            raise ProblemError(f"{where}: key {key!r} names one point twice")
        if at.size(i) != at.size(j):
            raise ProblemError(f"{where}: the points {i} and {j} are in spaces of two dimensions")
        return i, j

    def end(self, table: Mapping[str, Any], _: str, where: str, __: Found) -> int:
        """A point, or a new place."""
        return self.points.attached(table, where)

    def rotation(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> Rows:
        """{ axis, angle } in R³, or rows of numbers."""
        assert self.points.group is not None
        return rotation(table[key], self.points.group.n, f"{where}, {key}")

    def timed(self, table: Mapping[str, Any], key: str, where: str, found: Found) -> Vector:
        """A vector of the space of all points, of the time as well."""
        return tuple(in_time(x) for x in self.vector(table, key, where, found))

    def charges(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> Vector:
        """A number for each point."""
        count = self.points.masses
        if not count:
            raise ProblemError(f"{where}: key {key!r} is for [[point]] tables, and there are none")
        return vector(missing(table, key, where), count, f"{where}, {key}")

    def masses(self, *_: Any) -> tuple[()]:
        """Those of the points."""
        return ()


def _placed(t: Tree, where: str, points: Points) -> Tree:
    """r1_x, r1_2, … as entries of the places in space; t as the time."""
    if not isinstance(t, tuple):
        return t
    if t[0] != "par":
        return (t[0], *(_placed(x, where, points) for x in t[1:]))
    name = t[1]
    match = PLACE.fullmatch(name)
    if match is None and name != "t":
        if LIKE_A_PLACE.fullmatch(name) and name not in points.parameters:
            raise ProblemError(
                f"{where}: {name!r}: a place in space is r1_x, r1_y, r1_z, or r1_1, r1_2, …"
            )
        return t
    if match is None:
        return "t"
    i = int(match[1])
    if not points.masses:
        raise ProblemError(f"{where}: {name!r}: there are no [[point]] tables to number")
    if not 1 <= i <= points.masses:
        raise ProblemError(f"{where}: {name!r}: the points are r1 … r{points.masses}")
    k = AXES.index(match[2]) + 1 if match[2] else int(match[3])
    if not 1 <= k <= points.size(i):
        raise ProblemError(f"{where}: {name!r}: point {i} has {points.size(i)} coordinates")
    offset = points.factor(points.block(i))[0]
    return ("entry", ("call", ("at", "r", i), "t"), offset + k)


def in_time(t: Tree) -> Tree:
    """The time, where an expression says t."""
    return replaced(t, ("par", "t"), "t")


def given_input(data: Mapping[str, Any], where: str, points: Points) -> Input:
    """One table [[input]]."""
    kind = choice(data, "kind", ("covector", "force"), where)
    name = identifier(text(data, "name", where), f"{where}, name")
    if kind == "covector":
        known(data, {"name", "kind"}, where)
        return CovectorInput(name)
    known(data, {"name", "kind", "on", "at", "block", "frame"}, where)
    if points.group is None:
        raise ProblemError(f"{where}: a text about any group has no points to push")
    frame = choice(data, "frame", ("space", "body"), where, "space")
    return ForceInput(name, points.attached(data, where), frame)


def damping(data: Mapping[str, Any], where: str, points: Points) -> Damping:
    """One table [[damping]]."""
    known(data, {"coefficient", "on", "at", "block"}, where)
    coefficient = expression(missing(data, "coefficient", where), f"{where}, coefficient")
    if "at" in data:
        if points.group is None:
            raise ProblemError(f"{where}: a text about any group has no points to damp")
        return Damping(coefficient, (points.attached(data, where),))
    if not points.masses:
        raise ProblemError(f"{where}: give a place of the body under 'at', or [[point]] tables")
    listed = data.get("on", [*range(1, points.masses + 1)])
    if not isinstance(listed, list) or not listed:
        raise ProblemError(f"{where}: key 'on' must be a list of points")
    on = tuple(points.point(i, f"{where}, on") for i in listed)
    if len(set(on)) != len(on):
        raise ProblemError(f"{where}: key 'on' names a point twice")
    return Damping(coefficient, on)


def negative_stiffness_of(
    potentials: Sequence[Potential],
    damping: Sequence[Damping],
    parameters: Mapping[str, Parameter],
) -> str | None:
    """Where a stiffness or a damping is negative, for the defaults of the parameters."""
    listed = [
        (f"potential {k}: key {key!r}", value)
        for k, p in enumerate(potentials, 1)
        for key, about, value in p.values()
        if about.positive
    ]
    listed += [(f"damping {k}: key 'coefficient'", d.coefficient) for k, d in enumerate(damping, 1)]
    return next((where for where, t in listed if is_negative(t, parameters)), None)


def trees(p: Damping | Place | Body | None) -> list[Tree]:
    """The expressions of a part of a problem."""
    match p:
        case Damping():
            return [p.coefficient]
        case Place():
            return [*p.at]
        case PointBody():
            return [*p.masses, *(x for r in p.positions for x in r)]
        case GivenBody():
            return [p.mass, *p.first, *(x for row in p.second for x in row)]
    return []
