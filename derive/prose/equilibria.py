"""What is said of relative equilibria and their stability: English, French."""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "equilibrium": {
        "tried": (
            "Points were tried with at most one momentum, equal to 1, and at most one other "
            "coordinate, equal to 1 or −1; others are to be given.",
            "On a essayé les points ayant au plus un moment, égal à 1, et au plus une autre "
            "coordonnée, égale à 1 ou −1 ; les autres sont à donner.",
        ),
        "at": (
            "A relative equilibrium, a steady motion: {point}, while all other variables vanish. "
            "The rates, in powers of the distance from it, have no constant terms.",
            "Un équilibre relatif, un mouvement stationnaire : {point}, les autres variables étant "
            "nulles. Les dérivées, en puissances de la distance à ce point, n’ont pas de terme "
            "constant.",
        ),
        "none": (
            "No multiples of what is known to be kept make the derivative of the energy vanish "
            "there.",
            "Aucun multiple de ce qu’on sait être conservé n’annule là la dérivée de l’énergie.",
        ),
        "form": (
            "The energy, with multiples of what else is kept such that the derivative vanishes at "
            "the equilibrium: a constant, squares, {positive} positive and {negative} negative, "
            "which are independent on the tangent space of the symplectic leaf, products that "
            "vanish there, and terms of higher order.",
            "L’énergie, avec des multiples de ce qui est conservé en outre tels que la dérivée "
            "s’annule à l’équilibre : une constante, des carrés, {positive} positifs et {negative} "
            "négatifs, indépendants sur l’espace tangent de la feuille symplectique, des produits "
            "nuls sur cet espace, et des termes d’ordre supérieur.",
        ),
        "stable": (
            "On the leaf the squares are of one sign, and the Poisson tensor has its largest rank "
            "at the equilibrium: it is stable (energy–Casimir method, Arnold).",
            "Sur la feuille, les carrés sont de même signe, et le tenseur de Poisson est de rang "
            "maximal à l’équilibre : il est stable (méthode énergie–Casimir, Arnold).",
        ),
        "stable_beyond": (
            "The second derivative is definite, not on the leaf alone: the equilibrium is stable "
            "(energy–Casimir method, Arnold).",
            "La dérivée seconde est définie, et pas seulement sur la feuille : l’équilibre est "
            "stable (méthode énergie–Casimir, Arnold).",
        ),
        "on_the_leaf": (
            "On the leaf the squares are of one sign: the equilibrium is stable for motions on its "
            "leaf. Of others nothing is said, as the rank of the Poisson tensor is not proved to "
            "be the largest there.",
            "Sur la feuille, les carrés sont de même signe : l’équilibre est stable pour les "
            "mouvements sur sa feuille. Des autres on ne dit rien, car il n’est pas prouvé que le "
            "rang du tenseur de Poisson soit maximal en ce point.",
        ),
        "unstable": (
            "The characteristic polynomial of the linearised rates on the leaf has the "
            "coefficients {coefficients}, from the highest power: by Sturm’s count of the roots, "
            "some eigenvalue has a positive real part, the largest being about {growth}. The "
            "equilibrium is unstable (Lyapunov).",
            "Le polynôme caractéristique des dérivées linéarisées sur la feuille a pour "
            "coefficients {coefficients}, depuis la plus haute puissance : selon le décompte des "
            "racines par Sturm, une valeur propre est de partie réelle positive, la plus grande "
            "étant {growth} environ. L’équilibre est instable (Lyapunov).",
        ),
        "open": (
            "The characteristic polynomial of the linearised rates on the leaf has the "
            "coefficients {coefficients}, from the highest power, and that some eigenvalue has a "
            "positive real part is not proved. Whether the equilibrium is stable stays open.",
            "Le polynôme caractéristique des dérivées linéarisées sur la feuille a pour "
            "coefficients {coefficients}, depuis la plus haute puissance, et il n’est pas prouvé "
            "qu’une valeur propre soit de partie réelle positive. La stabilité de l’équilibre "
            "reste ouverte.",
        ),
    },
}
"""Step, then name of the sentence."""
