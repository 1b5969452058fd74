"""Forces outside dϖ: inputs, given at every call, what acts as a function of the state, flows of
mass, and damping."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Self

from ..language.reserved import one_or_more
from ..language.tree import Tree
from .table import (
    End,
    Frame,
    Key,
    Name,
    Number,
    Points,
    Row,
    Scalar,
    Stiffness,
    Table,
    Vector,
    place,
)

Along = Annotated[Row | None, Key("direction", 1, trees=True)]
Couple = Annotated[Row | None, Key("couple", 1, trees=True)]
TurningBlock = Annotated[int, Key("turning", keys=("block",))]
Steady = Annotated[bool | None, Key("flag")]
"""What a number is the multiple of, a vector that is not 0; a moment, three numbers, or one in the
plane; a block of rotations of the plane or of R³; true or false."""


class CovectorInput(Table):
    """A covector of the Lie algebra: power ⟨u, ζ⟩."""

    kind, section, called = "covector", "input", "Covector"
    name: Name

    @classmethod
    def word(cls, name: str) -> Any:
        """An input: a covector of the Lie algebra, by its values on the basis."""
        return {"name": name}


class ForceInput(Table):
    """A force on a point or a place; ``frame``: its components are in space or body.

    With a ``direction`` it is one number times this, and a ``moment`` that times the same number.
    """

    kind, section, called = "force", "input", "Force"
    may = ("direction", "moment")
    name: Name
    on: End
    frame: Frame = "space"
    direction: Along = None
    moment: Couple = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A moment is beside a direction alone."""
        if "moment" in table and "direction" not in table:
            return "a 'moment' goes with a 'direction'; alone it is an input of kind \"torque\""
        return super().chosen(table, last)

    @classmethod
    def word(
        cls,
        name: str,
        on: int | Sequence[Number],
        frame: str = "space",
        block: int | None = None,
        direction: Sequence[Number] | None = None,
        moment: Sequence[Number] | None = None,
    ) -> Any:
        """An input: a force on a point, or at a place of the body, in a product of that of a block;
        its frame is "space" or "body". With a direction it is one number times this, and a moment
        that times the same number."""
        told = {"name": name, "frame": frame, "direction": direction, "moment": moment}
        return told | place(on, block)


class TorqueInput(Table):
    """A torque on a body that turns, of one number with a ``direction`` and in the plane."""

    kind, section, called = "torque", "input", "Torque"
    may = ("direction",)
    name: Name
    block: TurningBlock
    frame: Frame = "space"
    direction: Along = None

    @classmethod
    def word(
        cls,
        name: str,
        frame: str = "space",
        block: int | None = None,
        direction: Sequence[Number] | None = None,
    ) -> Any:
        """An input: a torque, in a product on that of a block; its frame is "space" or "body". With
        a direction it is one number times this."""
        return {"name": name, "frame": frame, "block": block, "direction": direction}


class ScalarInput(Table):
    """A number that forces of the state know, and that does not push by itself: a throttle."""

    kind, section, called = "scalar", "input", "Scalar"
    name: Name

    @classmethod
    def word(cls, name: str) -> Any:
        """An input: a number that expressions of applied forces have, as a throttle."""
        return {"name": name}


Named = Annotated[str | None, Key("name")]
Stated = Annotated[Row, Key("stated", 1, trees=True)]
Torque = Annotated[Row, Key("stated_couple", 1, trees=True)]
Wind = Annotated[Row, Key("wind", 1, trees=True, told=False)]
Dual = Annotated[Row, Key("stated_covector", 1, trees=True)]
Origin = Annotated[str, Key("text", keys=(), told=False)]
"""A name or none; expressions of the state, t, inputs and parameters; a moment of these; a velocity
in space, of t and the place; a covector of the Lie algebra; which other table this is made of."""


class Nameable(Table):
    """What may have a ``name``, by which the equations and the code call its numbers."""

    may: ClassVar[tuple[str, ...]] = ("name",)
    name: Named = None


class Acting(Nameable):
    """What acts as a function of the state; ``table``: of a damping or a flow that acts so, as
    "damping 1"."""

    section = "force"
    table: Origin = ""
    expressed: ClassVar[tuple[str, ...]]
    """The keys that have expressions of the state."""

    def numbers(self) -> dict[str, Tree]:
        """Its numbers that are not 0 by their names, ``drag_1``, … of ``drag`` (of one number, the
        name), in the order of its keys; none where it has no name."""
        listed = [t for key in self.expressed for t in getattr(self, key)]
        names = one_or_more(self.name, len(listed)) if self.name else ()
        return {name: t for name, t in zip(names, listed, strict=False) if t != 0}

    def by_name(self) -> Self:
        """The same with these names for its expressions."""
        if not self.name:
            return self
        names = iter(self.numbers())
        own: dict[str, Any] = {
            key: tuple(t if t == 0 else ("par", next(names)) for t in getattr(self, key))
            for key in self.expressed
        }
        return replace(self, **own)


