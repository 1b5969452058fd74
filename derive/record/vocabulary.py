"""The names of the walk: what each one means, how LaTeX writes it, and what it is.

The table is a contract between the walk, which uses the names, and the checker, which gives each a
value by its meaning alone.  Bars are transposes; a prime belongs to the second variation δ′.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from ..schema.kinds import kinds

ANY_GROUP = "any group"
ACTIONS = ("linear", "affine")
"""How a group moves points; the text about any group of an action is called by the same word."""
CONVENTIONS = (
    "T is the transpose, a bar in the paper; names are compared letter by letter, as written",
    "inner(a, b) and metric(M, a, b) are Tr a M b̄ for matrices and ā M b for vectors",
    "bracket(a, b) = ab − ba; hat(X) = j(X), j(X)Y = X ∧ Y; entries are counted from 1",
    "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] for commuting variations; ξ = g⁻¹δg, Z = g⁻¹ν; where X is the "
    "tangent of a lift, ν = ġ, δ varies it through lifts, and commutes with d/dt",
    "par(name) is a parameter; at(name, i) a member of a family, over which sum(i, x) runs",
    "an equation holds for every value of a free index and of the names in for_all, and there is a "
    "value of each name in exists, which has it from there on; ζ are the coordinates of Z in the "
    "basis of the group (Z = j(ζ) for rotations)",
    "the equations of a step hold where those that it lists as given do; X is any vector with "
    "δt(X) = 1 for which they do, and δ itself where δt = 1 is given; α̇, Ż, ζ̇ and their like are "
    "the acceleration of the motion, or of X where the equation holds for all of them",
    "a step that is not driven has neither inputs nor damping",
    "hypotheses: what the equations of a step need; A and with it C have inverses; a form on T_g G "
    "or 𝔤 is one in two variations δg and δ′g there; where masses are not of any sign, they are "
    "positive; of the velocity of X, what is given and is an equation as well, is what they tell "
    "where dϖ(X, δ′y) vanishes for every δ′y with δ′t = 0 and δ′g = 0",
)
"""The conventions of a record that another reader of its JSON must know, listed in every record."""

Type = str | tuple[Any, ...]
"""``scalar``, ``(matrix, rows, columns)``, ``(vector, n)``; ``(algebra,)``, a matrix among the
linear parts of 𝔤; ``(function, types of the arguments …, type of the value)``; ``(family, what its
index counts, type of a member)``; a variation of the point y, with the time or without."""

SCALAR, VARIATION, AT_ONE_TIME = "scalar", "variation", "variation at one time"
SQUARE, VECTOR, COORDINATES = ("matrix", "n", "n"), ("vector", "n"), ("vector", "d")
ALGEBRA, PLACE = ("algebra",), ("vector", "block")
"""Sizes in types: n is the dimension of the space, d that of the linear parts of 𝔤, dim that of 𝔤,
block that of the space of a factor, where a product has several of any of them."""

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
    """What a name means, how LaTeX writes it, and in which ways it is used in equations."""

    meaning: str
    latex: str
    uses: tuple[Use, ...]


def name(meaning: str, latex: str, *uses: Use) -> Name:
    """The :class:`Name` of a meaning, with its uses; without any it occurs in sentences alone."""
    return Name(meaning, latex, uses)


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


VOCABULARY: dict[str, Name] = {
    "t": name("time", "t", letter(SCALAR)),
    "δt": name("variation of the time", r"\delta t", letter(SCALAR)),
    "δ′t": name("variation δ′ of the time", r"\delta' t", letter(SCALAR)),
    "m": name("total mass", "m", defined(SCALAR), letter(family("points", SCALAR))),
    "c": name("first moment Σ m_i r_i (the centre of mass is c/m)", "c", defined(VECTOR)),
    "J": name("matrix of moments Σ m_i r_i r̄_i", "J", defined(SQUARE)),
    "r": name(
        "points of the body",
        "r",
        letter(VECTOR),
        letter(family("points", VECTOR)),
        Use(family("points", ("function", SCALAR, VECTOR)), "function"),
    ),
    "v": name(
        "velocities of the points in space",
        "v",
        defined(VECTOR),
        letter(family("points", VECTOR)),
    ),
    "F": name(
        "forces on the points; without index their resultant",
        "F",
        defined(VECTOR),
        letter(family("points", VECTOR)),
    ),
    "N": name("moments of the forces, Σ F_i r̄_i", "N", defined(SQUARE)),
    "N_b": name("ĀN, moments of the forces in the body frame", "N_b", defined(SQUARE)),
    "F_b": name("ĀF, resultant in the body frame", "F_b", defined(VECTOR)),
    "μ": name("moment of the forces in the body frame, a vector", r"\mu", defined(VECTOR)),
    "L": name("Lagrangian of the points", "L", defined(SCALAR)),
    "U": name("potential of the points", "U", letter(SCALAR)),
    "L̃": name("Lagrangian pulled back to the group", r"\tilde L", defined(SCALAR)),
    "Ũ": name("potential pulled back to the group", r"\tilde U", letter(SCALAR)),
    "dŨ": name(
        "differential of Ũ at fixed time",
        r"\mathrm{d}\tilde U",
        function(SQUARE, SCALAR),
        function(SQUARE, VECTOR, SCALAR),
    ),
    "p̃": name(
        "momentum, a covector on the group",
        r"\tilde p",
        function(SQUARE, SCALAR),
        function(SQUARE, VECTOR, SCALAR),
    ),
    "h̃": name("energy", r"\tilde h", defined(SCALAR)),
    "F̃": name("force on the group, −grad_J Ũ", r"\tilde F", defined(SQUARE)),
    "ϖ": name("Cartan form", r"\varpi", function(VARIATION, SCALAR)),
    "dϖ": name(
        "exterior derivative of the Cartan form",
        r"\mathrm{d}\varpi",
        function(VARIATION, VARIATION, SCALAR),
    ),
    "ω": name("dϖ at constant time", r"\omega", function(AT_ONE_TIME, AT_ONE_TIME, SCALAR)),
    "y": name("point (t, g, ν) of the evolution space: time, element of the group, velocity", "y"),
    "δy": name(
        "a variation of y = (t, g, ν): time, element of the group, velocity",
        r"\delta y",
        letter(VARIATION),
    ),
    "δ′y": name("another variation of y", r"\delta' y", letter(VARIATION)),
    "δx": name("a variation of (g, ν), at constant time", r"\delta x", letter(AT_ONE_TIME)),
    "δ′x": name("another variation at constant time", r"\delta' x", letter(AT_ONE_TIME)),
    "X": name(
        "a vector with δt = 1; the one of the kernel of dϖ gives the motion", "X", letter(VARIATION)
    ),
    "g": name("element of the group", "g", function(VECTOR, VECTOR)),
    "ν": name("velocity in the group", r"\nu"),
    "δg": name("variation of g", r"\delta g"),
    "A": name("linear part of g", "A", letter(SQUARE)),
    "T": name("translation of g", "T", letter(VECTOR)),
    "α": name("velocity of A", r"\alpha", letter(SQUARE)),
    "τ": name("velocity of T", r"\tau", letter(VECTOR)),
    "δA": name("variation of A", r"\delta A", letter(SQUARE), of_X(SQUARE)),
    "δ′A": name("variation δ′ of A", r"\delta' A", letter(SQUARE)),
    "δT": name("variation of T", r"\delta T", letter(VECTOR), of_X(VECTOR)),
    "δ′T": name("variation δ′ of T", r"\delta' T", letter(VECTOR)),
    "δα": name("variation of α", r"\delta\alpha", letter(SQUARE)),
    "δ′α": name("variation δ′ of α", r"\delta'\alpha", letter(SQUARE)),
    "δτ": name("variation of τ", r"\delta\tau", letter(VECTOR)),
    "δ′τ": name("variation δ′ of τ", r"\delta'\tau", letter(VECTOR)),
    "α̇": name("acceleration of A", r"\dot\alpha", rate(SQUARE)),
    "τ̇": name("acceleration of T", r"\dot\tau", rate(VECTOR)),
    "Ȧ": name("dA/dt along the motion", r"\dot A", rate(SQUARE)),
    "Ṫ": name("dT/dt along the motion", r"\dot T", rate(VECTOR)),
    "Z": name("A⁻¹α, in the Lie algebra", "Z", defined(ALGEBRA)),
    "w": name("A⁻¹τ", "w", defined(VECTOR)),
    "ξ": name("A⁻¹δA, in the Lie algebra", r"\xi", defined(ALGEBRA), of_X(ALGEBRA)),
    "ξ′": name("A⁻¹δ′A, in the Lie algebra", r"\xi'", defined(ALGEBRA)),
    "η": name("A⁻¹δT", r"\eta", defined(VECTOR), of_X(VECTOR)),
    "η′": name("A⁻¹δ′T", r"\eta'", defined(VECTOR)),
    "δZ": name("variation of Z", r"\delta Z", letter(ALGEBRA)),
    "δ′Z": name("variation δ′ of Z", r"\delta' Z", letter(ALGEBRA)),
    "δw": name("variation of w", r"\delta w", letter(VECTOR)),
    "δ′w": name("variation δ′ of w", r"\delta' w", letter(VECTOR)),
    "Ż": name("dZ/dt along the motion", r"\dot Z", rate(ALGEBRA)),
    "ẇ": name("dw/dt along the motion", r"\dot w", rate(VECTOR)),
    "C": name("Cauchy–Green matrix ĀA", "C", defined(SQUARE)),
    "δC": name("variation of C", r"\delta C", defined(SQUARE)),
    "f": name("A⁻¹F̃, in the Lie algebra", "f", defined(ALGEBRA)),
    "Π": name("momentum of 𝔤*, its linear part: Σ m_i Āv_i r̄_i", r"\Pi", defined(SQUARE)),
    "δΠ": name("variation of Π", r"\delta\Pi", letter(SQUARE)),
    "δ′Π": name("variation δ′ of Π", r"\delta'\Pi", letter(SQUARE)),
    "Π̇": name("dΠ/dt along the motion", r"\dot\Pi", rate(SQUARE)),
    "p_b": name("momentum in the body frame, Σ m_i Āv_i", "p_b", defined(VECTOR)),
    "δp_b": name("variation of p_b", r"\delta p_b", letter(VECTOR)),
    "δ′p_b": name("variation δ′ of p_b", r"\delta' p_b", letter(VECTOR)),
    "ṗ_b": name("dp_b/dt along the motion", r"\dot p_b", rate(VECTOR)),
    "ℓ_b": name(
        "angular momentum in the body frame, Āℓ A, a skew matrix", r"\ell_b", defined(SQUARE)
    ),
    "δℓ_b": name("variation of ℓ_b", r"\delta\ell_b", letter(SQUARE)),
    "δ′ℓ_b": name("variation δ′ of ℓ_b", r"\delta'\ell_b", letter(SQUARE)),
    "ℓ̇_b": name("dℓ_b/dt along the motion", r"\dot\ell_b", rate(SQUARE)),
    "Φ": name("derivative of L̃ along the group, at a fixed velocity", r"\Phi", defined(SQUARE)),
    "ζ": name("coordinates of Z in the basis of the Lie algebra", r"\zeta", defined(COORDINATES)),
    "Ω": name("ξ = j(Ω)", r"\Omega", defined(VECTOR), of_X(VECTOR)),
    "Ω′": name("ξ′ = j(Ω′)", r"\Omega'", defined(VECTOR)),
    "δζ": name("variation of ζ", r"\delta\zeta", letter(COORDINATES)),
    "δ′ζ": name("variation δ′ of ζ", r"\delta'\zeta", letter(COORDINATES)),
    "ζ̇": name("dζ/dt along the motion", r"\dot\zeta", rate(COORDINATES)),
    "φ": name("f = j(φ)", r"\varphi", defined(VECTOR)),
    "I": name("tensor of inertia", "I", defined(SQUARE)),
    "λ": name("principal moments of inertia, the eigenvalues of I", r"\lambda", letter(VECTOR)),
    "I_c": name("tensor of inertia about the centre of mass", "I_c", defined(SQUARE)),
    "J_c": name("matrix of moments about the centre of mass", "J_c", defined(SQUARE)),
    "r_c": name("centre of mass in the body, m⁻¹c", "r_c", defined(VECTOR)),
    "c_c": name("first moment seen from the centres of mass", "c_c", defined(VECTOR)),
    "S": name(
        "centre of mass of each factor, in the column of its translations", "S", defined(SQUARE)
    ),
    "Z_c": name("Z(1 + S), the velocity seen from the centres of mass", "Z_c", defined(SQUARE)),
    "ψ": name(
        "coordinates of Ż(1 + S) in the basis of the Lie algebra", r"\psi", defined(COORDINATES)
    ),
    "z": name(
        "coordinates of the velocity in the basis that the problem states",
        "z",
        letter(("vector", "dim")),
    ),
    "w_c": name("velocity of the centre of mass in the body frame", "w_c", defined(VECTOR)),
    "R": name("centre of mass in space, T + m⁻¹Ac", "R", defined(VECTOR)),
    "Ṙ": name("velocity of the centre of mass, τ + m⁻¹αc", r"\dot R", defined(VECTOR)),
    "∫": name(
        "integral over the body with its measure of mass",
        r"\int",
        function(SCALAR, SCALAR),
        function(VECTOR, VECTOR),
        function(SQUARE, SQUARE),
    ),
    "U_Q": name("part of the potential that is given point by point", "U_Q", defined(SCALAR)),
    "Q": name("force of U_Q on a point, in space", "Q", defined(family("points", VECTOR))),
    "d": name(
        "difference of two places in space, d_e of element e",
        "d",
        defined(family("distances", PLACE)),
    ),
    "P": name("force of U_Q on a point, in the body frame", "P", defined(family("points", VECTOR))),
    "χ": name("d_e in the body frame, Ād_e", r"\chi", defined(family("distances", PLACE))),
    "σ": name("force over distance along d_e", r"\sigma", defined(family("distances", SCALAR))),
    "N_Q": name("moments of the forces Q, in the body frame", "N_Q", defined(SQUARE)),
    "F_Q": name("resultant of the forces Q, in the body frame", "F_Q", defined(VECTOR)),
    "μ_Q": name("moment of the forces Q in the body frame, a vector", r"\mu_Q", defined(VECTOR)),
    "N_u": name("moments of the given forces, in the body frame", "N_u", defined(SQUARE)),
    "F_u": name("resultant of the given forces, in the body frame", "F_u", defined(VECTOR)),
    "μ_u": name(
        "moment of the given forces in the body frame, a vector", r"\mu_u", defined(VECTOR)
    ),
    "κ": name("coefficient of damping of a point", r"\kappa", defined(family("points", SCALAR))),
    "D": name("moments of the damping, Σ κ_i r_i r̄_i", "D", defined(SQUARE)),
    "D_c": name("first moment of the damping, Σ κ_i r_i", "D_c", defined(VECTOR)),
    "D_m": name("total damping, Σ κ_i", "D_m", defined(SCALAR)),
    "I_D": name("(Tr D) 1 − D", "I_D", defined(SQUARE)),
    "E": name(
        "basis of the Lie algebra (of its linear parts)", "E", letter(family("basis", ALGEBRA))
    ),
    "M": name("mass matrix of the basis", "M", defined(("matrix", "d", "d"))),
    "β": name("load along the elements of the basis", r"\beta", defined(COORDINATES)),
    "B": name("what forces and velocities leave to be balanced by Ż", "B", defined(SQUARE)),
    "N_c": name(
        "moments of the forces about the centre of mass, in the body frame", "N_c", defined(SQUARE)
    ),
    "Λ": name("direction normal to the Lie algebra", r"\Lambda", letter(SQUARE)),
    "θ": name("multiplier of the volume", r"\theta", unknown(SCALAR)),
    "K": name("stiffness matrix of the springs, Σ k_e s_e s̄_e", "K", defined(SQUARE)),
    "k": name("stiffness of a spring, k_e of spring e", "k", defined(family("springs", SCALAR))),
    "s": name(
        "difference r_i − r_j of the ends of a spring in the body, s_e of spring e",
        "s",
        defined(family("springs", VECTOR)),
    ),
    "γ": name("acceleration of gravity", r"\gamma", defined(VECTOR)),
    "u": name("input: a covector of the Lie algebra", "u", letter(("vector", "dim"))),
    "f_u": name(
        "input: the force part of a body wrench",
        "f_u",
        letter(VECTOR),
        letter(family("inputs", PLACE)),
    ),
    "δ": name(
        "first variation",
        r"\delta",
        function(VECTOR, VECTOR),
        function(ALGEBRA, ALGEBRA),
        function(SCALAR, SCALAR),
    ),
    "d/dt": name(
        "derivative in time along a curve",
        r"\frac{\mathrm{d}}{\mathrm{d}t}",
        function(SCALAR, SCALAR),
    ),
    "δ′": name(
        "another variation, which commutes with δ",
        r"\delta'",
        function(VECTOR, VECTOR),
        function(ALGEBRA, ALGEBRA),
    ),
    "ℓ": name("angular momentum in space, a skew matrix", r"\ell", defined(SQUARE)),
    "ℓ̇": name("dℓ/dt along the motion", r"\dot\ell", rate(SQUARE)),
    "p": name("momentum in space", "p", defined(VECTOR)),
    "ṗ": name("dp/dt along the motion", r"\dot p", rate(VECTOR)),
    "ḣ": name("dh̃/dt along the motion", r"\dot{\tilde h}", rate(SCALAR)),
    "∂ₜŨ": name("partial derivative of Ũ in time", r"\partial_t\tilde U", letter(SCALAR)),
}

OWN_TYPES: dict[str, Type] = {"scalar": SCALAR, "vector": VECTOR, "matrix": SQUARE}
VOCABULARY |= {
    x.name: name(x.meaning, x.latex, defined(OWN_TYPES[x.type]))
    for kind in kinds().values()
    for x in kind.letters
}
"""And the letters that a kind of potential has for its own."""

ROTATIONS: dict[str, Name] = {
    "Z": name("A⁻¹α, skew: Z = j(ζ)", "Z", defined(ALGEBRA)),
    "ζ": name("angular velocity in the body", r"\zeta", defined(VECTOR)),
    "u": name("input: a torque about the fixed point, in the body frame", "u", letter(VECTOR)),
    "ℓ": name("angular momentum in space", r"\ell", defined(VECTOR)),
    "ℓ̇": name("dℓ/dt along the motion", r"\dot\ell", rate(VECTOR)),
    "ℓ_b": name(
        "angular momentum in the body frame, about the body's origin", r"\ell_b", defined(VECTOR)
    ),
    "δℓ_b": name("variation of ℓ_b", r"\delta\ell_b", letter(VECTOR)),
    "δ′ℓ_b": name("variation δ′ of ℓ_b", r"\delta'\ell_b", letter(VECTOR)),
    "ℓ̇_b": name("dℓ_b/dt along the motion", r"\dot\ell_b", rate(VECTOR)),
}
DISPLACEMENTS: dict[str, Name] = ROTATIONS | {
    "w": VOCABULARY["w"]._replace(meaning="velocity of the body's origin in the body frame, A⁻¹τ"),
    "u": ROTATIONS["u"]._replace(
        meaning="input: a moment about the body's origin, in the body frame"
    ),
    "f_u": VOCABULARY["f_u"]._replace(
        meaning="input: a force on the body's origin, in the body frame"
    ),
}
"""Meanings and types of names that are more precise for rotations and displacements of R³."""

PRODUCTS: dict[str, Name] = {
    "A": VOCABULARY["A"]._replace(meaning="element of the group, a block for each of its factors"),
    "c": VOCABULARY["c"]._replace(meaning="first moment Σ m_i r_i, a block for each factor"),
    "J_c": VOCABULARY["J_c"]._replace(meaning="matrix of moments about the centres of mass"),
}
"""Meanings of names where the group is a product, whose affine factors act on (r, 1)."""

AMENDED = frozenset({20, 25, 26, 29, 31, 32, 35})
"""The numbered equations whose print the derivation corrects; ``derive paper`` finds them."""

DERIVATIVE_OF = {"dϖ": "ϖ", "ḣ": "h̃", "ℓ̇": "ℓ", "ṗ": "p"}
DERIVATIVE_OF |= {"δΠ": "Π", "δ′Π": "Π", "Π̇": "Π", "δp_b": "p_b", "δ′p_b": "p_b", "ṗ_b": "p_b"}
DERIVATIVE_OF |= dict.fromkeys(("δℓ_b", "δ′ℓ_b", "ℓ̇_b"), "ℓ_b")
"""Name → the name of which it is a derivative or a variation."""

COMMENTARY = ("meaning", "latex", "prose", "sentences", "paper", "title", "unit")
"""The fields of a record that no reader need understand, wherever they stand: words for people."""
