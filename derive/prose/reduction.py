"""What is said of Routh's reduction: English, French."""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "reduction": {
        "taken": (
            "The reduction is by symmetries of L̃ itself, without time, that commute; their number "
            "is {count}.",
            "La réduction se fait par des symétries de L̃ lui-même, sans le temps, qui commutent ; "
            "leur nombre est {count}.",
        ),
        "momentum": (
            "A symmetry of L̃, {kind}, and its momentum, which the motion keeps. For every "
            "variation tangent to a level of the momentum dϖ with the field vanishes: there the "
            "field is in the kernel, and dϖ is a form of the quotient.",
            "Une symétrie de L̃, {kind}, et son moment, que le mouvement conserve. Pour toute "
            "variation tangente à un niveau du moment, dϖ avec le champ s’annule : sur ce niveau "
            "le champ est dans le noyau, et dϖ est une forme du quotient.",
        ),
        "commute": (
            "Each field is tangent to the levels of the other momentum.",
            "Chaque champ est tangent aux niveaux de l’autre moment.",
        ),
        "locked": (
            "The locked inertia: the metric of the kinetic energy on the fields of the symmetries, "
            "with the relations of the group.",
            "L’inertie bloquée : la métrique de l’énergie cinétique sur les champs des symétries, "
            "avec les relations du groupe.",
        ),
        "connection": (
            "The mechanical connection gives the velocities along the symmetries by the momenta; "
            "what is left of the velocity is orthogonal to the fields.",
            "La connexion mécanique donne les vitesses le long des symétries par les moments ; le "
            "reste de la vitesse est orthogonal aux champs.",
        ),
        "form": (
            "The part of ϖ that pairs momenta with the connection is taken away: the Cartan form "
            "of the Routhian is left.",
            "On enlève la partie de ϖ qui couple les moments à la connexion : il reste la forme de "
            "Cartan du routhien.",
        ),
        "curvature": (
            "On a level of the momenta, where their variations vanish, dϖ differs from its "
            "derivative by the curvature of the connection, times the momenta: a magnetic term.",
            "Sur un niveau des moments, où leurs variations s’annulent, dϖ diffère de sa dérivée "
            "par la courbure de la connexion, multipliée par les moments : un terme magnétique.",
        ),
        "effective": (
            "The effective potential is the energy of what moves along the symmetries alone; on a "
            "level of the momenta it is a function of the configuration. The Routhian is L̃ less "
            "the momenta times their velocities.",
            "Le potentiel effectif est l’énergie de ce qui ne se meut que le long des symétries ; "
            "sur un niveau des moments, c’est une fonction de la configuration. Le routhien est L̃ "
            "moins les moments multipliés par leurs vitesses.",
        ),
        "named": (
            "The entries of the locked inertia stand by their names.",
            "Les coefficients de l’inertie bloquée sont désignés par leur nom.",
        ),
        "isotropy": (
            "This holds where {conditions}: elsewhere the locked inertia has no inverse, and where "
            "the kinetic energy is positive a motion along the symmetries leaves the configuration "
            "as it is.",
            "Cela vaut là où {conditions} : ailleurs, l’inertie bloquée n’a pas d’inverse, et là "
            "où l’énergie cinétique est définie positive, un mouvement le long des symétries "
            "laisse la configuration comme elle est.",
        ),
        "divided": (
            "This holds where {conditions}, by which the equations divide.",
            "Cela vaut là où {conditions} : les équations divisent par ces expressions.",
        ),
        "free": (
            "No motion along the symmetries leaves a configuration as it is, so that the locked "
            "inertia has an inverse everywhere where the kinetic energy is positive.",
            "Aucun mouvement le long des symétries ne laisse une configuration comme elle est : "
            "l’inertie bloquée a un inverse partout où l’énergie cinétique est définie positive.",
        ),
        "curved": (
            "The curvature in coordinates, by the structure equation.",
            "La courbure en coordonnées, par l’équation de structure.",
        ),
        "flat": (
            "The connection has no curvature: the magnetic term vanishes.",
            "La connexion est sans courbure : le terme magnétique s’annule.",
        ),
        "quadrature": (
            "One degree of freedom is left, with the coordinate {entry}: the energy gives the "
            "square of its rate, and the motion follows by a quadrature.",
            "Il reste un degré de liberté, de coordonnée {entry} : l’énergie donne le carré de sa "
            "dérivée, et le mouvement s’obtient par une quadrature.",
        ),
        "elementary": (
            "For generic parameters, momenta and energy the right side is a polynomial of degree "
            "{degree}: its integral is elementary.",
            "Pour des paramètres, des moments et une énergie génériques, le membre de droite est "
            "un polynôme de degré {degree} : l’intégrale est élémentaire.",
        ),
        "elliptic": (
            "For generic parameters, momenta and energy the right side is a polynomial of degree "
            "{degree}: the integral is elliptic.",
            "Pour des paramètres, des moments et une énergie génériques, le membre de droite est "
            "un polynôme de degré {degree} : l’intégrale est elliptique.",
        ),
        "hyperelliptic": (
            "For generic parameters, momenta and energy the right side is a polynomial of degree "
            "{degree}: the integral is hyperelliptic.",
            "Pour des paramètres, des moments et une énergie génériques, le membre de droite est "
            "un polynôme de degré {degree} : l’intégrale est hyperelliptique.",
        ),
        "elementary_squared": (
            "For generic parameters, momenta and energy the right side is a polynomial of degree "
            "{degree}, a square times one of degree {left}: its integral is elementary.",
            "Pour des paramètres, des moments et une énergie génériques, le membre de droite est "
            "un polynôme de degré {degree}, un carré fois un polynôme de degré {left} : "
            "l’intégrale est élémentaire.",
        ),
        "elliptic_squared": (
            "For generic parameters, momenta and energy the right side is a polynomial of degree "
            "{degree}, a square times one of degree {left}: the integral is elliptic.",
            "Pour des paramètres, des moments et une énergie génériques, le membre de droite est "
            "un polynôme de degré {degree}, un carré fois un polynôme de degré {left} : "
            "l’intégrale est elliptique.",
        ),
        "hyperelliptic_squared": (
            "For generic parameters, momenta and energy the right side is a polynomial of degree "
            "{degree}, a square times one of degree {left}: the integral is hyperelliptic.",
            "Pour des paramètres, des moments et une énergie génériques, le membre de droite est "
            "un polynôme de degré {degree}, un carré fois un polynôme de degré {left} : "
            "l’intégrale est hyperelliptique.",
        ),
    },
}
"""Step, then name of the sentence."""