class StatedForce(Acting):
    """A force, or a moment, that is a function of the state: of the velocity of its place too,
    less that of what is there (``relative_to``, which a record has in the expressions)."""

    called, expressed = "AppliedForce", ("force", "moment")
    on: End
    frame: Frame = "space"
    relative_to: Wind = ()
    force: Stated = ()
    moment: Torque = ()

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """One of force and moment at least."""
        if not table.get("force") and not table.get("moment"):
            return "give 'force' or 'moment', lists of expressions, or a 'covector' alone"
        return super().chosen(table, last)

    @classmethod
    def word(
        cls,
        on: int | Sequence[Number] | None = None,
        force: Sequence[Number] | None = None,
        moment: Sequence[Number] | None = None,
        frame: str = "space",
        block: int | None = None,
        relative_to: Sequence[Number] | None = None,
        name: str | None = None,
    ) -> Any:
        """A force and a moment on a point, or at a place of the body, in a product of that of a
        block: expressions of the velocity v_1, … of the place, less that of a wind, of the state,
        t, inputs and parameters, in the frame "space" or "body"; with a name in the equations. A
        moment alone needs no place."""
        told = {"force": force, "moment": moment, "frame": frame, "relative_to": relative_to}
        return {"name": name} | told | place(on, block)


class StatedCovector(Acting):
    """A covector of the Lie algebra that is a function of the state, by its values on the basis
    that the problem states: power ⟨Q, ζ⟩."""

    called, expressed = "AppliedCovector", ("covector",)
    covector: Dual

    @classmethod
    def word(cls, covector: Sequence[Number], name: str | None = None) -> Any:
        """What acts along each element of the basis: expressions of the state, t, inputs and
        parameters, as many as the group has dimensions; with a name in the equations."""
        return {"name": name, "covector": covector}


def acting_kind(table: Any) -> type[StatedForce] | type[StatedCovector]:
    """Of a force of the state, as its table says it: at a place, or a covector."""
    covector = isinstance(table, dict) and "covector" in table
    return StatedCovector if covector else StatedForce


class Flow(Nameable):
    """Mass that comes to a place of the body, or leaves there: the ``rate`` dm/dt, below 0 where it
    leaves, and its ``velocity`` relative to the body, along the axes of this; ``mass``: the number
    of the state that the mass is, where inputs say the rate; ``steady``: is the rate ṗ of the
    momentum of what flows inside neglected?"""

    section, timed = "flow", True
    may: ClassVar[tuple[str, ...]] = ("name", "mass", "steady")
    on: End
    rate: Scalar
    velocity: Vector
    mass: Named = None
    steady: Steady = None

    @classmethod
    def word(
        cls,
        on: int | Sequence[Number],
        rate: Number,
        velocity: Sequence[Number] | None = None,
        name: str | None = None,
        mass: str | None = None,
        steady: bool | None = None,
    ) -> Any:
        """Mass that flows at a point or a place of the body: dm/dt, below 0 where it leaves, and
        its velocity relative to the body; expressions of t and inputs; with a name in the
        equations; ``mass``: the parameter that the mass is, a number of the state then;
        ``steady``: the rate ṗ of the momentum of what flows inside is neglected."""
        told = {"name": name, "rate": rate, "velocity": velocity, "mass": mass, "steady": steady}
        return {**told, **place(on, None)}


class Damping(Nameable):
    """−κ v on points: a Rayleigh function ½ κ ‖v‖², no potential; of one with a name a record has
    a force of the state."""

    section = "damping"
    coefficient: Stiffness
    on: Points

    @classmethod
    def word(
        cls,
        coefficient: Number,
        on: Sequence[int] | None = None,
        at: Sequence[Number] | None = None,
        block: int | None = None,
        kind: str | None = None,
        name: str | None = None,
        power: int | None = None,
    ) -> Any:
        """The force −κ v on points (all by default), or on a place of the body, in a product of
        that of a block, outside dϖ; "quadratic", −κ ‖v‖ v; "rotational", the moment −κ ω; with a
        name in the equations, where it acts at one place. On the torus "laplacian", −κ (−Δ)ᵖ ω, p
        the ``power``."""
        told = {"name": name, "kind": kind, "coefficient": coefficient, "power": power}
        return told | {"on": on, "at": at, "block": block}


class QuadraticDamping(Nameable):
    """−κ ‖v‖ v on points, which a record has as forces of the state."""

    kind, section = "quadratic", "damping"
    coefficient: Stiffness
    on: Points


class RotationalDamping(Nameable):
    """The moment −κ ω, ω the angular velocity in the body; the same of records."""

    kind, section = "rotational", "damping"
    coefficient: Stiffness
    block: TurningBlock


class LaplacianDamping(Table):
    """−κ (−Δ)ᵖ ω of the vorticity ω of a fluid on the torus, −κ ‖n‖²ᵖ ω̂(n), p the ``power``: 0 is
    the drag of Ekman, 1 viscosity, more hyperviscosity."""

    kind, section = "laplacian", "damping"
    coefficient: Stiffness
    power: Annotated[int, Key("order")] = 0


AnyDamping = Damping | QuadraticDamping | RotationalDamping
DAMPING: dict[str, type[QuadraticDamping] | type[RotationalDamping]] = {
    x.kind: x for x in (QuadraticDamping, RotationalDamping)
}


Input = CovectorInput | ForceInput | TorqueInput | ScalarInput
INPUTS: dict[str, type[Input]] = {
    "covector": CovectorInput,
    "force": ForceInput,
    "torque": TorqueInput,
    "scalar": ScalarInput,
}
