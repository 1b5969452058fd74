"""What is said of a fluid.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "lagrangian": {
        "fluid": (
            "The fluid is a continuous body that fills a compact and connected domain of the flat "
            "space, with a smooth boundary, or a flat torus. Its Lagrangian is an integral over "
            "its points with their measure of mass, half the square of a norm; ⟨a, b⟩ is here the "
            "integral, with the measure of mass, of the scalar product at each point.",
            "Le fluide est un corps continu qui remplit un domaine compact et connexe de l’espace "
            "plat, à bord lisse, ou un tore plat. Son lagrangien est une intégrale sur ses points "
            "par rapport à leur mesure de masse, la moitié du carré d’une norme ; ⟨a, b⟩ est ici "
            "l’intégrale, par rapport à la mesure de masse, du produit scalaire en chaque point.",
        ),
        "free": (
            "No force acts on the fluid.",
            "Le fluide n’est soumis à aucune force.",
        ),
        "forced": (
            "U is the potential of forces that per unit mass depend on the place alone: the "
            "weight, say.",
            "U est le potentiel de forces qui, par unité de masse, ne dépendent que du lieu : le "
            "poids, par exemple.",
        ),
        "homogeneous": (
            "Its density is the same everywhere: 1.",
            "Sa densité est partout la même : 1.",
        ),
        "advected": (
            "Its density is positive, and may vary from place to place.",
            "Sa densité est strictement positive, et peut varier d’un lieu à l’autre.",
        ),
    },
    "action": {
        "fluid": (
            "The group SDiff is that of the smooth diffeomorphisms g of the domain that keep the "
            "volume; g brings each point r of the body to the place g(r), and its tangent vector ν "
            "is the velocity of all points.",
            "Le groupe SDiff est celui des difféomorphismes lisses g du domaine qui conservent le "
            "volume ; g amène chaque point r du corps au lieu g(r), et son vecteur tangent ν est "
            "la vitesse de tous les points.",
        ),
    },
    "force": {
        "potential": (
            "The potential per unit mass is a function V of the place, taken where each point is; "
            "G is the composition with g. The force per unit mass is f, the opposite of its "
            "gradient.",
            "Le potentiel par unité de masse est une fonction V du lieu, prise là où se trouve "
            "chaque point ; G est la composition avec g. La force par unité de masse est f, "
            "l’opposé de son gradient.",
        ),
    },
    "dalembert": {
        "fluid": (
            "It is d’Alembert’s principle of virtual work, with ν̇ for the acceleration of the "
            "points: what keeps the volume does no work in any displacement that keeps it.",
            "C’est le principe des travaux virtuels de d’Alembert, où ν̇ est l’accélération des "
            "points : ce qui conserve le volume ne travaille dans aucun déplacement qui le "
            "conserve.",
        ),
    },
    "trivialisation": {
        "fluid": (
            "Velocities and displacements are referred to the place where the point is: G is the "
            "composition with g, so that the tangent bundle is trivialised on the right. As g "
            "keeps the volume, u, η and η′ are divergence-free, and tangent to the boundary, if "
            "there is one.",
            "Vitesses et déplacements sont rapportés au lieu où se trouve le point : G est la "
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
            "which is carried along by g: ρ is ρ₀ ∘ g⁻¹, with dm = ρ₀ dr over the body.",
            "Les champs sur les points ont le produit scalaire de la masse, ceux dans l’espace "
            "celui du volume : ce qui tient lieu de C = ĀA est le produit par la densité ρ, que g "
            "transporte : ρ est ρ₀ ∘ g⁻¹, où dm = ρ₀ dr sur le corps.",
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
            "the translations of an affine group, with ∇_η and ∇_η′ for ξ and ξ′. The right side "
            "is the bracket of the fields η′ and η; the bracket of 𝔤 is the opposite of it.",
            "Les variations commutent sur le groupe : δ(Gη′) = δ′(Gη). C’est l’équation de "
            "structure des translations d’un groupe affine, où ∇_η et ∇_η′ tiennent lieu de ξ et "
            "ξ′. Le second membre est le crochet des champs η′ et η ; le crochet de 𝔤 en est "
            "l’opposé.",
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
        "fluid_line": (
            "With δt = 0 the same two tests leave X = 0: the kernel is at most a line. It is a "
            "line, as Neumann’s problem for the pressure, below, has a solution, which gives u̇.",
            "Pour δt = 0, les deux mêmes conditions ne laissent que X = 0 : le noyau est au plus "
            "une droite. C’est une droite, car le problème de Neumann pour la pression, "
            "ci-dessous, a une solution, qui donne u̇.",
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
            "By Helmholtz’ decomposition of smooth fields on the domain, what is orthogonal to "
            "every η′ with Dη′ = 0 is the transpose of D of some function: the multiplier of the "
            "volume, the pressure p, up to a constant, as the domain is connected. This transpose, "
            "on fields tangent to the boundary, is −grad by Stokes’ theorem.",
            "Par la décomposition de Helmholtz des champs lisses sur le domaine, ce qui est "
            "orthogonal à tout η′ tel que Dη′ = 0 est l’image d’une fonction par la transposée de "
            "D : le multiplicateur du volume, la pression p, à une constante près, car le domaine "
            "est connexe. Cette transposée, sur les champs tangents au bord, est −grad par le "
            "théorème de Stokes.",
        ),
        "curved": (
            "On a curved manifold the same holds, with the connection of Levi-Civita, which has no "
            "torsion.",
            "Sur une variété courbe, l’énoncé est le même, avec la connexion de Levi-Civita, "
            "qui est sans torsion.",
        ),
    },
    "absorbed": {
        "pressure": (
            "As f is the opposite of a gradient, it is orthogonal to every η′: where the density "
            "is the same everywhere, the motion is that without forces, and V joins the pressure.",
            "Comme f est l’opposé d’un gradient, elle est orthogonale à tout η′ : si la densité "
            "est partout la même, le mouvement est celui sans forces, et V s’ajoute à la pression.",
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
            "D is put before the equation of motion, and D u̇ = 0: with the condition at the "
            "boundary, below, the velocity alone determines the pressure, up to a constant.",
            "On applique D à l’équation du mouvement, où D u̇ = 0 : avec la condition au bord, "
            "ci-dessous, la vitesse seule détermine la pression, à une constante près.",
        ),
        "advected": (
            "The equation of motion is divided by the density, and D is put before it; D u̇ = 0.",
            "On divise l’équation du mouvement par la densité, et on lui applique D ; D u̇ = 0.",
        ),
    },
    "boundary": {
        "tangent": (
            "At the boundary the equation of motion is paired with the normal n, to which u̇ is "
            "orthogonal as u is; ⟨a, n⟩ is the scalar product at each place there, without an "
            "integral. Without a boundary this says nothing.",
            "Au bord, on prend le produit de l’équation du mouvement par la normale n, à laquelle "
            "u̇ est orthogonal comme u ; ⟨a, n⟩ est là le produit scalaire en chaque lieu, sans "
            "intégrale. Sans bord, cela ne dit rien.",
        ),
    },
    "advection": {
        "carried": (
            "The density at the place of a point is that of the point, ρ(g(r)) = ρ₀(r), at all "
            "times. By the chain rule, Ġ = G ∇_u, this gives ρ̇, without any hypothesis on u; the "
            "variation of ḠG along η = u gives the same.",
            "La densité au lieu d’un point est celle du point, ρ(g(r)) = ρ₀(r), à tout instant. "
            "Par dérivation des fonctions composées, Ġ = G ∇_u, il en résulte ρ̇, sans aucune "
            "hypothèse sur u ; la variation de ḠG le long de η = u donne la même dérivée.",
        ),
        "place": (
            "At each place ∇_u ρ is a derivative of products, to which the product rule applies; "
            "⟨u, grad ρ⟩ is here the scalar product at each place, without an integral, and the "
            "product with it. So the density is advected.",
            "En chaque lieu, ∇_u ρ est la dérivée d’un produit, que donne la règle de Leibniz ; "
            "⟨u, grad ρ⟩ est ici le produit scalaire en chaque lieu, sans intégrale, et le produit "
            "par celui-ci. La densité est donc transportée.",
        ),
    },
    "energy_kept": {
        "kernel": (
            "The energy and its rate, which is the expression of the kernel for η′ = u, as u too "
            "is divergence-free and tangent to the boundary: so the energy is constant, by Euler’s "
            "equation alone, without Helmholtz’ decomposition, which only the pressure needs.",
            "L’énergie et sa dérivée, qui est l’expression du noyau pour η′ = u, car u aussi est "
            "solénoïdal et tangent au bord : l’énergie est donc constante, par la seule équation "
            "d’Euler, sans la décomposition de Helmholtz, dont seule la pression a besoin.",
        ),
        "homogeneous": (
            "∇_u is skew for such a field: ∇_u u contributes nothing.",
            "∇_u est antisymétrique pour un tel champ : ∇_u u ne contribue pas.",
        ),
        "advected": (
            "The change of the density contributes ½ ⟨ρ̇u, u⟩, which is ⟨u, ∇_u u⟩_ρ as ∇_u is skew "
            "for such a field.",
            "La variation de la densité contribue par ½ ⟨ρ̇u, u⟩, qui est ⟨u, ∇_u u⟩_ρ car ∇_u est "
            "antisymétrique pour un tel champ.",
        ),
        "forced": (
            "The change of Ũ is dŨ(ν), the opposite of the power of the force.",
            "La variation de Ũ est dŨ(ν), l’opposé de la puissance de la force.",
        ),
        "absorbed": (
            "The change of Ũ is dŨ(ν) = −⟨f, u⟩, which vanishes, as f is a gradient: Ũ and ½ ‖u‖² "
            "are each constant, where the density is the same everywhere.",
            "La variation de Ũ est dŨ(ν) = −⟨f, u⟩, qui s’annule, car f est un gradient : Ũ et "
            "½ ‖u‖² sont constants l’un et l’autre, si la densité est partout la même.",
        ),
        "pressure": (
            "The pressure does no work: by Stokes’ theorem ⟨grad p, u⟩ is −⟨p, Du⟩, and Du = 0.",
            "La pression ne travaille pas : par le théorème de Stokes, ⟨grad p, u⟩ est −⟨p, Du⟩, "
            "et Du = 0.",
        ),
    },
    "relabelling": {
        "field": (
            "Displacements h of the body made before g, g ∘ h, where h is the same at all times, "
            "leave u alone: δg = Gϑ and δu = 0, with ϑ the image in space of the displacement of "
            "the body. Along the motion ϑ changes by the structure equation, where the motion is "
            "the other variation.",
            "Les déplacements h du corps effectués avant g, g ∘ h, où h est le même à tout "
            "instant, laissent u invariant : δg = Gϑ et δu = 0, où ϑ est l’image dans l’espace du "
            "déplacement du corps. Le long du mouvement, ϑ varie par l’équation de structure, où "
            "le mouvement est l’autre variation.",
        ),
    },
    "circulation": {
        "potential": (
            "The force does not change it: ϑ is orthogonal to gradients, and with a density ρϑ is.",
            "La force ne le change pas : ϑ est orthogonal aux gradients et, avec une densité, ρϑ "
            "l’est.",
        ),
        "homogeneous": (
            "The momentum on ϑ, p̃(Gϑ), is constant along the motion, by the symmetry on the right.",
            "L’impulsion sur ϑ, p̃(Gϑ), est constante le long du mouvement, par la symétrie à "
            "droite.",
        ),
        "advected": (
            "The momentum on ϑ, p̃(Gϑ), is constant along the motion where ϑ leaves the density "
            "alone, which the fluid carries along as well.",
            "L’impulsion sur ϑ, p̃(Gϑ), est constante le long du mouvement si ϑ laisse invariante "
            "la densité, que le fluide transporte aussi.",
        ),
    },
    "curve": {
        "carried": (
            "A closed curve γ₀ in the body is carried along by the fluid: γ = g ∘ γ₀. Γ₀ and Γ are "
            "the compositions with γ₀ and γ; their rates are those of g and G.",
            "Une courbe fermée γ₀ du corps est transportée par le fluide : γ = g ∘ γ₀. Γ₀ et Γ "
            "sont les compositions avec γ₀ et γ ; leurs dérivées sont celles de g et de G.",
        ),
    },
    "closed_curve": {
        "skew": (
            "Between fields along the curve, ⟨a, b⟩ is the integral over its parameter s. The "
            "integral of a derivative over a closed curve vanishes, so that ∂_s is skew. By the "
            "chain rule ∂_sΓ gives the derivative of fields in space along γ_s, at each place of "
            "the curve. So ⟨Γ grad p, γ_s⟩ is the integral of ∂_sΓp, as for any function, and "
            "⟨Γu, ∂_sΓu⟩ that of half the derivative of ‖Γu‖².",
            "Entre champs le long de la courbe, ⟨a, b⟩ est l’intégrale sur son paramètre s. "
            "L’intégrale d’une dérivée sur une courbe fermée s’annule, si bien que ∂_s est "
            "antisymétrique. Par dérivation des fonctions composées, ∂_sΓ donne la dérivée des "
            "champs dans l’espace le long de γ_s, en chaque lieu de la courbe. Ainsi "
            "⟨Γ grad p, γ_s⟩ est l’intégrale de ∂_sΓp, comme pour toute fonction, et ⟨Γu, ∂_sΓu⟩ "
            "celle de la moitié de la dérivée de ‖Γu‖².",
        ),
    },
    "level_curve": {
        "kept": (
            "Where the curve lies in a level surface of the density, ρ has one value κ on it; as "
            "the fluid carries both along, it stays there.",
            "Si la courbe est dans une surface de niveau de la densité, ρ a sur elle une seule "
            "valeur κ ; comme le fluide transporte l’une et l’autre, elle reste dans cette "
            "surface.",
        ),
    },
    "kelvin": {
        "homogeneous": (
            "The circulation of u along γ changes by the acceleration of the points and by the "
            "change of γ_s, which contributes ⟨Γu, ∂_sΓu⟩ = 0. By the equation of motion the "
            "acceleration is a gradient: the circulation is constant, Kelvin’s theorem. It is the "
            "momentum on Γ̄γ_s, a distribution on the curve, divergence-free as γ is closed.",
            "La circulation de u le long de γ varie par l’accélération des points et par la "
            "variation de γ_s, dont la contribution est ⟨Γu, ∂_sΓu⟩ = 0. Selon l’équation du "
            "mouvement, l’accélération est un gradient : la circulation est constante, c’est le "
            "théorème de Kelvin. Elle est l’impulsion sur Γ̄γ_s, distribution portée par la "
            "courbe, solénoïdale car γ est fermée.",
        ),
        "advected": (
            "The circulation of u along γ changes by the acceleration of the points and by the "
            "change of γ_s, which contributes ⟨Γu, ∂_sΓu⟩ = 0. By the equation of motion the "
            "acceleration is a gradient on the curve, as κ > 0 is one number: the circulation is "
            "constant, Kelvin’s theorem. Times κ it is the momentum on Γ̄γ_s, a distribution on "
            "the curve, divergence-free as γ is closed.",
            "La circulation de u le long de γ varie par l’accélération des points et par la "
            "variation de γ_s, dont la contribution est ⟨Γu, ∂_sΓu⟩ = 0. Selon l’équation du "
            "mouvement, l’accélération est un gradient sur la courbe, car κ > 0 est un seul "
            "nombre : la circulation est constante, c’est le théorème de Kelvin. Multipliée par κ, "
            "elle est l’impulsion sur Γ̄γ_s, distribution portée par la courbe, solénoïdale car γ "
            "est fermée.",
        ),
    },
}
