"""What is said of SO(3) and SE(3), and of rotations, step by step.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "unaligned": {
        "turned": (
            "Rotations keep vector products. Of two points that are not on one line with the "
            "fixed point, and of their vector product, which span the space, the images are "
            "known: the rotation is then unique, if the points are not all on one line through "
            "the fixed point.",
            "Les rotations conservent les produits vectoriels. De deux points qui ne sont pas "
            "alignés avec le point fixe, et de leur produit vectoriel, qui engendrent l’espace, on "
            "connaît les images : la rotation est alors unique, si les points ne sont pas tous "
            "sur une même droite passant par le point fixe.",
        ),
        "displaced": (
            "Rotations keep vector products. Of the arms from the centre of mass to two points "
            "that are not on one line with it, and of their vector product, which span the space, "
            "the images are known: g_t is then unique, if the points are not all on one line.",
            "Les rotations conservent les produits vectoriels. Des bras du centre de masse à deux "
            "points qui ne sont pas alignés avec lui, et de leur produit vectoriel, qui engendrent "
            "l’espace, on connaît les images : g_t est alors unique, si les points ne sont pas "
            "tous alignés.",
        ),
    },
    "rigid": {
        "orbit": (
            "The body is rigid: C = 𝟏 says that the distances of its points are kept, so that it "
            "moves on an orbit of the isometries.",
            "Le corps est rigide : C = 𝟏 dit que les distances de ses points sont conservées, si "
            "bien qu’il évolue sur une orbite des isométries.",
        ),
    },
    "geodesics": {
        "held": (
            "The point A moves in the space of all matrices, with the metric of J, pushed by F̃ "
            "and held on the group by what is orthogonal to it, α̇ − F̃: without forces it draws "
            "a geodesic of the metric.",
            "Le point A, dans l’espace de toutes les matrices muni de la métrique de J, est "
            "poussé par F̃ et retenu sur le groupe par ce qui lui est orthogonal, α̇ − F̃ : sans "
            "forces, il décrit une géodésique de la métrique.",
        ),
        "free": (
            "Of Āα̇ = Ż + Z² the term in Z² does no work: for J = 𝟏 and without forces Z is then "
            "constant, and the motions are the one-parameter groups, moved by an element of the "
            "group.",
            "De Āα̇ = Ż + Z² le terme en Z² ne travaille pas : pour J = 𝟏 et sans forces Z est "
            "alors constant, et les mouvements sont les groupes à un paramètre, translatés par un "
            "élément du groupe.",
        ),
    },
    "hat": {
        "rotations": (
            "The Lie algebra 𝔰𝔬(3) is identified with ℝ³ by j(X)Y = X ∧ Y; the bracket is the "
            "vector product.",
            "On identifie l’algèbre de Lie 𝔰𝔬(3) à ℝ³ par j(X)Y = X ∧ Y ; le crochet est le "
            "produit vectoriel.",
        ),
        "displacements": (
            "The linear part 𝔰𝔬(3) of the Lie algebra is identified with ℝ³ by j(X)Y = X ∧ Y; the "
            "bracket is the vector product.",
            "On identifie la partie linéaire 𝔰𝔬(3) de l’algèbre de Lie à ℝ³ par j(X)Y = X ∧ Y ; "
            "le crochet est le produit vectoriel.",
        ),
    },
    "isomorphism": {
        "onto": (
            "The operator j is an isomorphism of ℝ³ onto 𝔰𝔬(3): both have dimension 3, and j(ζ) = "
            "0 for ζ = 0 alone.",
            "L’opérateur j est un isomorphisme de ℝ³ sur 𝔰𝔬(3) : tous deux sont de dimension 3, "
            "et j(ζ) = 0 pour ζ = 0 seulement.",
        ),
    },
    "inertia": {
        "metric": (
            "The metric of J on 𝔰𝔬(3) is that of the tensor of inertia on ℝ³.",
            "La métrique de J sur 𝔰𝔬(3) est celle du tenseur d’inertie sur ℝ³.",
        ),
    },
    "exterior_vector": {
        "momenta": (
            "The exterior derivative in vectors, by the momenta and with their values.",
            "La dérivée extérieure, écrite avec des vecteurs : par les moments, puis avec leurs "
            "valeurs.",
        ),
    },
    "euler": {
        "solved": (
            "Euler's equations, solved for the angular acceleration: the tensor I is invertible.",
            "Les équations d’Euler, résolues par rapport à l’accélération angulaire : le tenseur "
            "I est inversible.",
        ),
        "solved_signed": (
            "Euler's equations, solved for the angular acceleration wherever the tensor I is "
            "invertible.",
            "Les équations d’Euler, résolues par rapport à l’accélération angulaire partout où le "
            "tenseur I est inversible.",
        ),
    },
    "principal": {
        "axes": (
            "In principal axes of inertia, where I is diagonal with entries λ₁, λ₂, λ₃; the term "
            "of the potential stays.",
            "Dans les axes principaux d’inertie, où I est diagonal, de coefficients λ₁, λ₂, λ₃ ; "
            "le terme du potentiel subsiste.",
        ),
    },
    "torque": {
        "varied": (
            "The forces of this problem: the potential is varied along the group.",
            "Les forces de ce problème : on fait varier le potentiel le long du groupe.",
        ),
    },
    "tensor": {
        "entries": (
            "The tensor of inertia of this body, entry by entry.",
            "Le tenseur d’inertie de ce corps, coefficient par coefficient.",
        ),
    },
    "components": {
        "principal": (
            "The equations of motion in coordinates: the axes of the body are principal ones.",
            "Les équations du mouvement en coordonnées : les axes du corps sont des axes "
            "principaux.",
        ),
    },
}
