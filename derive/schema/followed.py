"""What a file says of motions that are followed, and no record of equations has: events."""

from typing import Annotated, Any

from ..language.tree import Tree
from .table import Key, Name, Number, Table

Watched = Annotated[Tree, Key("watched", trees=True)]
Direction = Annotated[str, Key("direction")]
Flag = Annotated[bool, Key("flag")]
"""An expression of the state, the time and the parameters; one of DIRECTIONS; true or false."""

DIRECTIONS = ("both", "rising", "falling")


class Event(Table):
    """An instant at which the expression ``when`` changes its sign: ``rising`` from below 0,
    ``falling`` from above; a ``terminal`` one ends the run."""

    section, called = "event", "Event"
    name: Name
    when: Watched
    direction: Direction = "both"
    terminal: Flag = False

    @classmethod
    def word(cls, name: str, when: Number, direction: str = "both", terminal: bool = False) -> Any:
        """An event of a motion: an expression of the state, t and the parameters crosses 0, from
        below, "rising", or from above, "falling", or either, "both"; a terminal one ends a run."""
        return {"name": name, "when": when, "direction": direction, "terminal": terminal}
