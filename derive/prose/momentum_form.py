"""What is said of the motion told by momenta.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "by_momenta": {
        "quadratic": (
            "L̃ is quadratic in Z, so that the momenta tell the velocity.",
            "L̃ est quadratique en Z, de sorte que les moments donnent la vitesse.",
        ),
    },
    "poisson_tensor": {
        "group": (
            "The Poisson tensor 𝕁 has the brackets of the momenta as its entries, and ζ is the "
            "derivative of the energy with respect to them: Lie–Poisson equations, with a force "
            "where the energy depends on the element of the group.",
            "Le tenseur de Poisson 𝕁 a pour coefficients les crochets des moments, et ζ est la "
            "dérivée de l’énergie par rapport à eux : des équations de Lie–Poisson, avec une force "
            "là où l’énergie dépend de l’élément du groupe.",
        ),
        "reduced": (
            "The Poisson tensor 𝕁 has the brackets of the momenta and of Γ as its entries; what it "
            "is applied to is the derivative of the energy with respect to these: Lie–Poisson "
            "equations on the dual of a semidirect product.",
            "Le tenseur de Poisson 𝕁 a pour coefficients les crochets des moments et de Γ ; on "
            "l’applique à la dérivée de l’énergie par rapport à ceux-ci : des équations de "
            "Lie–Poisson sur le dual d’un produit semi-direct.",
        ),
    },
}
