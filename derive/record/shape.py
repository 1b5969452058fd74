"""The form of a record's problem: types of values, and references, as its readers need them.

A record is read from strangers; what passes here has a value or is refused by name in the checker,
and can be drawn.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

from ..language.derivatives import DERIVATIVES
from ..language.limits import BASIS, TEXT
from ..language.reserved import WORDS, taken
from ..language.tree import OPERATORS, Tree
from ..schema.kinds import kinds
from ..schema.outside import INPUTS, Damping
from ..schema.solid_kinds import SOLIDS
from ..schema.table import Table, nearest
from .contract import ACTIONS, CONVENTIONS

IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
FRACTION = re.compile(r"-?[0-9]{1,4000}(/0*[1-9][0-9]{0,4000})?")
KINDS = ("points", "given", "moments", "any")
SIZES = {x: tuple(sizes) for x, sizes in SOLIDS.items()} | {"mesh": ("vertices", "faces")}
LONGEST = 16
"""The most entries of a vector, and the most rows of a matrix."""


class ShapeError(ValueError):
    """A problem of another form: the message says under which key, and what is wrong."""


def problem_shape(data: Mapping[str, Any], tree: Callable[[Any, str], Tree]) -> None:
    """``ShapeError`` where the problem of a record has not the form that is expected; ``tree``
    reads an operator tree."""
    _Shape(data, tree).problem()


def tree_shape(t: tuple[Any, ...]) -> str:
    """What is wrong with the operands of an operator that takes names or numbers; else empty."""
    if t[0] == "fun":
        return "" if isinstance(t[1], str) and t[1] in DERIVATIVES else "unknown function"
    if t[0] == "pow":
        return "" if type(t[2]) is int else "an exponent must be an integer"
    if t[0] in ("par", "sum", "at"):
        named = isinstance(t[1], str) and all(isinstance(i, (str, int)) for i in t[2:3])
        return "" if named or (t[0] == "sum" and isinstance(t[1], str)) else "expected a name"
    if t[0] == "entry":
        return "" if all(isinstance(i, (str, int)) for i in t[2:]) else "expected indices"
    if t[0] == "matrix":
        lengths = {len(x) if isinstance(x, tuple) and x[0] == "row" else 0 for x in t[1:]}
        return "" if len(lengths) == 1 and 0 not in lengths else "expected rows of one length"
    return ""


def deepest(data: Any) -> int:
    """How many lists and objects lie in one another at most; found without recursion."""
    level, inside = 0, [data]
    while inside := [
        x
        for y in inside
        if isinstance(y, (list, dict))
        for x in (y.values() if isinstance(y, dict) else y)
    ]:
        level += 1
    return level


class _Shape:
    def __init__(self, data: Mapping[str, Any], tree: Callable[[Any, str], Tree]):
        self.data, self.read = data, tree
        self.points = 0

    def problem(self) -> None:
        """Check the whole problem, key by key."""
        data = self.data
        for key in ("title", "group"):
            self.text(self.at(data, key, str, key), key)
        self.identifier(self.at(data, "name", str, "name"), "name")
        self.one_of(self.at(data, "action", str, "action"), ACTIONS, "action")
        self.at(data, "homogeneous", bool, "homogeneous")
        n = self.at(data, "n", object, "n")
        if n != "any" and not (type(n) is int and 1 <= n <= 2 * LONGEST):
            raise ShapeError("n: key must be the dimension of the space, or 'any'")
        self.blocks = len(data["group"].split(" x "))
        for name, about in self.at(data, "parameters", dict, "parameters").items():
            self.identifier(name, "parameters")
            if taken(name):
                raise ShapeError(f"parameters: {name!r} is {taken(name)} in an expression")
            self.parameter(about, f"parameters, {name!r}")
        self.body(self.at(data, "body", dict, "body"))
        for k, x in self.each("places"):
            self.placed(x, f"place {k}")
        self.points += len(data["places"])
        for k, x in self.each("potentials"):
            self.potential(x, f"potential {k}")
        for k, x in self.each("inputs"):
            self.input(x, f"input {k}")
        inputs = [x["name"] for x in data["inputs"]]
        if len({*inputs, *data["parameters"]}) < len(inputs) + len(data["parameters"]):
            raise ShapeError("inputs: two of one name, or one of a parameter's name")
        for k, x in self.each("damping"):
            self.table(Damping, x, f"damping {k}")
        self.basis(self.at(data, "basis", list, "basis"))
        if self.at(data, "conventions", list, "conventions") != [*CONVENTIONS]:
            raise ShapeError("conventions: not those by which equations are checked")

    # -- the parts ---------------------------------------------------------------------------

    def parameter(self, about: Any, where: str) -> None:
        """Check a parameter, an object with default, unit and meaning."""
        default = self.at(about, "default", object, where)
        number = isinstance(default, (int, float)) and not isinstance(default, bool)
        if default is not None and not (number and abs(default) < math.inf):
            raise ShapeError(f"{where}: key 'default' must be a number or null")
        for key in ("unit", "meaning"):
            self.text(self.at(about, key, str, where), where)

    def body(self, body: Any) -> None:
        """Check the body: its kind, and its points, moments or solids."""
        kind = self.at(body, "kind", str, "body")
        self.one_of(kind, KINDS, "body, kind")
        listed = self.at(body, "points", list, "body") if "points" in body else []
        for k, x in enumerate(listed, 1):
            self.scalar(self.at(x, "mass", object, f"point {k}"), f"point {k}, mass")
            self.placed(x, f"point {k}")
        self.points = len(listed)
        if kind == "points" and not listed:
            raise ShapeError("body: key 'points' must list points")
        if kind in ("moments", "any") and listed:
            raise ShapeError(f"body: {kind!r} leaves the points open; it lists none")
        if kind != "given":
            return
        if listed and not body.get("solids"):
            raise ShapeError("body: given moments are of no listed points; leave these out")
        given = self.at(body, "given", dict, "body")
        self.scalar(self.at(given, "m", object, "body, given"), "body, m")
        size = len(self.vector(self.at(given, "c", list, "body, given"), "body, c"))
        self.square(self.at(given, "J", list, "body, given"), size, "body, J")
        for k, x in enumerate(self.at(body, "solids", list, "body"), 1):
            self.solid(x, f"solid {k}")

    def solid(self, data: Any, where: str) -> None:
        """Check a solid: the sizes of its kind, its density, rotation and shift."""
        self.one_of(self.at(data, "kind", str, where), tuple(SIZES), f"{where}, kind")
        self.scalar(self.at(data, "density", object, where), f"{where}, density")
        if (rotation := self.at(data, "rotation", object, where)) is not None:
            self.square(rotation, 3, f"{where}, rotation")
        if (shift := self.at(data, "shift", object, where)) is not None:
            self.vector(shift, f"{where}, shift", 3)
        sizes = self.at(data, "sizes", dict, where)
        if {*sizes} != {*SIZES[data["kind"]]}:
            raise ShapeError(f"{where}: the sizes must be {', '.join(SIZES[data['kind']])}")
        for key, value in sizes.items():
            if key in ("sides", "semi_axes"):
                self.vector(value, f"{where}, {key}", 3)
            elif key not in ("vertices", "faces"):
                self.scalar(value, f"{where}, {key}")
        if "vertices" in sizes:
            self.vertices(sizes, f"{where}, vertices")

    def vertices(self, sizes: Mapping[str, Any], where: str) -> None:
        """Check vertices: four of a tetrahedron; of a mesh any, with faces of three numbers."""
        listed = self.at(sizes, "vertices", list, where)
        if "faces" not in sizes and len(listed) != 4:
            raise ShapeError(f"{where}: expected four points")
        for x in listed:
            self.vector(x, where, 3)
        for face in self.at(sizes, "faces", list, where) if "faces" in sizes else ():
            three = isinstance(face, list) and len(face) == 3
            if not three or not all(type(i) is int and 0 <= i < len(listed) for i in face):
                raise ShapeError(f"{where}: a face must be three numbers of vertices")
        if "faces" in sizes and not sizes["faces"]:
            raise ShapeError(f"{where}: no faces")

    def placed(self, data: Any, where: str) -> None:
        """Check the place of a point, and the block of a product in which it lies."""
        self.vector(self.at(data, "at", list, where), f"{where}, at")
        block = self.at(data, "block", int, where)
        if isinstance(block, bool) or not 1 <= block <= max(self.blocks, 1):
            raise ShapeError(f"{where}: key 'block' must be one of the factors of the group")

    def potential(self, data: Any, where: str) -> None:
        """By its kind."""
        kind = self.at(data, "kind", str, where)
        self.one_of(kind, tuple(kinds()), f"{where}, kind")
        self.table(kinds()[kind], data, where)

    def input(self, data: Any, where: str) -> None:
        """A covector or a force."""
        kind = self.at(data, "kind", str, where)
        self.one_of(kind, tuple(INPUTS), f"{where}, kind")
        self.table(INPUTS[kind], data, where)

    def table(self, own: type[Table], data: Any, where: str) -> None:
        """Its keys and no others; their types are the methods of :class:`_Keys`."""
        known = {*own.keys()} | ({"kind"} if own.kind else set())
        for name in data if isinstance(data, dict) else ():
            if name not in known:
                told = f"{ascii(name)[:60]}{nearest(name, known)}"
                raise ShapeError(f"{where}: unknown key {told}")
        own.read(data, where, _Keys(self))

    def basis(self, basis: list[Any]) -> None:
        """Check a basis: square matrices of fractions as strings."""
        for e in basis:
            rows = e if isinstance(e, list) and len(e) <= LONGEST else []
            if not rows or not all(isinstance(row, list) and len(row) == len(e) for row in rows):
                raise ShapeError("basis: expected square matrices")
            if not all(isinstance(x, str) and FRACTION.fullmatch(x) for row in e for x in row):
                raise ShapeError("basis: expected fractions in quotes")
        if len(basis) > 2 * BASIS:
            raise ShapeError(f"basis: more than {2 * BASIS} matrices")

    # -- of what everything is made --------------------------------------------------------------

    def scalar(self, data: Any, where: str, *, placed: bool = False, timed: bool = False) -> None:
        """A tree of a number; ``timed``: of t as well, ``placed``: and of coordinates of points."""
        if not self.is_scalar(self.read(data, where), placed, timed or placed):
            raise ShapeError(f"{where}: expected the expression of a number")

    def is_scalar(self, t: Tree, placed: bool, timed: bool) -> bool:
        """Is it made of what is known, by what keeps to numbers?"""
        if not isinstance(t, tuple):
            return not isinstance(t, str) or t == "π" or (timed and t == "t")
        if t[0] == "par":
            return t[1] in self.data["parameters"]
        if t[0] == "entry":
            return placed and len(t) == 3 and self.is_place(t[1])
        kept = {"add": t[1:], "mul": t[1:], "div": t[1:], "pow": t[1:2], "fun": t[2:]}
        return t[0] in kept and all(self.is_scalar(x, placed, timed) for x in kept[t[0]])

    def is_place(self, t: Tree) -> bool:
        """Is a tree r_i(t), for a point or a place of the problem?"""
        i = t[1][2] if isinstance(t, tuple) and t[:1] == ("call",) and len(t[1]) == 3 else 0
        known = isinstance(i, int) and 1 <= i <= self.points
        return known and t == ("call", ("at", "r", i), "t")

    def identifier(self, name: str, where: str) -> None:
        """Check a name: letters, digits and _, and no word that expressions reserve."""
        if not IDENTIFIER.fullmatch(name):
            raise ShapeError(f"{where}: {ascii(name)[:60]} is no name of letters, digits and _")
        if name in WORDS:
            raise ShapeError(f"{where}: {name!r} is {WORDS[name]}")

    def at(self, data: Any, key: str, kind: type, where: str) -> Any:
        """The value of a key that must be there and of a type; ``ShapeError`` else."""
        if not isinstance(data, dict):
            raise ShapeError(f"{where}: expected an object")
        if key not in data:
            raise ShapeError(f"{where}: key {key!r} is missing")
        if not isinstance(data[key], kind):
            raise ShapeError(f"{where}: key {key!r} must be a {kind.__name__}")
        return data[key]

    def each(self, key: str) -> list[tuple[int, Any]]:
        """The members of the list under a key of the problem, numbered from 1."""
        return [*enumerate(self.at(self.data, key, list, key), 1)]

    def text(self, words: str, where: str) -> None:
        """Check that a text is not longer than TEXT letters."""
        if len(words) > TEXT:
            raise ShapeError(f"{where}: a text longer than {TEXT} letters")

    def one_of(self, value: str, allowed: tuple[str, ...], where: str) -> None:
        """Check that a word is one of those allowed."""
        if value not in allowed:
            raise ShapeError(f"{where}: key must be one of {', '.join(allowed)}")

    def vector(
        self,
        data: Any,
        where: str,
        size: int | None = None,
        least: int = 1,
        *,
        timed: bool = False,
    ) -> Any:
        """A list of trees, which is not a tree itself."""
        most = LONGEST if size is None else size
        if not isinstance(data, list) or not (size or least) <= len(data) <= most:
            raise ShapeError(f"{where}: expected a list of {size or 'a few'} expressions")
        if data and isinstance(data[0], str) and data[0] in OPERATORS:
            raise ShapeError(f"{where}: expected a list of expressions")
        for x in data:
            self.scalar(x, where, timed=timed)
        return data

    def square(self, data: Any, size: int, where: str) -> None:
        """Check a square matrix: ``size`` rows of as many trees."""
        if not isinstance(data, list) or len(data) != size:
            raise ShapeError(f"{where}: expected {size} rows")
        for row in data:
            self.vector(row, where, size)

    def point(self, i: Any, where: str) -> Any:
        """The number of a point or a place."""
        if type(i) is not int or not 1 <= i <= self.points:
            raise ShapeError(f"{where}: expected a point from 1 to {self.points}")
        return i


class _Keys:
    """Reads a potential of a record, as :class:`Reader` has it: what is right comes back."""

    def __init__(self, shape: _Shape):
        self.shape = shape

    def fail(self, message: str) -> ShapeError:
        """The error of a record."""
        return ShapeError(message)

    def has(self, table: Mapping[str, Any], key: str) -> bool:
        """All must be there; of what is not, the reading says so."""
        del table, key
        return True

    def meets(self, need: str, kind: str, where: str) -> None:
        """What the header says of the body and the group."""
        data = self.shape.data
        if need == "points alone" and data["body"]["kind"] != "points":
            raise ShapeError(f"{where}: {kind} is of a body of points alone")
        if need in ("rotations", "affine of R^3") and self.shape.blocks > 1:
            raise ShapeError(f"{where}: {kind} is in no product")
        if need == "affine of R^3" and (data["action"], data["n"]) != ("affine", 3):
            raise ShapeError(f"{where}: {kind} is of affine maps of R^3")

    def scalar(self, table: Any, key: str, where: str, _: Any) -> Any:
        """A tree of parameters."""
        value = self.shape.at(table, key, object, where)
        self.shape.scalar(value, f"{where}, {key}")
        return value

    def energy(self, table: Any, key: str, where: str, _: Any) -> Any:
        """A tree of places in space and the time as well."""
        value = self.shape.at(table, key, object, where)
        self.shape.scalar(value, f"{where}, {key}", placed=True)
        return value

    def vector(self, table: Any, key: str, where: str, _: Any) -> Any:
        """A list of trees; empty for the origin, where a file may leave it out."""
        least = 0 if kinds()[table["kind"]].optional(key) else 1
        value = self.shape.at(table, key, list, where)
        return self.shape.vector(value, f"{where}, {key}", least=least)

    def pair(self, table: Any, key: str, where: str, _: Any) -> Any:
        """Two points."""
        ends = self.shape.at(table, key, list, where)
        if len(ends) != 2:
            raise ShapeError(f"{where}: key {key!r} must be two points")
        return tuple(self.shape.point(i, where) for i in ends)

    def end(self, table: Any, key: str, where: str, _: Any) -> Any:
        """A point or a place."""
        return self.shape.point(self.shape.at(table, key, int, where), where)

    def rotation(self, table: Any, key: str, where: str, _: Any) -> Any:
        """Rows of trees, as many as the space has dimensions; none for 1."""
        n, rows = self.shape.data["n"], self.shape.at(table, key, list, where)
        if rows or not kinds()[table["kind"]].optional(key):
            self.shape.square(rows, n if isinstance(n, int) else 0, f"{where}, {key}")
        return rows

    def timed(self, table: Any, key: str, where: str, _: Any) -> Any:
        """A list of trees with the time, but no places."""
        value = self.shape.at(table, key, list, where)
        return self.shape.vector(value, f"{where}, {key}", timed=True)

    def charges(self, table: Any, key: str, where: str, _: Any) -> Any:
        """A tree for each point that has a mass."""
        count = len(self.shape.data["body"].get("points", []))
        value = self.shape.at(table, key, list, where)
        if not count or len(value) != count:
            raise ShapeError(f"{where}: key {key!r} must have a number for each point")
        for x in value:
            self.shape.scalar(x, f"{where}, {key}")
        return value

    def points(self, table: Any, key: str, where: str, _: Any) -> Any:
        """Points or places."""
        listed = self.shape.at(table, key, list, where)
        return tuple(self.shape.point(i, where) for i in listed)

    def name(self, table: Any, key: str, where: str, _: Any) -> Any:
        """As the files of problems have them."""
        name = self.shape.at(table, key, str, where)
        self.shape.identifier(name, where)
        return name

    def frame(self, table: Any, key: str, where: str, _: Any) -> Any:
        """Space or body."""
        frame = self.shape.at(table, key, str, where)
        self.shape.one_of(frame, ("space", "body"), f"{where}, {key}")
        return frame

    def masses(self, table: Any, key: str, where: str, _: Any) -> Any:
        """Of a problem in its principal frame, which is not read."""
        if key in table:
            raise ShapeError(f"{where}: key {key!r} is for a problem in its principal frame")
        return ()
