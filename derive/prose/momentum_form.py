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
        "metric": (
            "The kinetic energy is quadratic, so that the momenta tell the velocity.",
            "L’énergie cinétique est quadratique, de sorte que les moments donnent la vitesse.",
        ),
        "basis": (
            "The momenta on the basis of the Lie algebra; they tell the velocity as the loads tell "
            "the acceleration.",
            "Les moments sur la base de l’algèbre de Lie ; ils donnent la vitesse comme les "
            "charges donnent l’accélération.",
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
        "dual": (
            "The Poisson tensor 𝕁 has the brackets of the momenta as its entries; what it is "
            "applied to is the derivative of the energy with respect to them: Lie–Poisson "
            "equations on 𝔤*.",
            "Le tenseur de Poisson 𝕁 a pour coefficients les crochets des moments ; on l’applique "
            "à la dérivée de l’énergie par rapport à ceux-ci : des équations de Lie–Poisson sur "
            "𝔤*.",
        ),
        "rotations": (
            "The same motion told by its momentum, with the forces of this problem: Lie–Poisson "
            "equations, 𝕁ζ and a torque; 𝕁 has the brackets of the components of ℓ_b as its "
            "entries.",
            "Le même mouvement donné par son moment, avec les forces de ce problème : des "
            "équations de Lie–Poisson, 𝕁ζ et un couple ; 𝕁 a pour coefficients les crochets des "
            "composantes de ℓ_b.",
        ),
        "displacements": (
            "The same motion told by its momenta, with the forces of this problem: Lie–Poisson "
            "equations, 𝕁 applied to (ζ, w), and the forces; 𝕁 has the brackets of the components "
            "of ℓ_b, then of p_b, as its entries.",
            "Le même mouvement donné par ses moments, avec les forces de ce problème : des "
            "équations de Lie–Poisson, 𝕁 appliqué à (ζ, w), et les forces ; 𝕁 a pour coefficients "
            "les crochets des composantes de ℓ_b, puis de p_b.",
        ),
        "invariant": (
            "The same motion told by its momenta, with the forces of this problem: Lie–Poisson "
            "equations, as the metric does not depend on the element of the group. Of the Poisson "
            "tensor 𝕁_ab is the bracket of Π_a and Π_b.",
            "Le même mouvement donné par ses moments, avec les forces de ce problème : des "
            "équations de Lie–Poisson, car la métrique ne dépend pas de l’élément du groupe. Du "
            "tenseur de Poisson, 𝕁_ab est le crochet de Π_a et de Π_b.",
        ),
        "basis": (
            "The same motion told by its momenta, with the forces of this problem. Of the Poisson "
            "tensor 𝕁_ab is the bracket of Π_a and Π_b: ⟨Π, [Z, E_a]⟩ is Σ 𝕁_ab ζ_b, and with what "
            "the metric, which depends on the element of the group, adds to Φ it makes ⟨Z̄Π, E_a⟩.",
            "Le même mouvement donné par ses moments, avec les forces de ce problème. Du tenseur "
            "de Poisson, 𝕁_ab est le crochet de Π_a et de Π_b : ⟨Π, [Z, E_a]⟩ est Σ 𝕁_ab ζ_b, et "
            "avec ce que la métrique, qui dépend de l’élément du groupe, ajoute à Φ, il fait "
            "⟨Z̄Π, E_a⟩.",
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
