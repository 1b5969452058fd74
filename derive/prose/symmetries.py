"""The prose of the symmetries of a Lagrangian, in English and French."""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "symmetries": {
        "all": (
            "All symmetries of L̃, and of L̃ up to dF, among the fields δt = τ, δg = (S₀ + tS₁)g − "
            "g(B₀ + tB₁) tangent to the group, with constant τ, S and B, and F of degree two at "
            "most in t and the entries of g: {count}, for generic parameters, without inputs.",
            "Toutes les symétries de L̃, et de L̃ à dF près, parmi les champs δt = τ, δg = (S₀ + "
            "tS₁)g − g(B₀ + tB₁) tangents au groupe, avec des constantes τ, S et B, et F de degré "
            "deux au plus en t et les coefficients de g : {count}, pour des paramètres génériques, "
            "sans entrées.",
        ),
        "integrand": (
            "For the integral of self-gravity L̃ has its integrand, at any place ({place}) with "
            "any weight ({weight}): a field that changes it by dF/dt for all of these does so for "
            "the integral.",
            "À la place de l’intégrale de l’autogravitation, L̃ a son intégrande, en un point "
            "({place}) et avec un poids ({weight}) quelconques : un champ qui le change de dF/dt "
            "pour tous ces points le fait pour l’intégrale.",
        ),
        "open": (
            "The values of {functions} were taken for any numbers, so that no relation between "
            "them is used but cos² + sin² = 1 and cosh² − sinh² = 1.",
            "Les valeurs de {functions} sont prises pour des nombres quelconques : aucune relation "
            "entre elles n’est utilisée, sinon cos² + sin² = 1 et cosh² − sinh² = 1.",
        ),
        "kernel": (
            "The motion is in the kernel of dϖ. A field that changes L̃ by dF/dt, put into dϖ "
            "beside X, leaves the rate of ϖ(δy) − F along the motion: it vanishes.",
            "Le mouvement est dans le noyau de dϖ. Un champ qui change L̃ de dF/dt, mis dans dϖ à "
            "côté de X, laisse la dérivée de ϖ(δy) − F le long du mouvement : elle s’annule.",
        ),
        "algebra": (
            "a Lie algebra of dimension {dimension}",
            "une algèbre de Lie de dimension {dimension}",
        ),
        "algebra_modulo": (
            "a Lie algebra of dimension {dimension} modulo those along which L̃ has no kinetic "
            "energy",
            "une algèbre de Lie de dimension {dimension} modulo ceux le long desquels L̃ n’a pas "
            "d’énergie cinétique",
        ),
        "modulo": (
            "These are symmetries times any function, and the quantity that they give is 0.",
            "Ces derniers sont des symétries même multipliés par une fonction quelconque, et la "
            "quantité qu’ils donnent est 0.",
        ),
        "none": (
            "a Lie algebra of dimension 0",
            "une algèbre de Lie de dimension 0",
        ),
        "exact": (
            "By a symmetry of L̃, {kind}.",
            "Par une symétrie de L̃, {kind}.",
        ),
        "up_to": (
            "By a symmetry of L̃ up to dF, {kind}.",
            "Par une symétrie de L̃ à dF près, {kind}.",
        ),
        "central": (
            "These commute, {first} and {second}, and dϖ of them is a number, which no choice of "
            "F takes away.",
            "Ces champs commutent, {first} et {second}, et leur dϖ est un nombre, qu’aucun choix "
            "de F n’enlève.",
        ),
        "time": (
            "a translation of time",
            "une translation du temps",
        ),
        "translation_space": (
            "a translation of space",
            "une translation de l’espace",
        ),
        "rotation_space": (
            "a rotation of space",
            "une rotation de l’espace",
        ),
        "displacement_space": (
            "a displacement of space",
            "un déplacement de l’espace",
        ),
        "deformation_space": (
            "a deformation of space",
            "une déformation de l’espace",
        ),
        "boost": (
            "a boost, a uniform motion of space",
            "une poussée, un mouvement uniforme de l’espace",
        ),
        "translation_body": (
            "a translation of the body",
            "une translation du corps",
        ),
        "rotation_body": (
            "a rotation of the body",
            "une rotation du corps",
        ),
        "displacement_body": (
            "a displacement of the body",
            "un déplacement du corps",
        ),
        "deformation_body": (
            "a deformation of the body",
            "une déformation du corps",
        ),
        "rotation_alone": (
            "a rotation of T alone",
            "une rotation de T seul",
        ),
        "both": (
            "a field that moves more than one of time, space and body",
            "un champ qui déplace plus d’une chose parmi le temps, l’espace et le corps",
        ),
        "moving": (
            "a field that depends on the time",
            "un champ qui dépend du temps",
        ),
    },
}
