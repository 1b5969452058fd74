"""The rules by which steps are derived: a sentence for each, and of what kind its equations are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple


class Rule(NamedTuple):
    """The name of a rule in French, what a step with it does, in a sentence, and the kind of its
    equations.

    A *definition* says what names are; an *identity* holds at every point of the evolution space, a
    *restriction* for some arguments alone; a *kernel* step is what the variations test, those of
    ``for_all`` in its equations; a *solution* and a *conservation* hold along the motion.
    """

    french: str
    sentence: str
    kind: str


RULES: dict[str, Rule] = {
    "definition": Rule("définition", "A name is given to an expression.", "definition"),
    "variation": Rule(
        "variation", "The derivation δ is applied: product rule on words.", "identity"
    ),
    "pull-back": Rule(
        "image réciproque",
        "The motion by the group is substituted and summed over the points.",
        "identity",
    ),
    "fibre derivative": Rule(
        "dérivée le long des fibres",
        "The Lagrangian is differentiated along the velocity.",
        "identity",
    ),
    "Legendre transform": Rule(
        "transformation de Legendre",
        "The momentum is paired with the velocity, less the Lagrangian.",
        "definition",
    ),
    "Cartan form": Rule(
        "forme de Cartan", "Momentum on the displacement, less energy on the time.", "definition"
    ),
    "exterior derivative": Rule(
        "dérivée extérieure", "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)].", "identity"
    ),
    "restriction": Rule("restriction", "Some variations are set to zero.", "restriction"),
    "trivialisation": Rule(
        "trivialisation", "Tangent vectors are carried to the identity by g⁻¹.", "identity"
    ),
    "structure equation": Rule(
        "équation de structure", "δ(δ′g) = δ′(δg), read in the trivialisation.", "identity"
    ),
    "contraction": Rule("contraction", "A vector is put into dϖ.", "restriction"),
    "kernel": Rule("noyau", "The coefficient of each free variation must vanish.", "kernel"),
    "relation": Rule("relation", "A relation of the group is used.", "identity"),
    "identification": Rule(
        "identification", "The same in other letters: so(3) as R³ by j, say.", "identity"
    ),
    "elimination": Rule(
        "élimination", "One unknown is solved for and put into the other equations.", "solution"
    ),
    "multiplier": Rule(
        "multiplicateur",
        "An element orthogonal to the Lie algebra is a multiplier of its constraint.",
        "kernel",
    ),
    "input": Rule("entrée", "A given force, outside dϖ, is added to the equations.", "definition"),
    "coordinates": Rule("coordonnées", "A basis of the Lie algebra is chosen.", "identity"),
    "conservation": Rule(
        "conservation",
        "The Cartan form is constant on a displacement that leaves it alone.",
        "conservation",
    ),
    "reduction": Rule(
        "réduction",
        "What of the state moves within itself is taken apart from the rest.",
        "solution",
    ),
    "Poisson bracket": Rule(
        "crochet de Poisson",
        "A function is constant along the motion where its bracket with the energy vanishes.",
        "conservation",
    ),
    "inversion": Rule(
        "inversion", "The velocity is found from the momentum, its inverse function.", "identity"
    ),
    "Poisson tensor": Rule(
        "tenseur de Poisson",
        "The equations are told by brackets of the variables with the energy.",
        "solution",
    ),
    "expansion": Rule(
        "développement",
        "Polynomials are written in powers of the distance from a point.",
        "identity",
    ),
    "enclosure": Rule(
        "encadrement",
        "A critical point is proved to be near a point, by the terms of the expansion there.",
        "identity",
    ),
    "evaluation": Rule(
        "évaluation", "The numbers of the problem are put into its equations.", "solution"
    ),
    "solution": Rule("résolution", "The equations are solved for the accelerations.", "solution"),
}


def names() -> Iterator[tuple[str, str]]:
    """The name of every rule, in English and in French."""
    return ((name, rule.french) for name, rule in RULES.items())
