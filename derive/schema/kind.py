"""What a problem may say: parameters, a group, an algebra, a fluid, a Lagrangian, kinematics."""

from fractions import Fraction
from typing import Annotated, Any

from ..language.tree import Tree
from .table import Action, Basis, Default, Key, Letters, Name, Table, Text

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
Forces = Annotated[str, Key("word", words=("none", "potential", "given"))]
"""None; or per unit mass, −grad V of any function V of the place, or any field f, given."""
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
