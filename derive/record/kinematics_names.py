"""What the names of a record of kinematics of first order mean: a motion, its estimate, errors."""

from __future__ import annotations

from .names import (
    ALGEBRA,
    COORDINATES,
    SCALAR,
    SQUARE,
    VECTOR,
    Name,
    defined,
    family,
    function,
    letter,
    name,
    rate,
)

# fmt: off
KINEMATICS: dict[str, Name] = {
    "A": name("element of the group", "élément du groupe", "A", letter(SQUARE)),
    "Ȧ": name("dA/dt along the motion", "dA/dt le long du mouvement", r"\dot A", rate(SQUARE)),
    "Â": name("estimate of A, which moves by the same inputs",
        "estimation de A, qui évolue avec les mêmes entrées", r"\hat A", letter(SQUARE)),
    "ℱ": name("velocity at an element of the group, for the inputs of this time",
        "vitesse en un élément du groupe, pour les entrées de cet instant",
        r"\mathcal{F}", function(SQUARE, SQUARE), function(SCALAR, SQUARE)),
    "Z": name("velocity carried to the identity", "vitesse ramenée à l’identité",
        "Z", defined(SQUARE)),
    "ζ": name("coordinates of Z in the basis of the Lie algebra",
        "coordonnées de Z dans la base de l’algèbre de Lie", r"\zeta", defined(COORDINATES)),
    "E": name("basis of the Lie algebra", "base de l’algèbre de Lie",
        "E", letter(family("basis", ALGEBRA))),
    "d/dt": name("derivative in time, along the motions",
        "dérivée dans le temps, le long des mouvements",
        r"\frac{\mathrm{d}}{\mathrm{d}t}",
        function(SQUARE, SQUARE), function(COORDINATES, COORDINATES)),
    "η_L": name("left error of the estimate", "erreur à gauche de l’estimation",
        r"\eta_L", defined(SQUARE)),
    "η_R": name("right error of the estimate", "erreur à droite de l’estimation",
        r"\eta_R", defined(SQUARE)),
    "ξ_L": name("coordinates of the logarithm of η_L", "coordonnées du logarithme de η_L",
        r"\xi_L", letter(COORDINATES)),
    "ξ_R": name("coordinates of the logarithm of η_R", "coordonnées du logarithme de η_R",
        r"\xi_R", letter(COORDINATES)),
    "𝒜_L": name("what moves ξ_L, by the inputs alone", "ce qui fait évoluer ξ_L, par les entrées "
        "seules", r"\mathcal{A}_L", defined(("matrix", "d", "d"))),
    "𝒜_R": name("what moves ξ_R, by the inputs alone", "ce qui fait évoluer ξ_R, par les entrées "
        "seules", r"\mathcal{A}_R", defined(("matrix", "d", "d"))),
    "ς": name("noise on the inputs, in their order", "bruit sur les entrées, dans leur ordre",
        r"\varsigma", letter(("vector", "inputs"))),
    "W_L": name("velocity that the noise adds to the estimate, carried to 1 on the left",
        "vitesse que le bruit ajoute à l’estimation, ramenée à 1 par la gauche",
        "W_L", defined(SQUARE)),
    "W_R": name("velocity that the noise adds to the estimate, carried to 1 on the right",
        "vitesse que le bruit ajoute à l’estimation, ramenée à 1 par la droite",
        "W_R", defined(SQUARE)),
    "o": name("what is seen by the element or its inverse",
        "ce qui est vu par l’élément ou son inverse",
        "o", letter(VECTOR)),
    "z_L": name("innovation of o seen by A", "innovation de o vu par A", "z_L", defined(VECTOR)),
    "z_R": name("innovation of o seen by A⁻¹", "innovation de o vu par A⁻¹",
        "z_R", defined(VECTOR)),
}
# fmt: on
