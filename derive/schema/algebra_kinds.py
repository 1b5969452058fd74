"""A Lie algebra whose group moves no points, and what it carries along: advected quantities."""

from fractions import Fraction
from typing import Annotated, Any

from .table import Basis, Key, Name, Table, Text

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
