"""Points by their velocity in space, ν = gZ, with ν = (Ȧ, Ṫ).

Where A stretches, Z = g⁻¹ν and C = ĀA lose digits as the square of its condition; what is kept is
small beside their entries.  In ν it is a sum of products of what is seen:

    h̃ = ½ Tr ν𝕁ν̄ + Ũ,    p̃(δg) = Tr ν𝕁δḡ,    𝕁 = [[J, c], [c̄, m]].
"""

from __future__ import annotations

from ..language.tree import Tree, add, mul, nodes, replaced, terms

BACK: Tree = ("inv", "A")
IN_SPACE = "ν𝕁ḡ"
"""The matrix p with p̃(Yg) = Tr p Ȳ."""

KINETIC: tuple[tuple[Tree, Tree], ...] = (
    (("tr", ("mul", "Z", "J", ("T", "Z"), "C")), ("tr", ("mul", "ν", "J", ("T", "ν")))),
    (("inner", ("mul", "C", "Z", "c"), "w"), ("inner", ("mul", "ν", "c"), "τ")),
    (("inner", ("mul", "C", "w"), "w"), ("norm2", "τ")),
)
"""What the energy has of Z, w and C = ĀA, and the same by the linear part ν = AZ and τ = Aw."""


def by_velocity(h: Tree, names: tuple[str, str]) -> Tree:
    """The energy h̃ of points by the ``names`` of ν and τ, where it has C; else as it is."""
    for inside, outside in KINETIC:
        for old, new in zip(("ν", "τ"), names, strict=True):
            outside = replaced(outside, old, new)
        h = replaced(h, inside, outside)
    return h


def has_velocity(h: Tree) -> bool:
    """Is the kinetic energy that of points on a group whose C does not drop out?"""
    return replaced(h, KINETIC[0][0], 0) != h


def in_space(quantity: Tree) -> Tree:
    """⟨Π, η⟩ by ⟨ν𝕁ḡ, Y⟩ for the parts A⁻¹YA of η: what is kept, without an inverse."""
    for pairing in nodes(quantity):
        if isinstance(pairing, tuple) and pairing[:2] == ("inner", "Π"):
            quantity = replaced(quantity, pairing, add(*map(_paired, terms(pairing[2]))))
    return quantity


def _paired(eta: Tree) -> Tree:
    """⟨Π, η⟩ of one part of η."""
    match eta:
        case ("mul", back, *Y, "A") if back == BACK:
            return ("inner", IN_SPACE, mul(*Y))
    return ("inner", "Π", eta)
