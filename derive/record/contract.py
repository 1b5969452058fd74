"""What a reader of a record must know beside its steps: scopes, conventions, commentary."""

from __future__ import annotations

ANY_GROUP = "any group"
ACTIONS = ("linear", "affine")
"""How a group moves points; the text about any group of an action is called by the same word."""
CHAPTERS = (*ACTIONS, "left", "right", "discrete", "discrete_affine")
"""What is said of any group, by what the labels begin with: for points that it moves linearly, or
by affine maps; for any Lagrangian on it, trivialised on the left, or on the
right; of the discrete motion, for each action."""
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
    "where δA and δt are given, δ is a field on R × G, δA a function of t and A, and velocities go "
    "along; likewise δ′; d/dt of ϖ(δy) − F(t, A) is that along the motion",
    "a step that is not driven has neither inputs nor damping",
    "hypotheses: what the equations of a step need; A and with it C have inverses; a form on T_g G "
    "or 𝔤 is one in two variations δg and δ′g there; where masses are not of any sign, they are "
    "positive; of the velocity of X, what is given and is an equation as well, is what they tell "
    "where dϖ(X, δ′y) vanishes for every δ′y with δ′t = 0 and δ′g = 0",
)
"""The conventions of a record that another reader of its JSON must know, listed in every record."""

FIELDS = ("δt", "δA", "δ′t", "δ′A")
"""What says, where it is given in a step, that δ or δ′ is a field: it defines no name."""

COMMENTARY = ("meaning", "latex", "prose", "sentences", "paper", "title", "unit")
"""The fields of a record that no reader need understand, wherever they stand: words for people."""

AMENDED = frozenset({20, 25, 26, 29, 31, 32, 35})
"""The numbered equations whose print the derivation corrects; ``derive paper`` finds them."""
