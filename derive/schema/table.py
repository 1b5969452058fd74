"""What a table of a problem is: its keys with their types.

It is a dataclass.  From its keys come the table of a file, the data of a record and the check of a
stranger's, and the word of Python.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass, fields
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple, Self, dataclass_transform, get_args

from ..language.reserved import did_you_mean, near_name
from ..language.tree import Tree

Number = int | float | str | Fraction
"""What a word of Python takes: a number, or an expression in quotes."""


class Slot(NamedTuple):
    """A key of a table that is being read: the table, where it is, what the key is.

    ``default``: what the key is where a file leaves it out, ``MISSING`` where none may;
    ``found``: what has been read of the table already.
    """

    table: Mapping[str, Any]
    key: str
    where: str
    about: Any = None
    default: Any = MISSING
    found: Mapping[str, Any] = {}

    @property
    def path(self) -> str:
        """The place of the value, in messages."""
        return f"{self.where}, {self.key}"


@dataclass(frozen=True)
class Key:
    """A key: the name of its type, which is one value, a list, or rows (``depth`` 0, 1, 2), of
    ``trees`` or not.

    ``keys``: those of a file that say it, where they are not the one of its name; ``null``: a
    record says it by null, and a file not at all, where there is none; ``told``: in a record.
    ``mass``: in units of mass, by which the principal frame scales it; ``positive``: may not be
    negative but where that is allowed; ``zero``: a length that may be 0; ``own``: what another
    table is; ``words``: those that it may have.
    """

    type: str
    depth: int = 0
    trees: bool = False
    keys: tuple[str, ...] | None = None
    null: bool = False
    told: bool = True
    mass: bool = False
    positive: bool = False
    zero: bool = False
    own: Any = None
    words: tuple[str, ...] = ()


Row = tuple[Tree, ...]
Rows = tuple[Row, ...]
ATTACHED = ("on", "at", "block")
Scalar = Annotated[Tree, Key("scalar", trees=True)]
Positive = Annotated[Tree, Key("scalar", trees=True, positive=True)]
Stiffness = Annotated[Tree, Key("scalar", trees=True, mass=True, positive=True)]
Energy = Annotated[Tree, Key("energy", trees=True)]
OfVolume = Annotated[Tree, Key("of_volume", trees=True)]
Vector = Annotated[Row, Key("vector", 1, trees=True)]
Symmetric = Annotated[Rows, Key("symmetric", 2, trees=True)]
Charges = Annotated[Row, Key("charges", 1, trees=True)]
Rotation = Annotated[Rows, Key("rotation", 2, trees=True)]
"""Expressions of the parameters, in a table that is ``timed`` of the time as well; an energy is of
places too, one of the volume of that. A vector and the rows of a rotation are of the space of the
points; there is a charge for each point."""

Pair = Annotated[tuple[int, int], Key("pair", 1)]
End = Annotated[int, Key("end", keys=ATTACHED)]
Points = Annotated[tuple[int, ...], Key("points", 1, keys=ATTACHED)]
Masses = Annotated[tuple[tuple[int, Tree], ...], Key("masses", 2, keys=())]
At = Annotated[Row, Key("place", 1, trees=True)]
Block = Annotated[int, Key("block")]
Space = Annotated[int, Key("space", keys=(), told=False)]
"""Two points; a point or a place of the body; points or a place; points with their masses, of which
the principal frame makes a list.  A place in the space of a block, and the block of a product.  The
dimension of the space, which the group says."""

First = Annotated[Row, Key("first", 1, trees=True, keys=("c", "centre"))]
Second = Annotated[
    Rows, Key("second", 2, trees=True, keys=("J", "I", "I_centre", "rotation", "rpy", "quaternion"))
]
Central = Annotated[bool, Key("central", keys=("I_centre",), told=False)]
Length = Annotated[Tree, Key("length", trees=True)]
Inner = Annotated[Tree, Key("length", trees=True, zero=True)]
Density = Annotated[Tree, Key("layered", trees=True)]
Lengths = Annotated[Row, Key("lengths", 1, trees=True)]
Axes = Annotated[Row | None, Key("lengths", 1, trees=True)]
Quadric = Annotated[Rows | None, Key("quadric", 2, trees=True)]
Corners = Annotated[Rows, Key("corners", 2, trees=True)]
Vertices = Annotated[tuple[tuple[Fraction, ...], ...], Key("vertices", 2, keys=("file",))]
Faces = Annotated[tuple[tuple[int, ...], ...], Key("faces", 2, keys=("file",))]
Turn = Annotated[Rows | None, Key("turn", 2, trees=True, null=True)]
Shift = Annotated[Row | None, Key("shift", 1, trees=True, null=True)]
"""Moments of a body, and whether a file says them about its centre; of solids in R³ the sizes:
lengths, positive, one or three; a density, of an ellipsoid or a ball a polynomial in the level s of
a place; a symmetric matrix; four corners; what the file of a mesh has.  A rotation and a vector of
R³, or none."""

Name = Annotated[str, Key("name")]
Letters = Annotated[str, Key("letters")]
Text = Annotated[str, Key("text")]
Frame = Annotated[str, Key("word", words=("space", "body"))]
ACTIONS = ("linear", "affine")
Action = Annotated[str, Key("word", words=ACTIONS)]
Default = Annotated[float | None, Key("number", null=True)]
Basis = Annotated[tuple[tuple[tuple[Fraction, ...], ...], ...], Key("basis", 2)]
"""A name of code; one of any letters, digits and _; text; space or body; linear or affine; a number
or none; matrices.

