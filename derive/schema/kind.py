"""What a problem may say beside its body and what acts on it: parameters, a group, an algebra, a
fluid, a Lagrangian, kinematics; of motions that are followed the tables [[event]] and
[[signal]], of which no record of equations has anything; and what is read off a motion,
[[output]], by kinds.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Annotated, Any, ClassVar

from ..language.tree import Tree
from .force_kinds import TurningBlock
from .table import (
    ATTACHED,
    Action,
    Basis,
    Block,
    Default,
    End,
    Frame,
    Key,
    Letters,
    Name,
    Number,
    Row,
    Table,
    Text,
    place,
)

# What a problem declares before its body: its parameters, and a group of its own.


class Parameter(Table):
    """A free name, with what a reader of the emitted code wants to know."""

    default: Default = None
    unit: Text = ""
    meaning: Text = ""


class StatedGroup(Table):
    """A group by a ``basis`` of its Lie algebra, matrices over Q; those of an affine one have a
    last row of zeros."""

    name: Letters
    action: Action = "linear"
    basis: Basis


# A fluid whose displacements keep the volume: a problem without matrices.

Density = Annotated[str, Key("word", words=("homogeneous", "advected"))]
"""Everywhere the same; or from place to place another, which the fluid carries along."""
Forces = Annotated[str, Key("word", words=("none", "potential"))]
"""None; or per unit mass, −grad V of any function V of the place."""
GROUP = "SDiff"
"""The displacements that keep the volume."""


class Fluid(Table):
    """An incompressible fluid in the flat space of any dimension, or a domain of it; with its
    ``density`` and the ``forces`` on it."""

    section = "fluid"
    density: Density = "homogeneous"
    forces: Forces = "none"


# Kinematics of first order: ġ = f_u(g), of whose state a filter keeps an estimate.

SIDES = ("left", "right")
Side = Annotated[str, Key("word", words=SIDES)]
InputNames = Annotated[tuple[str, ...], Key("input_names", 1)]
Rate = Annotated[tuple[tuple[Tree, ...], ...], Key("rate", 2, trees=True)]
Densities = Annotated[tuple[Tree, ...], Key("densities", 1, trees=True)]
"""The side of a trivialisation, or of an error; names of numbers; ġ, a matrix of expressions in the
entries of g and the inputs; an expression of the parameters for each input."""


class Kinematics(Table):
    """ġ = f_u(g), the matrix ``rate``, u the numbers ``inputs``; ``noise``: the spectral density of
    the noise on each of them; ``error``: the side of the error whose covariance the code has."""

    section = "kinematics"
    inputs: InputNames
    rate: Rate
    noise: Densities = ()
    error: Side = "left"


# Lagrangians that no points give: an expression ℓ(t, g, Z), or an inertia operator on 𝔤.

Lettered = Annotated[Tree, Key("lettered", trees=True)]
Coordinates = Annotated[tuple[Tree, ...], Key("coordinates", 1, trees=True)]
Operator = Annotated[tuple[tuple[Tree, ...], ...], Key("operator", 2, trees=True)]
Held = Annotated[tuple[int, ...], Key("held", 1, keys=())]
"""An expression in the time and the names of the state; one for each coordinate of 𝔤; a symmetric
matrix of these; numbers of coordinates, which no file tells."""


class Lagrangian(Table):
    """ℓ(t, g, Z), in t, the entries of g, the coordinates of Z in the basis of 𝔤, and parameters.

    ``trivialisation``: Z = g⁻¹ġ on the left, ġg⁻¹ on the right. ``held``: the coordinates, from 1,
    in which a motion is chosen, where the second derivative is singular.
    """

    section = "lagrangian"
    L: Lettered
    trivialisation: Side = "left"
    held: Held = ()


class Inertia(Table):
    """½⟨ζ, 𝕀ζ⟩ + ⟨a, ζ⟩ − U: the ``operator`` 𝕀, d × d, the ``momentum`` a at rest, and ``U``."""

    section = "inertia"
    operator: Operator
    momentum: Coordinates = ()
    U: Lettered = 0
    trivialisation: Side = "left"


SECTIONS: dict[str, type[Lagrangian] | type[Inertia]] = {
    x.section: x for x in (Lagrangian, Inertia)
}


# A Lie algebra whose group moves no points, and what it carries along: advected quantities.

Rows = Annotated[tuple[tuple[int, int, int, Fraction], ...], Key("brackets", 2)]
Count = Annotated[int, Key("elements")]
Matrices = Annotated[tuple[tuple[tuple[Fraction, ...], ...], ...], Key("representation", 2)]
"""Rows [a, b, k, c] of [E_a, E_b] = c E_k + …; how many; the matrices of a representation."""


class StatedAlgebra(Table):
    """Those of a group ``of`` a name; or by a ``basis`` of matrices; or by ``brackets``, rows
    [a, b, k, c] of [E_a, E_b] = c E_k + …, of so many elements (``dimension``)."""

    section = "algebra"
    called = "Algebra"
    of: Text = ""
    basis: Basis = ()
    brackets: Rows = ()
    dimension: Count = 0


class Torus(Table):
    """su(N) in the basis T_n of the torus, as a record has it; L = ½ Σ |n|² |ζ_n|²."""

    N: Annotated[int, Key("odd")]


class StatedTorus(Torus):
    """The same in a file."""

    section, called = "algebra", "Torus"
    of: Text

    @classmethod
    def word(cls, N: int) -> Any:
        """su(N) in the basis of the torus, N odd: Zeitlin's model, with ``Laplacian()``."""
        return {"of": "torus", "N": N}


