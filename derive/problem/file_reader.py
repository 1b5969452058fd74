"""The values of a problem file, where they depend on the group and the body: a method for each
type of a key; rotations by axis and angle, roll, pitch and yaw, a quaternion, or rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from ..algebra.groups import Group, names_by_block
from ..language import rational as q
from ..language.expression import ExpressionError, parse
from ..language.laurent import LEVEL, WRITTEN, degree_in_level, is_layered
from ..language.limits import BASIS, LAYERS, MATRIX, TEXT
from ..language.reserved import taken
from ..language.tree import Tree, mul, nodes, replaced
from ..language.values import approximate
from ..schema.body_kinds import LAYERED, Body, GivenBody, PointBody, is_ellipsoid
from ..schema.kind import SIDES, Advected
from ..schema.table import Rows, Slot, Table
from ..schema.table_reader import NAME, TableReader
from .entries_on_orbit import with_constant_entries
from .fields import is_entry, known_in_lagrangian, meant, state_names
from .force_reader import ForceReader, Vector
from .moments import first_moment, given_by, require_symmetric, second_moment
from .problem import ProblemError, SolidError, points_of
from .solids import (
    fault_of_quadric,
    product_of,
    rotation_about,
    rotation_by_angles,
    rotation_of_quaternion,
)

TURNS: dict[str, tuple[int, Callable[..., Rows]]] = {
    "rpy": (3, rotation_by_angles),
    "quaternion": (4, lambda *x: rotation_of_quaternion(x)),
}
"""Key of a rotation of R³ → of how many numbers, and the rows that they give."""
ROTATION_KEYS = ("rotation", *TURNS)
"""The keys of a table that is turned."""


def turn_in(table: Mapping[str, Any], where: str) -> tuple[str, Any]:
    """By which of its ROTATION_KEYS a table says a rotation, and what it says; "" for none."""
    said = [x for x in ROTATION_KEYS if x in table]
    if len(said) > 1:
        raise ProblemError(f"{where}: give one of {said[0]} and {said[1]}")
    if not said:
        return "", None
    (name,) = said
    return name, table[name] if name == "rotation" else {name: table[name]}


def rotation(value: Any, n: int, where: str, reader: TableReader) -> Rows:
    """{ axis, angle }, { rpy } or { quaternion } in R³, or a matrix of numbers that is a rotation
    of Rⁿ."""
    if isinstance(value, dict):
        if n != 3:
            name = next((x for x in TURNS if x in value), "axis")
            told = "[[c, -s], [s, c]] with numbers" if n == 2 else f"{n} rows of {n} numbers"
            raise ProblemError(f"{where}: {name!r} is of R^3; give rotation = {told}")
        try:
            return _in_words(value, where, reader)
        except SolidError as error:
            raise ProblemError(f"{where}: {error}") from None
    words = ("{ axis, angle }", *(f"{{ {x} }}" for x in TURNS)) if n == 3 else ()
    other, exact = (f", or {words[0]}", f"; {words[0]} is exact") if words else ("", "")
    if not isinstance(value, list) or len(value) != n:
        listed = f"{', '.join(words)} or " if words else ""
        raise ProblemError(f"{where}: expected {listed}a list of {n} rows")
    if not all(isinstance(row, list) for row in value):
        raise ProblemError(f"{where}: expected {n} rows of {n} numbers{other}")
    rows = reader.rows(value, n, n, where)
    if not all(isinstance(x, (int, Fraction)) for row in rows for x in row):
        raise ProblemError(
            f"{where}: the entries must be numbers{other.replace(', or', '; else give')}"
        )
    R = tuple(tuple(Fraction(str(x)) for x in row) for row in rows)
    off = q.minus(q.times(R, q.transposed(R)), q.identity(n))
    if max(abs(x) for x in q.flatten(off)) > Fraction(1, 10**6):
        raise ProblemError(f"{where}: the rows are not orthogonal unit vectors{exact}")
    if q.determinant(R) < 0:
        raise ProblemError(f"{where}: a reflection; change the sign of one row")
    return rows


def _in_words(table: Mapping[str, Any], where: str, reader: TableReader) -> Rows:
    """A rotation of R³ by a key of TURNS, or by its axis and angle."""
    name = next((x for x in TURNS if x in table), "")
    reader.known(table, {name} if name else {"axis", "angle"}, where)
    if name:
        size, rows_of = TURNS[name]
        return rows_of(*reader.listed(table[name], size, f"{where}, {name}"))
    axis = reader.listed(reader.value(Slot(table, "axis", where)), 3, f"{where}, axis")
    return rotation_about(axis, reader.scalar(Slot(table, "angle", where)))


CHAPTERS = ("linear", "affine", "discrete", "discrete_affine", *SIDES)
"""The names of what is said of any group."""


class FileReader(ForceReader):
    """Reads the tables of a file in a folder; ``heavy``: the body has mass outside its points;
    ``fills_ellipsoid``: it is a homogeneous one; ``in_layers``: the density of a solid depends on
    the level; ``advected``: what an algebra without g carries along; ``by_block``: names of the
    velocity by the blocks of a product → those of the state."""

    def __init__(self, folder: Path = Path()) -> None:
        self.folder, self.group = folder, None
        self.parameters, self.point_masses, self.places = {}, (), []
        self.heavy = self.fills_ellipsoid = self.in_layers = False
        self.advected: tuple[Advected, ...] | None = None
        self.by_block: dict[str, str] = {}

    def moves(self, group: Group | None) -> None:
        """From here on the group is known,"""
        self.group = group
        self.blocks = len(group.places) if group else 1
        running = names_by_block(group) if group else {}
        self.by_block = {own: name for name, own in running.items()}

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
                f"or SE(2), and not for {g.name}; give springs to the body's points, or L in an "
                "[inertia] table, with this potential as its U"
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

    @property
    def state_names(self) -> dict[str, Tree]:
        """Name → what it stands for in a Lagrangian."""
        return known_in_lagrangian(self.moving(), self.advected)

    def space(self, _: Slot) -> int:
        """The dimension of its space."""
        return self.moving().n

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

    def masses(self, *_: Any) -> tuple[()]:
        """Those of the points."""
        return ()

    # -- expressions ---------------------------------------------------------------------------

    def expression(self, value: Any, where: str) -> Tree:
        """A number or a string of the grammar, where t may be the time."""
        if isinstance(value, bool) or not isinstance(value, (int, float, str)):
            raise ProblemError(f"{where}: expected a number or an expression in quotes")
        if isinstance(value, float) and not math.isfinite(value):
            raise ProblemError(f"{where}: {value} is not a finite number")
        try:
            found = parse(value if isinstance(value, str) else repr(value))
        except ExpressionError as error:
            raise ProblemError(f"{where}: {error}") from None
        own = {x: ("par", y) for x, y in self.by_block.items() if x not in self.parameters}
        found = meant(found, own) if own else found
        return replaced(found, ("par", "t"), "t") if self.timed else found

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

    def lettered(self, slot: Slot) -> Tree:
        """An expression in the names of the state."""
        return meant(self.scalar(slot), self.state_names)

    def coordinates(self, slot: Slot) -> Vector:
        """One for each coordinate of the Lie algebra."""
        found = self.listed(self.value(slot), self.moving().dimension, slot.path)
        return tuple(meant(t, self.state_names) for t in found)

    def meaning_of(self, name: str) -> str:
        """A parameter, or what the grammar or the state has."""
        if name in self.parameters:
            return "a parameter"
        return taken(name) or ("an entry of the state" if name in self.state_names else "")

    def rate(self, slot: Slot) -> Rows:
        """Of the entries of g, numbers where they are the same in all of the group."""
        g = self.moving()
        entries = {x: t for x, t in self.state_names.items() if is_entry(t)}
        found = self.rows(self.value(slot), g.size, g.size, slot.path)
        try:
            return tuple(
                tuple(with_constant_entries(meant(t, entries), g) for t in row) for row in found
            )
        except ZeroDivisionError:
            raise ProblemError(
                f"{slot.path}: it divides by an entry of g that is 0 on {g.name}"
            ) from None

    def operator(self, slot: Slot) -> Rows:
        """A matrix of its size."""
        g = self.moving()
        found = self.rows(self.value(slot), g.dimension, g.dimension, slot.path)
        names = state_names(g)
        return tuple(tuple(meant(t, names) for t in row) for row in found)

    def watched(self, slot: Slot) -> Tree:
        """An expression of the state, the parameters and the time."""
        return self.in_time(self.value(slot), slot.path)

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
            require_symmetric(rows, f"{where}, {name}")
        turn, said = turn_in(slot.table, where)
        if turn:
            R = self.turned(said, n, f"{where}, {turn}" if turn == "rotation" else where)
            try:
                rows = q.symmetrised(product_of(product_of(R, rows), q.transposed(R)))
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
        require_symmetric(found, slot.path)
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
