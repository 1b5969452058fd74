"""What a file says of motions that are followed, and no record of equations has: the tables
[[event]] and [[signal]]."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from ..language.tree import Tree
from .table import Key, Name, Number, Row, Table

Watched = Annotated[Tree, Key("watched", trees=True)]
Direction = Annotated[str, Key("word", words=("both", "rising", "falling"))]
Flag = Annotated[bool, Key("flag")]
Times = Annotated[Row | None, Key("samples", 1, trees=True, keys=("times",))]
Samples = Annotated[Row | None, Key("samples", 1, trees=True, keys=("values",))]
InTime = Annotated[Tree | None, Key("scalar", trees=True)]
"""An expression of the state, the time and the parameters; from where 0 is reached; true or false;
as many expressions of the parameters as there are; one of these and the time t."""


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


class Signal(Table):
    """A number of an input in time: ``values`` at increasing ``times``, each held up to the next
    one or, without ``hold``, joined by straight lines; or ``u``, an expression of t."""

    section, called = "signal", "Signal"
    input: Name
    times: Times = None
    samples: Samples = None
    hold: Flag = True
    u: InTime = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """Times and values, or an expression."""
        if ("u" in table) == ("times" in table or "values" in table):
            return "give 'times' and 'values', or 'u', an expression of t and the parameters"
        if "u" in table and "hold" in table:
            return "'hold' is of 'values', not of 'u': leave it out"
        return ("input", "u") if "u" in table else ("input", "times", "samples", "hold")

    @classmethod
    def word(
        cls,
        input: str,
        times: Sequence[Number] | None = None,
        values: Sequence[Number] | None = None,
        hold: bool | None = None,
        u: Number | None = None,
    ) -> Any:
        """A number of an input in time, as "thrust" or "F_3": values at times from 0 on, each held
        up to the next one, or joined by straight lines; or u, an expression of t and the
        parameters."""
        return {"input": input, "times": times, "values": values, "hold": hold, "u": u}
