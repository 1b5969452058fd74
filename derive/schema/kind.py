"""What a kind of potential is: the keys of its table with their types, and its words.

A kind is a dataclass in :mod:`derive.schema.kinds`.  From its keys come the table ``[[potential]]``
of a file, the potential of a record and the check of a stranger's, and the word of Python.
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import MISSING, dataclass, fields
from functools import cache
from typing import Annotated, Any, ClassVar, NamedTuple, Protocol, Self, get_args, get_type_hints

from ..language.tree import Tree


class Reader(Protocol):
    """What reads the values of a table: from a file, or from a record of a stranger.

    Its methods are named by the types of keys.  Each takes the whole table, the key, where it is,
    and what has been read of it already.
    """

    def fail(self, message: str) -> Exception:
        """The error of a file, or of a record."""

    def has(self, table: Mapping[str, Any], key: str) -> bool:
        """Is there a value to be read?"""

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
}
"""``scalar``: an expression of the parameters; ``energy``: of places and the time as well;
``vector``: of the space of the points; ``pair``: two points; ``end``: a point or a place of the
body; ``masses``: points with their masses, of which the principal frame makes a list; ``rotation``:
rows of a matrix; ``timed``: a vector, of the time as well; ``charges``: a number for each point."""


@dataclass(frozen=True)
class Key:
    """A key: the name of its type; ``mass``: in units of mass; ``positive``: may not be negative
    but where that is allowed."""

    type: str
    mass: bool = False
    positive: bool = False

    @property
    def as_type(self) -> Type:
        """Its type."""
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
Masses = Annotated[tuple[tuple[int, Tree], ...], Key("masses")]
"""The types of the keys of a kind.  A key without a default must be there; one that is ``None`` if
its kind chooses it (:meth:`Potential.given`)."""


@cache
def _keys(cls: type[Any]) -> dict[str, Key]:
    hints = get_type_hints(cls, include_extras=True)
    return {x.name: _key(hints[x.name]) for x in fields(cls)}


def _key(hint: Any) -> Key:
    """The key of a type, or of one that may be ``None``."""
    for x in (hint, *get_args(hint)):
        for about in getattr(x, "__metadata__", ()):
            if isinstance(about, Key):
                return about
    raise TypeError(f"{hint} is no type of a key")


def nearest(word: str, known: Collection[str]) -> str:
    """``; did you mean 'spring'?``, or nothing."""
    near = difflib.get_close_matches(word[:40], sorted(known), 1)
    return f"; did you mean {near[0]!r}?" if near else ""


class Own(NamedTuple):
    """A letter that the words of a kind have for their own: a scalar, a vector or a matrix."""

    name: str
    type: str
    meaning: str
    latex: str


@dataclass(frozen=True, kw_only=True)
class Potential:
    """One potential of a problem.

    ``kind``: its name in files.  ``rank``: in which order kinds are told.  ``phrase``, ``several``:
    what acts, in words.  ``drawn``: is it in the figure?  ``legend``: what the figure says of it.
    ``turns``: can it be said in the principal frame; else ``unturned`` says what cannot.
    ``needs``: what the problem must be.  ``alone``: there is one of the kind.  ``letters``: those
    that its words have for their own.
    """

    kind: ClassVar[str]
    rank: ClassVar[int] = 100
    phrase: ClassVar[str]
    several: ClassVar[str] = ""
    legend: ClassVar[str] = ""
    drawn: ClassVar[bool] = False
    unturned: ClassVar[str] = ""
    needs: ClassVar[tuple[str, ...]] = ()
    alone: ClassVar[bool] = False
    letters: ClassVar[tuple[Own, ...]] = ()

    @classmethod
    def keys(cls) -> dict[str, Key]:
        """Its keys by their names."""
        own: Any = cls
        return _keys(own)

    @property
    def summed(self) -> bool:
        """Has it a term for every point?"""
        return any(about.type == "masses" for about in self.keys().values())

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """The keys of its table in a file."""
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
        """The potential of a table of which the kind is known."""
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
            if about.type in ("pair", "end"):
                yield from value if about.type == "pair" else (value,)

    def plain(self) -> dict[str, Any]:
        """The potential as the record has it; trees as they are."""
        return {"kind": self.kind} | {x: k.as_type.plain(v) for x, k, v in self.values()}

    def trees(self) -> list[Tree]:
        """Its expressions."""
        return [t for _, k, value in self.values() for t in k.as_type.trees(value)]
