"""What is said of the first integrals of reduced equations.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "poisson": {
        "group": (
            "The energy is a function of the momenta alone, and so are the equations of motion: "
            "Lie–Poisson equations on 𝔤*, of dimension {dimension}.",
            "L’énergie est une fonction des seuls moments, et les équations du mouvement aussi : "
            "équations de Lie–Poisson sur 𝔤*, de dimension {dimension}.",
        ),
        "advected": (
            "The momenta, and what the energy needs beside them, move among themselves: "
            "Lie–Poisson equations on the dual of a semidirect product, of dimension {dimension}.",
            "Les moments, et ce dont l’énergie dépend en outre, évoluent entre eux : équations de "
            "Lie–Poisson sur le dual d’un produit semi-direct, de dimension {dimension}.",
        ),
        "weighted": (
            "In what follows degrees are weighted: the other variables than momenta count as of "
            "degree {weight}.",
            "Dans la suite, les degrés sont pondérés : les variables autres que les moments "
            "comptent pour le degré {weight}.",
        ),
        "weights": (
            "In what follows degrees are weighted: those of the other variables than momenta are, "
            "in order, {weights}.",
            "Dans la suite, les degrés sont pondérés : ceux des variables autres que les moments "
            "sont, dans l’ordre, {weights}.",
        ),
        "undriven": (
            "The inputs are left out: they vanish here.",
            "Les entrées sont laissées de côté : elles sont nulles ici.",
        ),
    },
    "casimirs": {
        "kept": (
            "The Poisson brackets of these polynomials with every function vanish: they are "
            "Casimirs, which motions keep whatever the energy is.",
            "Les crochets de Poisson de ces polynômes avec toute fonction sont nuls : ce sont des "
            "Casimirs, que les mouvements conservent quelle que soit l’énergie.",
        ),
        "all": (
            "Every polynomial Casimir of degree at most {degree} is a polynomial in these.",
            "Tout Casimir polynomial de degré au plus {degree} est un polynôme en ceux-ci.",
        ),
        "all_large": (
            "Every polynomial Casimir of degree at most {degree} is a polynomial in these: the "
            "search says so, and no check computes it again at this size.",
            "Tout Casimir polynomial de degré au plus {degree} est un polynôme en ceux-ci : c’est "
            "la recherche qui le dit, et aucune vérification ne le recalcule à cette taille.",
        ),
    },
    "first_integrals": {
        "energy": (
            "The energy is an integral.",
            "L’énergie est une intégrale première.",
        ),
        "several": (
            "The Poisson brackets of these polynomials with the energy, the first of them, vanish: "
            "they are integrals.",
            "Les crochets de Poisson de ces polynômes avec l’énergie, le premier d’entre eux, sont "
            "nuls : ce sont des intégrales premières.",
        ),
        "all": (
            "Every polynomial of degree at most {degree} that is an integral is a polynomial in "
            "{these}.",
            "Tout polynôme de degré au plus {degree} qui est une intégrale première est un "
            "polynôme en {these}.",
        ),
        "all_generic": (
            "For generic values of the parameters, every polynomial of degree at most {degree} "
            "that is an integral is a polynomial in {these}.",
            "Pour des valeurs génériques des paramètres, tout polynôme de degré au plus {degree} "
            "qui est une intégrale première est un polynôme en {these}.",
        ),
        "all_large": (
            "Every polynomial of degree at most {degree} that is an integral is a polynomial in "
            "{these}: the search says so, and no check computes it again at this size.",
            "Tout polynôme de degré au plus {degree} qui est une intégrale première est un "
            "polynôme en {these} : c’est la recherche qui le dit, et aucune vérification ne le "
            "recalcule à cette taille.",
        ),
        "all_generic_large": (
            "For generic values of the parameters, every polynomial of degree at most {degree} "
            "that is an integral is a polynomial in {these}: the search says so, and no check "
            "computes it again at this size.",
            "Pour des valeurs génériques des paramètres, tout polynôme de degré au plus {degree} "
            "qui est une intégrale première est un polynôme en {these} : c’est la recherche qui le "
            "dit, et aucune vérification ne le recalcule à cette taille.",
        ),
        "it": ("it", "celle-ci"),
        "it_and_casimirs": ("it and the Casimirs", "celle-ci et en les Casimirs"),
        "these": ("these", "celles-ci"),
        "these_and_casimirs": ("these and the Casimirs", "celles-ci et en les Casimirs"),
        "dependent": (
            "The integral of number {number} is a function of those before and of the Casimirs, "
            "though no polynomial in them.",
            "L’intégrale première de numéro {number} est fonction des précédentes et des Casimirs, "
            "sans en être un polynôme.",
        ),
        "complete": (
            "The Poisson tensor has rank {rank} in dimension {dimension}, and {half} of these "
            "integrals, of numbers {numbers}, are in involution, and independent of each other and "
            "of the Casimirs: the equations are completely integrable, in the sense of Liouville.",
            "Le tenseur de Poisson est de rang {rank} en dimension {dimension}, et {half} de ces "
            "intégrales premières, de numéros {numbers}, sont en involution, indépendantes entre "
            "elles et des Casimirs : les équations sont complètement intégrables au sens de "
            "Liouville.",
        ),
        "complete_by_one": (
            "The Poisson tensor has rank 2 in dimension {dimension}, and the integral of number "
            "{number} is independent of the Casimirs: the equations are completely integrable, in "
            "the sense of Liouville.",
            "Le tenseur de Poisson est de rang 2 en dimension {dimension}, et l’intégrale première "
            "de numéro {number} est indépendante des Casimirs : les équations sont complètement "
            "intégrables au sens de Liouville.",
        ),
        "complete_by_energy": (
            "The Poisson tensor has rank 2 in dimension {dimension}, and the energy is independent "
            "of the Casimirs: the equations are completely integrable, in the sense of Liouville.",
            "Le tenseur de Poisson est de rang 2 en dimension {dimension}, et l’énergie est "
            "indépendante des Casimirs : les équations sont complètement intégrables au sens de "
            "Liouville.",
        ),
        "undecided": (
            "The Poisson tensor has rank {rank} in dimension {dimension}: {half} integrals in "
            "involution, independent of each other and of the Casimirs, are not found here, and "
            "complete integrability is left open.",
            "Le tenseur de Poisson est de rang {rank} en dimension {dimension} : on n’a pas ici "
            "{half} intégrales premières en involution, indépendantes entre elles et des Casimirs, "
            "et l’intégrabilité complète reste indécise.",
        ),
        "still": (
            "The Poisson tensor vanishes: every function is a Casimir, and the motion keeps all.",
            "Le tenseur de Poisson est nul : toute fonction est un Casimir, et le mouvement les "
            "conserve toutes.",
        ),
        "unknown_rank": (
            "The Casimirs that are found do not prove the rank of the Poisson tensor, and complete "
            "integrability is left open.",
            "Les Casimirs trouvés ne prouvent pas le rang du tenseur de Poisson, et "
            "l’intégrabilité complète reste indécise.",
        ),
        "further": (
            "The parameters being real and the kinetic energy positive, there are further "
            "polynomials of degree at most {degree} that are integrals where one of these "
            "conditions holds: {conditions}. The search finds none elsewhere; at best, that is "
            "computed again at a few numbers.",
            "Les paramètres étant réels et l’énergie cinétique définie positive, d’autres "
            "polynômes de degré au plus {degree} sont des intégrales premières là où l’une de ces "
            "conditions est satisfaite : {conditions}. La recherche n’en trouve aucun ailleurs ; "
            "au mieux, cela est recalculé pour quelques nombres.",
        ),
        "no_further": (
            "The parameters being real and the kinetic energy positive, the search finds no "
            "further polynomials of degree at most {degree} that are integrals for special values; "
            "at best, that is computed again at a few numbers.",
            "Les paramètres étant réels et l’énergie cinétique définie positive, la recherche ne "
            "trouve aucun autre polynôme de degré au plus {degree} qui soit une intégrale première "
            "pour des valeurs particulières ; au mieux, cela est recalculé pour quelques nombres.",
        ),
        "unsolved": (
            "It is not decided whether there are where {conditions}: no parameter is of first "
            "order there. That these cases are all is what the search says.",
            "Il n’est pas décidé s’il en existe là où {conditions} : aucun paramètre n’est là du "
            "premier ordre. Que ce soient tous les cas, c’est la recherche qui le dit.",
        ),
    },
    "level": {
        "multiple": (
            "The rates of these polynomials are multiples of the Casimir of number {number}: where "
            "it vanishes, they are integrals.",
            "Les dérivées de ces polynômes sont des multiples du Casimir de numéro {number} : là "
            "où il s’annule, ce sont des intégrales premières.",
        ),
        "complete": (
            "On this level, too, the Poisson tensor has rank {rank}, and {half} integrals are in "
            "involution, and independent of each other and of the Casimirs: there the equations "
            "are completely integrable, in the sense of Liouville.",
            "Sur ce niveau aussi, le tenseur de Poisson est de rang {rank}, et {half} intégrales "
            "premières sont en involution, indépendantes entre elles et des Casimirs : là, les "
            "équations sont complètement intégrables au sens de Liouville.",
        ),
    },
    "condition": {
        "one": (
            "Where {condition}, this polynomial is an integral: its rate is made of multiples of "
            "what vanishes there.",
            "Là où {condition}, ce polynôme est une intégrale première : sa dérivée est faite de "
            "multiples de ce qui s’annule là.",
        ),
        "several": (
            "Where {condition}, these polynomials are integrals: their rates are made of multiples "
            "of what vanishes there.",
            "Là où {condition}, ces polynômes sont des intégrales premières : leurs dérivées sont "
            "faites de multiples de ce qui s’annule là.",
        ),
        "complete": (
            "For generic parameters under this condition, the Poisson tensor has rank {rank}, and "
            "{half} integrals are in involution, and independent of each other and of the "
            "Casimirs: the equations are completely integrable, in the sense of Liouville.",
            "Pour des paramètres génériques sous cette condition, le tenseur de Poisson est de "
            "rang {rank}, et {half} intégrales premières sont en involution, indépendantes entre "
            "elles et des Casimirs : les équations sont complètement intégrables au sens de "
            "Liouville.",
        ),
    },
}
