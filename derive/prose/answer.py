"""What is said of equations with a problem's own numbers, and of the form of the orbits."""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "moment_map": {
        "left": (
            "Z is the same for hg as for g, where h is constant. The momentum of these "
            "displacements is Π carried by g to the other side, Π_o (the moment map): along the "
            "motion it has no coadjoint term, and is constant where Φ vanishes. The energy "
            "changes only with the time that L̃ has by itself.",
            "Z est le même pour hg que pour g, où h est constant. Le moment de ces déplacements "
            "est Π transporté par g de l’autre côté, Π_o (l’application moment) : le long du "
            "mouvement il n’a pas de terme coadjoint, et il est constant là où Φ s’annule. "
            "L’énergie ne varie que par le temps que L̃ contient explicitement.",
        ),
        "right": (
            "Z is the same for gh as for g, where h is constant. The momentum of these "
            "displacements is Π carried by g to the other side, Π_o (the moment map): along the "
            "motion it has no coadjoint term, and is constant where Φ vanishes. The energy "
            "changes only with the time that L̃ has by itself.",
            "Z est le même pour gh que pour g, où h est constant. Le moment de ces déplacements "
            "est Π transporté par g de l’autre côté, Π_o (l’application moment) : le long du "
            "mouvement il n’a pas de terme coadjoint, et il est constant là où Φ s’annule. "
            "L’énergie ne varie que par le temps que L̃ contient explicitement.",
        ),
    },
    "conserved": {
        "kept_by_any": (
            "Without inputs the motion keeps {kept}.",
            "Sans entrées, le mouvement conserve {kept}.",
        ),
        "other": (
            "the whole of the other momentum Π_o",
            "la totalité de l’autre moment Π_o",
        ),
        "components": (
            "Components of Π_o were not tried: derive symmetries finds all symmetries.",
            "Les composantes de Π_o n’ont pas été essayées : derive symmetries trouve toutes les "
            "symétries.",
        ),
        "no_element": (
            "The state has no element of the group, which Π_o needs; what is kept of Π itself, "
            "derive integrals finds.",
            "L’état ne contient pas l’élément du groupe dont Π_o a besoin ; ce qui est conservé de "
            "Π même, derive integrals le trouve.",
        ),
    },
    "kks": {
        "level": (
            "The second equation has on its right the variations of the other momentum Π_o: on a "
            "level of it they vanish, and there dϖ at constant time is the form of Kirillov, "
            "Kostant and Souriau on the orbit of Π.",
            "La seconde équation a pour second membre les variations de l’autre moment Π_o : sur "
            "un niveau de celui-ci elles "
            "s’annulent, et dϖ à temps constant est alors la forme de Kirillov, Kostant et "
            "Souriau sur l’orbite de Π.",
        ),
    },
    "explicit": {
        "solved": (
            "The equations of motion in coordinates, with the numbers and the parameters of this "
            "problem.",
            "Les équations du mouvement en coordonnées, avec les nombres et les paramètres de ce "
            "problème.",
        ),
        "balance": (
            "The equations of motion in coordinates, with the numbers and the parameters of this "
            "problem; those that share accelerations stay together.",
            "Les équations du mouvement en coordonnées, avec les nombres et les paramètres de ce "
            "problème ; celles qui ont des accélérations en commun restent ensemble.",
        ),
        "idle": (
            "The forces of the potential do no work in any displacement by the group, and cannot "
            "act.",
            "Les forces du potentiel ne travaillent dans aucun déplacement par le groupe, et ne "
            "peuvent agir.",
        ),
        "left": (
            "Z is constant: every motion is g₀ exp(tZ), g₀ the element at the time 0.",
            "Z est constant : tout mouvement est g₀ exp(tZ), où g₀ est l’élément au temps 0.",
        ),
        "right": (
            "Z is constant: every motion is exp(tZ) g₀, g₀ the element at the time 0.",
            "Z est constant : tout mouvement est exp(tZ) g₀, où g₀ est l’élément au temps 0.",
        ),
        "steady": (
            "Their right sides are constant: the coordinates of Z are affine functions of the "
            "time.",
            "Leurs seconds membres sont constants : les coordonnées de Z sont des fonctions "
            "affines du temps.",
        ),
        "linear": (
            "With the rates of the entries of g in them, these equations are linear, with constant "
            "coefficients.",
            "Avec les dérivées des coefficients de g qu’elles contiennent, ces équations sont "
            "linéaires, à coefficients constants.",
        ),
    },
}
