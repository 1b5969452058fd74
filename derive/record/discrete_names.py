"""The names of the discrete road: elements of the group a time h apart, and what is made of them.

An affine map is here its matrix on (r, 1): ``of_action`` has the types and meanings of each action.
"""

from __future__ import annotations

from .name_types import (
    ALGEBRA,
    SCALAR,
    SQUARE,
    VARIATION,
    VECTOR,
    Name,
    Type,
    defined,
    family,
    function,
    letter,
    name,
    unknown,
)

MATRIX, PLACE = ("matrix", "size", "size"), ("vector", "size")


# fmt: off
COMMON: dict[str, Name] = {
    "h": name("time from one element to the next",
        "durée d’un élément au suivant", "h", letter(SCALAR)),
    "L_d": name("discrete Lagrangian, of two elements of the group",
        "lagrangien discret, de deux éléments du groupe", "L_d", defined(SCALAR)),
    "y": name("pair (g_0, g_1) of elements of the group",
        "couple (g_0, g_1) d’éléments du groupe", "y"),
    "δy": name("a variation of (g_0, g_1)",
        "variation de (g_0, g_1)", r"\delta y", letter(VARIATION)),
    "δ′y": name("another variation of (g_0, g_1)",
        "autre variation de (g_0, g_1)", r"\delta' y", letter(VARIATION)),
    "Θ⁺": name("part of δL_d at the later end",
        "partie de δL_d au second bout", r"\Theta^+", function(VARIATION, SCALAR)),
    "Θ⁻": name("opposite of the part of δL_d at the earlier end",
        "opposé de la partie de δL_d au premier bout",
        r"\Theta^-", function(VARIATION, SCALAR)),
    "dΘ⁺": name("exterior derivative of Θ⁺",
        "dérivée extérieure de Θ⁺",
        r"\mathrm{d}\Theta^+", function(VARIATION, VARIATION, SCALAR)),
    "dΘ⁻": name("exterior derivative of Θ⁻",
        "dérivée extérieure de Θ⁻",
        r"\mathrm{d}\Theta^-", function(VARIATION, VARIATION, SCALAR)),
    "δ": name("a variation", "une variation", r"\delta", function(SCALAR, SCALAR)),
    "θ": name("multiplier of the volume", "multiplicateur du volume",
        r"\theta", unknown(SCALAR)),
    "H": name("where the linear parts would go without the multiplier",
        "là où iraient les parties linéaires sans le multiplicateur", "H", defined(SQUARE)),
    "Y": name("H by the moments and the element in the middle: H times J, carried back",
        "H par les moments et l’élément du milieu : H fois J, ramené", "Y", defined(SQUARE)),
    "J_D": name("moments of the masses, and h/2 times those of the damping",
        "moments des masses, et h/2 fois ceux de l’amortissement", "J_D", defined(SQUARE)),
    "μ_1": name("torque of the forces at g_1 in the body frame, about the fixed point "
        "or the centre of mass, a vector",
        "moment des forces en g_1 dans le repère du corps, par rapport au point fixe "
        "ou au centre de masse, un vecteur", r"\mu_1", defined(VECTOR)),
}
"""The names of the discrete road that mean the same for every action."""

for _k in range(2):
    COMMON |= {
        f"q_{_k}": name(f"real part of a unit quaternion of W_{_k}",
            f"partie réelle d’un quaternion unitaire de W_{_k}", f"q_{_k}", unknown(SCALAR)),
        f"x_{_k}": name(f"the other three parts of a unit quaternion of W_{_k}",
            f"les trois autres parties d’un quaternion unitaire de W_{_k}",
            f"x_{_k}", unknown(VECTOR)),
        f"U_{_k}": name(f"potential at g_{_k}", f"potentiel en g_{_k}",
            f"U_{_k}", letter(SCALAR)),
        f"W_{_k}": name(f"linear part of g_{_k}⁻¹g_{_k + 1}, a step seen from the body",
            f"partie linéaire de g_{_k}⁻¹g_{_k + 1}, un intervalle vu du corps",
            f"W_{_k}", defined(SQUARE)),
        f"M_{_k}": name(f"momentum of the step W_{_k}, a skew matrix",
            f"moment de l’intervalle W_{_k}, une matrice antisymétrique",
            f"M_{_k}", defined(SQUARE)),
        f"ℓ_{_k}": name(f"angular momentum of the step from g_{_k}, a skew matrix",
            f"moment cinétique de l’intervalle depuis g_{_k}, une matrice antisymétrique",
            rf"\ell_{_k}", defined(SQUARE)),
        f"p_{_k}": name(f"momentum of the step from g_{_k}, in space",
            f"impulsion de l’intervalle depuis g_{_k}, dans l’espace",
            f"p_{_k}", defined(VECTOR)),
    }
