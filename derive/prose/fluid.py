"""What is said of a fluid.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "lagrangian": {
        "fluid": (
            "The fluid is a continuous body: its Lagrangian is an integral over its points with "
            "their measure of mass, half the square of a norm; ⟨a, b⟩ is here the integral of the "
            "scalar product at each place. The space is flat, and the fluid is without forces.",
            "Le fluide est un corps continu : son lagrangien est une intégrale sur ses points pour "
            "leur mesure de masse, la moitié du carré d’une norme ; ⟨a, b⟩ est ici l’intégrale du "
            "produit scalaire en chaque lieu. L’espace est plat, et le fluide sans forces.",
        ),
        "homogeneous": (
            "Its density is the same everywhere: 1.",
            "Sa densité est partout la même : 1.",
        ),
        "advected": (
            "Its density is positive, and another at each place.",
            "Sa densité est strictement positive, et dépend du lieu.",
        ),
    },
    "action": {
        "fluid": (
            "The group is that of the displacements g of the fluid that keep the volume; g moves "
            "the places r of the body by g ∘ r, and its tangent vector ν is the velocity of all "
            "points.",
            "Le groupe est celui des déplacements g du fluide qui conservent le volume ; g déplace "
            "les positions r du corps par g ∘ r, et son vecteur tangent ν est la vitesse de tous "
            "les points.",
        ),
    },
    "trivialisation": {
        "fluid": (
            "Velocities and displacements are told at the place where a point is: G is the "
            "composition with g, so that the tangent bundle is trivialised on the right. As g "
            "keeps the volume, u, η and η′ are divergence-free, and tangent to the boundary, if "
            "there is one.",
            "Vitesses et déplacements sont dits au lieu où se trouve le point : G est la "
            "composition avec g, si bien que le fibré tangent est trivialisé à droite. Comme g "
            "conserve le volume, u, η et η′ sont solénoïdaux, et tangents au bord éventuel.",
        ),
    },
    "chain": {
        "rule": (
            "The chain rule: ∇_c is the derivative of fields along c, linear in c. So (G, "
            "∇_η) stands where (A, ξ) stands for an affine group, and (u, η) where (w, η) stands.",
            "La dérivation des fonctions composées : ∇_c est la dérivée des champs le long de c, "
            "linéaire en c. Ainsi (G, ∇_η) est à la place de (A, ξ) d’un groupe affine, et (u, η) "
            "à celle de (w, η).",
        ),
    },
    "isometry": {
        "homogeneous": (
            "The volume is kept, and with it the mass of this homogeneous fluid: composition with "
            "g leaves scalar products alone.",
            "Le volume est conservé, et avec lui la masse de ce fluide homogène : la composition "
            "avec g laisse invariants les produits scalaires.",
        ),
        "advected": (
            "The fields over the points have the scalar product of the mass, those in space that "
            "of the volume: what takes the place of C = ĀA is the product with the density ρ, "
            "which is carried along by g.",
            "Les champs sur les points ont le produit scalaire de la masse, ceux dans l’espace "
            "celui du volume : ce qui tient lieu de C = ĀA est le produit par la densité ρ, que g "
            "transporte.",
        ),
    },
    "skew": {
        "stokes": (
            "By Stokes’ theorem, for a divergence-free field η that is tangent to the boundary: "
            "the integral of the derivative of ⟨a, b⟩ along η vanishes.",
            "Par le théorème de Stokes, pour un champ η solénoïdal et tangent au bord : "
            "l’intégrale de la dérivée de ⟨a, b⟩ le long de η s’annule.",
        ),
    },
    "transport": {
        "density": (
            "The variation of ρ = ḠG, an operator: the product with the derivative of the density "
            "along −η.",
            "La variation de ρ = ḠG, un opérateur : le produit par la dérivée de la densité le "
            "long de −η.",
        ),
    },
    "pullback": {
        "fluid": (
            "The Lagrangian by the velocity at each place.",
            "Le lagrangien par la vitesse en chaque lieu.",
        ),
    },
    "structure": {
        "fields": (
            "The variations commute on the group: δ(Gη′) = δ′(Gη). It is the structure equation of "
            "the translations of an affine group, with ∇_η and ∇_η′ for ξ and ξ′.",
            "Les variations commutent sur le groupe : δ(Gη′) = δ′(Gη). C’est l’équation de "
            "structure des translations d’un groupe affine, où ∇_η et ∇_η′ tiennent lieu de ξ et "
            "ξ′.",
        ),
    },
    "exterior_trivialised": {
        "fluid": (
            "The exterior derivative by the fields u and η.",
            "La dérivée extérieure par les champs u et η.",
        ),
    },
    "second_order": {
        "fluid": (
            "The scalar product is not degenerate: this expression vanishes for all such "
            "variations only if X has the velocity of the motion, which is inserted; u̇ is δu(X).",
            "Le produit scalaire n’est pas dégénéré : cette expression ne s’annule pour toutes ces "
            "variations que si X a la vitesse du mouvement, que l’on substitue ; u̇ est δu(X).",
        ),
    },
    "kernel": {
        "fluid": (
            "X is in the kernel if and only if this expression vanishes for every η′ that is "
            "divergence-free and tangent to the boundary: Euler’s equation.",
            "X est dans le noyau si et seulement si cette expression s’annule pour tout η′ "
            "solénoïdal et tangent au bord : l’équation d’Euler.",
        ),
    },
    "divergence": {
        "fields": (
            "The divergence as an operator D: it vanishes on the fields of the Lie algebra, to "
            "which u̇ belongs too.",
            "La divergence comme opérateur D : elle s’annule sur les champs de l’algèbre de Lie, "
            "à laquelle u̇ appartient aussi.",
        ),
    },
    "pressure": {
        "helmholtz": (
            "By Helmholtz’ decomposition of smooth fields, on a compact domain with a smooth "
            "boundary or a torus, what is orthogonal to every η′ with Dη′ = 0 is the transpose of "
            "D of some function: the multiplier of the volume, the pressure p, up to a constant. "
            "This transpose, on fields tangent to the boundary, is −grad by Stokes’ theorem.",
            "Par la décomposition de Helmholtz des champs lisses, sur un domaine compact à bord "
            "lisse ou un tore, ce qui est orthogonal à tout η′ tel que Dη′ = 0 est l’image d’une "
            "fonction par la transposée de D : le multiplicateur du volume, la pression p, à une "
            "constante près. Cette transposée, sur les champs tangents au bord, est −grad par le "
            "théorème de Stokes.",
        ),
        "curved": (
            "On a curved manifold the words are the same, with the connection of Levi-Civita, "
            "which has no torsion.",
            "Sur une variété courbe, les mots sont les mêmes, avec la connexion de Levi-Civita, "
            "qui est sans torsion.",
        ),
    },
    "divergence_along": {
        "twice": (
            "At each place ∇_u u is the matrix ∇u times u; its derivative is (∇u)² and a term "
            "whose trace is the derivative of div u, 0. Here the space is flat: on a curved "
            "manifold Ric(u, u) is added, the curvature of Ricci.",
            "En chaque lieu, ∇_u u est la matrice ∇u appliquée à u ; sa dérivée est (∇u)² plus un "
            "terme dont la trace est la dérivée de div u, 0. L’espace est ici plat : sur une "
            "variété courbe s’ajoute Ric(u, u), la courbure de Ricci.",
        ),
    },
    "pressure_equation": {
        "homogeneous": (
            "D is put before the equation of motion, and D u̇ = 0: the velocity alone tells the "
            "pressure.",
            "On applique D à l’équation du mouvement, où D u̇ = 0 : la vitesse seule détermine la "
            "pression.",
        ),
        "advected": (
            "The equation of motion is divided by the density, and D is put before it; D u̇ = 0.",
            "On divise l’équation du mouvement par la densité, et on lui applique D ; D u̇ = 0.",
        ),
    },
    "boundary": {
        "tangent": (
            "At the boundary the equation of motion is paired with the normal n, to which u̇ is "
            "orthogonal as u is. Without a boundary this says nothing.",
            "Au bord, on prend le produit de l’équation du mouvement par la normale n, à laquelle "
            "u̇ est orthogonal comme u. Sans bord, cela ne dit rien.",
        ),
    },
    "relabelling": {
        "field": (
            "Displacements h of the fluid before g, g ∘ h, leave u alone: δg = Gϑ and δu = 0. "
            "Along the motion ϑ changes by the structure equation, where the motion is the other "
            "variation.",
            "Les déplacements h du fluide avant g, g ∘ h, laissent u invariant : δg = Gϑ et "
            "δu = 0. Le long du mouvement, ϑ varie par l’équation de structure, où le mouvement "
            "est l’autre variation.",
        ),
    },
    "circulation": {
        "homogeneous": (
            "The momentum on ϑ is constant along the motion, by the symmetry on the right. For a "
            "field ϑ in a thin tube around a closed curve that moves with the fluid it is the "
            "circulation of u along this curve: Kelvin’s theorem.",
            "Le moment sur ϑ est constant le long du mouvement, par la symétrie à droite. Pour un "
            "champ ϑ dans un tube mince autour d’une courbe fermée qui suit le fluide, c’est la "
            "circulation de u le long de cette courbe : le théorème de Kelvin.",
        ),
        "advected": (
            "The momentum on ϑ is constant along the motion where ϑ leaves the density alone, "
            "which the fluid carries along as well. For a field ϑ in a thin tube around a closed "
            "curve that moves with the fluid in a level surface of ρ it is the circulation of ρu: "
            "Kelvin’s theorem.",
            "Le moment sur ϑ est constant le long du mouvement là où ϑ laisse invariante la "
            "densité, que le fluide transporte aussi. Pour un champ ϑ dans un tube mince autour "
            "d’une courbe fermée qui suit le fluide dans une surface de niveau de ρ, c’est la "
            "circulation de ρu : le théorème de Kelvin.",
        ),
    },
}
