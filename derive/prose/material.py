"""What is said of a body, its potentials, and what is given from outside.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "body": {
        "points": (
            "The points of the body and their masses.",
            "Les points du corps et leurs masses.",
        ),
        "moments": (
            "The moments of the body.",
            "Les moments du corps.",
        ),
        "given": (
            "The moments of the body are given.",
            "Les moments du corps sont donnés.",
        ),
        "symbolic": (
            "The moments of the body are parameters: those of some positive masses.",
            "Les moments du corps sont des paramètres : ceux d’une répartition de masses "
            "strictement positives.",
        ),
        "blocks": (
            "Each is in its block of coordinates; an affine block ends in 1.",
            "Chacun est dans son bloc de coordonnées ; un bloc affine se termine par 1.",
        ),
        "homogeneous": (
            "Their coordinates end in 1: affine maps act on (r, 1) by matrices.",
            "Leurs coordonnées se terminent par 1 : les applications affines agissent sur (r, 1) "
            "par des matrices.",
        ),
        "place": (
            "Point {point} has no mass: forces are attached there.",
            "Le point {point} est sans masse : des forces s’appliquent en ce point.",
        ),
        "places": (
            "Points {low} to {high} have no mass: forces are attached there.",
            "Les points {low} à {high} sont sans masse : des forces s’appliquent en ces points.",
        ),
        "symbolic_signed": (
            "The moments of the body are parameters: those of some masses, which may be negative.",
            "Les moments du corps sont des paramètres : ceux de masses qui peuvent être négatives.",
        ),
    },
    "integrals": {
        "moments": (
            "The moments of a continuous body are integrals, and all else stays: its motions are "
            "those of points with the same moments.",
            "Les moments d’un corps continu sont des intégrales, et tout le reste demeure : ses "
            "mouvements sont ceux de points de mêmes moments.",
        ),
        "solids": (
            "Here: {solids}.",
            "Ici : {solids}.",
        ),
        "solid": (
            "{kind} of density {density} ({sizes})",
            "{kind} de masse volumique {density} ({sizes})",
        ),
        "layered": (
            "{kind} of density {density} at the level s_r, from 0 in its middle to 1 at its "
            "boundary ({sizes})",
            "{kind} de masse volumique {density} au niveau s_r, de 0 au centre à 1 au bord "
            "({sizes})",
        ),
        "turned": (
            "{solid}, turned by a rotation",
            "{solid}, après une rotation",
        ),
        "shifted": (
            "{solid}, shifted by {shift}",
            "{solid}, après une translation de {shift}",
        ),
        "turned_and_shifted": (
            "{solid}, turned by a rotation and then shifted by {shift}",
            "{solid}, après une rotation puis une translation de {shift}",
        ),
        "ball": (
            "ball",
            "boule",
        ),
        "box": (
            "box",
            "parallélépipède",
        ),
        "ellipsoid": (
            "ellipsoid",
            "ellipsoïde",
        ),
        "cylinder": (
            "cylinder",
            "cylindre",
        ),
        "cone": (
            "cone",
            "cône",
        ),
        "hollow_ball": (
            "hollow ball",
            "boule creuse",
        ),
        "tetrahedron": (
            "tetrahedron",
            "tétraèdre",
        ),
        "mesh": (
            "mesh",
            "maillage",
        ),
        "radius": (
            "radius {size}",
            "rayon {size}",
        ),
        "outer": (
            "outer {size}",
            "rayon extérieur {size}",
        ),
        "inner": (
            "inner {size}",
            "rayon intérieur {size}",
        ),
        "sides": (
            "sides {size}",
            "côtés {size}",
        ),
        "semi_axes": (
            "semi axes {size}",
            "demi-axes {size}",
        ),
        "quadric": (
            "matrix of rows {size}",
            "matrice de lignes {size}",
        ),
        "height": (
            "height {size}",
            "hauteur {size}",
        ),
        "vertices": (
            "vertices {size}",
            "sommets {size}",
        ),
        "count_of_vertices": (
            "{count} vertices",
            "{count} sommets",
        ),
        "count_of_triangles": (
            "{count} triangles",
            "{count} triangles",
        ),
    },
    "potential": {
        "none": (
            "No potential: the motion is free.",
            "Pas de potentiel : le mouvement est libre.",
        ),
        "pulled_back": (
            "The potential of the problem, on the points and pulled back to the group.",
            "Le potentiel du problème, sur les points, puis son image réciproque sur le groupe.",
        ),
        "whole_body": (
            "Here Σ m_i stands for the sum over the whole body.",
            "Ici Σ m_i désigne la somme sur tout le corps.",
        ),
        "springs": (
            "K is the sum over the springs of natural length 0; s_e joins the ends of one of them "
            "in the body.",
            "K est la somme sur les ressorts de longueur à vide nulle ; s_e joint les extrémités "
            "de l’un d’eux dans le corps.",
        ),
        "self_gravity": (
            "The homogeneous ellipsoid stays one: its energy depends on g by the invariants of "
            "AK_GĀ alone, and δU_G = ½ Tr B_G δ(ĀA).",
            "L’ellipsoïde homogène en reste un : son énergie ne dépend de g que par les "
            "invariants de AK_GĀ, et δU_G = ½ Tr B_G δ(ĀA).",
        ),
        "volume": (
            "U_V depends on the volume alone: δU_V = −p_V δ(log V_A), and by Jacobi’s formula "
            "δ(log V_A) = Tr A⁻¹δA.",
            "U_V ne dépend que du volume : δU_V = −p_V δ(log V_A), et par la formule de Jacobi "
            "δ(log V_A) = Tr A⁻¹δA.",
        ),
        "far_orders": (
            "Of the gravity of the far centre, the terms of the fourth and higher orders in one "
            "over the distance are dropped.",
            "De l’attraction du centre lointain, les termes d’ordre quatre et plus en l’inverse "
            "de la distance sont négligés.",
        ),
    },
    "pushes": {
        "body": (
            "The part U_Q of the potential is given point by point: P_i is its force on point i "
            "in the body frame, Ā on minus the derivative of U_Q with respect to r_i(t).",
            "La partie U_Q du potentiel est donnée point par point : P_i est sa force sur le "
            "point i dans le repère du corps, Ā appliqué à l’opposé de la dérivée de U_Q par "
            "rapport à r_i(t).",
        ),
        "space": (
            "The part U_Q of the potential is given point by point: Q_i is its force on point i, "
            "minus the derivative of U_Q by r_i(t).",
            "La partie U_Q du potentiel est donnée point par point : Q_i est sa force sur le "
            "point i, l’opposé de la dérivée de U_Q par rapport à r_i(t).",
        ),
        "element": (
            "Element e, a function of ‖d_e‖, pushes along d_e.",
            "L’élément e, fonction de ‖d_e‖, exerce une force le long de d_e.",
        ),
        "element_and_length": (
            "Element e, a function of ‖d_e‖, pushes along d_e, and ‖d_e‖ = ‖Ād_e‖.",
            "L’élément e, fonction de ‖d_e‖, exerce une force le long de d_e, et ‖d_e‖ = ‖Ād_e‖.",
        ),
    },
    "input": {
        "outside": (
            "Outside dϖ: {forces}.",
            "En dehors de dϖ : {forces}.",
        ),
        "forces": (
            "the forces that are given as functions of time and state",
            "les forces données en fonction du temps et de l’état",
        ),
        "damping": (
            "the damping",
            "l’amortissement",
        ),
        "moments": (
            "These are their moments and resultants in the body; their work joins that of the "
            "potential in the equations of motion.",
            "En voici les moments et les résultantes dans le corps ; leur travail s’ajoute à "
            "celui du potentiel dans les équations du mouvement.",
        ),
        "given": (
            "Inputs: {forces}.",
            "Entrées : {forces}.",
        ),
        "numbers": (
            "{meaning}, {numbers}",
            "{meaning}, {numbers}",
        ),
        "space_force": (
            "{name}, a force at {point}, in the space frame",
            "{name}, une force en {point}, dans le repère de l’espace",
        ),
        "body_force": (
            "{name}, a force at {point}, in the body frame",
            "{name}, une force en {point}, dans le repère du corps",
        ),
    },
}
