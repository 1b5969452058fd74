"""The names of the walk: what each one means and how LaTeX writes it.

The table is a contract between the walk, which uses the names, and the checker, which gives each a
value by its meaning alone.  Bars are transposes; a prime belongs to the second variation δ′.
"""

from __future__ import annotations

ANY_GROUP = "any group"
GIVENS = ("principal axes", "input", "any X", "vertical", "any acceleration")
"""What a step may assume: a body with diagonal J; an input that acts; X any vector with δt = 1, its
components those of δ; δ′t = 0 and δ′g = 0; X with the velocity of the motion, any acceleration."""

CONVENTIONS = (
    "T is the transpose, a bar in the paper; names are compared letter by letter, as written",
    "inner(a, b) and metric(M, a, b) are Tr a M b̄ for matrices and ā M b for vectors",
    "bracket(a, b) = ab − ba; hat(X) = j(X), j(X)Y = X ∧ Y; entries are counted from 1",
    "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] for commuting variations; ξ = g⁻¹δg, Z = g⁻¹ν",
    "par(name) is a parameter; at(name, i) a member of a family, over which sum(i, x) runs",
    "an equation holds for every value of a free index and of the names in for_all; ζ are the "
    "coordinates of Z in the basis of the group (Z = j(ζ) for rotations)",
    "a step that does not list 'input' among what is given has neither inputs nor damping",
)
"""What another reader of the JSON must know."""

