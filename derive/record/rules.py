"""The rules by which steps are derived: a sentence for each, and of what kind its equations are."""

from __future__ import annotations

from typing import NamedTuple


class Rule(NamedTuple):
    """What a step with this rule does, in a sentence, and the kind of its equations.

    A *definition* says what names are; an *identity* holds at every point of the evolution space, a
    *restriction* for some arguments alone; a *kernel* step is what the variations test, those of
    ``for_all`` in its equations; a *solution* and a *conservation* hold along the motion.
    """

    sentence: str
    kind: str


RULES: dict[str, Rule] = {
    "definition": Rule("A name is given to an expression.", "definition"),
    "variation": Rule("The derivation δ is applied: product rule on words.", "identity"),
    "pull-back": Rule(
        "The motion by the group is substituted and summed over the points.", "identity"
    ),
    "fibre derivative": Rule("The Lagrangian is differentiated along the velocity.", "identity"),
    "Legendre transform": Rule(
        "The momentum is paired with the velocity, less the Lagrangian.", "definition"
    ),
    "Cartan form": Rule("Momentum on the displacement, less energy on the time.", "definition"),
    "exterior derivative": Rule("dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)].", "identity"),
    "restriction": Rule("Some variations are set to zero.", "restriction"),
    "trivialisation": Rule("Tangent vectors are carried to the identity by g⁻¹.", "identity"),
    "structure equation": Rule("δ(δ′g) = δ′(δg), read in the trivialisation.", "identity"),
    "contraction": Rule("A vector is put into dϖ.", "restriction"),
    "kernel": Rule("The coefficient of each free variation must vanish.", "kernel"),
    "relation": Rule("A relation of the group is used.", "identity"),
    "identification": Rule("The same in other letters: so(3) as R³ by j, say.", "identity"),
    "elimination": Rule("One unknown is solved for and put into the other equations.", "solution"),
    "multiplier": Rule(
        "An element orthogonal to the Lie algebra is a multiplier of its constraint.", "kernel"
    ),
    "input": Rule("A given force, outside dϖ, is added to the equations.", "definition"),
    "coordinates": Rule("A basis of the Lie algebra is chosen.", "identity"),
    "conservation": Rule(
        "The Cartan form is constant on a displacement that leaves it alone.", "conservation"
    ),
    "solution": Rule("The equations are solved for the accelerations.", "solution"),
}
