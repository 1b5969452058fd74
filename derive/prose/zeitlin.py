"""The sentences of the walk on the torus, by the label of the step."""

from __future__ import annotations

STEPS = {
    "coordinates": {
        "torus": (
            "The basis of su(N), N = {order}, is that of the torus: 𝐧 is a point of a square "
            "lattice modulo N, and T(𝐧) the power n₁ of the clock, a diagonal matrix of roots of "
            "unity, times the power n₂ of the cyclic shift, times a root of unity, so that T(−𝐧) "
            "is its adjoint. Sums go over the points but 0 with coordinates from −{half} to "
            "{most}; i is the imaginary unit, and ζ(−𝐧) the conjugate of ζ(𝐧).",
            "La base de su(N), N = {order}, est celle du tore : 𝐧 est un point d’un réseau carré "
            "modulo N, et T(𝐧) la puissance n₁ de l’horloge, matrice diagonale de racines de "
            "l’unité, fois la puissance n₂ du décalage cyclique, fois une racine de l’unité, de "
            "sorte que T(−𝐧) est son adjointe. Les sommes portent sur les points sauf 0 dont les "
            "coordonnées vont de −{half} à {most} ; i est l’unité imaginaire, et ζ(−𝐧) le "
            "conjugué de ζ(𝐧).",
        ),
    },
    "algebra": {
        "torus": (
            "In the bracket the even part of the phase drops out, and the odd one is doubled: for "
            "a large N this is, but for a factor, the bracket of the flows that keep the area.",
            "Dans le crochet la partie paire de la phase disparaît et la partie impaire double : "
            "pour N grand c’est, à un facteur près, le crochet des flots qui conservent l’aire.",
        ),
    },
    "lagrangian": {
        "torus": (
            "The kinetic energy of the fluid: the inertia operator is the opposite of the "
            "Laplacian, ‖𝐧‖² on T(𝐧), and ζ the opposite of the stream function.",
            "L’énergie cinétique du fluide : l’opérateur d’inertie est l’opposé du laplacien, ‖𝐧‖² "
            "sur T(𝐧), et ζ l’opposé de la fonction de courant.",
        ),
    },
    "momenta": {
        "torus": (
            "The momentum is the vorticity: ω̂(𝐧) is the derivative of L̃ with respect to ζ(−𝐧), and "
            "W the matrix with these coefficients. As the trace of T(𝐦)T(𝐧) is N where 𝐦 + 𝐧 = 0, "
            "and else 0, Π is the transpose of W but for a factor.",
            "Le moment est le tourbillon : ω̂(𝐧) est la dérivée de L̃ par rapport à ζ(−𝐧), et W la "
            "matrice qui a ces coefficients. Comme la trace de T(𝐦)T(𝐧) vaut N si 𝐦 + 𝐧 = 0, et 0 "
            "sinon, Π est la transposée de W à un facteur près.",
        ),
    },
    "stream": {
        "torus": (
            "The velocity from the momentum: P is the stream function, whose Laplacian is W.",
            "La vitesse d’après le moment : P est la fonction de courant, dont le laplacien est W.",
        ),
    },
    "energy": {
        "torus": (
            "The energy is the kinetic energy, told by the vorticity.",
            "L’énergie est l’énergie cinétique, écrite avec le tourbillon.",
        ),
    },
    "coadjoint": {
        "torus": (
            "Put into the equations of any Lagrangian on the right: no force acts, and ξ′ is any "
            "element. Zeitlin’s equation.",
            "On substitue dans les équations de tout lagrangien à droite : aucune force n’agit, et "
            "ξ′ est quelconque. C’est l’équation de Zeitlin.",
        ),
    },
    "motion": {
        "torus": (
            "The same on T(𝐧), by the brackets of the basis. As N grows, and 𝐧 is kept, this goes "
            "to Euler’s equation of the vorticity on the torus.",
            "La même sur T(𝐧), d’après les crochets de la base. Quand N croît, à 𝐧 fixé, elle tend "
            "vers l’équation d’Euler du tourbillon sur le tore.",
        ),
    },
    "conserved": {
        "torus": (
            "The energy is kept, and so is the trace of every power of W, which the motion "
            "conjugates: for a fluid, the integral of every power of the vorticity. The second is "
            "the enstrophy.",
            "L’énergie est conservée, ainsi que la trace de chaque puissance de W, que le "
            "mouvement conjugue : pour un fluide, l’intégrale de chaque puissance du tourbillon. "
            "La deuxième est l’enstrophie.",
        ),
    },
}
