"""The heads of calls as data: the functions, their arguments, and what each index counts."""

from __future__ import annotations

from dataclasses import dataclass

from ...language.tree import Tree, names


@dataclass(frozen=True)
class ArgumentKind:
    """What an argument of a function may be: one of the trees ``letters``; ``family``: or a member
    of that family at a time, as r_i(t); ``polynomial``: or a polynomial in Π_a and the entries of
    A or Γ; ``less``: or one of the trees less a function of t and A; ``members``: or a member of
    that family; ``applied``: or one of that family at that argument. ``description``: the same in
    words, for messages."""

    description: str
    letters: tuple[Tree, ...]
    family: str = ""
    polynomial: bool = False
    less: bool = False
    members: str = ""
    applied: tuple[str, str] = ("", "")


VARIATION = ArgumentKind("a variation δy, δ′y or X", ("δy", "δ′y", "X"))
TWO_ELEMENTS = ArgumentKind("a variation δy or δ′y", ("δy", "δ′y"))
AT_ONE_TIME = ArgumentKind("a variation δx or δ′x, at constant time", ("δx", "δ′x"))
MOTION = ArgumentKind("X", ("X",))
TIME = ArgumentKind("t", ("t",))
LINEAR = ArgumentKind(
    "a variation or a velocity of A, or 0",
    (0, "α", "δA", "δ′A", ("mul", "A", "ξ"), ("mul", "A", "ξ′"), ("mul", "A", "Z")),
)
TRANSLATION = ArgumentKind(
    "a variation or a velocity of T, or 0",
    (0, "τ", "δT", "δ′T", ("mul", "A", "η"), ("mul", "A", "η′"), ("mul", "A", "w")),
)
FIRST_FIELD, SECOND_FIELD = ArgumentKind("ξ", ("ξ",)), ArgumentKind("ξ′ or δ′Z", ("ξ′", "δ′Z"))
CARRYING = ArgumentKind("ξ or Z", ("ξ", "Z"))
SITE = ArgumentKind(
    "a point of the lattice",
    (
        *("𝐧", "𝐦", ("mul", -1, "𝐧"), ("add", "𝐦", "𝐧"), ("add", "𝐧", ("mul", -1, "𝐦"))),
        *(("mul", -1, "𝐦"), ("add", "𝐧", "𝐦"), ("add", "𝐦", ("mul", -1, "𝐧"))),
    ),
)
COORDINATE = ArgumentKind("a coordinate of a point of the lattice", (*range(-2, 3),))
NUMBERED = dict.fromkeys(("ω̂", "f̂"), (COORDINATE, COORDINATE))
"""The functions of the lattice that may be taken at a point by its coordinates, which are small."""
ON_TORUS: tuple[Tree, ...] = (
    *("h̃", ("call", "ω̂", "𝐧")),
    *(("call", "ω̂", a, b) for a in COORDINATE.letters for b in COORDINATE.letters),
    *(("tr", ("mul", *["W"] * k)) for k in (2, 3, 4)),
)
ERRORS = ("η_L", "η_R")
OF_ESTIMATE: tuple[Tree, ...] = ("Â", *ERRORS, "ξ_L", "ξ_R")
FORM = ArgumentKind(
    "ϖ(δy), less a function or not, r_i(t), v_i, or a polynomial in Π_a and entries of A or Γ",
    (("call", "ϖ", "δy"), *ON_TORUS, *OF_ESTIMATE),
    "r",
    polynomial=True,
    less=True,
    members="v",
)
MOVED_PLACE: Tree = ("call", "g", "r")
PER_DENSITY: tuple[Tree, ...] = (("div", "σ_r", "ρ_r"), ("div", "p_r", "ρ_r"))
INTEGRAND = ArgumentKind(
    "1, r, r r̄, p_r, σ_r/ρ_r, p_r/ρ_r, ‖v‖² or ⟨v, δ(g(r))⟩",
    (
        *(1, "r", "p_r", ("mul", "r", ("T", "r")), *PER_DENSITY),
        *(("norm2", "v"), ("inner", "v", ("call", "δ", MOVED_PLACE))),
    ),
)
PLACE = ArgumentKind("r", ("r",))
INVARIANTS = tuple(ArgumentKind(x, (x,)) for x in ("I_1", "I_2", "I_3"))
VARIED = ArgumentKind(
    "r_i(t), g(r), ξ′, η′, L̃, L_d, U_0, U_1, ϖ(X), 𝒥_i or 𝒜_i(ξ′)",
    ("ξ′", "η′", "L̃", "L_d", "U_0", "U_1", MOVED_PLACE, ("call", "ϖ", "X")),
    "r",
    members="𝒥",
    applied=("𝒜", "ξ′"),
)
VARIED_PRIME = ArgumentKind(
    "r_i(t), ξ, η, 𝒥_i or 𝒜_i(ξ)", ("ξ", "η"), "r", members="𝒥", applied=("𝒜", "ξ")
)
ALONG_FIELDS = ArgumentKind("ξ, ξ′ or Z", ("ξ", "ξ′", "Z"))