HATTED: dict[str, Name] = {
    "r̂": name(
        "points of the body, (r, 1)",
        "points du corps, (r, 1)",
        r"\hat r",
        letter(family("points", PLACE)),
    ),
    "Ĵ": name(
        "matrix of moments Σ m_i r̂_i r̂̄_i",
        "matrice des moments Σ m_i r̂_i r̂̄_i",
        r"\hat J",
        defined(MATRIX),
    ),
    "D̂": name(
        "moments of the damping, Σ κ_i r̂_i r̂̄_i",
        "moments de l’amortissement, Σ κ_i r̂_i r̂̄_i",
        r"\hat D",
        defined(MATRIX),
    ),
}
BLOCKS: dict[str, Name] = {
    "ι": name("r ↦ (r, 0)", "r ↦ (r, 0)", r"\iota", letter(("matrix", "size", "n"))),
    "o": name("(0, 1)", "(0, 1)", "o", letter(("vector", "size"))),
    "N_1": name(
        "moments of the forces at g_1, Σ F_i r̄_i",
        "moments des forces en g_1, Σ F_i r̄_i",
        "N_1",
        defined(SQUARE),
    ),
    "f_1": name(
        "resultant of the forces at g_1", "résultante des forces en g_1", "f_1", defined(VECTOR)
    ),
    "ξ": name("linear part of g_1⁻¹δg_1", "partie linéaire de g_1⁻¹δg_1", r"\xi", defined(ALGEBRA)),
    "η": name("translation of g_1⁻¹δg_1", "translation de g_1⁻¹δg_1", r"\eta", defined(VECTOR)),
}
"""The names of the blocks of an affine map, beside those of its elements."""
WHICH = (("first", "premier"), ("second", "deuxième"), ("third", "troisième"))
for _k, (_which, _french) in enumerate(WHICH):
    BLOCKS |= {
        f"A_{_k}": name(
            f"linear part of g_{_k}", f"partie linéaire de g_{_k}", f"A_{_k}", defined(SQUARE)
        ),
        f"T_{_k}": name(
            f"translation of g_{_k}", f"translation de g_{_k}", f"T_{_k}", defined(VECTOR)
        ),
        f"R_{_k}": name(
            f"centre of mass in space at g_{_k}",
            f"centre de masse dans l’espace en g_{_k}",
            f"R_{_k}",
            defined(VECTOR),
        ),
    }


def of_action(square: Type, algebra: Type, *, affine: bool) -> dict[str, Name]:
    """The names, for elements of the group of one type and elements of 𝔤; those of an affine map
    have a hat where they are of its size."""
    hat, latex_hat = ("\u0302", r"\hat ") if affine else ("", "")
    hatted, chapeau = ("; of (r, 1)", " ; de (r, 1)") if affine else ("", "")
    found = {
        f"ξ{hat}": name("g_1⁻¹δg_1, in the Lie algebra",
            "g_1⁻¹δg_1, dans l’algèbre de Lie", rf"{latex_hat}\xi", defined(algebra)),
        "E": name("basis of the Lie algebra", "base de l’algèbre de Lie",
            "E", letter(family("basis", algebra))),
    }
    for k, (which, french) in enumerate(WHICH):
        found[f"g_{k}"] = name(f"{which} element of the group",
            f"{french} élément du groupe", f"g_{k}", letter(square))
        found[f"N{hat}_{k}"] = name(f"moments of the forces at g_{k}{hatted}",
            f"moments des forces en g_{k}{chapeau}", f"{latex_hat}N_{k}", defined(square))
        for mark, latex in (("δ", r"\delta"), ("δ′", r"\delta'")):
            found[f"{mark}g_{k}"] = name(f"variation {mark} of g_{k}",
                f"variation {mark} de g_{k}", f"{latex} g_{k}", letter(square))
    return COMMON | found | (HATTED | BLOCKS if affine else {})


# fmt: on
DISCRETE: dict[str, dict[str, Name]] = {
    "linear": of_action(SQUARE, ALGEBRA, affine=False),
    "affine": of_action(MATRIX, MATRIX, affine=True),
}
"""By the action: meanings and types of the names of the discrete road."""
