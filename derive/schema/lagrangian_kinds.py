"""Lagrangians that no points give: an expression ℓ(t, g, Z), or an inertia operator on 𝔤."""

from typing import Annotated

from ..language.tree import Tree
from .table import Key, Table

Lettered = Annotated[Tree, Key("lettered", trees=True)]
Coordinates = Annotated[tuple[Tree, ...], Key("coordinates", 1, trees=True)]
Operator = Annotated[tuple[tuple[Tree, ...], ...], Key("operator", 2, trees=True)]
Side = Annotated[str, Key("side")]
Held = Annotated[tuple[int, ...], Key("held", 1, keys=())]
"""An expression in the time and the names of the state; one for each coordinate of 𝔤; a symmetric
matrix of these; the side on which velocities are carried to 𝔤; numbers of coordinates, which no
file tells."""


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
SIDES = ("left", "right")