A key without a default must be there; one that is ``None`` if its kind chooses it
(:meth:`Table.chosen`)."""


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


NEEDS = (
    *("points alone", "one space", "rotations", "affine of R^3", "volumes"),
    *("deformations of R^3", "one ellipsoid", "no turning"),
)
"""What a kind may need of its problem: nothing has mass but the points; blocks of one dimension;
linear parts that are rotations; all translations of R³; one space, whose volumes change; linear
parts in R³ that are not rotations; a homogeneous ellipsoid about the origin, and nothing else; not
SO(3) or SE(3), nor a product."""
DETERMINANT: Tree = ("det", "A")
"""What ``det_A`` is in an energy of the volume."""
WORDS = Path(__file__).with_name("words.txt")
_LINES = (x.partition(": ") for x in WORDS.read_text(encoding="utf-8").split("\n"))
_TOLD = [(x, told) for words, _, told in _LINES if words[:1] != "#" for x in words.split()]
OTHER_WORDS = {x: told for x, told in _TOLD if " " not in told}
"""What others call it."""
ELSEWHERE = {x: told for x, told in _TOLD if " " in told}
"""Where a word stands that is often tried, or that it is outside of all this; of no parameter."""

OF_FORCES = ("direction", "axis", "magnitude", "value")
"""Those that are tried of inputs and of gravity."""


def nearest(word: str, known: Collection[str]) -> str:
    """``; did you mean 'spring'?``, or nothing."""
    other = OTHER_WORDS.get(word, "")
    return did_you_mean(other if other in known else near_name(word, known), "; ")


def hint(word: str, known: Collection[str], said: Collection[str] = ()) -> str:
    """Where a word stands that means nothing here, as of :data:`ELSEWHERE`; or else the nearest of
    those that are not yet said."""
    away = word in ELSEWHERE and OTHER_WORDS.get(word) not in known and "default" not in known
    away = away and (word not in OF_FORCES or not {"frame", "g"}.isdisjoint(known))
    return f"; {ELSEWHERE[word]}" if away else nearest(word, sorted({*known} - {*said}))


@dataclass_transform(frozen_default=True, kw_only_default=True)
@dataclass(frozen=True, kw_only=True)
class Table:
    """A table of a problem; each class of it is a dataclass.

    ``kind``: its name, where there are several kinds; ``needs``: what the problem must be;
    ``section``: the key of a file under which such tables stand; ``timed``: do its expressions know
    the time?  ``may``: keys that it has only where a file says them; ``called``: its word in
    Python;
    ``word``: what that makes of arguments, a table or a list of them, where they are not its keys.
    """

    kind: ClassVar[str] = ""
    needs: ClassVar[tuple[str, ...]] = ()
    section: ClassVar[str] = ""
    timed: ClassVar[bool] = False
    may: ClassVar[tuple[str, ...]] = ()
    called: ClassVar[str] = ""
    word: ClassVar[Any] = None

    def __init_subclass__(cls) -> None:
        dataclass(frozen=True, kw_only=True)(cls)

    @classmethod
    def keys(cls) -> dict[str, Key]:
        """Its keys by their names."""
        own: Any = cls
        return _keys(own)

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """The keys that a table of this kind may have in a file."""
        listed = {x: k.keys for x, k in cls.keys().items()}
        found = [x for name, keys in listed.items() for x in ((name,) if keys is None else keys)]
        return tuple(dict.fromkeys(found))

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """The keys that this table must or may have; or what is wrong with those it has.

        ``last``: points are numbered up to this.
        """
        del last
        known = cls.keys()
        return tuple(x for x in known if x not in cls.may or x in table)

    @classmethod
    def read(cls, table: Mapping[str, Any], where: str, reader: Any) -> Self:
        """What a table of this kind says to a :class:`~derive.schema.table_reader.TableReader`."""
        chosen = cls.chosen(table, reader.last)
        if isinstance(chosen, str):
            raise reader.fail(f"{where}: {chosen}")
        for need in cls.needs:
            reader.meets(need, cls.kind, where)
        found: dict[str, Any] = {}
        outer, reader.timed = reader.timed, cls.timed
        for x in fields(cls):
            about = cls.keys()[x.name]
            slot = Slot(table, x.name, where, about, x.default, found)
            needed = x.default is MISSING or (x.default is None and not about.null)
            if x.name in chosen and (needed or reader.has(slot)):
                found[x.name] = getattr(reader, about.type)(slot)
        reader.timed = outer
        return cls(**found)

    def values(self) -> Iterator[tuple[str, Key, Any]]:
        """Its keys that have a value."""
        for name, about in self.keys().items():
            value = getattr(self, name)
            said = about.null or value is not None
            if about.told and said and (about.type not in ("masses", "held") or value):
                yield name, about, value

    def plain(self) -> dict[str, Any]:
        """The table as the record has it; trees as they are."""
        said = {x: _plain(v, k.depth) for x, k, v in self.values()}
        return ({"kind": self.kind} if self.kind else {}) | said

    def trees(self) -> list[Tree]:
        """The expressions in this table."""
        return [
            t
            for _, k, value in self.values()
            for x in _members(value, k.depth)
            for t in (x.trees() if isinstance(x, Table) else [x] if k.trees else [])
        ]


def place(on: int | Sequence[Number] | None, block: int | None) -> dict[str, Any]:
    """The keys of a point by its number, or of a place of a body, of a block of a product."""
    return {"on" if isinstance(on, int) else "at": on, "block": block}


def _plain(value: Any, depth: int) -> Any:
    """Tuples as lists, to a depth; other tables as they say themselves."""
    if depth and value is not None:
        return [_plain(x, depth - 1) for x in value]
    return value.plain() if isinstance(value, Table) else value


def _members(value: Any, depth: int) -> Iterator[Any]:
    """What stands in lists of lists."""
    if depth and value is not None:
        for x in value:
            yield from _members(x, depth - 1)
    elif value is not None:
        yield value
