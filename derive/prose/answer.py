"""What is said of equations with a problem's own numbers, and of the form of the orbits."""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "kks": {
        "level": (
            "The other momentum is Π carried by g to the other side. The second equation has on "
            "its right the variations of this momentum: on a level of it they vanish, and there "
            "dϖ at constant time is the form of Kirillov, Kostant and Souriau on the orbit of Π.",
            "L’autre moment est Π transporté par g de l’autre côté. La seconde équation a pour "
            "second membre les variations de ce moment : sur un niveau de celui-ci elles "
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
            "Avec les dérivées des entrées de g qu’elles contiennent, ces équations sont "
            "linéaires, à coefficients constants.",
        ),
    },
}
