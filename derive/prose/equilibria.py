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
        "origin": (
            "A relative equilibrium, where all variables vanish. The rates, in powers of these, "
            "have no constant terms.",
            "Un équilibre relatif, où toutes les variables sont nulles. Les dérivées, en "
            "puissances de celles-ci, n’ont pas de terme constant.",
        ),
        "none": (
            "No multiples of what is known to be kept make the derivative of the energy vanish "
            "there.",
            "Aucun multiple de ce qu’on sait être conservé n’annule là la dérivée de l’énergie.",
        ),
        "orbit": (
            "The second derivative of the energy along the symplectic leaf, modulo the stabiliser, "
            "is ω(Mv, v) for the linearised rates M and the symplectic form ω: {positive} positive "
            "and {negative} negative squares.",
            "La dérivée seconde de l’énergie le long de la feuille symplectique, modulo le "
            "stabilisateur, est ω(Mv, v), avec les dérivées linéarisées M et la forme symplectique "
            "ω. Carrés positifs : {positive}, négatifs : {negative}.",
        ),
        "form": (
            "The energy, with multiples of what else is kept such that the derivative vanishes at "
            "the equilibrium: a constant, squares, {positive} positive and {negative} negative, "
            "which are independent on the tangent space of the symplectic leaf, products that "
            "vanish there, and terms of higher order.",
            "L’énergie, avec des multiples de ce qui est conservé en outre tels que la dérivée "
            "s’annule à l’équilibre : une constante, des carrés indépendants sur l’espace tangent "
            "de la feuille symplectique (positifs : {positive}, négatifs : {negative}), des "
            "produits nuls sur cet espace, et des termes d’ordre supérieur.",
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
        "stable_compact": (
            "On the leaf the squares are of one sign, and the stabiliser of the equilibrium is "
            "compact, as the Killing form of the Lie algebra is negative definite: the equilibrium "
            "is stable, off its leaf too (Montaldi).",
            "Sur la feuille, les carrés sont de même signe, et le stabilisateur de l’équilibre est "
            "compact, la forme de Killing de l’algèbre de Lie étant définie négative : l’équilibre "
            "est stable, hors de sa feuille aussi (Montaldi).",
        ),
        "on_the_leaf": (
            "On the leaf the squares are of one sign: the equilibrium is stable for motions on its "
            "leaf. Of others nothing is said: it is not proved that the rank of the Poisson tensor "
            "is the largest there or the stabiliser compact.",
            "Sur la feuille, les carrés sont de même signe : l’équilibre est stable pour les "
            "mouvements sur sa feuille. Des autres on ne dit rien : il n’est pas prouvé que le "
            "rang du tenseur de Poisson soit maximal en ce point ou le stabilisateur compact.",
        ),
        "indefinite": (
            "The form is not definite on the leaf, which proves nothing.",
            "La forme n’est pas définie sur la feuille, ce qui ne prouve rien.",
        ),
        "point": (
            "The symplectic leaf of the equilibrium is this point alone, which proves nothing. "
            "Whether the equilibrium is stable stays open.",
            "La feuille symplectique de l’équilibre se réduit à ce point, ce qui ne prouve rien. "
            "La stabilité de l’équilibre reste ouverte.",
        ),
        "unstable": (
            "The characteristic polynomial of the linearised rates on the leaf has the "
            "coefficients {coefficients}, from the highest power: by Sturm’s count of the roots, "
            "some eigenvalue has a positive real part. The equilibrium is unstable (Lyapunov).",
            "Le polynôme caractéristique des dérivées linéarisées sur la feuille a pour "
            "coefficients {coefficients}, depuis la plus haute puissance : selon le décompte des "
            "racines par Sturm, une valeur propre est de partie réelle strictement positive. "
            "L’équilibre est instable (Lyapunov).",
        ),
        "unstable_beyond": (
            "The characteristic polynomial of the linearised rates, not on the leaf alone, has the "
            "coefficients {coefficients}, from the highest power: by Routh’s scheme some "
            "eigenvalue has a positive real part. The equilibrium is unstable (Lyapunov).",
            "Le polynôme caractéristique des dérivées linéarisées, et pas seulement sur la "
            "feuille, a pour coefficients {coefficients}, depuis la plus haute puissance : selon "
            "le schéma de Routh, une valeur propre est de partie réelle strictement positive. "
            "L’équilibre est instable (Lyapunov).",
        ),
        "open": (
            "The characteristic polynomial of the linearised rates on the leaf has the "
            "coefficients {coefficients}, from the highest power: by Sturm’s count of the roots, "
            "all eigenvalues are imaginary or 0, which proves nothing. Whether the equilibrium is "
            "stable stays open.",
            "Le polynôme caractéristique des dérivées linéarisées sur la feuille a pour "
            "coefficients {coefficients}, depuis la plus haute puissance : selon le décompte des "
            "racines par Sturm, toutes les valeurs propres sont imaginaires ou 0, ce qui ne "
            "prouve rien. La stabilité de l’équilibre reste ouverte.",
        ),
        "undecided": (
            "Whether an element of the group has these entries of g is not decided: of the "
            "stability nothing is said.",
            "Qu’un élément du groupe ait ces coefficients de g n’est pas décidé : de la stabilité "
            "on ne dit rien.",
        ),
        "eigenvalues": (
            "The eigenvalues are about {eigenvalues}.",
            "Les valeurs propres sont environ {eigenvalues}.",
        ),
        "squares": (
            "Their squares are exactly {squares}.",
            "Leurs carrés sont exactement {squares}.",
        ),
        "near": (
            "Newton’s method leads to an equilibrium, a steady motion, {point}, while all other "
            "variables nearly vanish. The rates, in powers of the distance from these decimals.",
            "La méthode de Newton conduit à un équilibre, un mouvement stationnaire, {point}, les "
            "autres variables étant presque nulles. Les dérivées, en puissances de la distance à "
            "ces décimales.",
        ),
    },
    "enclosure": {
        "within": (
            "The Casimirs, less their values on a level, and the energy with multiples of them, in "
            "powers of the distance. By these numbers a step of Newton’s method for the critical "
            "points of the energy on the level is a contraction: within {radius} of the decimals, "
            "in each variable and multiplier, there is exactly one, an equilibrium (Krawczyk).",
            "Les Casimirs, moins leurs valeurs sur un niveau, et l’énergie avec des multiples de "
            "ceux-ci, en puissances de la distance. D’après ces nombres, une étape de la méthode "
            "de Newton pour les points critiques de l’énergie sur le niveau est une contraction : "
            "à moins de {radius} des décimales, en chaque variable et chaque multiplicateur, il en "
            "existe exactement un, un équilibre (Krawczyk).",
        ),
        "signs": (
            "There the second derivative of the energy on the level has {positive} positive and "
            "{negative} negative squares, which is certified: with the derivatives of the Casimirs "
            "beside it, its matrix is invertible everywhere within this distance.",
            "Là, la dérivée seconde de l’énergie sur le niveau est une somme de carrés (positifs : "
            "{positive}, négatifs : {negative}), ce qui est certifié : bordée des dérivées des "
            "Casimirs, sa matrice est inversible partout à moins de cette distance.",
        ),
        "stable": (
            "It is definite: the equilibrium is stable (energy–Casimir method, Arnold).",
            "Elle est définie : l’équilibre est stable (méthode énergie–Casimir, Arnold).",
        ),
        "unstable": (
            "It is indefinite, which proves nothing. The characteristic polynomial q(λ²) of the "
            "linearised rates, enclosed, has a root λ with positive real part, as its coefficients "
            "have not the signs or do not satisfy Newton’s inequalities of a polynomial with "
            "real roots that are negative or 0: the equilibrium is unstable (Lyapunov).",
            "Elle est indéfinie, ce qui ne prouve rien. Le polynôme caractéristique q(λ²) des "
            "dérivées linéarisées, encadré, a une racine λ de partie réelle strictement positive, "
            "car ses coefficients n’ont pas les signes, ou ne vérifient pas les inégalités de "
            "Newton, d’un polynôme à racines réelles négatives ou égales à 0 : l’équilibre est "
            "instable (Lyapunov).",
        ),
        "open": (
            "It is indefinite, which proves nothing, and that an eigenvalue of the linearised "
            "rates has a positive real part is not proved. Whether the equilibrium is stable is "
            "left open.",
            "Elle est indéfinie, ce qui ne prouve rien, et il n’est pas prouvé qu’une valeur "
            "propre des dérivées linéarisées soit de partie réelle strictement positive. La "
            "stabilité de l’équilibre reste ouverte.",
        ),
        "eigenvalues": (
            "Its eigenvalues are about {eigenvalues}.",
            "Ses valeurs propres sont environ {eigenvalues}.",
        ),
    },
}
"""Step, then name of the sentence."""
