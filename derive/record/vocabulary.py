"""The names of the walk: what each one means, how LaTeX writes it, and what it is.

The table is a contract between the walk, which uses the names, and the checker, which gives each a
value by its meaning alone.  Bars are transposes; a prime belongs to the second variation δ′.  The
French stands beside the English; spaces that it does not break are written as ordinary ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..schema.kind import Own
from ..schema.kinds import kinds
from .kinematics_names import KINEMATICS
from .names import (
    ADVECTED,
    ALGEBRA,
    AT_ONE_TIME,
    COORDINATES,
    DISCRETE,
    FLUID,
    LATTICE,
    PLACE,
    SCALAR,
    SQUARE,
    VARIATION,
    VECTOR,
    Name,
    Use,
    defined,
    family,
    function,
    letter,
    name,
    of_X,
    rate,
    unknown,
    with_derivatives,
)

# fmt: off
VOCABULARY: dict[str, Name] = {
    "t": name("time", "temps", "t", letter(SCALAR)),
    "δt": name("variation of the time", "variation du temps", r"\delta t", letter(SCALAR)),
    "δ′t": name("variation δ′ of the time",
        "variation δ′ du temps", r"\delta' t", letter(SCALAR)),
    "m": name("total mass",
        "masse totale", "m", defined(SCALAR), letter(family("points", SCALAR))),
    "c": name("first moment Σ m_i r_i (the centre of mass is c/m)",
        "premier moment Σ m_i r_i (le centre de masse est c/m)", "c", defined(VECTOR)),
    "J": name("matrix of moments Σ m_i r_i r̄_i",
        "matrice des moments Σ m_i r_i r̄_i", "J", defined(SQUARE)),
    "r": name("points of the body",
        "points du corps",
        "r", letter(VECTOR), letter(family("points", VECTOR)),
        Use(family("points", ("function", SCALAR, VECTOR)), "function")),
    "v": name("velocities of the points in space",
        "vitesses des points dans l’espace",
        "v", defined(VECTOR), letter(family("points", VECTOR))),
    "v̇": name("accelerations of the points in space",
        "accélérations des points dans l’espace",
        r"\dot v", defined(family("points", VECTOR))),
    "F": name("forces on the points; without index their resultant",
        "forces sur les points ; sans indice, leur résultante",
        "F", defined(VECTOR), letter(family("points", VECTOR))),
    "N": name("moments of the forces, Σ F_i r̄_i",
        "moments des forces, Σ F_i r̄_i", "N", defined(SQUARE)),
    "N_b": name("ĀN, moments of the forces in the body frame",
        "ĀN, moments des forces dans le repère du corps", "N_b", defined(SQUARE)),
    "F_b": name("ĀF, resultant in the body frame",
        "ĀF, résultante dans le repère du corps", "F_b", defined(VECTOR)),
    "μ": name("moment of the forces in the body frame, a vector",
        "vecteur moment des forces, dans le repère du corps", r"\mu", defined(VECTOR)),
    "L": name("Lagrangian of the points", "lagrangien des points", "L", defined(SCALAR)),
    "U": name("potential of the points", "potentiel des points", "U", letter(SCALAR)),
    "L̃": name("Lagrangian pulled back to the group",
        "image réciproque du lagrangien sur le groupe", r"\tilde L", defined(SCALAR)),
    "Ũ": name("potential pulled back to the group",
        "image réciproque du potentiel sur le groupe", r"\tilde U", letter(SCALAR)),
    "dŨ": name("differential of Ũ at fixed time",
        "différentielle de Ũ à temps fixé",
        r"\mathrm{d}\tilde U", function(SQUARE, SCALAR), function(SQUARE, VECTOR, SCALAR)),
    "p̃": name("momentum, a covector on the group",
        "impulsion, un covecteur du groupe",
        r"\tilde p", function(SQUARE, SCALAR), function(SQUARE, VECTOR, SCALAR)),
    "h̃": name("energy", "énergie", r"\tilde h", defined(SCALAR)),
    "F̃": name("force on the group, −grad_J Ũ",
        "force sur le groupe, −grad_J Ũ", r"\tilde F", defined(SQUARE)),
    "ϖ": name("Cartan form", "forme de Cartan", r"\varpi", function(VARIATION, SCALAR)),
    "dϖ": name("exterior derivative of the Cartan form",
        "dérivée extérieure de la forme de Cartan",
        r"\mathrm{d}\varpi", function(VARIATION, VARIATION, SCALAR)),
    "ω": name("dϖ at constant time",
        "dϖ à temps constant", r"\omega", function(AT_ONE_TIME, AT_ONE_TIME, SCALAR)),
    "y": name("point (t, g, ν) of the evolution space: time, element of the group, velocity",
        "point (t, g, ν) de l’espace d’évolution : temps, élément du groupe, vitesse", "y"),
    "δy": name("a variation of y = (t, g, ν): time, element of the group, velocity",
        "variation de y = (t, g, ν) : temps, élément du groupe, vitesse",
        r"\delta y", letter(VARIATION)),
    "δ′y": name("another variation of y",
        "autre variation de y", r"\delta' y", letter(VARIATION)),
    "δx": name("a variation of (g, ν), at constant time",
        "une variation de (g, ν), à temps constant", r"\delta x", letter(AT_ONE_TIME)),
    "δ′x": name("another variation at constant time",
        "autre variation à temps constant", r"\delta' x", letter(AT_ONE_TIME)),
    "X": name("a vector with δt = 1; the one of the kernel of dϖ gives the motion",
        "vecteur tel que δt = 1 ; celui du noyau de dϖ donne le mouvement",
        "X", letter(VARIATION)),
    "g": name("element of the group", "élément du groupe", "g", function(VECTOR, VECTOR)),
    "ν": name("velocity in the group", "vitesse dans le groupe", r"\nu"),
    "δg": name("variation of g", "variation de g", r"\delta g"),
    "A": name("linear part of g", "partie linéaire de g", "A", letter(SQUARE)),
    "T": name("translation of g", "translation de g", "T", letter(VECTOR)),
    "α": name("velocity of A", "vitesse de A", r"\alpha", letter(SQUARE)),
    "τ": name("velocity of T", "vitesse de T", r"\tau", letter(VECTOR)),
    "δA": name("variation of A", "variation de A", r"\delta A", letter(SQUARE), of_X(SQUARE)),
    "δT": name("variation of T", "variation de T", r"\delta T", letter(VECTOR), of_X(VECTOR)),
    "α̇": name("acceleration of A", "accélération de A", r"\dot\alpha", rate(SQUARE)),
    "τ̇": name("acceleration of T", "accélération de T", r"\dot\tau", rate(VECTOR)),
    "Z": name("A⁻¹α, in the Lie algebra", "A⁻¹α, dans l’algèbre de Lie", "Z", defined(ALGEBRA)),
    "w": name("A⁻¹τ", "A⁻¹τ", "w", defined(VECTOR)),
    "ξ": name("A⁻¹δA, in the Lie algebra",
        "A⁻¹δA, dans l’algèbre de Lie", r"\xi", defined(ALGEBRA), of_X(ALGEBRA)),
    "ξ′": name("A⁻¹δ′A, in the Lie algebra",
        "A⁻¹δ′A, dans l’algèbre de Lie", r"\xi'", defined(ALGEBRA)),
    "η": name("A⁻¹δT", "A⁻¹δT", r"\eta", defined(VECTOR), of_X(VECTOR)),
    "η′": name("A⁻¹δ′T", "A⁻¹δ′T", r"\eta'", defined(VECTOR)),
    "C": name("Cauchy–Green matrix ĀA", "matrice de Cauchy–Green ĀA", "C", defined(SQUARE)),
    "δC": name("variation of C", "variation de C", r"\delta C", defined(SQUARE)),
    "f": name("A⁻¹F̃, in the Lie algebra", "A⁻¹F̃, dans l’algèbre de Lie", "f", defined(ALGEBRA)),
    "Π": name("momentum of 𝔤*, its linear part: Σ m_i Āv_i r̄_i",
        "moment de 𝔤*, sa partie linéaire : Σ m_i Āv_i r̄_i",
        r"\Pi", defined(SQUARE), defined(family("basis", SCALAR))),
    "Π_g": name("a matrix that gives Π_a on E_a, as Π does",
        "une matrice qui donne Π_a sur E_a, comme Π", r"\Pi_g", defined(SQUARE)),
    "Π_o": name("the other momentum, Π carried by g to the other side",
        "l’autre moment, Π transporté par g de l’autre côté", r"\Pi_o", defined(SQUARE)),
    "p_b": name("momentum in the body frame, Σ m_i Āv_i",
        "quantité de mouvement dans le repère du corps, Σ m_i Āv_i", "p_b", defined(VECTOR)),
    "ℓ_b": name("angular momentum in the body frame, Āℓ A, a skew matrix",
        "moment cinétique dans le repère du corps, Āℓ A, une matrice antisymétrique",
        r"\ell_b", defined(SQUARE)),
    "Φ": name("derivative of L̃ along the group, at a fixed velocity",
        "dérivée de L̃ le long du groupe, à vitesse fixée",
        r"\Phi", defined(SQUARE), defined(family("basis", SCALAR))),
    "ζ": name("coordinates of Z in the basis of the Lie algebra",
        "coordonnées de Z dans la base de l’algèbre de Lie", r"\zeta", defined(COORDINATES)),
    "Ω": name("ξ = j(Ω)", "ξ = j(Ω)", r"\Omega", defined(VECTOR), of_X(VECTOR)),
    "Ω′": name("ξ′ = j(Ω′)", "ξ′ = j(Ω′)", r"\Omega'", defined(VECTOR)),
    "φ": name("f = j(φ)", "f = j(φ)", r"\varphi", defined(VECTOR)),
    "I": name("tensor of inertia", "tenseur d’inertie", "I", defined(SQUARE)),
    "λ": name("principal moments of inertia, the eigenvalues of I",
        "moments principaux d’inertie, valeurs propres de I", r"\lambda", letter(VECTOR)),
    "I_c": name("tensor of inertia about the centre of mass",
        "tenseur d’inertie par rapport au centre de masse", "I_c", defined(SQUARE)),
    "J_c": name("matrix of moments about the centre of mass",
        "matrice des moments par rapport au centre de masse", "J_c", defined(SQUARE)),
    "r_c": name("centre of mass in the body, m⁻¹c",
        "centre de masse dans le corps, m⁻¹c", "r_c", defined(VECTOR)),
    "c_c": name("first moment seen from the centres of mass",
        "premier moment vu des centres de masse", "c_c", defined(VECTOR)),
    "S": name("centre of mass of each factor, in the column of its translations",
        "centre de masse de chaque facteur, dans la colonne de ses translations",
        "S", defined(SQUARE)),
    "Z_c": name("Z(1 + S), the velocity seen from the centres of mass",
        "Z(1 + S), la vitesse vue des centres de masse", "Z_c", defined(SQUARE)),
    "ψ": name("coordinates of Ż(1 + S) in the basis of the Lie algebra",
        "coordonnées de Ż(1 + S) dans la base de l’algèbre de Lie",
        r"\psi", defined(COORDINATES)),
    "z": name("coordinates of the velocity in the basis that the problem states",
        "coordonnées de la vitesse dans la base que donne le problème",
        "z", letter(("vector", "dim"))),
    "w_c": name("velocity of the centre of mass in the body frame",
        "vitesse du centre de masse dans le repère du corps", "w_c", defined(VECTOR)),
    "R": name("centre of mass in space, T + m⁻¹Ac",
        "centre de masse dans l’espace, T + m⁻¹Ac", "R", defined(VECTOR)),
    "Ṙ": name("velocity of the centre of mass, τ + m⁻¹αc",
        "vitesse du centre de masse, τ + m⁻¹αc", r"\dot R", defined(VECTOR)),
    "𝐧": name("point of the lattice of the torus",
        "point du réseau du tore", r"\mathbf n", letter(LATTICE)),
    "𝐦": name("another point of the lattice; 𝐦 ∧ 𝐧 = m₁n₂ − m₂n₁",
        "autre point du réseau ; 𝐦 ∧ 𝐧 = m₁n₂ − m₂n₁",
        r"\mathbf m", letter(LATTICE)),
    "i": name("imaginary unit", "unité imaginaire", "i", letter(SCALAR)),
    "ω̂": name("coefficients of the vorticity on the basis of the torus, in space on waves",
        "coefficients du tourbillon dans la base du tore, dans l’espace sur les ondes",
        r"\hat\omega", function(LATTICE, SCALAR), function(SCALAR, SCALAR, SCALAR)),
    "Ẇ": name("dW/dt along the motion", "dW/dt le long du mouvement", r"\dot W", rate(SQUARE)),
    "∫": name("integral over the body with its measure of mass",
        "intégrale sur le corps pour sa mesure de masse",
        r"\int", function(SCALAR, SCALAR), function(VECTOR, VECTOR), function(SQUARE, SQUARE)),
    "U_Q": name("part of the potential that is given point by point",
        "partie du potentiel donnée point par point", "U_Q", defined(SCALAR)),
    "Q": name("force of U_Q on a point, in space",
        "force de U_Q sur un point, dans l’espace", "Q", defined(family("points", VECTOR))),
    "d": name("difference of two places in space, d_e of element e",
        "différence de deux positions dans l’espace, d_e pour l’élément e",
        "d", defined(family("distances", PLACE))),
    "P": name("force of U_Q on a point, in the body frame",
        "force de U_Q sur un point, dans le repère du corps",
        "P", defined(family("points", VECTOR))),
    "χ": name("d_e in the body frame, Ād_e",
        "d_e dans le repère du corps, Ād_e", r"\chi", defined(family("distances", PLACE))),
    "σ": name("force over distance along d_e",
        "force divisée par la distance, le long de d_e",
        r"\sigma", defined(family("distances", SCALAR))),
    "N_Q": name("moments of the forces Q, in the body frame",
        "moments des forces Q, dans le repère du corps", "N_Q", defined(SQUARE)),
    "F_Q": name("resultant of the forces Q, in the body frame",
        "résultante des forces Q, dans le repère du corps", "F_Q", defined(VECTOR)),
    "μ_Q": name("moment of the forces Q in the body frame, a vector",
        "vecteur moment des forces Q, dans le repère du corps", r"\mu_Q", defined(VECTOR)),
    "N_u": name("moments of the given forces, in the body frame",
        "moments des forces données, dans le repère du corps", "N_u", defined(SQUARE)),
    "F_u": name("resultant of the given forces, in the body frame",
        "résultante des forces données, dans le repère du corps", "F_u", defined(VECTOR)),
    "μ_u": name("moment of the given forces in the body frame, a vector",
        "vecteur moment des forces données, dans le repère du corps", r"\mu_u", defined(VECTOR)),
    "κ": name("coefficient of damping of a point",
        "coefficient d’amortissement d’un point", r"\kappa", defined(family("points", SCALAR))),
    "D": name("moments of the damping, Σ κ_i r_i r̄_i",
        "moments de l’amortissement, Σ κ_i r_i r̄_i", "D", defined(SQUARE)),
    "D_c": name("first moment of the damping, Σ κ_i r_i",
        "premier moment de l’amortissement, Σ κ_i r_i", "D_c", defined(VECTOR)),
    "D_m": name("total damping, Σ κ_i", "amortissement total, Σ κ_i", "D_m", defined(SCALAR)),
    "I_D": name("(Tr D) 1 − D", "(Tr D) 1 − D", "I_D", defined(SQUARE)),
    "E": name("basis of the Lie algebra (of its linear parts)",
        "base de l’algèbre de Lie (de ses parties linéaires)",
        "E", letter(family("basis", ALGEBRA))),
    "M": name("mass matrix of the basis",
        "matrice de masse de la base", "M", defined(("matrix", "d", "d"))),
    "β": name("load along the elements of the basis",
        "charge le long des éléments de la base", r"\beta", defined(COORDINATES)),
    "B": name("what forces and velocities leave to be balanced by Ż",
        "ce que les forces et les vitesses laissent à équilibrer par Ż", "B", defined(SQUARE)),
    "N_c": name("moments of the forces about the centre of mass, in the body frame",
        "moments des forces par rapport au centre de masse, dans le repère du corps",
        "N_c", defined(SQUARE)),
    "Λ": name("direction normal to the Lie algebra",
        "direction normale à l’algèbre de Lie", r"\Lambda", letter(SQUARE)),
    "θ": name("multiplier of the volume", "multiplicateur du volume", r"\theta", unknown(SCALAR)),
    "Q_r": name("quadric of the boundary of the body, ⟨r, Q_r r⟩ = 1",
        "quadrique du bord du corps, ⟨r, Q_r r⟩ = 1", "Q_r", defined(SQUARE)),
    "s_r": name("level of the place r in the body, ⟨r, Q_r r⟩, 1 at the boundary",
        "niveau de la position r dans le corps, ⟨r, Q_r r⟩, 1 au bord", "s_r", defined(SCALAR)),
    "ρ_r": name("density at the place r of the body, a function of s_r",
        "masse volumique à la position r dans le corps, une fonction de s_r",
        r"\rho_r", defined(SCALAR)),
    "σ_r": name("integral of the density over the levels from s_r to 1",
        "intégrale de la masse volumique sur les niveaux de s_r à 1",
        r"\sigma_r", defined(SCALAR)),
    "κ_Q": name("factor of J = κ_Q Q_r⁻¹", "facteur de J = κ_Q Q_r⁻¹",
        r"\kappa_Q", defined(SCALAR)),
    "p_0": name("pressure in the middle", "pression au centre", "p_0", defined(SCALAR)),
    "p_r": name("pressure at the place r of the body",
        "pression à la position r dans le corps", "p_r", defined(SCALAR)),
    "Υ": name("circulation, a skew matrix: Āα − ᾱA",
        "circulation, une matrice antisymétrique : Āα − ᾱA", r"\Upsilon", defined(SQUARE)),
    "K": name("stiffness matrix of the springs, Σ k_e s_e s̄_e",
        "matrice de raideur des ressorts, Σ k_e s_e s̄_e", "K", defined(SQUARE)),
    "k": name("stiffness of a spring, k_e of spring e",
        "raideur d’un ressort, k_e pour le ressort e", "k", defined(family("springs", SCALAR))),
    "s": name("difference r_i − r_j of the ends of a spring in the body, s_e of spring e",
        "différence r_i − r_j des extrémités d’un ressort dans le corps, s_e pour le ressort e",
        "s", defined(family("springs", VECTOR))),
    "γ": name("acceleration of gravity",
        "accélération de la pesanteur", r"\gamma", defined(VECTOR)),
    "u": name("input: a covector of the Lie algebra",
        "commande : un covecteur de l’algèbre de Lie", "u", letter(("vector", "dim"))),
    "f_u": name("input: the force part of a body wrench",
        "commande : la résultante d’un torseur, dans le repère du corps",
        "f_u", letter(VECTOR)),
    "δ": name("first variation",
        "première variation",
        r"\delta", function(VECTOR, VECTOR), function(ALGEBRA, ALGEBRA),
        function(SCALAR, SCALAR)),
    "d/dt": name("derivative in time along a curve",
        "dérivée dans le temps le long d’une courbe",
        r"\frac{\mathrm{d}}{\mathrm{d}t}", function(SCALAR, SCALAR), function(VECTOR, VECTOR)),
    "δ′": name("another variation, which commutes with δ",
        "autre variation, qui commute avec δ",
        r"\delta'", function(VECTOR, VECTOR), function(ALGEBRA, ALGEBRA),
        function(SCALAR, SCALAR)),
    "ℓ": name("angular momentum in space, a skew matrix",
        "moment cinétique dans l’espace, une matrice antisymétrique", r"\ell", defined(SQUARE)),
    "p": name("momentum in space", "impulsion dans l’espace", "p", defined(VECTOR)),
    "ḣ": name("dh̃/dt along the motion",
        "dh̃/dt le long du mouvement", r"\dot{\tilde h}", rate(SCALAR)),
    "∂ₜL̃": name("partial derivative of L̃ in time",
        "dérivée partielle de L̃ par rapport au temps", r"\partial_t\tilde L", letter(SCALAR)),
    "M̃": name("second derivative of L̃ with respect to the velocity",
        "dérivée seconde de L̃ par rapport à la vitesse",
        r"\tilde M", function(ALGEBRA, ALGEBRA, SCALAR)),
    "Γ": name("what the algebra carries along: advected quantities",
        "ce que l’algèbre transporte : quantités transportées",
        r"\Gamma", letter(ADVECTED)),
    "δΓ": name("variation of Γ", "variation de Γ", r"\delta\Gamma", defined(ADVECTED)),
    "𝕁": name("Poisson tensor: the brackets of the momenta",
        "tenseur de Poisson : les crochets des moments",
        r"\mathbb{J}", defined(("matrix", "d", "d"))),
    "ρ": name("representation of the Lie algebra on what it carries along",
        "représentation de l’algèbre de Lie sur ce qu’elle transporte",
        r"\rho", function(ALGEBRA, ("matrix", "carried", "carried"))),
    "𝒥": name("momenta of symmetries that commute: 𝒥_i is ϖ of the i-th field",
        "moments de symétries qui commutent : 𝒥_i est ϖ du i-ième champ",
        r"\mathcal{J}", defined(family("symmetries", SCALAR))),
    "𝕀": name("locked inertia: the metric of the kinetic energy on the fields of the symmetries",
        "inertie bloquée : la métrique de l’énergie cinétique sur les champs des symétries",
        r"\mathbb{I}", defined(("matrix", "fields", "fields"))),
    "𝒜": name("mechanical connection: 𝒜_i is the velocity along the i-th symmetry",
        "connexion mécanique : 𝒜_i est la vitesse le long de la i-ième symétrie",
        r"\mathcal{A}", Use(family("symmetries", ("function", ALGEBRA, SCALAR)), "function")),
    "d𝒜": name("curvature of the connection, its exterior derivative",
        "courbure de la connexion, sa dérivée extérieure",
        r"\mathrm{d}\mathcal{A}",
        Use(family("symmetries", ("function", VARIATION, VARIATION, SCALAR)), "function")),
    "ζ_h": name("horizontal part of ζ, orthogonal to the fields of the symmetries",
        "partie horizontale de ζ, orthogonale aux champs des symétries",
        r"\zeta_h", defined(COORDINATES)),
    "ϖ_h": name("Cartan form of the Routhian: momentum at the horizontal velocity, on horizontal "
        "parts",
        "forme de Cartan du routhien : impulsion à la vitesse horizontale, sur les parties "
        "horizontales", r"\varpi_h", function(VARIATION, SCALAR)),
    "dϖ_h": name("exterior derivative of ϖ_h",
        "dérivée extérieure de ϖ_h",
        r"\mathrm{d}\varpi_h", function(VARIATION, VARIATION, SCALAR)),
    "𝒱": name("effective potential: the energy of the velocity along the symmetries alone",
        "potentiel effectif : l’énergie de la seule vitesse le long des symétries",
        r"\mathcal{V}", defined(SCALAR)),
    "ℛ": name("Routhian: L̃ less the momenta times the velocities along the symmetries",
        "routhien : L̃ moins les moments multipliés par les vitesses le long des symétries",
        r"\mathcal{R}", defined(SCALAR)),
    "∂ₜŨ": name("partial derivative of Ũ in time",
        "dérivée partielle de Ũ par rapport au temps", r"\partial_t\tilde U", letter(SCALAR)),
}
# fmt: on
VOCABULARY = with_derivatives(
    VOCABULARY, varied="A T α τ Z w ζ Π p_b ℓ_b", moving="A T Z w ζ Π Π_o p_b ℓ_b p ℓ Γ Υ"
)

OWN_USES: dict[str, Use] = {
    **{x: defined(y) for x, y in (("scalar", SCALAR), ("vector", VECTOR), ("matrix", SQUARE))},
    "of invariants": function(SCALAR, SCALAR, SCALAR, SCALAR),
}


def add_letters(known: dict[str, Name], letters: Iterable[Own]) -> None:
    """The letters that a kind of potential has for its own; ``ValueError`` for a known one."""
    for x in letters:
        if x.name in known:
            raise ValueError(f"the letter {x.name} has a meaning: {known[x.name].meaning}")
        known[x.name] = name(x.meaning, x.french, x.latex, OWN_USES[x.type])


add_letters(VOCABULARY, (x for kind in kinds().values() for x in kind.letters))
VOCABULARY |= {x: about for x, about in FLUID.items() if x not in VOCABULARY}
VOCABULARY |= {x: about for x, about in KINEMATICS.items() if x not in VOCABULARY}
for _action in DISCRETE.values():
    VOCABULARY |= {x: about for x, about in _action.items() if x not in VOCABULARY}

# fmt: off
ROTATIONS: dict[str, Name] = {
    "Z": name("A⁻¹α, skew: Z = j(ζ)", "A⁻¹α, antisymétrique : Z = j(ζ)", "Z", defined(ALGEBRA)),
    "ζ": name("angular velocity in the body",
        "vitesse angulaire dans le corps", r"\zeta", defined(VECTOR)),
    "u": name("input: a torque about the fixed point, in the body frame",
        "commande : un moment par rapport au point fixe, dans le repère du corps",
        "u", letter(VECTOR)),
    "ℓ": name("angular momentum in space",
        "moment cinétique dans l’espace", r"\ell", defined(VECTOR)),
    "ℓ_b": name("angular momentum in the body frame, about the body's origin",
        "moment cinétique dans le repère du corps, par rapport à l’origine du corps",
        r"\ell_b", defined(VECTOR)),
}
# fmt: on
ROTATIONS = with_derivatives(ROTATIONS, varied="ℓ_b", moving="ℓ ℓ_b")
DISPLACEMENTS: dict[str, Name] = ROTATIONS | {
    "𝕁": VOCABULARY["𝕁"]._replace(uses=(defined(("matrix", "dim", "dim")),)),
    "w": VOCABULARY["w"]._replace(
        meaning="velocity of the body's origin in the body frame, A⁻¹τ",
        french="vitesse de l’origine du corps dans le repère du corps, A⁻¹τ",
    ),
    "u": ROTATIONS["u"]._replace(
        meaning="input: a moment about the body's origin, in the body frame",
        french="commande : un moment par rapport à l’origine du corps, dans le repère du corps",
    ),
    "f_u": VOCABULARY["f_u"]._replace(
        meaning="input: a force on the body's origin, in the body frame",
        french="commande : une force à l’origine du corps, dans le repère du corps",
    ),
}
"""Meanings and types of names that are more precise for rotations and displacements of R³."""

PRODUCTS: dict[str, Name] = {
    "A": VOCABULARY["A"]._replace(
        meaning="element of the group, a block for each of its factors",
        french="élément du groupe, un bloc par facteur",
    ),
    "c": VOCABULARY["c"]._replace(
        meaning="first moment Σ m_i r_i, a block for each factor",
        french="premier moment Σ m_i r_i, un bloc par facteur",
    ),
    "J_c": VOCABULARY["J_c"]._replace(
        meaning="matrix of moments about the centres of mass",
        french="matrice des moments par rapport aux centres de masse",
    ),
}
"""Meanings of names where the group is a product, whose affine factors act on (r, 1)."""

_OF_LAGRANGIANS = {
    "A": ("element of the group", "élément du groupe"),
    "α": ("velocity, tangent to the group", "vitesse, tangente au groupe"),
    "L̃": (
        "Lagrangian, a function of the time, of g and of Z",
        "lagrangien, une fonction du temps, de g et de Z",
    ),
    "Π": (
        "momentum of 𝔤*, the derivative of L̃ with respect to Z; Π_a is its value on E_a",
        "moment de 𝔤*, dérivée de L̃ par rapport à Z ; Π_a est sa valeur sur E_a",
    ),
    "Φ": (
        "derivative of L̃ along the group, at a fixed Z; Φ_a is the one along E_a",
        "dérivée de L̃ le long du groupe, à Z fixé ; Φ_a est celle le long de E_a",
    ),
    "E": ("basis of the Lie algebra", "base de l’algèbre de Lie"),
}
_CARRIED = {
    "left": {
        "Z": ("A⁻¹α, in the Lie algebra", "A⁻¹α, dans l’algèbre de Lie"),
        "ξ": ("A⁻¹δA, in the Lie algebra", "A⁻¹δA, dans l’algèbre de Lie"),
        "ξ′": ("A⁻¹δ′A, in the Lie algebra", "A⁻¹δ′A, dans l’algèbre de Lie"),
    },
    "right": {
        "Z": ("αA⁻¹, in the Lie algebra", "αA⁻¹, dans l’algèbre de Lie"),
        "ξ": ("δAA⁻¹, in the Lie algebra", "δAA⁻¹, dans l’algèbre de Lie"),
        "ξ′": ("δ′AA⁻¹, in the Lie algebra", "δ′AA⁻¹, dans l’algèbre de Lie"),
    },
}
LAGRANGIANS: dict[str, dict[str, Name]] = {
    side: {
        x: VOCABULARY[x]._replace(meaning=meaning, french=french)
        for x, (meaning, french) in (_OF_LAGRANGIANS | carried).items()
    }
    | {
        "𝕁": VOCABULARY["𝕁"]._replace(
            uses=(defined(("matrix", "reduced", "reduced")),),
        )
    }
    for side, carried in _CARRIED.items()
}
"""Meanings of names where no points give the Lagrangian, by the trivialisation."""

CARRYING: dict[str, Name] = {
    "𝕁": LAGRANGIANS["left"]["𝕁"]._replace(
        meaning="Poisson tensor: the brackets of the momenta and of Γ",
        french="tenseur de Poisson : les crochets des moments et de Γ",
    ),
}
"""Meanings of names where an algebra carries something along."""

ON_THE_TORUS: dict[str, Name] = {
    "T": name(
        "basis of su(N), products of powers of the clock and of the cyclic shift",
        "base de su(N), produits de puissances de l’horloge et du décalage cyclique",
        "T",
        function(LATTICE, SQUARE),
    ),
    "ζ": name(
        "coefficients of Z but for a factor: the opposite of the stream function",
        "coefficients de Z à un facteur près : l’opposé de la fonction de courant",
        r"\zeta",
        function(LATTICE, SCALAR),
    ),
    "W": name("vorticity, a matrix", "tourbillon, une matrice", "W", defined(SQUARE)),
    "P": name(
        "stream function, a matrix", "fonction de courant, une matrice", "P", defined(SQUARE)
    ),
}
"""Meanings of names on the torus."""

DERIVATIVE_OF = {"dϖ": "ϖ", "ḣ": "h̃", "ℓ̇": "ℓ", "ṗ": "p", "Π̇_o": "Π_o"}
DERIVATIVE_OF |= {"dΘ⁺": "Θ⁺", "dΘ⁻": "Θ⁻"}
DERIVATIVE_OF |= {"ρ̇": "ρ", "ϑ̇": "ϑ"}
DERIVATIVE_OF |= {"Γ̇": "Γ", "δΓ": "Γ", "Ẇ": "W", "Υ̇": "Υ", "dϖ_h": "ϖ_h", "d𝒜": "𝒜"}
DERIVATIVE_OF |= {"δΠ": "Π", "δ′Π": "Π", "Π̇": "Π", "δp_b": "p_b", "δ′p_b": "p_b", "ṗ_b": "p_b"}
DERIVATIVE_OF |= dict.fromkeys(("δℓ_b", "δ′ℓ_b", "ℓ̇_b"), "ℓ_b")
"""Name → the name of which it is a derivative or a variation."""


def meanings() -> Iterator[tuple[str, str]]:
    """The meaning of every name, in English and in French."""
    for table in (
        *(VOCABULARY, ROTATIONS, DISPLACEMENTS, PRODUCTS, ON_THE_TORUS, FLUID),
        *LAGRANGIANS.values(),
        *DISCRETE.values(),
        CARRYING,
        KINEMATICS,
    ):
        yield from ((x.meaning, x.french) for x in table.values())
