"""What a name is: its meaning, its types, its roles; and the names of two kinds of problems.

Of the discrete road, elements of the group a time h apart, and what is made of them: an affine map
is there its matrix on (r, 1), and ``of_action`` has the types and meanings of each action.  Of a
fluid: what each name means there.
"""

from __future__ import annotations

from typing import Any, NamedTuple
from unicodedata import normalize

Type = str | tuple[Any, ...]
"""``scalar``, ``(matrix, rows, columns)``, ``(vector, n)``; ``(algebra,)``, a matrix among the
linear parts of 𝔤; ``(function, types of the arguments …, type of the value)``; ``(family, what its
index counts, type of a member)``; a variation of the point y, with the time or without."""

SCALAR, VARIATION, AT_ONE_TIME = "scalar", "variation", "variation at one time"
SQUARE, VECTOR, COORDINATES = ("matrix", "n", "n"), ("vector", "n"), ("vector", "d")
ALGEBRA, PLACE = ("algebra",), ("vector", "block")
LATTICE = ("vector", "lattice")
ADVECTED = ("vector", "carried")
"""Sizes in types: n is the dimension of the space, d that of the linear parts of 𝔤, dim that of 𝔤,
block that of the space of a factor, where a product has several of any of them; carried, how many
entries what the algebra carries along has; lattice, 2; reduced, d and carried together; fields, how
many symmetries a problem is reduced by."""

FIELD, FUNCTION_ON_SPACE, OPERATOR = "vector field", "scalar field", "operator"
TENSOR = "tensor field"
"""Of a fluid: a vector, a number or a matrix at each place; a linear map of fields to fields."""

ROLES = ("letter", "definition", "value on X", "unknown", "function")
"""What a name is: chosen freely; defined by an equation; a rate along the motion, or the value of a
variation on X; what exists by a theorem; a function."""


class Use(NamedTuple):
    """One of the ways in which a name is used: m is a number, and m_i a family of numbers.

    ``defined``: in a record, the key of the equation that defines it, or says what it is first.
    """

    type: Type
    role: str
    defined: str = ""


class Name(NamedTuple):
    """What a name means, in English and in French, how LaTeX writes it, and in which ways it is
    used in equations."""

    meaning: str
    french: str
    latex: str
    uses: tuple[Use, ...]


def name(meaning: str, french: str, latex: str, *uses: Use) -> Name:
    """The :class:`Name` of a meaning, with its uses; without any it occurs in sentences alone."""
    return Name(meaning, french, latex, uses)


def letter(type: Type) -> Use:
    """The use of a name that the walk starts from; a step may say later what it is, as for U."""
    return Use(type, "letter")


def defined(type: Type) -> Use:
    """The use of a name that an equation defines."""
    return Use(type, "definition")


def rate(type: Type) -> Use:
    """The use of a name whose value is a rate along the motion."""
    return Use(type, "value on X")


def unknown(type: Type) -> Use:
    """The use of a name that exists by a theorem: a multiplier."""
    return Use(type, "unknown")


def function(*types: Type) -> Use:
    """The use of a name as a function: the types of its arguments, then that of its value."""
    return Use(("function", *types), "function")


def of_X(type: Type) -> Use:
    """The use of a name as the value of a variation on X."""
    return Use(("function", VARIATION, type), "value on X")


def family(index: str, type: Type) -> Type:
    """The type of a family of members of a type, and what their index counts."""
    return ("family", index, type)


def with_derivatives(table: dict[str, Name], varied: str, moving: str) -> dict[str, Name]:
    """A table of names, with δX and δ′X for each X of ``varied`` and the rate Ẋ for each of
    ``moving``, names apart by spaces; what the table says of one itself stays."""
    found: dict[str, Name] = {}
    for x in varied.split():
        latex, use = table[x].latex, letter(table[x].uses[0].type)
        told = f"variation of {x}", f"variation de {x}"
        found[f"δ{x}"] = name(*told, _of(r"\delta", latex), use)
        told = f"variation δ′ of {x}", f"variation δ′ de {x}"
        found[f"δ′{x}"] = name(*told, _of(r"\delta'", latex), use)
    for x in moving.split():
        told = f"d{x}/dt along the motion", f"d{x}/dt le long du mouvement"
        rates = (rate(use.type) for use in table[x].uses)
        dotted = normalize("NFC", f"{x[0]}\u0307{x[1:]}")
        found[dotted] = name(*told, _of(r"\dot", table[x].latex), *rates)
    return found | table


