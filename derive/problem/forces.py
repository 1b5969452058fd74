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
from ..schema.outside import INPUTS, Damping, ForceInput, Input
from .bodies import rotation
from .fields import (
    LIKE_A_PLACE,
    block,
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
    GivenBody,
    Parameter,
    Place,
    PointBody,
    ProblemError,
)

AXES = "xyz"
UNNUMBERED = "there are no [[point]] tables to number"
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
            raise ProblemError(f"{where}: {UNNUMBERED}")
        return whole(value, 1, self.masses, where)

    def attached(self, data: Mapping[str, Any], where: str) -> int:
        """The point of ``on``, or a new place at ``at``."""
        if "on" in data:
            if "at" in data:
                raise ProblemError(f"{where}: give either 'on' or 'at'")
            if not self.masses:
                raise ProblemError(f"{where}, on: {UNNUMBERED}; give 'at', a place of the body")
            listed = _as_list(data["on"])
            if len(listed) != 1:
                raise ProblemError(f"{where}: key 'on' must be one point")
            return self.point(listed[0], f"{where}, on")
        assert self.group is not None
        if "at" not in data:
            given = "'on' or 'at'" if self.masses else "'at', a place of the body,"
            raise ProblemError(f"{where}: key {given} is missing")
        number = block(data, self.group, where)
        n = self.factor(number)[1].n
        self.places.append(Place(vector(data["at"], n, f"{where}, at"), number))
        return self.masses + len(self.places)


def _as_list(value: Any) -> list[Any]:
    """A number of a point, or a list of them."""
    return value if isinstance(value, list) else [value]


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

    at: Points

    def fail(self, message: str) -> ProblemError:
        """The error of a file."""
        return ProblemError(message)

    def has(self, table: Mapping[str, Any], key: str) -> bool:
        """Does the table say it?"""
        return key in table

    def meets(self, need: str, kind: str, where: str) -> None:
        """``points alone``: nothing else has mass; ``one space``: all blocks are of one dimension,
        or the points where there are some."""
        at = self.at
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
        assert self.at.group is not None
        return {g.n for _, g in self.at.group.places}

    def scalar(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> Tree:
        """An expression of the parameters."""
        return expression(missing(table, key, where), f"{where}, {key}")

    def vector(self, table: Mapping[str, Any], key: str, where: str, found: Found) -> Vector:
        """Of the space of the end that is given, or of all points."""
        n = self.at.size(found["on"]) if found.get("on") else max(self._sizes())
        return vector(missing(table, key, where), n, f"{where}, {key}")

    def energy(self, table: Mapping[str, Any], key: str, where: str, found: Found) -> Tree:
        """An expression of places in space, with one at least."""
        U = _placed(self.scalar(table, key, where, found), where, self.at)
        if not any(x[0] == "at" for _, x in subtrees(U) if isinstance(x, tuple)):
            raise ProblemError(
                f"{where}, {key}: no place of a point, as r1_x, so no force; leave it out"
            )
        return U

    def pair(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> tuple[int, int]:
        """Two points, in spaces of one dimension."""
        ends, at = table[key], self.at
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
        return self.at.attached(table, where)

    def rotation(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> Rows:
        """{ axis, angle } in R³, or rows of numbers."""
        assert self.at.group is not None
        return rotation(table[key], self.at.group.n, f"{where}, {key}")

    def timed(self, table: Mapping[str, Any], key: str, where: str, found: Found) -> Vector:
        """A vector of the space of all points, of the time as well."""
        return tuple(in_time(x) for x in self.vector(table, key, where, found))

    def charges(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> Vector:
        """A number for each point."""
        count = self.at.masses
        if not count:
            raise ProblemError(f"{where}: key {key!r} is for [[point]] tables, and there are none")
        return vector(missing(table, key, where), count, f"{where}, {key}")

    def points(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> tuple[int, ...]:
        """A place of the body; or points, by a number or a list, all without either."""
        at = self.at
        if "at" in table:
            return (at.attached(table, where),)
        if not at.masses:
            raise ProblemError(f"{where}: give a place of the body under 'at', or [[point]] tables")
        listed = table.get(key, [*range(1, at.masses + 1)])
        if not listed and isinstance(listed, list):
            raise ProblemError(f"{where}: key {key!r} must be a point or a list of points")
        on = tuple(at.point(i, f"{where}, {key}") for i in _as_list(listed))
        if len(set(on)) != len(on):
            raise ProblemError(f"{where}: key {key!r} names a point twice")
        return on

    def name(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> str:
        """One that every emitted language can take."""
        return identifier(text(table, key, where), f"{where}, {key}")

    def frame(self, table: Mapping[str, Any], key: str, where: str, _: Found) -> str:
        """Space or body."""
        return choice(table, key, ("space", "body"), where)

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
    own = INPUTS[choice(data, "kind", tuple(INPUTS), where)]
    known(data, {"kind", *own.names()}, where)
    if points.group is None and own is ForceInput:
        raise ProblemError(f"{where}: a text about any group has no points to push")
    return own.read(data, where, FileReader(points))


def damping(data: Mapping[str, Any], where: str, points: Points) -> Damping:
    """One table [[damping]]."""
    known(data, {*Damping.names()}, where)
    if points.group is None:
        raise ProblemError(f"{where}: a text about any group has no points to damp")
    return Damping.read(data, where, FileReader(points))


def negative_stiffness_of(
    potentials: Sequence[Potential],
    damping: Sequence[Damping],
    parameters: Mapping[str, Parameter],
) -> str | None:
    """Where a stiffness or a damping is negative, for the defaults of the parameters."""
    listed = [
        (f"{told} {k}: key {key!r}", value)
        for told, tables in (("potential", potentials), ("damping", damping))
        for k, p in enumerate(tables, 1)
        for key, about, value in p.values()
        if about.positive
    ]
    return next((where for where, t in listed if is_negative(t, parameters)), None)


def trees(p: Place | Body | None) -> list[Tree]:
    """The expressions of a part of a problem."""
    match p:
        case Place():
            return [*p.at]
        case PointBody():
            return [*p.masses, *(x for r in p.positions for x in r)]
        case GivenBody():
            return [p.mass, *p.first, *(x for row in p.second for x in row)]
    return []
