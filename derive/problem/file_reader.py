"""The values of a problem file, where they depend on the group and the body: a method for each type
of a key."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.expression import ExpressionError, parse
from ..language.laurent import LEVEL, WRITTEN, degree_in_level, is_layered
from ..language.limits import BASIS, LAYERS, MATRIX, TEXT
from ..language.reserved import PLACE
from ..language.tree import Tree, mul, nodes, replaced, subtrees
from ..language.values import approximate
from ..schema.body_kinds import LAYERED, Body, GivenBody, Place, Point, PointBody, is_ellipsoid
from ..schema.kind import SIDES, Advected, Potential
from ..schema.table import DETERMINANT, Rows, Slot, Table
from ..schema.table_reader import NAME, TableReader
from .fields import (
    LIKE_A_PLACE,
    known_in_lagrangian,
    meant,
    names_at_place,
    names_of_points,
    state_names,
    velocity_at_place,
)
from .moments import SolidError, first_moment, given_by, second_moment
from .problem import ProblemError, points_of
from .rotations import rotation, turn_in
from .solids import fault_of_quadric, product_of

AXES = "xyz"
CHAPTERS = ("linear", "affine", "discrete", "discrete_affine", *SIDES)
"""The names of what is said of any group."""
Vector = tuple[Tree, ...]


class FileReader(TableReader):
    """Reads the tables of a file in a folder; ``places``: those that forces have named so far.

    ``heavy``: the body has mass outside its points; ``fills_ellipsoid``: it is a homogeneous one;
    ``in_layers``: the density of a solid depends on the level;
    ``advected``: what an algebra without g carries along; ``potentials``: those that it has;
    ``observing``: is what is read off motions being read, whose places may be those of forces?
    ``pointless``: no points give the Lagrangian.
    """

    error = ProblemError
    numbered = "[[point]] tables"

    def __init__(self, folder: Path = Path()) -> None:
        self.folder, self.group = folder, None
        self.parameters: Mapping[str, Any] = {}
        self.point_masses: tuple[Point, ...] = ()
        self.places: list[Place] = []
        self.potentials: tuple[Potential, ...] = ()
        self.observing = self.pointless = False
        self.heavy = self.fills_ellipsoid = self.in_layers = False
        self.advected: tuple[Advected, ...] | None = None

    group: Group | None

    def moves(self, group: Group | None) -> None:
        """From here on the group is known,"""
        self.group = group
        self.blocks = len(group.places) if group else 1

    def carries(self, body: Body | None, parameters: Mapping[str, Any]) -> None:
        """and from here on the body."""
        self.parameters, self.point_masses = parameters, points_of(body)
        self.count = self.last = len(self.point_masses)
        self.heavy = not isinstance(body, PointBody)
        self.fills_ellipsoid = is_ellipsoid(body)
        solids = body.solids if isinstance(body, GivenBody) else ()
        self.in_layers = any(is_layered(x.density) for x in solids)

    def name_of(self, data: Mapping[str, Any], *, of_its_own: bool = True) -> str:
        """The name of a problem: a prefix of labels that nothing else has, if it is ``of_its_own``
        and no text about any group."""
        name = self.identifier(self.text(Slot(data, "name", "file")), "key 'name'")
        if of_its_own and name in CHAPTERS:
            raise ProblemError(
                f"key 'name': {name!r} names what is said of any group; choose another"
            )
        return name

    def title_of(self, data: Mapping[str, Any], name: str) -> str:
        """The title of a problem; its name without one."""
        return self.text(Slot(data, "title", "file")) if "title" in data else name

    def names(self, own: type[Table]) -> tuple[str, ...]:
        """The keys of a file."""
        return own.names()

    def has(self, slot: Slot) -> bool:
        """Does the table say it?"""
        keys = slot.about.keys
        return any(x in slot.table for x in ((slot.key,) if keys is None else keys))

    def meets(self, need: str, kind: str, where: str) -> None:
        """``points alone``: nothing else has mass; ``one space``: all blocks are of one dimension,
        or the points where there are some."""
        g = self.moving()
        if need == "points alone" and (not self.point_masses or self.heavy):
            raise ProblemError(f"{where}: {kind} needs a body of [[point]] tables alone")
        if need == "one space" and len(self._sizes()) > 1:
            more = "; use 'expression'" if kind == "gravity" else ""
            raise ProblemError(f"{where}: {kind} needs blocks of one dimension{more}")
        if need == "rotations" and ("orthogonal" not in g.relations or g.factors):
            raise ProblemError(
                f"{where}: {kind} needs one group whose linear parts are rotations, as SO(3) or "
                f"SE(3); those of {g.name} are others"
            )
        if need == "deformations of R^3" and (g.n != 3 or g.factors or "orthogonal" in g.relations):
            rigid = "; where linear parts are rotations it is a constant" * (g.n == 3)
            raise ProblemError(
                f"{where}: {kind} needs one group that deforms R^3, as SL(3), GL(3) or Aff(3), "
                f"not {g.name}{rigid}"
            )
        if need == "one ellipsoid" and self.in_layers:
            raise ProblemError(
                f"{where}: {kind} is of a homogeneous ellipsoid, and the density of this body "
                "depends on the level s; give it one without s"
            )
        if need == "one ellipsoid" and not self.fills_ellipsoid:
            raise ProblemError(
                f"{where}: {kind} is of a body that is one homogeneous ellipsoid about the origin; "
                'give [body] solid = "ellipsoid", without points or shift'
            )
        if need == "no turning" and (g.factors or g.turns_space):
            raise ProblemError(
                f"{where}: {kind} is for one group that is walked in matrices, as SL(3), SAff(3) "
                f"or SE(2), and not for {g.name}; give springs to the body's points"
            )
        if need == "volumes" and (g.factors or "unimodular" in g.relations):
            raise ProblemError(
                f"{where}: {kind} needs one group that changes volumes, as GL(3) or Aff(3); "
                + (f"{g.name} is a product" if g.factors else f"det A = 1 on {g.name}")
            )
        if need == "affine of R^3" and (g.n != 3 or not g.free_translations or g.factors):
            raise ProblemError(
                f"{where}: {kind} needs a group with all translations of R^3, as SE(3) or Aff(3)"
            )

    # -- the group and its spaces --------------------------------------------------------------

    def moving(self) -> Group:
        """The group, where there must be one."""
        assert self.group is not None
        return self.group

    @property
    def state_names(self) -> dict[str, Tree]:
        """Name → what it stands for in a Lagrangian."""
        return known_in_lagrangian(self.moving(), self.advected)

    def space(self, _: Slot) -> int:
        """The dimension of its space."""
        return self.moving().n

    def _sizes(self) -> set[int]:
        return {g.n for _, g in self.moving().places}

    def of_place(self, i: int) -> tuple[int, int]:
        """The first row, and how many, of the coordinates of point i in space."""
        first, factor = self._factor_of(i)
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
        _, factor = self._factor_of(slot.found["on"])
        self._turned(factor, slot.where)
        return self.listed(self.value(slot), 3 if factor.n == 3 else 1, slot.path)

    def wind(self, slot: Slot) -> Vector:
        """A velocity in space of t and the place r_1, …."""
        on = slot.found["on"]
        first, n = self.of_place(on)
        named = names_at_place(n, first, on)
        found = self.listed(self.value(slot), n, slot.path, self.in_time)
        return tuple(meant(t, named) for t in found)

    def stated(self, slot: Slot) -> Vector:
        """A vector of expressions of the state at a place, which has a velocity there."""
        return self._of_state(slot, self.of_place(slot.found["on"])[1])

    def stated_couple(self, slot: Slot) -> Vector:
        """Three of them in R³, one in the plane."""
        _, factor = self._factor_of(slot.found["on"])
        self._turned(factor, slot.where)
        return self._of_state(slot, 3 if factor.n == 3 else 1)

    def other_end(self, slot: Slot) -> int:
        """A point in a space of the same dimension."""
        other = super().other_end(slot)
        if self.of_place(other)[1] != self.of_place(slot.found["on"])[1]:
            raise ProblemError(f"{slot.where}, to: the points are in spaces of two dimensions")
        return other

    def observed(self, slot: Slot) -> Vector:
        """Some expressions of the state, which know a place where the table says one."""
        if self.pointless:
            known = known_in_lagrangian(self.moving(), self.advected)
            found = self.listed(self.value(slot), None, slot.path, self.in_time)
            return tuple(meant(t, known) for t in found)
        return self._of_state(slot, None)

    def is_spring(self, k: int) -> bool:
        """Is it one of those that have been read?"""
        return 1 <= k <= len(self.potentials) and self.potentials[k - 1].kind == "spring"

    def _of_state(self, slot: Slot, count: int | None) -> Vector:
        found, on = slot.found, slot.found.get("on")
        named = names_of_points(self.moving())
        if on:
            first, n = self.of_place(on)
            wind = found.get("relative_to") or (0,) * n
            named |= names_at_place(n, first, on)
            named |= velocity_at_place(n, first, on, wind, turned=found.get("frame") == "body")
        listed = self.listed(self.value(slot), count, slot.path, self.in_time)
        return tuple(meant(t, named) for t in listed)

    def _factor_of(self, on: int) -> tuple[int, Group]:
        """The first row, and the factor that moves a point or place."""
        return self.moving().places[self.listed_places[on - 1].block - 1]

    def letters(self, slot: Slot) -> str:
        """As those of a name, which may be a word of another language."""
        name = self.text(slot)
        if not NAME.fullmatch(name):
            raise ProblemError(f"{slot.where}: key {slot.key!r}: letters, digits and _ only")
        return name

    def basis(self, slot: Slot) -> tuple[q.Matrix, ...]:
        """Matrices over Q."""
        listed = self.value(slot)
        if not isinstance(listed, list) or len(listed) > BASIS:
            raise ProblemError(f"{slot.where}: key 'basis' must list at most {BASIS} matrices")
        where = f"{slot.where}, element {{}} of the basis"
        return tuple(self._matrix(e, where.format(a)) for a, e in enumerate(listed, 1))

    def _matrix(self, value: Any, where: str) -> q.Matrix:
        if not isinstance(value, list) or not all(isinstance(row, list) for row in value):
            raise ProblemError(f"{where}: expected a list of rows")
        if len(value) > MATRIX or any(len(row) > MATRIX for row in value):
            raise ProblemError(f"{where}: larger than {MATRIX} × {MATRIX}")
        rows = tuple(tuple(self.expression(x, where) for x in row) for row in value)
        if not all(isinstance(x, (int, Fraction)) for row in rows for x in row):
            raise ProblemError(f"{where}: the entries of a basis must be rational numbers")
        return tuple(tuple(Fraction(str(x)) for x in row) for row in rows)

    # -- points --------------------------------------------------------------------------------

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
            if not self.point_masses:
                raise ProblemError(
                    f"{where}, on: there are no {self.numbered} to number; give 'at', a place of "
                    "the body"
                )
            listed = _as_list(table["on"])
            if len(listed) != 1:
                raise ProblemError(f"{where}: key 'on' must be one point")
            return self.point(listed[0], f"{where}, on")
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
            raise ProblemError(f"{where}: give a place of the body under 'at', or [[point]] tables")
        listed = slot.table.get(key, [*range(1, self.last + 1)])
        if not listed and isinstance(listed, list):
            raise ProblemError(f"{where}: key {key!r} must be a point or a list of points")
        on = tuple(self.point(i, slot.path) for i in _as_list(listed))
        if len(set(on)) != len(on):
            raise ProblemError(f"{where}: key {key!r} names a point twice")
        return on

    def masses(self, *_: Any) -> tuple[()]:
        """Those of the points."""
        return ()

    # -- expressions ---------------------------------------------------------------------------

    def expression(self, value: Any, where: str) -> Tree:
        """A number or a string of the grammar."""
        if isinstance(value, bool) or not isinstance(value, (int, float, str)):
            raise ProblemError(f"{where}: expected a number or an expression in quotes")
        if isinstance(value, float) and not math.isfinite(value):
            raise ProblemError(f"{where}: {value} is not a finite number")
        try:
            return parse(value if isinstance(value, str) else repr(value))
        except ExpressionError as error:
            raise ProblemError(f"{where}: {error}") from None

    def layered(self, slot: Slot) -> Tree:
        """A density, where ``s`` may be the level of a place in an ellipsoid or a ball."""
        found = self.scalar(slot)
        if WRITTEN not in nodes(found) or (
            "s" in self.parameters and slot.table["kind"] not in LAYERED
        ):
            return found
        if slot.table["kind"] not in LAYERED:
            raise ProblemError(
                f"{slot.path}: 's' is the level <r, Q r> of a place in an ellipsoid or a ball, and "
                f"no parameter; of a {slot.table['kind']} the density is the same everywhere"
            )
        if "s" in self.parameters:
            raise ProblemError(
                f"{slot.path}: 's' is the level <r, Q r> of a place here, and a parameter as well; "
                "give the parameter another name"
            )
        found = replaced(found, WRITTEN, LEVEL)
        degree = degree_in_level(found)
        if degree is None:
            raise ProblemError(f"{slot.path}: no polynomial in 's', the level of a place")
        if degree > LAYERS:
            raise ProblemError(f"{slot.path}: of degree {degree} in 's'; at most {LAYERS}")
        return found

    def in_time(self, value: Any, where: str) -> Tree:
        """The time, where an expression says t."""
        return replaced(self.expression(value, where), ("par", "t"), "t")

    def energy(self, slot: Slot) -> Tree:
        """An expression of places in space, with one at least."""
        U = self._placed(self.scalar(slot), slot.where)
        if not any(x[0] == "at" for _, x in subtrees(U) if isinstance(x, tuple)):
            raise ProblemError(
                f"{slot.path}: no place of a point, as r1_x, so no force; leave it out"
            )
        return U

    def of_volume(self, slot: Slot) -> Tree:
        """An expression of ``det_A``, which must be in it, and the time."""
        found = replaced(self.in_time(self.value(slot), slot.path), ("par", "det_A"), DETERMINANT)
        if not any(x == DETERMINANT for _, x in subtrees(found)):
            raise ProblemError(f"{slot.path}: no det_A, the volume, so no force; leave it out")
        return found

    def _placed(self, t: Tree, where: str) -> Tree:
        """r1_x, r1_2, … as entries of the places in space; t as the time."""
        if not isinstance(t, tuple):
            return t
        if t[0] != "par":
            return (t[0], *(self._placed(x, where) for x in t[1:]))
        name = t[1]
        match = PLACE.fullmatch(name)
        if match is None and name != "t":
            if LIKE_A_PLACE.fullmatch(name) and name not in self.parameters:
                raise ProblemError(
                    f"{where}: {name!r}: a place in space is r1_x, r1_y, r1_z, or r1_1, r1_2, …"
                )
            return t
        if match is None:
            return "t"
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

    def lettered(self, slot: Slot) -> Tree:
        """An expression in the names of the state."""
        return meant(self.scalar(slot), self.state_names)

    def coordinates(self, slot: Slot) -> Vector:
        """One for each coordinate of the Lie algebra."""
        found = self.listed(self.value(slot), self.moving().dimension, slot.path)
        return tuple(meant(t, self.state_names) for t in found)

    def operator(self, slot: Slot) -> Rows:
        """A matrix of its size."""
        g = self.moving()
        found = self.rows(self.value(slot), g.dimension, g.dimension, slot.path)
        names = state_names(g)
        return tuple(tuple(meant(t, names) for t in row) for row in found)

    def watched(self, slot: Slot) -> Tree:
        """An expression of the state, the parameters and the time."""
        return self.in_time(self.value(slot), slot.path)

    def flag(self, slot: Slot) -> bool:
        """True or false."""
        return bool(self.value(slot, bool))

    # -- moments, solids, rotations ------------------------------------------------------------

    def first(self, slot: Slot) -> Vector:
        """c, or m times the centre of mass."""
        name = given_by(slot.table, ("c", "centre"), slot.where)
        found = self.listed(slot.table[name], self.moving().n, f"{slot.where}, {name}")
        return found if name == "c" else first_moment(slot.found["m"], found)

    def second(self, slot: Slot) -> Rows:
        """J, or in R³ a tensor of inertia, about the origin or the centre of mass, in axes of its
        own where a rotation is said; in the plane, of a body that turns, the number I."""
        n, where = self.moving().n, slot.where
        plane = n == 2 and "orthogonal" in self.moving().relations
        name = given_by(slot.table, ("J", "I", "I_centre") if n == 3 or plane else ("J",), where)
        if plane and name != "J":
            half = mul(Fraction(1, 2), self.expression(slot.table[name], f"{where}, {name}"))
            rows: Rows = ((half, 0), (0, half))
        else:
            rows = self.rows(slot.table[name], n, n, f"{where}, {name}")
        turn, said = turn_in(slot.table, where)
        if turn:
            R = self.turned(said, n, f"{where}, {turn}" if turn == "rotation" else where)
            try:
                rows = product_of(product_of(R, rows), q.transposed(R))
            except SolidError as error:
                raise ProblemError(f"{where}, {turn}: {error}") from None
        return second_moment(name, rows, slot.found["m"], slot.found["c"], where)

    def central(self, slot: Slot) -> bool:
        """That the moments are about the centre of mass."""
        return self.has(slot)

    def positive(self, size: Tree, slot: Slot) -> Tree:
        """No number below 0; nor 0, where a length may not be."""
        value = approximate(size, {})
        if value is not None and (value < 0 or (value == 0 and not slot.about.zero)):
            raise ProblemError(f"{slot.path}: a length that is not positive")
        return size

    def symmetric(self, slot: Slot) -> Rows:
        """A matrix of the size of the space."""
        n, value = self.space(slot), self.value(slot)
        found = self.rows(value, n, n, slot.path)
        if any(found[i][j] != found[j][i] for i in range(n) for j in range(i)):
            raise ProblemError(f"{slot.path}: the matrix must be symmetric")
        return found

    def quadric(self, slot: Slot) -> Rows:
        """A symmetric matrix of the size of the space, positive definite where that is known."""
        found = super().quadric(slot)
        if fault := fault_of_quadric(found, {}):
            raise ProblemError(f"{slot.path}: {fault}")
        return found

    def vertices(self, slot: Slot) -> tuple[tuple[Fraction, ...], ...]:
        """Those of the mesh in a file, which is read by what needs NumPy."""
        from .mesh import read

        path = self._file(Slot(slot.table, "file", slot.where))
        try:
            vertices, self._faces = read(path)
        except SolidError as error:
            raise ProblemError(f"{slot.where}: {error}") from None
        return vertices

    def faces(self, _: Slot) -> tuple[tuple[int, ...], ...]:
        """Those of the same."""
        return self._faces

    def _file(self, slot: Slot) -> Path:
        """The path of a mesh, inside the folder of the problem file."""
        value, where = self.value(slot), slot.path
        if not isinstance(value, str) or not value or not value.isprintable() or len(value) > TEXT:
            raise ProblemError(f"{where}: expected a file name in quotes, of letters that print")
        try:
            path = (self.folder / value).resolve()
        except (OSError, RuntimeError):  # a link to itself
            raise ProblemError(f"{where}: {value[:60]!r} leads nowhere") from None
        if not path.is_relative_to(self.folder.resolve()):
            raise ProblemError(f"{where}: {value[:60]!r} is outside the folder of the problem file")
        return path

    def turned(self, value: Any, n: int, where: str) -> Rows:
        """A rotation of Rⁿ."""
        return rotation(value, n, where, self)


def _as_list(value: Any) -> list[Any]:
    """A number of a point, or a list of them."""
    return value if isinstance(value, list) else [value]
