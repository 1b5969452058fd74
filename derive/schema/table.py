"""What a table of a problem is: its keys with their types.

It is a dataclass.  From its keys come the table of a file, the data of a record and the check of a
stranger's, and the word of Python.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import MISSING, dataclass, fields
from functools import cache
from typing import Annotated, Any, ClassVar, Protocol, Self, get_args

from ..language.near_names import did_you_mean, near_name
from ..language.tree import Tree


class Reader(Protocol):
    """What reads the values of a table: from a file, or from a record of a stranger.

    Its methods are named by the types of keys.  Each takes the whole table, the key, where it is,
    and what has been read of it already.
    """

    def fail(self, message: str) -> Exception:
        """The error of a file, or of a record."""

    def has(self, table: Mapping[str, Any], key: str) -> bool:
        """Has a table a value under a key?"""

    def meets(self, need: str, kind: str, where: str) -> None:
        """Refuse a kind where the problem is not what it needs."""


@dataclass(frozen=True)
class Type:
    """What stands under a key: as a record has it, and the expressions in it.

    ``keys``: the keys of a file that say it, where they are not the one of its name.
    """

    plain: Callable[[Any], Any]
    trees: Callable[[Any], list[Tree]]
    keys: tuple[str, ...] = ()


def _rows(value: Any) -> list[Any]:
    return [[*row] for row in value]


TYPES = {
    "scalar": Type(lambda x: x, lambda x: [x]),
    "energy": Type(lambda x: x, lambda x: [x]),
    "vector": Type(list, list),
    "pair": Type(list, lambda _: []),
    "end": Type(lambda x: x, lambda _: [], ("on", "at", "block")),
    "masses": Type(_rows, lambda _: []),
    "rotation": Type(_rows, lambda rows: [x for row in rows for x in row]),
    "timed": Type(list, list),
    "charges": Type(list, list),
    "points": Type(list, lambda _: [], ("on", "at", "block")),
    "name": Type(lambda x: x, lambda _: []),
    "frame": Type(lambda x: x, lambda _: []),
}
"""``scalar``: an expression of the parameters; ``energy``: of places and the time as well;
``vector``: of the space of the points; ``pair``: two points; ``end``: a point or a place of the
body; ``masses``: points with their masses, of which the principal frame makes a list; ``rotation``:
rows of a matrix; ``timed``: a vector, of the time as well; ``charges``: a number for each point;
``points``: some or a place of the body; ``name``: one of code; ``frame``: space or body."""


@dataclass(frozen=True)
class Key:
    """A key: the name of its type; ``mass``: in units of mass; ``positive``: may not be negative
    but where that is allowed."""

    type: str
    mass: bool = False
    positive: bool = False

    @property
    def as_type(self) -> Type:
        """The type of this key."""
        return TYPES[self.type]


Scalar = Annotated[Tree, Key("scalar")]
Stiffness = Annotated[Tree, Key("scalar", mass=True, positive=True)]
Energy = Annotated[Tree, Key("energy")]
Vector = Annotated[tuple[Tree, ...], Key("vector")]
Pair = Annotated[tuple[int, int], Key("pair")]
End = Annotated[int, Key("end")]
Rotation = Annotated[tuple[tuple[Tree, ...], ...], Key("rotation")]
Timed = Annotated[tuple[Tree, ...], Key("timed")]
Charges = Annotated[tuple[Tree, ...], Key("charges")]
Points = Annotated[tuple[int, ...], Key("points")]
Name = Annotated[str, Key("name")]
Frame = Annotated[str, Key("frame")]
Masses = Annotated[tuple[tuple[int, Tree], ...], Key("masses")]
"""The types of the keys of a kind.  A key without a default must be there; one that is ``None`` if
its kind chooses it (:meth:`Potential.given`)."""


@cache
def _keys(cls: type[Any]) -> dict[str, Key]:
    return {x.name: _key(x.type) for x in fields(cls)}


def _key(hint: Any) -> Key:
    """The key of a type, or of one that may be ``None``: an annotation itself, not its text."""
    for x in (hint, *get_args(hint)):
        for about in getattr(x, "__metadata__", ()):
            if isinstance(about, Key):
                return about
    raise TypeError(f"{hint} is no type of a key")


NEEDS = ("points alone", "one space", "rotations", "affine of R^3")
"""What a kind may need of its problem: nothing has mass but the points; blocks of one dimension;
linear parts that are rotations; all translations of R³."""
OTHER_WORDS = {
    **dict.fromkeys(("sphere", "globe"), "ball"),
    **dict.fromkeys(("cube", "cuboid", "brick", "block"), "box"),
    **dict.fromkeys(("shell", "hollow_sphere"), "hollow_ball"),
    **dict.fromkeys(("rod", "disk", "disc"), "cylinder"),
    **dict.fromkeys(("weight", "uniform_gravity"), "gravity"),
    **dict.fromkeys(("newton", "kepler", "central"), "attraction"),
    **dict.fromkeys(("gravity_gradient", "satellite"), "far_centre"),
    **dict.fromkeys(("torque", "moment"), "covector"),
    **dict.fromkeys(("world", "inertial"), "space"),
}
"""What others call it."""


def nearest(word: str, known: Collection[str]) -> str:
    """``; did you mean 'spring'?``, or nothing."""
    other = OTHER_WORDS.get(word, "")
    return did_you_mean(other if other in known else near_name(word, known), "; ")


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table of a problem; ``kind``: its name, where there are several kinds.  ``needs``: what the
    problem must be."""

    kind: ClassVar[str] = ""
    needs: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def keys(cls) -> dict[str, Key]:
        """Its keys by their names."""
        own: Any = cls
        return _keys(own)

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """The keys that a table of this kind may have in a file."""
        stated = {name: k for name, k in cls.keys().items() if k.type != "masses"}
        found = [x for name, k in stated.items() for x in k.as_type.keys or (name,)]
        return tuple(dict.fromkeys(found))

    @classmethod
    def optional(cls, name: str) -> bool:
        """May a file leave a key out that it may say?"""
        return any(x.name == name and x.default not in (MISSING, None) for x in fields(cls))

    @classmethod
    def given(cls, table: Mapping[str, Any]) -> tuple[str, ...] | str:
        """The keys that this table must or may have; or what is wrong with those it has."""
        del table
        return tuple(cls.keys())

    @classmethod
    def read(cls, table: Mapping[str, Any], where: str, reader: Reader) -> Self:
        """What a table of this kind says."""
        chosen = cls.given(table)
        if isinstance(chosen, str):
            raise reader.fail(f"{where}: {chosen}")
        for need in cls.needs:
            reader.meets(need, cls.kind, where)
        found: dict[str, Any] = {}
        for x in fields(cls):
            about = cls.keys()[x.name]
            there = any(reader.has(table, name) for name in about.as_type.keys or (x.name,))
            if x.name not in chosen or (cls.optional(x.name) and not there):
                continue
            found[x.name] = getattr(reader, about.type)(table, x.name, where, found)
        return cls(**found)

    def values(self) -> Iterator[tuple[str, Key, Any]]:
        """Its keys that have a value."""
        for name, about in self.keys().items():
            value = getattr(self, name)
            if value is not None and (about.type != "masses" or value):
                yield name, about, value

    def points(self) -> Iterator[int]:
        """The points and places that it names by their numbers."""
        for _, about, value in self.values():
            if about.type in ("pair", "end", "points"):
                yield from (value,) if about.type == "end" else value

    def plain(self) -> dict[str, Any]:
        """The table as the record has it; trees as they are."""
        return ({"kind": self.kind} if self.kind else {}) | {
            x: k.as_type.plain(v) for x, k, v in self.values()
        }

    def trees(self) -> list[Tree]:
        """The expressions in this table."""
        return [t for _, k, value in self.values() for t in k.as_type.trees(value)]
