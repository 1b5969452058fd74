"""What a file says of motions that are followed: the tables [[event]] and [[signal]], of which no
record of equations has anything, and what is read off a motion, [[output]], by kinds.
"""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar

from ..language.tree import Tree
from .force_kinds import TurningBlock
from .table import ATTACHED, Block, End, Frame, Key, Name, Number, Row, Table, place

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


AxisDirection = Annotated[Row, Key("direction", 1, trees=True)]
OtherEnd = Annotated[int | None, Key("other_end", keys=("to",))]
Anchor = Annotated[Row | None, Key("anchor", 1, trees=True, keys=("to",))]
SpringNumber = Annotated[int, Key("spring")]
Acting = Annotated[str | None, Key("acting_name", null=True)]
Falling = Annotated[Row | None, Key("vector", 1, trees=True)]
ReadAt = Annotated[int | None, Key("end", keys=ATTACHED)]
Unit = Annotated[str, Key("unit")]
Expressions = Annotated[Row, Key("observed", 1, trees=True)]
"""A vector that is not 0; the point, or the point of space, up to which a distance is; a potential
that is a spring, by its number; what acts, by its name; the acceleration of what falls; the place
whose r_1, …, v_1, … expressions name, if they do; a unit; expressions of the state, t, inputs and
parameters."""


class Output(Table):
    """What of a motion has a name: a number, or as many as the space has; in a ``unit``, which
    columns of runs have beside it."""

    section: ClassVar[str] = "output"
    name: Name
    unit: Unit = ""


class PlaceOutput(Output):
    """r_i(t), where a point or a place of the body is, from the origin of space."""

    kind = "place"
    on: End
    frame: Frame = "space"


class VelocityOutput(PlaceOutput):
    """Its velocity."""

    kind = "velocity"


class AccelerationOutput(PlaceOutput):
    """Its acceleration, along the motion."""

    kind = "acceleration"


class SpecificForceOutput(Output):
    """What an accelerometer reads there: the acceleration less that of uniform gravity, along the
    axes of the body; beside a Lagrangian, which does not say what of it is gravity, less ``g``."""

    kind, may = "specific_force", ("g",)
    on: End
    g: Falling = None


class RateOutput(Output):
    """What a gyroscope reads: the angular velocity in the body, one number in the plane."""

    kind = "rate"
    block: TurningBlock


class DirectionOutput(Output):
    """A vector of the body as it is in space; or one of space as the body sees it, in its axes."""

    kind = "direction"
    block: Block
    direction: AxisDirection
    frame: Frame = "space"


class DistanceOutput(Output):
    """That of a point to another, or to a point of space."""

    kind = "distance"
    on: End
    other_end: OtherEnd = None
    anchor: Anchor = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A point by its number, or a point of space by its coordinates."""
        if not {"to", "other_end", "anchor"} & {*table}:
            return "give 'to', a point by its number or a point of space by its coordinates"
        given = isinstance(table.get("to", table.get("anchor")), list)
        return "name", "unit", "on", "anchor" if given else "other_end"


class MomentumOutput(Output):
    """Σ m_i v_i, over the points of a block."""

    kind = "momentum"
    block: Block
    frame: Frame = "space"


class TensionOutput(Output):
    """k (‖d‖ − length), with which a spring pulls."""

    kind = "tension"
    of: SpringNumber


class PowerOutput(Output):
    """The power of what acts by a name, or of all that acts."""

    kind = "power"
    of: Acting = None


class ExpressionOutput(Output):
    """Expressions y of the state, and of the coordinates r_1, … and the velocity v_1, … of a place
    where one is said."""

    kind, called = "expression", "Output"
    on: ReadAt = None
    y: Expressions

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A place where the table says one."""
        return ("name", "unit", *["on"] * bool({*ATTACHED} & {*table}), "y")

    @classmethod
    def word(
        cls,
        name: str,
        kind: str | None = None,
        on: int | Sequence[Number] | None = None,
        y: Sequence[Number] | None = None,
        frame: str | None = None,
        block: int | None = None,
        to: int | Sequence[Number] | None = None,
        direction: Sequence[Number] | None = None,
        of: int | str | None = None,
        g: Sequence[Number] | None = None,
        unit: str | None = None,
    ) -> Any:
        """What is read off a motion: the "place", "velocity", "acceleration" or "specific_force" of
        a point or a place of the body; a "rate", that of turning; a "direction" of the body in
        space, or of space in the frame "body"; the "distance" to a point or an anchor; the
        "momentum"; the "tension" of a spring, the potential of that number; the "power" of what
        acts by a name, or of all; or expressions y. Beside a Lagrangian a specific force is the
        acceleration less g. A unit is beside it in runs."""
        told = {"name": name, "kind": kind, "y": y, "frame": frame, "to": to, "g": g}
        told |= {"direction": direction, "of": of, "block": block, "unit": unit}
        return told if on is None else told | place(on, block)


OUTPUTS: dict[str, type[Output]] = {
    x.kind: x
    for x in (
        PlaceOutput,
        VelocityOutput,
        AccelerationOutput,
        SpecificForceOutput,
        RateOutput,
        DirectionOutput,
        DistanceOutput,
        MomentumOutput,
        TensionOutput,
        PowerOutput,
        ExpressionOutput,
    )
}


def fault_of_gravity(data: Mapping[str, Any], pointless: bool) -> str:
    """What is wrong with an output that has, or lacks, the acceleration of gravity; "" for none."""
    if data.get("kind") != SpecificForceOutput.kind or (data.get("g") is not None) == pointless:
        return ""
    if pointless:
        return (
            "L does not say what of it is uniform gravity: give its acceleration, as "
            "g = [0, 0, -9.81] in space, or read the acceleration"
        )
    return "g: the potentials of a body say what gravity there is; leave this out"


OF_MASSES = ("momentum", "tension")
"""Kinds that need masses or springs: where no points give the Lagrangian there are none."""
