"""The sentences of the walk on the torus, by the label of the step."""

from __future__ import annotations

STEPS = {
    "coordinates": {
        "torus": (
            "The basis of su(N), N = {order}, is that of the torus of sides 2π: 𝐧 is a point of a "
            "square lattice modulo N, and T(𝐧) the power n₁ of the clock, times the power n₂ of "
            "the cyclic shift, times the power n₁n₂ of the root of unity of angle 2π/N, so that "
            "T(−𝐧) is its adjoint; in space it is the wave of wave vector 𝐧. The clock is the "
            "diagonal matrix of the powers of the root of unity of angle 4π/N, the shift takes "
            "each vector of the standard basis to the one before it, and 𝐦 ∧ 𝐧 = m₁n₂ − m₂n₁. "
            "Sums go over the points but 0 with coordinates from −{half} to {most}; i is the "
            "imaginary unit, and ζ(−𝐧) the conjugate of ζ(𝐧).",
            "La base de su(N), N = {order}, est celle du tore de côtés 2π : 𝐧 est un point d’un "
            "réseau carré modulo N, et T(𝐧) la puissance n₁ de l’horloge, fois la puissance n₂ du "
            "décalage cyclique, fois la puissance n₁n₂ de la racine de l’unité d’angle 2π/N, de "
            "sorte que T(−𝐧) est son adjointe ; dans l’espace c’est l’onde de vecteur d’onde 𝐧. "
            "L’horloge est la matrice diagonale des puissances de la racine de l’unité d’angle "
            "4π/N, le décalage envoie chaque vecteur de la base canonique sur celui qui le "
            "précède, et 𝐦 ∧ 𝐧 = m₁n₂ − m₂n₁. Les sommes portent sur les points sauf 0 dont les "
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
            "The energy is the kinetic energy, told by the vorticity: its mean over the torus, "
            "half that of the square of the velocity.",
            "L’énergie est l’énergie cinétique, écrite avec le tourbillon : sa moyenne sur le "
            "tore, la moitié de celle du carré de la vitesse.",
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
            "The same on T(𝐧), by the brackets of the basis. For a smooth flow, at a fixed time "
            "and 𝐧, this goes to Euler’s equation of the vorticity on the torus as N grows.",
            "La même sur T(𝐧), d’après les crochets de la base. Pour un écoulement lisse, à un "
            "instant et un 𝐧 fixés, elle tend vers l’équation d’Euler du tourbillon sur le tore "
            "quand N croît.",
        ),
    },
    "modes": {
        "torus": (
            "The sums written out, mode by mode, for one of 𝐧 and −𝐧: the rate at −𝐧 is the same "
            "with every place on the other side of 0. Two points of the lattice whose sum is 𝐧 "
            "modulo N make one term, as their sines are opposite; those of the same length cancel.",
            "Les sommes développées, mode par mode, pour l’un de 𝐧 et −𝐧 : la dérivée en −𝐧 est la "
            "même, chaque point étant pris de l’autre côté de 0. Deux points du réseau de somme 𝐧 "
            "modulo N font un terme, leurs sinus étant opposés ; ceux de même longueur se "
            "détruisent.",
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
