"""The rules by which steps are derived: a sentence for each, and of what kind its equations are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple


class Rule(NamedTuple):
    """The name of a rule in French, what a step with it does, in a sentence in both languages, and
    the kind of its equations.

    A *definition* says what names are; an *identity* holds at every point of the evolution space, a
    *restriction* for some arguments alone; a *kernel* step is what the variations test, those of
    ``for_all`` in its equations; a *solution* and a *conservation* hold along the motion.
    """

    french: str
    sentence: str
    sentence_in_french: str
    kind: str


OFF_MOTION = ("definition", "identity", "restriction")
"""The kinds of what holds whether or not a point moves as the equations of motion say."""

RULES: dict[str, Rule] = {
    "definition": Rule(
        "définition",
        "A name is given to an expression.",
        "Une expression reçoit un nom.",
        "definition",
    ),
    "variation": Rule(
        "variation",
        "The derivation δ is applied: product rule, factor by factor.",
        "La dérivation δ est appliquée : règle du produit, facteur par facteur.",
        "identity",
    ),
    "pull-back": Rule(
        "image réciproque",
        "The motion by the group is substituted and summed over the points.",
        "Le mouvement par le groupe est substitué et sommé sur les points.",
        "identity",
    ),
    "fibre derivative": Rule(
        "dérivée le long des fibres",
        "The Lagrangian is differentiated along the velocity.",
        "Le lagrangien est dérivé le long de la vitesse.",
        "identity",
    ),
    "Legendre transform": Rule(
        "transformation de Legendre",
        "The momentum is paired with the velocity, less the Lagrangian.",
        "L’impulsion est appliquée à la vitesse, moins le lagrangien.",
        "definition",
    ),
    "Cartan form": Rule(
        "forme de Cartan",
        "Momentum on the displacement, less energy on the time.",
        "L’impulsion sur le déplacement, moins l’énergie sur le temps.",
        "definition",
    ),
    "exterior derivative": Rule(
        "dérivée extérieure",
        "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)].",
        "dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)].",
        "identity",
    ),
    "restriction": Rule(
        "restriction",
        "Some variations are set to 0.",
        "Certaines variations sont prises égales à 0.",
        "restriction",
    ),
    "trivialisation": Rule(
        "trivialisation",
        "Tangent vectors are carried to the identity by g⁻¹.",
        "Les vecteurs tangents sont ramenés à l’identité par g⁻¹.",
        "identity",
    ),
    "structure equation": Rule(
        "équation de structure",
        "δ(δ′g) = δ′(δg), read in the trivialisation.",
        "δ(δ′g) = δ′(δg), lu dans la trivialisation.",
        "identity",
    ),
    "contraction": Rule(
        "contraction", "A vector is put into dϖ.", "Un vecteur est mis dans dϖ.", "restriction"
    ),
    "kernel": Rule(
        "noyau",
        "The coefficient of each free variation must vanish.",
        "Le coefficient de chaque variation libre doit s’annuler.",
        "kernel",
    ),
    "relation": Rule(
        "relation",
        "A relation of the group is used.",
        "Une relation du groupe est utilisée.",
        "identity",
    ),
    "identification": Rule(
        "identification",
        "The same in other letters: so(3) as ℝ³ by j, say.",
        "La même chose en d’autres lettres : so(3) vu comme ℝ³ par j, par exemple.",
        "identity",
    ),
    "elimination": Rule(
        "élimination",
        "One unknown is solved for and put into the other equations.",
        "Une inconnue est tirée d’une équation et mise dans les autres.",
        "solution",
    ),
    "multiplier": Rule(
        "multiplicateur",
        "An element orthogonal to the Lie algebra is a multiplier of its constraint.",
        "Un élément orthogonal à l’algèbre de Lie est un multiplicateur de sa contrainte.",
        "kernel",
    ),
    "input": Rule(
        "commande",
        "A given force, outside dϖ, is added to the equations.",
        "Une force donnée, hors de dϖ, est ajoutée aux équations.",
        "definition",
    ),
    "output": Rule(
        "sortie",
        "What is read off the motion is said by the state and its rates.",
        "Ce qui se lit sur le mouvement est exprimé par l’état et ses dérivées.",
        "solution",
    ),
    "coordinates": Rule(
        "coordonnées",
        "A basis of the Lie algebra is chosen.",
        "Une base de l’algèbre de Lie est choisie.",
        "identity",
    ),
    "components": Rule(
        "composantes",
        "The equations of motion are written in coordinates.",
        "Les équations du mouvement sont écrites en coordonnées.",
        "solution",
    ),
    "conservation": Rule(
        "conservation",
        "The Cartan form is constant on a displacement that leaves it alone.",
        "La forme de Cartan est constante sur un déplacement qui la laisse invariante.",
        "conservation",
    ),
    "reduction": Rule(
        "réduction",
        "What of the state moves within itself is taken apart from the rest.",
        "Ce qui, dans l’état, évolue par soi-même est séparé du reste.",
        "solution",
    ),
    "Poisson bracket": Rule(
        "crochet de Poisson",
        "A function is constant along the motion where its bracket with the energy vanishes.",
        "Une fonction est constante le long du mouvement si son crochet avec l’énergie est nul.",
        "conservation",
    ),
    "inversion": Rule(
        "inversion",
        "The velocity is found from the momentum, its inverse function.",
        "La vitesse se trouve à partir de l’impulsion, par la fonction réciproque.",
        "identity",
    ),
    "Poisson tensor": Rule(
        "tenseur de Poisson",
        "The equations are told by brackets of the variables with the energy.",
        "Les équations sont données par les crochets des variables avec l’énergie.",
        "solution",
    ),
    "expansion": Rule(
        "développement",
        "Polynomials are written in powers of the distance from a point.",
        "Les polynômes sont écrits en puissances de l’écart à un point.",
        "identity",
    ),
    "enclosure": Rule(
        "encadrement",
        "A critical point is proved to be near a point, by the terms of the expansion there.",
        "Il y a un point critique près d’un point : les termes du développement le prouvent.",
        "identity",
    ),
    "evaluation": Rule(
        "évaluation",
        "The numbers of the problem are put into its equations.",
        "Les nombres du problème sont mis dans ses équations.",
        "solution",
    ),
    "group-affine": Rule(
        "affinité",
        "A velocity on the group is tried on products of its elements.",
        "Une vitesse sur le groupe est éprouvée sur les produits de ses éléments.",
        "identity",
    ),
    "error equation": Rule(
        "équation de l’erreur",
        "What parts two motions by the same inputs is followed in time.",
        "On suit dans le temps ce qui sépare deux mouvements par les mêmes entrées.",
        "identity",
    ),
    "trim": Rule(
        "équilibrage",
        "A state and inputs are found at which the rates of the velocity vanish.",
        "On trouve un état et des commandes où les dérivées de la vitesse s’annulent.",
        "solution",
    ),
    "solution": Rule(
        "résolution",
        "The equations are solved for the accelerations.",
        "Les équations sont résolues en les accélérations.",
        "solution",
    ),
}


def names() -> Iterator[tuple[str, str]]:
    """The name of every rule, and its sentence, in English and in French."""
    for name, rule in RULES.items():
        yield name, rule.french
        yield rule.sentence, rule.sentence_in_french
