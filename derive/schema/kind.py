"""What a problem may say: parameters, a group, an algebra, a fluid, forces, potentials."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Annotated, Any, ClassVar, Self

from ..language.reserved import one_or_more
from ..language.tree import Tree
from .table import (
    Action,
    Basis,
    Default,
    End,
    Frame,
    Key,
    Letters,
    Name,
    Number,
    Points,
    Row,
    Scalar,
    Stiffness,
    Table,
    Text,
    Vector,
    place,
)

# What a kind of potential is: a table, its words, and what the others must know of it.
#
# The kinds are in ``schema.potential_kinds``.


class Potential(Table):
    """One potential of a problem.

    ``rank``: in which order kinds are told. ``phrase``, ``several``: what acts, in words.
    ``drawn``: is it in the figure? ``legend``: what the figure says of it. ``unturned``: what
    ``--frame principal`` cannot carry into its frame; empty where its vectors may be turned with
    space, its points put to new places, and one factor of each term of U is a key with ``mass``,
    which is scaled. ``alone``: there is one of the kind. ``linear``: is the force per mass linear
    in the place, at each point of a body?
    """

    section, timed = "potential", True
    rank: ClassVar[int] = 100
    phrase: ClassVar[str]
    several: ClassVar[str] = ""
    legend: ClassVar[str] = ""
    drawn: ClassVar[bool] = False
    unturned: ClassVar[str] = "a potential of this kind"
    alone: ClassVar[bool] = False
    linear: ClassVar[bool] = False

    @property
    def summed(self) -> bool:
        """Is this potential a sum with a term for every point?"""
        return any(about.type == "masses" for about in self.keys().values())

    def points(self) -> Iterator[int]:
        """The points and places that it names by their numbers."""
        for _, about, value in self.values():
            if about.type in ("pair", "end", "points"):
                yield from (value,) if about.type == "end" else value


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


# Forces outside dϖ: inputs, given at every call, and damping.


Along = Annotated[Row | None, Key("direction", 1, trees=True)]
Couple = Annotated[Row | None, Key("couple", 1, trees=True)]
TurningBlock = Annotated[int, Key("turning", keys=("block",))]
"""What a number is the multiple of, a vector that is not 0; a moment, three numbers, or one in the
plane; a block of rotations of the plane or of R³."""


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
    name: Name
    on: End
    frame: Frame = "space"
    direction: Along = None
    moment: Couple = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A direction and a moment are where a table says them, the second beside the first."""
        if "moment" in table and "direction" not in table:
            return "a 'moment' goes with a 'direction'; alone it is an input of kind \"torque\""
        return _said(super().chosen(table, last), table)

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
    name: Name
    block: TurningBlock
    frame: Frame = "space"
    direction: Along = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A direction where a table says one."""
        return _said(super().chosen(table, last), table)

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


def _said(keys: tuple[str, ...] | str, table: Mapping[str, Any]) -> tuple[str, ...]:
    """The keys of an input, without the direction and the moment that a table does not say."""
    return tuple(x for x in keys if x not in ("direction", "moment") or x in table)


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

    name: Named = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A name where a table has one."""
        own = super().chosen(table, last)
        return own if isinstance(own, str) else tuple(x for x in own if x != "name" or x in table)


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
        on: int | Sequence[Number],
        force: Sequence[Number] | None = None,
        moment: Sequence[Number] | None = None,
        frame: str = "space",
        block: int | None = None,
        relative_to: Sequence[Number] | None = None,
        name: str | None = None,
    ) -> Any:
        """A force and a moment on a point, or at a place of the body, in a product of that of a
        block: expressions of the velocity v_1, … of the place, less that of a wind, of the state,
        t, inputs and parameters, in the frame "space" or "body"; with a name in the equations."""
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


class Flow(Nameable):
    """Mass that comes to a place of the body, or leaves there: the ``rate`` dm/dt, below 0 where it
    leaves, and its ``velocity`` relative to the body, along the axes of this; ``mass``: the number
    of the state that the mass is, where inputs say the rate."""

    section, timed = "flow", True
    on: End
    rate: Scalar
    velocity: Vector
    mass: Named = None

    @classmethod
    def chosen(cls, table: Mapping[str, Any], last: int) -> tuple[str, ...] | str:
        """A mass of the state where a table has one."""
        own = super().chosen(table, last)
        return own if isinstance(own, str) else tuple(x for x in own if x != "mass" or x in table)

    @classmethod
    def word(
        cls,
        on: int | Sequence[Number],
        rate: Number,
        velocity: Sequence[Number] | None = None,
        name: str | None = None,
        mass: str | None = None,
    ) -> Any:
        """Mass that flows at a point or a place of the body: dm/dt, below 0 where it leaves, and
        its velocity relative to the body; expressions of t and inputs; with a name in the
        equations; ``mass``: the parameter that the mass is, a number of the state then."""
        told = {"name": name, "rate": rate, "velocity": velocity, "mass": mass}
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
    ) -> Any:
        """The force −κ v on points (all by default), or on a place of the body, in a product of
        that of a block, outside dϖ; "quadratic", −κ ‖v‖ v; "rotational", the moment −κ ω; with a
        name in the equations, where it acts at one place."""
        told = {"name": name, "kind": kind, "coefficient": coefficient}
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
