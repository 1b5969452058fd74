"""What may be called, and with what; what an index may stand under: the heads as data.

A head is a name of these tables and nothing else: no product, power, bar or sign of one.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Tree


@dataclass(frozen=True)
class Kind:
    """What an argument may be, letter by letter; ``family``: or a member of it at a time."""

    said: str
    letters: tuple[Tree, ...]
    family: str = ""


VARIATION = Kind("a variation δy, δ′y or X", ("δy", "δ′y", "X"))
AT_ONE_TIME = Kind("a variation δx or δ′x, at constant time", ("δx", "δ′x"))
MOTION = Kind("X", ("X",))
TIME = Kind("t", ("t",))
LINEAR = Kind(
    "a variation or a velocity of A, or 0",
    (0, "α", "δA", "δ′A", ("mul", "A", "ξ"), ("mul", "A", "ξ′"), ("mul", "A", "Z")),
)
TRANSLATION = Kind(
    "a variation or a velocity of T, or 0",
    (0, "τ", "δT", "δ′T", ("mul", "A", "η"), ("mul", "A", "η′"), ("mul", "A", "w")),
)
FORM = Kind("ϖ(δy)", (("call", "ϖ", "δy"),))
MOVED_PLACE: Tree = ("call", "g", "r")
INTEGRAND = Kind(
    "1, r, r r̄, ‖v‖² or ⟨v, δ(g(r))⟩",
    (
        *(1, "r", ("mul", "r", ("T", "r"))),
        *(("norm2", "v"), ("inner", "v", ("call", "δ", MOVED_PLACE))),
    ),
)
PLACE = Kind("r", ("r",))
VARIED = Kind("r_i(t), g(r), ξ′, η′ or ϖ(X)", ("ξ′", "η′", MOVED_PLACE, ("call", "ϖ", "X")), "r")
VARIED_PRIME = Kind("r_i(t), ξ or η", ("ξ", "η"), "r")

HEADS: dict[str, tuple[Kind, ...]] = {
    "ϖ": (VARIATION,),
    "dϖ": (VARIATION, VARIATION),
    "ω": (AT_ONE_TIME, AT_ONE_TIME),
    "p̃": (LINEAR, TRANSLATION),
    "dŨ": (LINEAR, TRANSLATION),
    "δ": (VARIED,),
    "δ′": (VARIED_PRIME,),
    "d/dt": (FORM,),
    **dict.fromkeys(("δA", "δT", "ξ", "η", "Ω"), (MOTION,)),
    "∫": (INTEGRAND,),
    "g": (PLACE,),
}
"""The kinds of the arguments of each function; a translation is one of affine groups alone."""

MOVED: dict[str, tuple[Kind, ...]] = {"r": (TIME,)}
"""The same for the members of families that move: r_i(t)."""

POINT, AXIS = "points", "axes or elements of a basis"
COUNTED: dict[str, str] = {
    **dict.fromkeys(("m", "r", "v", "F", "Q", "P", "κ"), POINT),
    **dict.fromkeys(("k", "s"), "springs"),
    **dict.fromkeys(("d", "χ", "σ"), "forces along a distance"),
    "f_u": "inputs",
    "E": AXIS,
}
"""What the index of each family counts; that of an entry counts axes, or elements of a basis."""

SHARED = ("m", "F", "Q", "P")
"""Families of what each copy of a point has a part of; all have one place and one velocity."""

MATRIX = "M"
"""A matrix of two indices also where it has one row: the others are then vectors of one entry."""

INDICES = ("a", "b", "e", "i", "j")
"""The letters of indices."""

FORMS = ((("δA", "δT"), ("ξ", "η"), ("Ω", "η")), (("δ′A", "δ′T"), ("ξ′", "η′"), ("Ω′", "η′")))
"""The two variations of g, each in three forms, which are tied to one another."""

RATES = (("α̇", "τ̇"), ("Ż", "ẇ"), ("ζ̇", "ẇ"), ("ℓ̇_b", "ṗ_b"))
"""The acceleration in the same forms."""

QUANTIFIED = tuple({x: 0 for forms in (*FORMS, RATES) for form in forms for x in form})
"""Of which all values are tried: an equation may be said to hold for all of them."""

SOLVED = ("θ",)
"""Of which a value is found: an equation may say that there is one."""