VOCABULARY: dict[str, tuple[str, str]] = {
    "t": ("time", "t"),
    "δt": ("variation of the time", r"\delta t"),
    "δ′t": ("variation δ′ of the time", r"\delta' t"),
    "m": ("total mass", "m"),
    "c": ("first moment Σ m_i r_i (the centre of mass is c/m)", "c"),
    "J": ("matrix of moments Σ m_i r_i r̄_i", "J"),
    "r": ("points of the body", "r"),
    "v": ("velocities of the points in space", "v"),
    "F": ("forces on the points; without index their resultant", "F"),
    "N": ("moments of the forces, Σ F_i r̄_i", "N"),
    "N_b": ("ĀN, moments of the forces in the body frame", "N_b"),
    "F_b": ("ĀF, resultant in the body frame", "F_b"),
    "μ": ("moment of the forces in the body frame, a vector", r"\mu"),
    "L": ("Lagrangian of the points", "L"),
    "U": ("potential of the points", "U"),
    "L̃": ("Lagrangian pulled back to the group", r"\tilde L"),
    "Ũ": ("potential pulled back to the group", r"\tilde U"),
    "dŨ": ("differential of Ũ at fixed time", r"\mathrm{d}\tilde U"),
    "p̃": ("momentum, a covector on the group", r"\tilde p"),
    "h̃": ("energy", r"\tilde h"),
    "F̃": ("force on the group, −grad_J Ũ", r"\tilde F"),
    "ϖ": ("Cartan form", r"\varpi"),
    "dϖ": ("exterior derivative of the Cartan form", r"\mathrm{d}\varpi"),
    "ω": ("dϖ at constant time", r"\omega"),
    "y": ("point (t, g, ν) of the evolution space: time, element of the group, velocity", "y"),
    "δy": (
        "a variation of y = (t, g, ν): time, element of the group, velocity",
        r"\delta y",
    ),
    "δ′y": ("another variation of y", r"\delta' y"),
    "δx": ("a variation of (g, ν), at constant time", r"\delta x"),
    "δ′x": ("another variation at constant time", r"\delta' x"),
    "X": ("a vector with δt = 1; the one of the kernel of dϖ gives the motion", "X"),
    "g": ("element of the group", "g"),
    "ν": ("velocity in the group", r"\nu"),
    "δg": ("variation of g", r"\delta g"),
    "A": ("linear part of g", "A"),
    "T": ("translation of g", "T"),
    "α": ("velocity of A", r"\alpha"),
    "τ": ("velocity of T", r"\tau"),
    "δA": ("variation of A", r"\delta A"),
    "δ′A": ("variation δ′ of A", r"\delta' A"),
    "δT": ("variation of T", r"\delta T"),
    "δ′T": ("variation δ′ of T", r"\delta' T"),
    "δα": ("variation of α", r"\delta\alpha"),
    "δ′α": ("variation δ′ of α", r"\delta'\alpha"),
    "δτ": ("variation of τ", r"\delta\tau"),
    "δ′τ": ("variation δ′ of τ", r"\delta'\tau"),
    "α̇": ("acceleration of A", r"\dot\alpha"),
    "τ̇": ("acceleration of T", r"\dot\tau"),
    "Ȧ": ("dA/dt along the motion", r"\dot A"),
    "Ṫ": ("dT/dt along the motion", r"\dot T"),
    "Z": ("A⁻¹α, in the Lie algebra", "Z"),
    "w": ("A⁻¹τ", "w"),
    "ξ": ("A⁻¹δA, in the Lie algebra", r"\xi"),
    "ξ′": ("A⁻¹δ′A, in the Lie algebra", r"\xi'"),
    "η": ("A⁻¹δT", r"\eta"),
    "η′": ("A⁻¹δ′T", r"\eta'"),
    "δZ": ("variation of Z", r"\delta Z"),
    "δ′Z": ("variation δ′ of Z", r"\delta' Z"),
    "δw": ("variation of w", r"\delta w"),
    "δ′w": ("variation δ′ of w", r"\delta' w"),
    "Ż": ("dZ/dt along the motion", r"\dot Z"),
    "ẇ": ("dw/dt along the motion", r"\dot w"),
    "C": ("Cauchy–Green matrix ĀA", "C"),
    "δC": ("variation of C", r"\delta C"),
    "f": ("A⁻¹F̃, in the Lie algebra", "f"),
    "ζ": ("coordinates of Z in the basis of the Lie algebra", r"\zeta"),
    "Ω": ("ξ = j(Ω)", r"\Omega"),
    "Ω′": ("ξ′ = j(Ω′)", r"\Omega'"),
    "δζ": ("variation of ζ", r"\delta\zeta"),
    "δ′ζ": ("variation δ′ of ζ", r"\delta'\zeta"),
    "ζ̇": ("dζ/dt along the motion", r"\dot\zeta"),
    "φ": ("f = j(φ)", r"\varphi"),
    "I": ("tensor of inertia", "I"),
    "I_c": ("tensor of inertia about the centre of mass", "I_c"),
    "J_c": ("matrix of moments about the centre of mass", "J_c"),
    "r_c": ("centre of mass in the body, m⁻¹c", "r_c"),
    "w_c": ("velocity of the centre of mass in the body frame", "w_c"),
    "R": ("centre of mass in space, T + m⁻¹Ac", "R"),
    "Ṙ": ("velocity of the centre of mass, τ + m⁻¹αc", r"\dot R"),
    "∫": ("integral over the body with its measure of mass", r"\int"),
    "U_Q": ("part of the potential that is given point by point", "U_Q"),
    "Q": ("force of U_Q on a point, in space", "Q"),
    "d": ("difference of two places in space, d_e of element e", "d"),
    "P": ("force of U_Q on a point, in the body frame", "P"),
    "χ": ("d_e in the body frame, Ād_e", r"\chi"),
    "σ": ("force over distance along d_e", r"\sigma"),
    "N_Q": ("moments of the forces Q, in the body frame", "N_Q"),
    "F_Q": ("resultant of the forces Q, in the body frame", "F_Q"),
    "μ_Q": ("moment of the forces Q in the body frame, a vector", r"\mu_Q"),
    "N_u": ("moments of the given forces, in the body frame", "N_u"),
    "F_u": ("resultant of the given forces, in the body frame", "F_u"),
    "μ_u": ("moment of the given forces in the body frame, a vector", r"\mu_u"),
    "κ": ("coefficient of damping of a point", r"\kappa"),
    "D": ("moments of the damping, Σ κ_i r_i r̄_i", "D"),
    "D_c": ("first moment of the damping, Σ κ_i r_i", "D_c"),
    "D_m": ("total damping, Σ κ_i", "D_m"),
    "I_D": ("(Tr D) 1 − D", "I_D"),
    "E": ("basis of the Lie algebra (of its linear parts)", "E"),
    "M": ("mass matrix of the basis", "M"),
    "β": ("load along the elements of the basis", r"\beta"),
    "B": ("what forces and velocities leave to be balanced by Ż", "B"),
    "N_c": ("moments of the forces about the centre of mass, in the body frame", "N_c"),
    "Λ": ("direction normal to the Lie algebra", r"\Lambda"),
    "λ": ("multiplier of the volume", r"\lambda"),
    "K": ("stiffness matrix of the springs, Σ k_e s_e s̄_e", "K"),
    "k": ("stiffness of a spring, k_e of spring e", "k"),
    "s": ("difference r_i − r_j of the ends of a spring in the body, s_e of spring e", "s"),
    "γ": ("acceleration of gravity", r"\gamma"),
    "u": ("input: a covector of the Lie algebra", "u"),
    "f_u": ("input: the force part of a body wrench", "f_u"),
    "δ": ("first variation", r"\delta"),
    "δ′": ("another variation, which commutes with δ", r"\delta'"),
    "ℓ": ("angular momentum in space, a skew matrix", r"\ell"),
    "ℓ̇": ("dℓ/dt along the motion", r"\dot\ell"),
    "p": ("momentum in space", "p"),
    "ṗ": ("dp/dt along the motion", r"\dot p"),
    "ḣ": ("dh̃/dt along the motion", r"\dot{\tilde h}"),
    "∂ₜŨ": ("partial derivative of Ũ in time", r"\partial_t\tilde U"),
}

ROTATIONS: dict[str, str] = {
    "Z": "A⁻¹α, skew: Z = j(ζ)",
    "ζ": "angular velocity in the body",
    "λ": "principal moments of inertia, the eigenvalues of I",
    "u": "input: a torque about the fixed point, in the body frame",
    "ℓ": "angular momentum in space",
}
DISPLACEMENTS: dict[str, str] = ROTATIONS | {
    "w": "velocity of the body's origin in the body frame, A⁻¹τ",
    "u": "input: a moment about the body's origin, in the body frame",
    "f_u": "input: a force on the body's origin, in the body frame",
}
"""What names mean more precisely for rotations and displacements of R³."""

PRODUCTS: dict[str, str] = {
    "A": "element of the group, a block for each of its factors",
    "c": "first moment Σ m_i r_i, a block for each factor",
}
"""What names mean where the group is a product, whose affine factors act on (r, 1)."""

MISPRINTED = frozenset({20, 25, 26, 29, 31, 32, 35})
"""The numbered equations whose print the derivation corrects; ``derive paper`` finds them."""