ON_GROUP = ArgumentKind("A, Â, A Â, an error or 1", ("A", "Â", ("mul", "A", "Â"), *ERRORS, 1))

HEADS: dict[str, tuple[ArgumentKind, ...]] = {
    "ϖ": (VARIATION,),
    "dϖ": (VARIATION, VARIATION),
    **dict.fromkeys(("Θ⁺", "Θ⁻"), (TWO_ELEMENTS,)),
    **dict.fromkeys(("dΘ⁺", "dΘ⁻"), (TWO_ELEMENTS, TWO_ELEMENTS)),
    "ω": (AT_ONE_TIME, AT_ONE_TIME),
    "p̃": (LINEAR, TRANSLATION),
    "dŨ": (LINEAR, TRANSLATION),
    "δ": (VARIED,),
    "δ′": (VARIED_PRIME,),
    "d/dt": (FORM,),
    **dict.fromkeys(("δA", "δT", "ξ", "η", "Ω"), (MOTION,)),
    "∫": (INTEGRAND,),
    "g": (PLACE,),
    "M̃": (FIRST_FIELD, SECOND_FIELD),
    "ℱ": (ON_GROUP,),
    "ρ": (CARRYING,),
    "ϖ_h": (VARIATION,),
    "dϖ_h": (VARIATION, VARIATION),
    **dict.fromkeys(("Ψ", "Ψ_0", "Ψ_1", "Ψ_2"), INVARIANTS),
    **dict.fromkeys(("T", "ω̂", "f̂", "ζ"), (SITE,)),
}
"""The kinds of the arguments of each function; TRANSLATION is left out for a group that does not
translate."""


def is_polynomial(t: Tree) -> bool:
    """Is a tree a polynomial in members Π_a and entries of A or Γ, its coefficients made of numbers
    and parameters?"""
    if not isinstance(t, tuple):
        return not isinstance(t, str) or t == "π"
    if t[0] in ("add", "mul"):
        return all(map(is_polynomial, t[1:]))
    if t[0] == "pow":
        return is_polynomial(t[1]) and t[2] > 0
    if t[0] == "div":
        return is_polynomial(t[1]) and is_polynomial(t[2]) and not {*names(t[2])} - {"π"}
    return t[0] == "par" or t[:2] in (("at", "Π"), ("entry", "A"), ("entry", "Γ"))


MOVED: dict[str, tuple[ArgumentKind, ...]] = {
    "r": (TIME,),
    "𝒜": (ALONG_FIELDS,),
    "d𝒜": (VARIATION, VARIATION),
}
"""The kinds of the arguments of members of families that are functions, as r_i(t)."""

POINT, AXIS = "points", "axes or elements of a basis"
INDEX_SETS: dict[str, str] = {
    **dict.fromkeys(("m", "r", "r̂", "v", "v̇", "F", "Q", "P", "κ"), POINT),
    **dict.fromkeys(("k", "s"), "springs"),
    **dict.fromkeys(("d", "χ", "σ"), "forces along a distance"),
    **dict.fromkeys(("E", "Π", "Π̇", "Φ"), AXIS),
    **dict.fromkeys(("𝒥", "𝒜", "d𝒜"), "symmetries"),
}
"""What the index of each family counts; that of an entry counts axes, or elements of a basis."""

SHARED = ("m", "F", "Q", "P")
"""The families in which each copy of a point has a share; all copies have one place and one
velocity."""

MATRICES = ("M", "𝕁", "𝕀")
"""The names of matrices whose entries have two indices also where they have one row; other matrices
of one column have entries of one index."""

LATTICE = ("𝐦", "𝐧")
"""The letters of points of the lattice of the torus, over which sums go as well."""

INDICES = ("a", "b", "e", "i", "j", *LATTICE)
"""The letters of indices."""

FORMS = (
    (("δA", "δT"), ("ξ", "η"), ("Ω", "η")),
    (("δ′A", "δ′T"), ("ξ′", "η′"), ("Ω′", "η′")),
)
"""The two variations of g, each in three forms, which are tied to one another."""

RATES = (("α̇", "τ̇"), ("Ż", "ẇ"), ("ζ̇", "ẇ"), ("ℓ̇_b", "ṗ_b"))
"""The acceleration of the motion, in the same forms."""

OF_ELEMENTS = ("δg_0", "δg_1", "ξ̂")
"""The variations of two elements of the discrete motion; ξ is tied to the second, and is ξ̂ for an
affine map."""

QUANTIFIED = (
    *{x: 0 for forms in (*FORMS, RATES) for form in forms for x in form},
    *OF_ELEMENTS,
)
"""The names of which all values are tried: an equation may be said to hold for all of them."""

SOLVED = ("θ", "q_0", "x_0", "q_1", "x_1")
"""The names of which a value is found, by solving: an equation may say that there is one."""
