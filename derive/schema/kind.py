"""What a kind of potential is: a table, its words, and what the others must know of it.

The kinds are in :mod:`derive.schema.kinds`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, NamedTuple

from .table import Table


class Own(NamedTuple):
    """A letter that the words of a kind have for their own: a scalar, a vector, a matrix, or a
    function "of invariants", three scalars; its meaning in English and in French."""

    name: str
    type: str
    meaning: str
    french: str
    latex: str


class Potential(Table):
    """One potential of a problem.

    ``rank``: in which order kinds are told. ``phrase``, ``several``: what acts, in words.
    ``drawn``: is it in the figure? ``legend``: what the figure says of it. ``unturned``: what
    ``--frame principal`` cannot carry into its frame; empty where its vectors may be turned with
    space, its points put to new places, and one factor of each term of U is a key with ``mass``,
    which is scaled. ``alone``: there is one of the kind. ``linear``: is the force per mass linear
    in the place, at each point of a body? ``letters``: those that its words have for their own.
    """

    section = "potential"
    rank: ClassVar[int] = 100
    phrase: ClassVar[str]
    several: ClassVar[str] = ""
    legend: ClassVar[str] = ""
    drawn: ClassVar[bool] = False
    unturned: ClassVar[str] = "a potential of this kind"
    alone: ClassVar[bool] = False
    linear: ClassVar[bool] = False
    letters: ClassVar[tuple[Own, ...]] = ()

    @property
    def summed(self) -> bool:
        """Is this potential a sum with a term for every point?"""
        return any(about.type == "masses" for about in self.keys().values())

    def points(self) -> Iterator[int]:
        """The points and places that it names by their numbers."""
        for _, about, value in self.values():
            if about.type in ("pair", "end", "points"):
                yield from (value,) if about.type == "end" else value