class TorusInertia(Table):
    """The inertia operator of the torus, by name: ``laplacian``, |n|² on T_n."""

    section, called = "inertia", "Laplacian"
    operator: Text
    trivialisation: Text = "right"

    @classmethod
    def word(cls) -> Any:
        """The inertia of a fluid on the torus: the square of n on T_n."""
        return {"operator": "laplacian"}


class StatedAdvected(Table):
    """Γ = ρ(g)⁻¹Γ₀, on the right ρ(g)Γ₀, by the matrices ρ(E_a) of its ``representation``, or one
    of those that every algebra has; its entries are NAME_1, NAME_2, … in expressions."""

    section = "advected"
    called = "Advected"
    name: Name
    representation: Matrices


class Advected(Table):
    """The same in a record: of so many entries; ρ is a block of the basis of the group."""

    name: Name
    size: Count


REPRESENTATIONS = ("standard", "dual", "adjoint", "coadjoint")
"""The representations by name: by the matrices of the algebra, x ↦ [E_a, x], and their duals."""


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
ReadAt = Annotated[int | None, Key("end", keys=ATTACHED)]
Unit = Annotated[str, Key("unit")]
Expressions = Annotated[Row, Key("observed", 1, trees=True)]
"""A vector that is not 0; the point, or the point of space, up to which a distance is; a potential
that is a spring, by its number; what acts, by its name; the place whose r_1, …, v_1, … expressions
name, if they do; a unit; expressions of the state, t, inputs and parameters."""


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
    axes of the body."""

    kind = "specific_force"
    on: End


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
        unit: str | None = None,
    ) -> Any:
        """What is read off a motion: the "place", "velocity", "acceleration" or "specific_force" of
        a point or a place of the body; a "rate", that of turning; a "direction" of the body in
        space, or of space in the frame "body"; the "distance" to a point or an anchor; the
        "momentum"; the "tension" of a spring, the potential of that number; the "power" of what
        acts by a name, or of all; or expressions y. A unit is beside it in runs."""
        told = {"name": name, "kind": kind, "y": y, "frame": frame, "to": to}
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

OF_MASSES = ("specific_force", "momentum", "tension")
"""Kinds that need masses, their weights or springs: where no points give the Lagrangian there are
none; what of it is uniform gravity it does not say."""
