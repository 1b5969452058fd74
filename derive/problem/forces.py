"""The tables [[potential]], [[input]] and [[damping]] of a problem file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..algebra.groups import Group
from ..language.reserved import PLACE
from ..language.tree import Tree, subtrees
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
    Attraction,
    Body,
    CovectorInput,
    Damping,
    Expression,
    ForceInput,
    GivenBody,
    Gravity,
    Input,
    Parameter,
    Place,
    PointBody,
    Potential,
    ProblemError,
    Spring,
)

AXES = "xyz"


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
    kinds = ("gravity", "spring", "attraction", "expression")
    kind = choice(data, "kind", kinds, where)
    if points.group is None:
        raise ProblemError(f"{where}: a text about any group has no potential of its own")
    if kind == "gravity":
        known(data, {"kind", "g"}, where)
        sizes = {g.n for _, g in points.group.places}
        if len(sizes) > 1:
            raise ProblemError(f"{where}: gravity needs blocks of one dimension; use 'expression'")
        return Gravity(vector(missing(data, "g", where), sizes.pop(), f"{where}, g"))
    if kind == "attraction":
        known(data, {"kind", "strength", "centre"}, where)
        if not points.masses or points.heavy:
            raise ProblemError(f"{where}: attraction needs a body of [[point]] tables alone")
        n = points.size(1)
        if any(points.size(i) != n for i in range(1, points.masses + 1)):
            raise ProblemError(f"{where}: attraction needs blocks of one dimension")
        centre = vector(data["centre"], n, f"{where}, centre") if "centre" in data else ()
        strength = expression(missing(data, "strength", where), f"{where}, strength")
        return Attraction(strength, centre)
    if kind == "spring":
        return _spring(data, where, points)
    known(data, {"kind", "U"}, where)
    U = _placed(expression(missing(data, "U", where), f"{where}, U"), where, points)
    if not any(x[0] == "at" for _, x in subtrees(U) if isinstance(x, tuple)):
        raise ProblemError(f"{where}, U: no place of a point, as r1_x, so no force; leave it out")
    return Expression(U)


def _spring(data: Mapping[str, Any], where: str, points: Points) -> Spring:
    known(data, {"kind", "between", "on", "at", "block", "anchor", "stiffness", "length"}, where)
    stiffness = expression(missing(data, "stiffness", where), f"{where}, stiffness")
    length = expression(data.get("length", 0), f"{where}, length")
    if "between" in data:
        ends = data["between"]
        if any(key in data for key in ("at", "on", "anchor")):
            raise ProblemError(f"{where}: give either 'between' or an end with an 'anchor'")
        if not isinstance(ends, list) or len(ends) != 2:
            raise ProblemError(f"{where}: key 'between' must be two points")
        i, j = (points.point(x, f"{where}, between") for x in ends)
        if i == j:
            raise ProblemError(f"{where}: key 'between' names one point twice")
        if points.size(i) != points.size(j):
            raise ProblemError(f"{where}: the points {i} and {j} are in spaces of two dimensions")
        return Spring((i, j), stiffness, length)
    if "anchor" not in data:
        raise ProblemError(f"{where}: give 'between', or 'on' or 'at' with an 'anchor'")
    i = points.attached(data, where)
    anchor = vector(data["anchor"], points.size(i), f"{where}, anchor")
    return Spring((i, None), stiffness, length, anchor)


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
        (f"{kind} {k}: key {key!r}", getattr(p, key))
        for kind, parts, of, key in (
            ("potential", potentials, Spring, "stiffness"),
            ("damping", damping, Damping, "coefficient"),
        )
        for k, p in enumerate(parts, 1)
        if isinstance(p, of)
    ]
    return next((where for where, t in listed if is_negative(t, parameters)), None)


def trees(p: Potential | Damping | Place | Body | None) -> list[Tree]:
    """The expressions of a part of a problem."""
    match p:
        case Gravity():
            return [*p.acceleration]
        case Spring():
            return [p.stiffness, p.length, *p.anchor]
        case Attraction():
            return [p.strength, *p.centre]
        case Expression():
            return [p.energy]
        case Damping():
            return [p.coefficient]
        case Place():
            return [*p.at]
        case PointBody():
            return [*p.masses, *(x for r in p.positions for x in r)]
        case GivenBody():
            return [p.mass, *p.first, *(x for row in p.second for x in row)]
    return []