def _of(mark: str, latex: str) -> str:
    """The LaTeX of a name behind a mark."""
    return f"{mark}{latex}" if latex.startswith("\\") else f"{mark} {latex}"


# The discrete road: elements of the group a time h apart, and what is made of them.

MATRIX, HATTED_PLACE = ("matrix", "size", "size"), ("vector", "size")


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
        letter(family("points", HATTED_PLACE)),
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


# A fluid.

# fmt: off
FLUID: dict[str, Name] = {
    "L": name("Lagrangian of the fluid", "lagrangien du fluide", "L", defined(SCALAR)),
    "v": name("velocities of the points of the fluid in space",
        "vitesses des points du fluide dans l’espace", "v", defined(FIELD)),
    "∫": name("integral over the fluid with its measure of mass",
        "intégrale sur le fluide par rapport à sa mesure de masse",
        r"\int", function(SCALAR, SCALAR)),
    "U": name("potential of the forces on the fluid", "potentiel des forces sur le fluide",
        "U", letter(SCALAR)),
    "V": name("potential per unit mass, a function of the place",
        "potentiel par unité de masse, fonction du lieu", "V", letter(FUNCTION_ON_SPACE)),
    "f": name("force per unit mass at each place", "force par unité de masse en chaque lieu",
        "f", defined(FIELD)),
    "Ũ": name("potential pulled back to the group",
        "image réciproque du potentiel sur le groupe", r"\tilde U", letter(SCALAR)),
    "dŨ": name("differential of Ũ", "différentielle de Ũ",
        r"\mathrm{d}\tilde U", function(FIELD, SCALAR)),
    "g": name("displacement of the fluid, which keeps the volume",
        "déplacement du fluide, qui conserve le volume", "g"),
    "ν": name("velocity in the group: that of each point of the body",
        "vitesse dans le groupe : celle de chaque point du corps", r"\nu", letter(FIELD)),
    "δg": name("variation of g", "variation de g", r"\delta g", letter(FIELD)),
    "δ′g": name("variation δ′ of g", "variation δ′ de g", r"\delta'g", letter(FIELD)),
    "ν̇": name("dν/dt along the motion, the acceleration of all points",
        "dν/dt le long du mouvement, accélération de tous les points",
        r"\dot\nu", rate(FIELD)),
    "ġ": name("dg/dt along the motion", "dg/dt le long du mouvement", r"\dot g", rate(FIELD)),
    "p̃": name("momentum, a covector on the group",
        "impulsion, un covecteur du groupe", r"\tilde p", function(FIELD, SCALAR)),
    "ω": name("dϖ at constant time",
        "dϖ à temps constant", r"\omega", function(AT_ONE_TIME, AT_ONE_TIME, SCALAR)),
    "G": name("composition with g: (Gc)(r) = c(g(r)) at each point r of the body",
        "composition avec g : (Gc)(r) = c(g(r)) en chaque point r du corps",
        "G", letter(OPERATOR)),
    "u": name("velocity of the point that is at each place: divergence-free, tangent to the "
        "boundary",
        "vitesse du point qui est en chaque lieu : solénoïdale, tangente au bord",
        "u", letter(FIELD)),
    "η": name("displacement of the point that is at each place: divergence-free, tangent to the "
        "boundary",
        "déplacement du point qui est en chaque lieu : solénoïdal, tangent au bord",
        r"\eta", letter(FIELD), of_X(FIELD)),
    "η′": name("displacement δ′ of the point that is at each place",
        "déplacement δ′ du point qui est en chaque lieu", r"\eta'", letter(FIELD)),
    "u̇": name("∂u/∂t along the motion, at each place",
        "∂u/∂t le long du mouvement, en chaque lieu", r"\dot u", rate(FIELD)),
    "δ": name("first variation", "première variation", r"\delta",
        function(FIELD, FIELD), function(OPERATOR, OPERATOR), function(SCALAR, SCALAR)),
    "δ′": name("another variation, which commutes with δ",
        "autre variation, qui commute avec δ", r"\delta'", function(FIELD, FIELD)),
    "D": name("divergence, as an operator; its transpose is −grad on fields tangent to the "
        "boundary",
        "divergence, comme opérateur ; sa transposée est −grad sur les champs tangents au bord",
        "D", letter(OPERATOR)),
    "p": name("pressure", "pression", "p", unknown(FUNCTION_ON_SPACE)),
    "grad": name("gradient", "gradient", r"\operatorname{grad}",
        function(FUNCTION_ON_SPACE, FIELD), function(OPERATOR, FIELD)),
    "div": name("divergence", "divergence", r"\operatorname{div}",
        function(FIELD, FUNCTION_ON_SPACE)),
    "Δ": name("Laplacian, div grad", "laplacien, div grad", r"\Delta",
        function(FUNCTION_ON_SPACE, FUNCTION_ON_SPACE)),
    "∇": name("∇u, the matrix of the derivatives of u at each place; ∇_c is the derivative of "
        "fields along c",
        "∇u, matrice des dérivées de u en chaque lieu ; ∇_c est la dérivée des champs le long de c",
        r"\nabla", function(FIELD, TENSOR)),
    "n": name("unit normal of the boundary; ⟨a, n⟩ is the normal component there",
        "normale unitaire du bord ; ⟨a, n⟩ est la composante normale au bord",
        "n", letter(FIELD)),
    "∂ₙ": name("derivative along the normal of the boundary",
        "dérivée le long de la normale du bord", r"\partial_n",
        function(FUNCTION_ON_SPACE, FUNCTION_ON_SPACE)),
    "ρ": name("density at each place, and the product with it",
        "densité en chaque lieu, et le produit par celle-ci", r"\rho", letter(OPERATOR)),
    "ρ̇": name("∂ρ/∂t along the motion, at each place",
        "∂ρ/∂t le long du mouvement, en chaque lieu", r"\dot\rho", rate(OPERATOR)),
    "ρ_0": name("density of the body at each of its points, and the product with it: dm = ρ₀ dr",
        "densité du corps en chacun de ses points, et le produit par celle-ci : dm = ρ₀ dr",
        r"\rho_0", letter(OPERATOR)),
    "ϑ": name("image in space of a displacement of the body made before g, which keeps volume and "
        "density; it is carried along by the motion",
        "image dans l’espace d’un déplacement du corps effectué avant g, qui conserve volume et "
        "densité ; elle est transportée par le mouvement",
        r"\vartheta", letter(FIELD)),
    "ϑ̇": name("∂ϑ/∂t along the motion, at each place",
        "∂ϑ/∂t le long du mouvement, en chaque lieu", r"\dot\vartheta", rate(FIELD)),
    "d/dt": name("derivative in time along the motion",
        "dérivée dans le temps le long du mouvement",
        r"\frac{\mathrm{d}}{\mathrm{d}t}", function(SCALAR, SCALAR), function(FIELD, FIELD)),
    "Γ_0": name("composition with a closed curve γ₀ in the body: of fields over the points",
        "composition avec une courbe fermée γ₀ du corps : des champs sur les points",
        r"\Gamma_0", letter(OPERATOR)),
    "Γ": name("composition with the curve γ = g ∘ γ₀ that the fluid carries along; products of "
        "such fields are integrated over its parameter s",
        "composition avec la courbe γ = g ∘ γ₀ que le fluide transporte ; les produits de tels "
        "champs sont intégrés sur son paramètre s",
        r"\Gamma", defined(OPERATOR)),
    "γ̇": name("∂γ/∂t along the motion, the velocity of the points of the curve",
        "∂γ/∂t le long du mouvement, vitesse des points de la courbe", r"\dot\gamma", rate(FIELD)),
    "γ_s": name("tangent of the curve γ, its derivative in the parameter s",
        "tangente de la courbe γ, sa dérivée par rapport au paramètre s", r"\gamma_s",
        letter(FIELD)),
    "∂_s": name("derivative along the curve, in its parameter s",
        "dérivée le long de la courbe, par rapport à son paramètre s", r"\partial_s",
        letter(OPERATOR)),
    "κ": name("density on the curve γ, in a level surface of ρ",
        "densité sur la courbe γ, dans une surface de niveau de ρ", r"\kappa", letter(SCALAR)),
    "X": name("a vector with δt = 1; the one of the kernel of dϖ gives the motion",
        "vecteur tel que δt = 1 ; celui du noyau de dϖ donne le mouvement",
        "X", letter(VARIATION)),
}
# fmt: on
FLUID = with_derivatives(FLUID, varied="ν u", moving="Γ κ")
