"""The values of forces, inputs, damping and potentials in a problem file: where they act, vectors,
expressions of places and of the state; and dimensions, where units say them: what is a force
must be in N.

Only what is certain is refused of dimensions: a term without a parameter that has a unit, and one
with a unit that is not of these, may be in anything.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any
from unicodedata import normalize

from ..algebra.groups import Group
from ..language.reserved import PLACE, acting_names
from ..language.tree import Tree, nodes, replaced, terms
from ..language.values import approximate
from ..schema.body_kinds import Place, Point
from ..schema.force_kinds import Acting, Damping, Input
from ..schema.kind import Advected
from ..schema.potential_kinds import Potential
from ..schema.table import DETERMINANT, Slot
from ..schema.table_reader import TableReader
from .fields import (
    LIKE_A_PLACE,
    known_in_lagrangian,
    meant,
    names_at_place,
    names_of_points,
    velocity_at_place,
)
from .problem import ProblemError

Dimension = tuple[Fraction | int, ...]
"""The exponents of kg, m and s."""
BASE = ("kg", "m", "s")
NUMBER: Dimension = (0, 0, 0)
FORCE, MOMENT, VELOCITY = (1, 1, -2), (1, 2, -2), (0, 1, -1)
LENGTH, TIME, RATE = (0, 1, 0), (0, 0, 1), (0, 0, -1)
UNITS: Mapping[str, Dimension] = {
    **{"kg": (1, 0, 0), "m": LENGTH, "s": TIME, "rad": NUMBER, "1": NUMBER, "Hz": RATE},
    **{"N": FORCE, "J": MOMENT, "W": (1, 2, -3), "Pa": (1, -1, -2)},
}
FORCES: Mapping[Dimension, str] = {FORCE: "N", MOMENT: "N m"}
WANTED: Mapping[str, Dimension] = {
    **{"a force": FORCE, "a moment": MOMENT, "a linear damping": (1, 0, -1)},
    **{"a quadratic damping": (1, -1, 0), "a rotational damping": (1, 2, -1)},
}
FACTOR = re.compile(r"\s*([*/· .]?)\s*([^\W\d_]+|1)(?:\^?\(?(-?\d+)\)?)?")
OF_PLACE = re.compile(r"\b[rv]_[0-9]")
PURE = {"sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "atan"}


def measured(unit: str) -> Dimension | None:
    """The dimension of a unit, as N s/m; ``None`` where it is not made of these of SI, or where
    it is not clear what is below its line, as in N/m s."""
    found, at, text = NUMBER, 0, normalize("NFKC", unit).strip()
    below = False
    while at < len(text):
        factor = FACTOR.match(text, at)
        if not factor or factor[2] not in UNITS or (below and factor[1] != "/"):
            return None
        below = factor[1] == "/"
        k = int(factor[3] or 1) * (-1 if below else 1)
        found = tuple(a + k * b for a, b in zip(found, UNITS[factor[2]], strict=True))
        at = factor.end()
    return found if text else None


def in_units(d: Dimension) -> str:
    """A dimension as a unit: N, N m, kg m/s."""
    told = {
        sign: [
            x + (f"^{abs(e)}" if abs(e) != 1 else "")
            for x, e in zip(BASE, d, strict=True)
            if e * sign > 0
        ]
        for sign in (1, -1)
    }
    return FORCES.get(d) or "/".join([" ".join(told[1]) or "1", *told[-1]])


def dimension(t: Tree, known: Mapping[Any, Dimension]) -> Dimension | None:
    """That of a tree, by those of parameters and of entries, numbers having none; ``None`` where it
    is not known."""
    if not isinstance(t, tuple):
        return TIME if t == "t" else NUMBER
    op, *parts = t
    if op == "par":
        return known.get(parts[0])
    if op == "entry":
        return known.get(t)
    if op == "fun":
        inside = dimension(parts[1], known) if parts[0] == "sqrt" else None
        return NUMBER if parts[0] in PURE else inside and tuple(Fraction(x) / 2 for x in inside)
    if op == "pow":
        inside = dimension(parts[0], known)
        return inside and tuple(x * parts[1] for x in inside)
    found = [dimension(x, known) for x in parts if op != "add" or isinstance(x, tuple)]
    if op == "add":  # a number in a sum is in what the others are in
        return next((x for x in found if x is not None), None)
    if op not in ("mul", "div") or None in found:
        return None
    signs = (1, -1) if op == "div" else (1,) * len(found)
    whole = [tuple(k * x for x in d) for k, d in zip(signs, found, strict=True) if d is not None]
    return tuple(map(sum, zip(*whole, strict=True)))


AXES = "xyz"
Vector = tuple[Tree, ...]


class ForceReader(TableReader):
    """Reads what acts on points and blocks, and what is read of them; ``places``: those that forces
    have named so far.

    ``potentials``: those that the problem has; ``observing``: is what is read off motions being
    read, whose places may be those of forces?  ``acts``: the names of what acts.  ``pointless``: no
    points give the Lagrangian, where an algebra carries along what is ``advected``;
    ``on_the_right``: and Z is ġg⁻¹."""

    error = ProblemError
    numbered = "[[point]] tables"
    group: Group | None
    parameters: Mapping[str, Any]
    point_masses: tuple[Point, ...]
    places: list[Place]
    potentials: tuple[Potential, ...] = ()
    advected: tuple[Advected, ...] | None = None
    observing = pointless = on_the_right = False
    acts: Collection[str] = ()

    # -- where it acts -------------------------------------------------------------------------

    def moving(self) -> Group:
        """The group, where there must be one."""
        assert self.group is not None
        return self.group

    def _sizes(self) -> set[int]:
        return {g.n for _, g in self.moving().places}

    def of_place(self, i: int) -> tuple[int, int]:
        """The first row, and how many, of the coordinates of point i in space."""
        first, factor = self.factor_of(i)
        return first, factor.n

    @property
    def listed_places(self) -> list[Point | Place]:
        """The points and the places of forces, in the order of their numbers."""
        return [*self.point_masses, *self.places]

    def dimension(self, slot: Slot) -> int:
        """Of the space of the block, or of the end that is given, or of all points."""
        if slot.about.type == "place" or "block" in slot.found:
            block = self.block(Slot(slot.table, "block", slot.where))
            return self.moving().places[block - 1][1].n
        return self.of_place(slot.found["on"])[1] if slot.found.get("on") else max(self._sizes())

    def block(self, slot: Slot) -> int:
        """1 where the table does not say it."""
        value = slot.table.get(slot.key, 1)
        if self.blocks == 1 and value != 1:
            name = self.moving().name
            raise ProblemError(f"{slot.path}: {name} is no product: there is one block")
        return self.integer(value, 1, self.blocks, slot.path)

    def pair(self, slot: Slot) -> tuple[int, int]:
        """Two points, in spaces of one dimension."""
        i, j = super().pair(slot)
        if self.of_place(i)[1] != self.of_place(j)[1]:
            raise ProblemError(
                f"{slot.where}: the points {i} and {j} are in spaces of two dimensions"
            )
        return i, j

    def end(self, slot: Slot) -> int:
        """The point of ``on``, or a new place at ``at``."""
        table, where = slot.table, slot.where
        if "on" in table:
            if "at" in table:
                raise ProblemError(f"{where}: give either 'on' or 'at'")
            if "block" in table:
                raise ProblemError(f"{where}: a point has a block of its own; leave out 'block'")
            if not self.point_masses:
                raise ProblemError(
                    f"{where}, on: there are no {self.numbered} to number; give 'at', a place of "
                    "the body"
                )
            listed = _as_list(table["on"])
            if len(listed) != 1:
                raise ProblemError(f"{where}: key 'on' must be one point")
            return self.point(listed[0], f"{where}, on")
        if _is_free_moment(table):
            block = self.block(Slot(table, "block", where))
            table = {**table, "at": [0] * self.moving().places[block - 1][1].n}
        if "at" not in table:
            given = "'on' or 'at'" if self.point_masses else "'at', a place of the body,"
            raise ProblemError(f"{where}: key {given} is missing")
        found = Place.read(table, where, self)
        if not (self.observing and found in self.places):
            self.places.append(found)
        last = len(self.places) - 1 - self.places[::-1].index(found)
        return len(self.point_masses) + last + 1

    def points(self, slot: Slot) -> tuple[int, ...]:
        """A place of the body; or points, by a number or a list, all without either."""
        key, where = slot.key, slot.where
        if "at" in slot.table:
            return (self.end(slot),)
        if not self.point_masses:
            other = "" if self.pointless else ", or [[point]] tables"
            raise ProblemError(f"{where}: give a place of the body under 'at'{other}")
        listed = slot.table.get(key, [*range(1, self.last + 1)])
        if not listed and isinstance(listed, list):
            raise ProblemError(f"{where}: key {key!r} must be a point or a list of points")
        on = tuple(self.point(i, slot.path) for i in _as_list(listed))
        if len(set(on)) != len(on):
            raise ProblemError(f"{where}: key {key!r} names a point twice")
        return on

    # -- vectors -------------------------------------------------------------------------------

    def turning(self, slot: Slot) -> int:
        """The same, whose linear parts are rotations of the plane or of R³."""
        found: int = self.block(slot)
        is_read = slot.table.get("kind") == "rate"
        self._turned(self.moving().places[found - 1][1], slot.where, is_read=is_read)
        return found

    def _turned(self, factor: Group, where: str, *, is_read: bool = False) -> None:
        if "orthogonal" not in factor.relations or factor.n not in (2, 3):
            what, other = "a torque", "give forces at places, or a covector"
            if is_read:
                what, other = "a rate", "give expressions 'y' of zeta_1, …"
            raise ProblemError(
                f"{where}: {what} needs linear parts that are rotations of the plane or of R^3, "
                f"and those of {factor.name} are others; {other}"
            )

    def direction(self, slot: Slot) -> Vector:
        """A vector of the space of the force, or of the torque, that is not 0."""
        if slot.table["kind"] == "torque" and self.dimension(slot) == 2:
            raise ProblemError(f"{slot.path}: a torque in the plane is one number; leave it out")
        found = self.vector(slot)
        values = {k: p.default for k, p in self.parameters.items() if p.default is not None}
        if all(approximate(x, values) == 0 for x in found):
            raise ProblemError(f"{slot.path}: it has the length 0; give a vector that is not 0")
        return found

    def couple(self, slot: Slot) -> Vector:
        """The moment that goes with a force: a vector of R³, or a list of one number in the
        plane."""
        return self.listed(self.value(slot), self._turns_by(slot), slot.path)

    def wind(self, slot: Slot) -> Vector:
        """A velocity in space of t and the place r_1, …."""
        on = slot.found["on"]
        first, n = self.of_place(on)
        named = names_at_place(n, first, on)
        found = self.listed(self.value(slot), n, slot.path, self.in_time)
        return tuple(meant(t, named) for t in found)

    def stated(self, slot: Slot) -> Vector:
        """A vector of expressions of the state at a place, which has a velocity there."""
        return self._of_state(slot, self.of_place(slot.found["on"])[1], "a force")

    def stated_couple(self, slot: Slot) -> Vector:
        """Three of them in R³, one in the plane."""
        return self._of_state(slot, self._turns_by(slot), "a moment")

    def _turns_by(self, slot: Slot) -> int:
        """How many numbers a moment at a place has."""
        _, factor = self.factor_of(slot.found["on"])
        self._turned(factor, slot.where)
        return 3 if factor.n == 3 else 1

    def stated_covector(self, slot: Slot) -> Vector:
        """One for each element of the basis."""
        return self._of_state(slot, self.moving().dimension)

    def other_end(self, slot: Slot) -> int:
        """A point in a space of the same dimension."""
        other = super().other_end(slot)
        if self.of_place(other)[1] != self.of_place(slot.found["on"])[1]:
            raise ProblemError(f"{slot.where}, to: the points are in spaces of two dimensions")
        return other

    def observed(self, slot: Slot) -> Vector:
        """Some expressions of the state, which know a place where the table says one."""
        return self._of_state(slot, None)

    def is_spring(self, k: int) -> bool:
        """Is it one of those that have been read?"""
        return 1 <= k <= len(self.potentials) and self.potentials[k - 1].kind == "spring"

    def knows_acting(
        self, inputs: Iterable[Input], forces: Iterable[Acting], damping: Sequence[Damping] = ()
    ) -> None:
        """Remember by what names these act."""
        kinds = {x.name: x.kind for x in inputs}
        self.acts = acting_names(kinds, [x.name or "" for x in forces], damped=bool(damping))

    def acting_names(self) -> Collection[str]:
        """Those of what has been read."""
        return self.acts

    def _of_state(self, slot: Slot, count: int | None, what: str = "") -> Vector:
        """Expressions of the state, in the unit of ``what`` they are, if it has one."""
        found, on, group = slot.found, slot.found.get("on"), self.moving()
        named = (
            known_in_lagrangian(group, self.advected) if self.pointless else names_of_points(group)
        )
        if on:
            first, n = self.of_place(on)
            wind = found.get("relative_to") or (0,) * n
            named |= names_at_place(n, first, on)
            named |= velocity_at_place(n, first, on, wind, turned=found.get("frame") == "body")
        listed = self.listed(self.value(slot), count, slot.path, self.in_time)
        for k, t in enumerate(listed, 1):
            self.require_unit(t, what, f"{slot.path}, entry {k}", named)
        return tuple(meant(t, named) for t in listed)

    def require_unit(self, t: Tree, what: str, where: str, named: Collection[str] = ()) -> None:
        """``ProblemError`` where the units of parameters, beside ``named`` numbers of the state, do
        not fit ``what`` an expression is, term by term. None where no unit has a mass: the numbers
        of such a problem may be in parts of anything."""
        stated = {x: p.unit for x, p in self.parameters.items()}
        units = {x: d for x, unit in stated.items() if (d := measured(unit)) is not None}
        wanted = WANTED.get(what)
        if wanted is None or not any(d[0] for d in units.values()):
            return
        turns = all(f.name.startswith(("SO(", "SE(")) for _, f in self.moving().places)
        letters = {"v": VELOCITY, "r": LENGTH}
        letters |= {"zeta": RATE, "w": VELOCITY} if turns and not self.pointless else {}
        known = {x: letters[y] for x in named if (y := x.rstrip("_0123456789")) in letters}
        for term in terms(t):
            own = [x[1] for x in nodes(term) if isinstance(x, tuple) and x[0] == "par"]
            found = dimension(term, {**known, **units}) if {*own} & {*units} else None
            if found is not None and found != wanted:
                given = ", ".join(f"{x} in {stated[x]}" for x in dict.fromkeys(own) if x in units)
                raise ProblemError(
                    f"{where}: with {given} it is in {in_units(found)}, and {what} is in "
                    f"{in_units(wanted)}; correct the unit or the expression"
                )

    def factor_of(self, on: int) -> tuple[int, Group]:
        """The first row, and the factor that moves a point or place."""
        return self.moving().places[self.listed_places[on - 1].block - 1]

    # -- potentials ----------------------------------------------------------------------------

    def in_time(self, value: Any, where: str) -> Tree:
        """The time, where an expression says t."""
        return replaced(self.expression(value, where), ("par", "t"), "t")

    def energy(self, slot: Slot) -> Tree:
        """An expression of places in space, with one at least."""
        U = self._placed(self.scalar(slot), slot.where)
        if not any(x[0] == "at" for x in nodes(U) if isinstance(x, tuple)):
            raise ProblemError(
                f"{slot.path}: no place of a point, as r1_x, so no force; leave it out, or write "
                "an angle by places, as atan2(r1_y, r1_x)"
            )
        return U

    def of_volume(self, slot: Slot) -> Tree:
        """An expression of ``det_A``, which must be in it, and the time."""
        found = replaced(self.scalar(slot), ("par", "det_A"), DETERMINANT)
        if DETERMINANT not in nodes(found):
            raise ProblemError(f"{slot.path}: no det_A, the volume, so no force; leave it out")
        return found

    def _placed(self, t: Tree, where: str) -> Tree:
        """r1_x, r1_2, … as entries of the places in space."""
        if not isinstance(t, tuple):
            return t
        if t[0] != "par":
            return (t[0], *(self._placed(x, where) for x in t[1:]))
        name = t[1]
        match = PLACE.fullmatch(name)
        if match is None:
            if LIKE_A_PLACE.fullmatch(name) and name not in self.parameters:
                raise ProblemError(
                    f"{where}: {name!r}: a place in space is r1_x, r1_y, r1_z, or r1_1, r1_2, …"
                )
            return t
        i = int(match[1])
        if not self.point_masses:
            raise ProblemError(f"{where}: {name!r}: there are no {self.numbered} to number")
        if not 1 <= i <= self.last:
            raise ProblemError(f"{where}: {name!r}: the points are r1 … r{self.last}")
        k = AXES.index(match[2]) + 1 if match[2] else int(match[3])
        first, n = self.of_place(i)
        if not 1 <= k <= n:
            raise ProblemError(f"{where}: {name!r}: point {i} has {n} coordinates")
        return ("entry", ("call", ("at", "r", i), "t"), first + k)


def _is_free_moment(table: Mapping[str, Any]) -> bool:
    """Is it a moment without a place, the same at all, that knows none?"""
    alone = "moment" in table and {"at", "force", "direction", "relative_to"}.isdisjoint(table)
    return alone and not OF_PLACE.search(str(table["moment"]))


def _as_list(value: Any) -> list[Any]:
    """A number of a point, or a list of them."""
    return value if isinstance(value, list) else [value]
