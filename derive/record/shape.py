"""The form of a record's problem: types of values, and references, as its readers need them.

A record is read from strangers; what passes here has a value or is refused by name in the checker,
and can be drawn.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, TypeVar

from ..language.laurent import LEVEL, degree_in_level
from ..language.limits import BASIS, CARRIED, LAYERS, TORUS
from ..language.reserved import acting_in, taken
from ..language.tree import Tree, nodes, operands, replaced
from ..schema.body_kinds import BODIES, LAYERED, SOLIDS, Place, Solid, is_ellipsoid
from ..schema.force_kinds import INPUTS, Damping, Flow, LaplacianDamping, acting_kind
from ..schema.kind import GROUP, Advected, Fluid, Kinematics, Lagrangian, Torus
from ..schema.motion_kinds import OF_MASSES, OUTPUTS, fault_of_gravity
from ..schema.potential_kinds import kinds
from ..schema.table import ACTIONS, DETERMINANT, Rows, Slot, Table
from ..schema.table_reader import LONGEST, NAME, TableReader
from .record import CONVENTIONS

T = TypeVar("T")
IDENTIFIER = NAME
FRACTION = re.compile(r"-?[0-9]{1,4000}(/0*[1-9][0-9]{0,4000})?")


class ShapeError(ValueError):
    """A problem of another form: the message says under which key, and what is wrong."""


def problem_shape(data: Mapping[str, Any], tree: Callable[[Any, str], Tree]) -> None:
    """``ShapeError`` where the problem of a record has not the form that is expected; ``tree``
    reads an operator tree."""
    _RecordReader(data, tree).problem()


class _RecordReader(TableReader):
    """Reads a problem in a record; ``last`` counts the places of the body as well."""

    error = ShapeError

    def __init__(self, data: Mapping[str, Any], tree: Callable[[Any, str], Tree]):
        self.data, self.read = data, tree

    def problem(self) -> None:
        """Check the whole problem, key by key."""
        data = self.data
        for key in ("title", "group", "name"):
            self.text(self.top(key))
        self.identifier(data["name"], "name")
        self.choice(self.top("action"), ACTIONS)
        self.value(self.top("homogeneous"), bool)
        if (n := self.value(self.top("n"))) != "any":
            self.integer(n, 1, TORUS if "torus" in data else 2 * self.longest, "n")
        self.blocks = len(data["group"].split(" x "))
        for name, about in self.value(self.top("parameters"), dict).items():
            self.parameter(name, about)
        self.body()
        self.last += len(self.each("places", partial(self.typed, Place)))
        self.each("potentials", partial(self.one_of, kinds()))
        inputs = self.each("inputs", partial(self.one_of, INPUTS))
        self.distinct(inputs, data["parameters"])
        self.each("damping", self.damped)
        forces: list[Any] = self.each(
            "forces", lambda x, where: self.typed(acting_kind(x), x, where), optional=True
        )
        forces += self.each("flows", self.flow, optional=True)
        outputs = self.each("outputs", partial(self.one_of, OUTPUTS), optional=True)
        self.distinct_outputs(outputs, inputs, data["parameters"], forces)
        self.matrices(self.value(self.top("basis"), list))
        if data.get("discrete", True) is not True:
            raise ShapeError("discrete: expected true, or nothing")
        self.lagrangian()
        self.symmetries()
        if self.value(self.top("conventions"), list) != [*CONVENTIONS]:
            raise ShapeError("conventions: not those by which equations are checked")

    @property
    def longest(self) -> int:
        """The most rows of a matrix of the basis."""
        return CARRIED if "advected" in self.data else LONGEST

    def top(self, key: str) -> Slot:
        """A key of the problem itself."""
        return Slot(self.data, key, key)

    def each(self, key: str, read: Callable[[Any, str], T], *, optional: bool = False) -> list[T]:
        """The tables of a list, called by their numbers; is it ``optional``, none where it is not
        there?"""
        if optional and key not in self.data:
            return []
        listed = enumerate(self.value(self.top(key), list), 1)
        return [read(x, f"{key.removesuffix('s')} {k}") for k, x in listed]

    def damped(self, data: Any, where: str) -> Damping | LaplacianDamping:
        """A damping, of points or of the modes of a fluid on the torus."""
        if "torus" in self.data:
            return self.one_of({LaplacianDamping.kind: LaplacianDamping}, data, where)
        return self.typed(Damping, data, where)

    def flow(self, data: Any, where: str) -> Flow:
        """Mass that flows, as inputs say, too; that of the state is one of the parameters."""
        self.flowing = True
        found = self.typed(Flow, data, where)
        self.flowing = False
        if found.mass and found.mass not in self.data["parameters"]:
            raise ShapeError(f"{where}: the mass {found.mass!r:.40} is no parameter")
        return found

    def body(self) -> None:
        """Its points are those that are named by numbers."""
        own = self.value(self.top("body"), dict)
        if own.get("kind") in ("moments", "any", "none") and own.get("points"):
            raise ShapeError(f"body: {own['kind']!r} leaves the points open; it lists none")
        self.filled = found = self.one_of(BODIES, own, "body")
        self.count = self.last = len(getattr(found, "points", None) or ())

    def lagrangian(self) -> None:
        """A Lagrangian that no points give is beside no body, and all that acts but covectors."""
        data = self.data
        if "fluid" in data or "kinematics" in data:
            return self.fluid() if "fluid" in data else self.kinematics()
        if data["group"] == GROUP:
            raise ShapeError(f"fluid: the problem of {GROUP} has this key")
        if ("lagrangian" in data) != (data["body"]["kind"] == "none"):
            raise ShapeError("lagrangian: it is of a problem without a body")
        on_algebra = "advected" in data or "torus" in data
        if on_algebra and "lagrangian" not in data:
            raise ShapeError("advected, torus: they are of a problem with a Lagrangian of its own")
        faults = (fault_of_gravity(x, "lagrangian" in data) for x in data.get("outputs", ()))
        if wrong := next(filter(None, faults), ""):
            raise ShapeError(f"outputs: {wrong}")
        if "lagrangian" not in data:
            return
        beside = ("potentials", "flows", *(() if "torus" in data else ("damping",)))
        self.empty("lagrangian: it says all of L", *beside)
        if on_algebra:
            self.covectors_alone()
        if any(x["kind"] in OF_MASSES for x in data.get("outputs", ())):
            raise ShapeError("lagrangian: an output of its problem is of masses, and it has none")
        self.each("advected", partial(self.typed, Advected), optional=True)
        if "torus" not in data:
            self.typed(Lagrangian, data["lagrangian"], "lagrangian")
            return
        self.typed(Torus, data["torus"], "torus")
        if [x["kind"] for x in data["inputs"]] not in ([], ["covector"]):
            raise ShapeError("torus: its input is one covector")
        self.empty("torus: inputs and damping act on it", "forces", "outputs")
        if data["lagrangian"] != {"trivialisation": "right"} or "advected" in data:
            raise ShapeError("lagrangian: that of the torus is told by its steps, on the right")

    def covectors_alone(self) -> None:
        """Without an element of a group nothing acts at a place."""
        data = self.data
        placed = data["places"] or any("covector" not in x for x in data.get("forces", ()))
        if placed or any(x["kind"] in ("force", "torque") for x in data["inputs"]):
            raise ShapeError("lagrangian: what acts on an algebra is a covector")
        if any(x["kind"] != "expression" for x in data.get("outputs", ())):
            raise ShapeError("lagrangian: the outputs of an algebra are expressions")

    def fluid(self) -> None:
        """A fluid says all of its problem."""
        data = self.data
        self.typed(Fluid, data["fluid"], "fluid")
        if data["group"] != GROUP or data["body"]["kind"] != "none" or data["n"] != "any":
            raise ShapeError(f"fluid: its group is {GROUP}, its n any, and it has no body")
        if "lagrangian" in data or data["homogeneous"] or data["action"] != "linear":
            raise ShapeError("fluid: nothing else says its Lagrangian or its action")
        absent = ("advected", "frame", "masses", "forces", "flows", "outputs")
        self.without("fluid: it has", absent, ("parameters", "basis"))

    def without(self, begin: str, absent: Sequence[str], empty: Sequence[str] = ()) -> None:
        """``ShapeError`` for a key that a problem without points has not, or not filled."""
        for key in absent:
            if key in self.data:
                raise ShapeError(f"{begin} no key {key!r}")
        self.empty(begin.partition(":")[0], "potentials", "places", "damping", "inputs", *empty)

    def empty(self, begin: str, *keys: str) -> None:
        """``ShapeError`` where one of these lists nothing may stand in is not empty."""
        if key := next((x for x in keys if self.data.get(x)), ""):
            raise ShapeError(f"{begin}; {key} must be empty")

    def kinematics(self) -> None:
        """ġ says all of the motion, on the matrices of a group."""
        data = self.data
        if data["body"]["kind"] != "none" or not data["basis"] or data["action"] != "linear":
            raise ShapeError("kinematics: they are of a group of matrices, without a body")
        absent = ("lagrangian", "advected", "frame", "masses", "forces", "outputs", "torus")
        self.without("kinematics: they have", absent)
        self.typed(Kinematics, data["kinematics"], "kinematics")

    def meaning_of(self, name: str) -> str:
        """A parameter, or what the grammar has."""
        return "a parameter" if name in self.data["parameters"] else taken(name)

    def rate(self, slot: Slot) -> Rows:
        """Of the entries of A, parameters and inputs."""
        n, inputs = self.data["n"], slot.found["inputs"]

        def plain(t: Tree) -> Tree:
            """The same with 1 for inputs, and with no number where ζ stands."""
            for name in inputs:
                t = replaced(t, ("par", name), 1)
            return "ζ" if "ζ" in nodes(t) else t

        one = partial(self.made_of, plain=plain, coordinates=len(self.data["basis"]))
        return self.rows(self.value(slot), n, n, slot.path, one=one)

    def symmetries(self) -> None:
        """The fields δA by which a record reduces, which is of a Lagrangian on a group."""
        if "symmetries" not in self.data:
            return
        listed = self.value(self.top("symmetries"), list)
        if "lagrangian" not in self.data or "advected" in self.data:
            raise ShapeError("symmetries: they are of a Lagrangian on a group")
        if not 1 <= len(listed) <= len(self.data["basis"]):
            raise ShapeError("symmetries: expected one at least, as many as the basis at most")
        for k, x in enumerate(listed, 1):
            self.read(x, f"symmetries {k}")

    def lettered(self, slot: Slot) -> Tree:
        """An expression in the time, the entries of g and ζ."""
        size = len(self.data["basis"])
        return self.made_of(self.value(slot), slot.path, timed=True, coordinates=size)

    def held(self, slot: Slot) -> tuple[int, ...]:
        """Numbers of coordinates, in order, or none."""
        listed = slot.table.get(slot.key, [])
        if not isinstance(listed, list) or listed != sorted({*listed}):
            raise ShapeError(f"{slot.path}: expected numbers of coordinates, in order")
        return tuple(self.integer(x, 1, len(self.data["basis"]), slot.path) for x in listed)

    def elements(self, slot: Slot) -> int:
        """How many entries."""
        return self.integer(self.value(slot), 1, CARRIED, slot.path)

    def matrices(self, basis: list[Any]) -> None:
        """Check a basis: square matrices of fractions as strings."""
        for e in basis:
            rows = e if isinstance(e, list) and len(e) <= self.longest else []
            if not rows or not all(isinstance(row, list) and len(row) == len(e) for row in rows):
                raise ShapeError("basis: expected square matrices")
            if not all(isinstance(x, str) and FRACTION.fullmatch(x) for row in e for x in row):
                raise ShapeError("basis: expected fractions in quotes")
        if len(basis) > 2 * BASIS:
            raise ShapeError(f"basis: more than {2 * BASIS} matrices")

    # -- tables ----------------------------------------------------------------------------------

    def names(self, own: type[Table]) -> tuple[str, ...]:
        """All keys that are told."""
        return tuple(x for x, k in own.keys().items() if k.told)

    def has(self, slot: Slot) -> bool:
        """All that are told must be; a list is empty where a file may leave it out."""
        return slot.about.told and not (slot.default == () and slot.table.get(slot.key) == [])

    def meets(self, need: str, kind: str, where: str) -> None:
        """What the header says of the body and the group."""
        data = self.data
        if need == "deformations of R^3" and (self.blocks > 1 or data["n"] != 3):
            raise ShapeError(f"{where}: {kind} is of one group of R^3")
        if need == "one ellipsoid" and not is_ellipsoid(self.filled):
            raise ShapeError(f"{where}: {kind} is of one ellipsoid about the origin")
        if need == "points alone" and data["body"]["kind"] != "points":
            raise ShapeError(f"{where}: {kind} is of a body of points alone")
        if need in ("rotations", "affine of R^3", "volumes", "no turning") and self.blocks > 1:
            raise ShapeError(f"{where}: {kind} is in no product")
        if need == "affine of R^3" and (data["action"], data["n"]) != ("affine", 3):
            raise ShapeError(f"{where}: {kind} is of affine maps of R^3")

    def solids(self, slot: Slot) -> tuple[Solid, ...]:
        """Their sizes are a table of their own."""
        found = []
        for k, x in enumerate(self.value(slot, list), 1):
            where = f"solid {k}"
            own = SOLIDS[self.choice(Slot(x, "kind", where), tuple(SOLIDS))]
            self.known(x, ("kind", "density", "sizes", "rotation", "shift"), where)
            sizes = self.value(Slot(x, "sizes", where), dict)
            chosen = own.chosen(sizes, self.last)
            if isinstance(chosen, str):
                raise ShapeError(f"{where}: {chosen}")
            wanted = {*chosen} - Solid.keys().keys()
            if sizes.keys() != wanted:
                raise ShapeError(f"{where}: the sizes must be {', '.join(sorted(wanted))}")
            rest = {key: value for key, value in x.items() if key != "sizes"}
            found.append(self.typed(own, rest | sizes, where))
        return tuple(found)

    # -- values ----------------------------------------------------------------------------------

    def expression(self, value: Any, where: str) -> Tree:
        """A tree of parameters, and of t where the table knows it."""
        return self.made_of(value, where, timed=self.timed)

    def in_time(self, value: Any, where: str) -> Tree:
        """The same, of t as well."""
        return self.made_of(value, where, timed=True)

    def layered(self, slot: Slot) -> Tree:
        """The same; of an ellipsoid or a ball a polynomial in the level as well."""
        t = self.read(self.value(slot), slot.path)
        degree = degree_in_level(t)
        if degree is None or degree > (LAYERS if slot.table["kind"] in LAYERED else 0):
            raise ShapeError(f"{slot.path}: expected a polynomial in the level, or no level")
        return self.made_of(self.value(slot), slot.path, plain=lambda t: replaced(t, LEVEL, 1))

    def energy(self, slot: Slot) -> Tree:
        """The same, of t and coordinates of points."""
        return self.made_of(self.value(slot), slot.path, placed=True, timed=True)

    def of_volume(self, slot: Slot) -> Tree:
        """The same, of t and the volume."""
        plain = partial(replaced, old=DETERMINANT, new="t")
        return self.made_of(self.value(slot), slot.path, timed=True, plain=plain)

    def made_of(
        self, value: Any, where: str, *, plain: Callable[[Tree], Tree] | None = None, **known: Any
    ) -> Tree:
        """The tree of a number, made of what is ``known``; ``plain``: the same without what else
        may stand in it."""
        t = self.read(value, where)
        if not self.is_scalar(plain(t) if plain else t, **known):
            raise ShapeError(f"{where}: expected the expression of a number")
        return t

    def is_scalar(
        self, t: Tree, *, placed: bool = False, timed: bool = False, coordinates: int = 0
    ) -> bool:
        """Is it made of what is known, by what keeps to numbers?  ``coordinates``: how many entries
        ζ has, where those of g are known as well."""
        if not isinstance(t, tuple):
            return not isinstance(t, str) or t == "π" or (timed and t == "t")
        if t[0] == "par":
            return t[1] in self.data["parameters"] or (self.flowing and self.is_input(t[1]))
        if t[0] == "entry":
            if coordinates:
                return self.is_entry(t, coordinates)
            return placed and len(t) == 3 and self.is_place(t[1])
        same = partial(self.is_scalar, placed=placed, timed=timed, coordinates=coordinates)
        return t[0] in ("add", "mul", "div", "pow", "fun") and all(map(same, operands(t)))

    def is_input(self, name: str) -> bool:
        """Is it that of an input, or of one of its numbers?"""
        return bool({name, name.rpartition("_")[0]} & {x["name"] for x in self.data["inputs"]})

    def is_entry(self, t: tuple[Any, ...], coordinates: int) -> bool:
        """Is a tree an entry of g, or of Γ where the state has no g, or of ζ?"""
        n, carried = self.data["n"], self.data.get("advected")
        sizes: dict[Any, tuple[int, ...]] = {"ζ": (coordinates,), "A": (n, n)}
        if carried is not None:
            sizes = {"ζ": (coordinates,), "Γ": (sum(x["size"] for x in carried),)}
        most = sizes.get(t[1], ())
        return len(t) - 2 == len(most) > 0 and all(
            type(i) is int and 1 <= i <= k for i, k in zip(t[2:], most, strict=True)
        )

    def is_place(self, t: Tree) -> bool:
        """Is a tree r_i(t), for a point or a place of the problem?"""
        i = t[1][2] if isinstance(t, tuple) and t[:1] == ("call",) and len(t[1]) == 3 else 0
        known = isinstance(i, int) and 1 <= i <= self.last
        return known and t == ("call", ("at", "r", i), "t")

    def stated(self, slot: Slot) -> tuple[Tree, ...]:
        """Expressions of t, parameters, inputs and the state: A, T, Z, ζ, w, places with their
        velocities."""

        def lettered(t: Tree) -> Tree:
            """The same with t for the state and for inputs."""
            if not isinstance(t, tuple):
                return t
            if t[0] == "par" and self.is_input(t[1]):
                return "t"
            if t[0] == "entry" and all(type(i) is int and i > 0 for i in t[2:]):
                velocity = isinstance(t[1], tuple) and t[1][:2] == ("at", "v")
                known = t[1] in ("A", "T", "Z", "ζ", "w", "Γ") or velocity or self.is_place(t[1])
                return "t" if known else t
            return (t[0], *map(lettered, t[1:]))

        read = partial(self.made_of, timed=True, plain=lettered)
        return self.listed(self.value(slot), None, slot.path, read)

    stated_couple = stated_covector = observed = stated
    first = TableReader.vector
    flowing = False

    def is_spring(self, k: int) -> bool:
        """Is it one of the problem?"""
        listed = self.data["potentials"]
        return 1 <= k <= len(listed) and listed[k - 1]["kind"] == "spring"

    def acting_names(self) -> list[str]:
        """Those of the problem's inputs, forces and damping."""
        return acting_in(self.data)

    def dimension(self, _: Slot) -> None:
        """The sizes of blocks are not known here."""

    def space(self, _: Slot) -> int:
        """The dimension of the space."""
        n = self.data["n"]
        return n if isinstance(n, int) else 0

    def second(self, slot: Slot) -> Rows:
        """A matrix."""
        n = len(slot.found["c"])
        return self.rows(self.value(slot), n, n, slot.path)

    def symmetric(self, slot: Slot) -> Rows:
        """A matrix; of the size of the space where that is known."""
        value = self.value(slot, list)
        return self.rows(value, len(value), len(value), slot.path)

    def vertices(self, slot: Slot) -> Rows:
        """Any number of points."""
        listed = self.value(slot, list)
        return self.rows(listed, len(listed), 3, slot.path, "points")

    def faces(self, slot: Slot) -> tuple[tuple[int, ...], ...]:
        """Three vertices each."""
        listed, most = self.value(slot, list), len(slot.found["vertices"])
        for face in listed:
            three = isinstance(face, list) and len(face) == 3
            if not three or not all(type(i) is int and 0 <= i < most for i in face):
                raise ShapeError(f"{slot.where}: a face must be three numbers of vertices")
        if not listed:
            raise ShapeError(f"{slot.where}: no faces")
        return tuple(map(tuple, listed))

    def end(self, slot: Slot) -> int:
        """A point or a place."""
        return self.point(self.value(slot), slot.path)

    def points(self, slot: Slot) -> tuple[int, ...]:
        """Points or places."""
        return tuple(self.point(i, slot.path) for i in self.value(slot, list))

    def masses(self, slot: Slot) -> tuple[()]:
        """Of a problem in its principal frame, which is not read."""
        if slot.key in slot.table:
            told = f"key {slot.key!r} is for a problem in its principal frame"
            raise ShapeError(f"{slot.where}: {told}")
        return ()
