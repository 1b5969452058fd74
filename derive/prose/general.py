"""What is said of any group, step by step.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "lagrangian": {
        "expression": (
            "The Lagrangian of this problem, an expression in the time, the entries of g and the "
            "coordinates of Z.",
            "Le lagrangien de ce problème, une expression du temps, des coefficients de g et des "
            "coordonnées de Z.",
        ),
        "carried": (
            "The Lagrangian of this problem, an expression in the time, the entries of Γ and the "
            "coordinates of Z.",
            "Le lagrangien de ce problème, une expression du temps, des coefficients de Γ et des "
            "coordonnées de Z.",
        ),
        "alone": (
            "The Lagrangian of this problem, an expression in the time and the coordinates of Z.",
            "Le lagrangien de ce problème, une expression du temps et des coordonnées de Z.",
        ),
        "points": (
            "A body is made of points r_i of mass m_i, which have the velocities v_i in space. "
            "Its Lagrangian is the kinetic energy less the potential.",
            "Un corps est fait de points r_i de masse m_i, qui ont dans l’espace les vitesses "
            "v_i. Son lagrangien est l’énergie cinétique moins le potentiel.",
        ),
    },
    "action": {
        "linear": (
            "An element g = A of the group G moves the body: every point is the image of its "
            "place in the body.",
            "Un élément du groupe G, g = A, déplace le corps : chaque point est l’image de sa "
            "place dans le corps.",
        ),
        "affine": (
            "An element g = (A, T) of the group G moves the body: every point is the image of its "
            "place in the body.",
            "Un élément du groupe G, g = (A, T), déplace le corps : chaque point est l’image de "
            "sa place dans le corps.",
        ),
    },
    "velocity": {
        "linear": (
            "A velocity ν = α, tangent to G at g, gives one to each point; a variation, the "
            "displacements that respect the constraint.",
            "Une vitesse ν = α, tangente à G en g, donne une vitesse à chaque point ; une "
            "variation donne les déplacements qui respectent la contrainte.",
        ),
        "affine": (
            "A velocity ν = (α, τ), tangent to G at g, gives one to each point; a variation, the "
            "displacements that respect the constraint.",
            "Une vitesse ν = (α, τ), tangente à G en g, donne une vitesse à chaque point ; une "
            "variation donne les déplacements qui respectent la contrainte.",
        ),
        "independent": (
            "Here the velocity is a coordinate of its own: that it is the derivative of the "
            "motion will come out of the kernel.",
            "La vitesse est ici une coordonnée indépendante : qu’elle soit la dérivée du "
            "mouvement résultera du noyau.",
        ),
    },
    "continuum": {
        "integrals": (
            "A continuous body has a measure of mass dm, density times volume: its places r and "
            "velocities v are functions on it, the group moves the body by g ∘ r, and the sums "
            "over the points are integrals.",
            "Un corps continu a une mesure de masse dm, densité fois volume : ses positions r et "
            "ses vitesses v sont des fonctions sur le corps, le groupe le déplace par g ∘ r, et "
            "les sommes sur les points sont des intégrales.",
        ),
    },
    "pullback": {
        "pulled": (
            "The Lagrangian is pulled back to the group by r̂ : (t, g, ν) ↦ (t, g(r), ν(r)): the "
            "velocities of the motion are put in and the sum over the points is carried out.",
            "On prend l’image réciproque du lagrangien sur le groupe par r̂ : (t, g, ν) ↦ (t, "
            "g(r), ν(r)) : on substitue les vitesses du mouvement, puis on effectue la somme sur "
            "les points.",
        ),
        "metric": (
            "From here on the masses are positive and no tangent vector of the group but 0 leaves "
            "all the points at rest: the kinetic energy is then half the square of a norm, a "
            "metric on the group.",
            "Désormais les masses sont strictement positives et aucun vecteur tangent au groupe, "
            "sauf 0, ne laisse tous les points au repos : l’énergie cinétique est alors la moitié "
            "du carré d’une norme, celle d’une métrique sur le groupe.",
        ),
        "metric_signed": (
            "Masses may be negative here: the kinetic energy is half the value of a quadratic "
            "form, which is called the metric; what follows holds wherever it is invertible on "
            "the tangent vectors of the group.",
            "Les masses peuvent ici être négatives : l’énergie cinétique est la moitié de la "
            "valeur d’une forme quadratique, qu’on appelle la métrique ; la suite est vraie "
            "partout où elle est inversible sur les vecteurs tangents au groupe.",
        ),
    },
    "moments": {
        "only": (
            "The body enters the kinetic energy through its moments only: mass, first moment, "
            "matrix of moments.",
            "Le corps n’intervient dans l’énergie cinétique que par ses moments : masse, premier "
            "moment, matrice des moments.",
        ),
    },
    "volumes": {
        "trace": (
            "The variation of a volume of places is Tr ξ times it, by the displacements of the "
            "points.",
            "La variation d’un volume de positions est Tr ξ fois ce volume, par les déplacements "
            "des points.",
        ),
    },
    "unique": {
        "elsewhere": (
            "Elsewhere the path is told by its start, if no tangent vector but 0 leaves all the "
            "points at rest.",
            "Ailleurs, le chemin est déterminé par son début, si aucun vecteur tangent autre que "
            "0 ne laisse au repos tous les points.",
        ),
        "span": (
            "The places of the points tell g where they span the space: g_t is then the only "
            "element that moves the body so, and is as smooth in t as they are.",
            "Les positions des points déterminent g, si les points engendrent l’espace : g_t est "
            "alors le seul élément qui déplace ainsi le corps, et il est aussi régulier en t "
            "qu’elles.",
        ),
        "affine_span": (
            "The places of the points tell g where they are not in one hyperplane: g_t is then "
            "the only element that moves the body so, and is as smooth in t as they are.",
            "Les positions des points déterminent g, si les points ne sont pas dans un même "
            "hyperplan : g_t est alors le seul élément qui déplace ainsi le corps, et il est "
            "aussi régulier en t qu’elles.",
        ),
        "span_signed": (
            "The places of the points tell g wherever J is invertible: g_t is then the only "
            "element that moves the body so, and is as smooth in t as they are.",
            "Les positions des points déterminent g partout où J est inversible : g_t est alors "
            "le seul élément qui déplace ainsi le corps, et dépend de t aussi régulièrement "
            "qu’elles.",
        ),
        "affine_span_signed": (
            "The places of the points tell g wherever m is not 0 and J_c is invertible: g_t is "
            "then the only element that moves the body so, and is as smooth in t as they are.",
            "Les positions des points déterminent g partout où m n’est pas nul et J_c inversible "
            ": g_t est alors le seul élément qui déplace ainsi le corps, et dépend de t aussi "
            "régulièrement qu’elles.",
        ),
    },
    "distances": {
        "cauchy_green": (
            "The distances of the points change through C alone, the Cauchy–Green matrix.",
            "Les distances des points ne changent que par C, la matrice de Cauchy–Green.",
        ),
    },
    "force": {
        "points": (
            "The forces F_i, opposite to the derivatives of U with respect to the places r_i(t) "
            "in space, act on the group through their moments.",
            "Les forces F_i, opposées aux dérivées de U par rapport aux positions r_i(t) dans "
            "l’espace, agissent sur le groupe par leurs moments.",
        ),
        "moments": (
            "The moments of this problem's forces in the body: the potential is varied over all "
            "matrices δA, of which those of the group are a part.",
            "Les moments des forces de ce problème dans le corps : on fait varier le potentiel "
            "selon toutes les matrices δA, dont celles du groupe font partie.",
        ),
    },
    "gradient": {
        "metric": (
            "The force F̃, tangent to the group, is the opposite of the gradient of Ũ in the "
            "metric.",
            "La force F̃, tangente au groupe, est l’opposé du gradient de Ũ pour la métrique.",
        ),
    },
    "momentum": {
        "linear": (
            "The momentum is the derivative of the Lagrangian with respect to the velocity.",
            "L’impulsion est la dérivée du lagrangien par rapport à la vitesse.",
        ),
        "affine": (
            "The momentum is the derivative of the Lagrangian with respect to the velocity, for "
            "every (δA, δT), in particular for those tangent to the group.",
            "L’impulsion est la dérivée du lagrangien par rapport à la vitesse, pour tout (δA, "
            "δT), en particulier pour ceux qui sont tangents au groupe.",
        ),
    },
    "energy": {
        "expression": (
            "The energy of this problem, Σ Π_a ζ_a − L̃.",
            "L’énergie de ce problème, Σ Π_a ζ_a − L̃.",
        ),
        "paired": (
            "The energy is the momentum paired with the velocity, less the Lagrangian.",
            "L’énergie est l’impulsion appliquée à la vitesse, moins le lagrangien.",
        ),
        "any_lagrangian": (
            "The energy is the momentum Π paired with the velocity Z, less the Lagrangian.",
            "L’énergie est le moment Π appliqué à la vitesse Z, moins le lagrangien.",
        ),
        "problem": (
            "The energy of this problem.",
            "L’énergie de ce problème.",
        ),
    },
    "cartan": {
        "form": (
            "The Cartan form: momentum on the displacement, less energy on the time.",
            "La forme de Cartan : l’impulsion sur le déplacement, moins l’énergie sur le temps.",
        ),
        "trivialised": (
            "The Cartan form, trivialised.",
            "La forme de Cartan, trivialisée.",
        ),
        "problem": (
            "The Cartan form of this problem.",
            "La forme de Cartan de ce problème.",
        ),
    },
    "trivialisation": {
        "matrices": (
            "As matrices, g is A and ν is α.",
            "En matrices, g est A, et ν est α.",
        ),
        "left": (
            "Tangent vectors are carried to the Lie algebra by g⁻¹ (Maurer–Cartan), from the left: "
            "ν = gZ.",
            "On transporte les vecteurs tangents dans l’algèbre de Lie par g⁻¹ (forme de "
            "Maurer–Cartan), à gauche : ν = gZ.",
        ),
        "right": (
            "Tangent vectors are carried to the Lie algebra by g⁻¹ (Maurer–Cartan), from the "
            "right: ν = Zg.",
            "On transporte les vecteurs tangents dans l’algèbre de Lie par g⁻¹ (forme de "
            "Maurer–Cartan), à droite : ν = Zg.",
        ),
        "carried": (
            "Tangent vectors are carried to the Lie algebra by g⁻¹ (Maurer–Cartan); the metric "
            "depends on g through C = ĀA only.",
            "On transporte les vecteurs tangents dans l’algèbre de Lie par g⁻¹ (forme de "
            "Maurer–Cartan) ; la métrique ne dépend de g que par C = ĀA.",
        ),
    },
    "cartan_trivialised": {
        "form": (
            "The Cartan form in this trivialisation.",
            "La forme de Cartan dans cette trivialisation.",
        ),
    },
    "exterior": {
        "derivative": (
            "The exterior derivative of the Cartan form.",
            "La dérivée extérieure de la forme de Cartan.",
        ),
        "explicit_time": (
            "The terms in ∂Ũ/∂t cancel.",
            "Les termes en ∂Ũ/∂t se compensent.",
        ),
        "by_momenta": (
            "Its exterior derivative: that of any group by {momenta}, whose values here are read "
            "off the Cartan form.",
            "Sa dérivée extérieure : celle d’un groupe quelconque, écrite avec {momenta}, dont "
            "les valeurs se lisent ici sur la forme de Cartan.",
        ),
    },
    "symplectic": {
        "constant_time": (
            "At constant time it is dp ∧ dq, which the metric carries from the cotangent bundle "
            "of the group to its tangent bundle: a symplectic form.",
            "À temps constant, c’est dp ∧ dq, que la métrique transporte du fibré cotangent du "
            "groupe à son fibré tangent : une forme symplectique.",
        ),
    },
    "structure": {
        "crossed": (
            "The variations commute on the group; carried to the Lie algebra, the crossed "
            "variations δξ′ and δ′ξ differ by a bracket.",
            "Les variations commutent sur le groupe ; portées dans l’algèbre de Lie, les "
            "variations croisées δξ′ et δ′ξ diffèrent d’un crochet.",
        ),
    },
    "exterior_trivialised": {
        "any_group": (
            "The exterior derivative in the trivialisation, for any group.",
            "La dérivée extérieure dans la trivialisation, pour un groupe quelconque.",
        ),
    },
    "extremal": {
        "action": (
            "The action of a curve in the group is the integral of L̃ in time along its lift, "
            "where ν is the velocity; on the tangent X of a lift ϖ is L̃, so this is the integral "
            "of ϖ.",
            "L’action d’une courbe du groupe est l’intégrale de L̃ dans le temps le long de son "
            "relèvement, où ν est la vitesse ; sur le vecteur tangent X d’un relèvement, ϖ vaut "
            "L̃ : c’est donc l’intégrale de ϖ.",
        ),
        "lifts": (
            "The lift is varied through lifts, and δ commutes with d/dt: where δt and δg vanish "
            "at both ends, the action changes by the integral of dϖ(δy, X).",
            "On fait varier le relèvement parmi les relèvements, et δ commute avec d/dt : si δt "
            "et δg s’annulent aux deux bouts, l’action varie de l’intégrale de dϖ(δy, X).",
        ),
    },
    "dalembert": {
        "extremal": (
            "Here δν does not occur, and δt and δg are any: so a lift is an extremal of the "
            "action if and only if its tangent is in the kernel of dϖ, whether or not L̃ is "
            "regular.",
            "Ici δν n’intervient pas, et δt et δg sont quelconques : un relèvement est donc une "
            "extrémale de l’action si et seulement si son vecteur tangent est dans le noyau de "
            "dϖ, que L̃ soit régulier ou non.",
        ),
        "points": (
            "On the points it is d’Alembert’s principle of virtual work: what the constraint adds "
            "to the forces F_i in Newton’s equations does no work in any displacement that "
            "respects it.",
            "Sur les points, c’est le principe des travaux virtuels de d’Alembert : ce que la "
            "contrainte ajoute aux forces F_i dans les équations de Newton ne travaille dans "
            "aucun déplacement qui la respecte.",
        ),
    },
    "contraction": {
        "extremals": (
            "The motions are the extremals of the action, the integral of L̃: curves whose "
            "tangent X is in the kernel of dϖ.",
            "Les mouvements sont les extrémales de l’action, l’intégrale de L̃ : les courbes dont "
            "le vecteur tangent X est dans le noyau de dϖ.",
        ),
        "unknown": (
            "A vector X with δt = 1 is inserted; its other components, {unknown}, are unknown.",
            "On contracte avec un vecteur X tel que δt = 1 ; ses autres composantes, {unknown}, "
            "sont inconnues.",
        ),
    },
    "vertical": {
        "velocity": (
            "X is in the kernel if and only if this expression vanishes for every δ′y; to begin "
            "with, for every δ′y that varies the velocity alone.",
            "X est dans le noyau si et seulement si cette expression s’annule pour tout δ′y ; "
            "pour commencer, pour tout δ′y qui ne fait varier que la vitesse.",
        ),
    },
    "second_order": {
        "any_lagrangian": (
            "Where the second derivative M̃ of L̃ with respect to Z is not degenerate, variations "
            "of Z alone give every δ′Π, and this expression vanishes for all of them only if X has "
            "the velocity of the motion.",
            "Là où la dérivée seconde M̃ de L̃ par rapport à Z est non dégénérée, les variations de "
            "Z seul donnent tout δ′Π, et cette expression ne s’annule pour toutes que si X a la "
            "vitesse du mouvement.",
        ),
        "velocity": (
            "As {regular}, this expression vanishes for all such variations only if X has the "
            "velocity of the motion, which is inserted; {rates}.",
            "Comme {regular}, cette expression ne s’annule pour toutes ces variations que si X a "
            "la vitesse du mouvement, que l’on substitue ; {rates}.",
        ),
        "displacement_signed": (
            "the metric is not degenerate",
            "la métrique est non dégénérée",
        ),
        "displacement": (
            "the metric is not degenerate (the masses are not all on one line)",
            "la métrique est non dégénérée (les masses ne sont pas toutes alignées)",
        ),
        "rotation": (
            "the tensor I is invertible (the masses are not all on one line through the fixed "
            "point)",
            "le tenseur I est inversible (les masses ne sont pas toutes sur une même droite "
            "passant par le point fixe)",
        ),
        "rate": (
            "{rate} is {value}",
            "{rate} est {value}",
        ),
        "velocity_signed": (
            "Wherever {regular}, this expression vanishes for all such variations only if X has "
            "the velocity of the motion, which is inserted; {rates}.",
            "Partout où {regular}, cette expression ne s’annule pour toutes ces variations que si "
            "X a la vitesse du mouvement, que l’on substitue ; {rates}.",
        ),
        "rotation_signed": (
            "the tensor I is invertible",
            "le tenseur I est inversible",
        ),
    },
    "kernel": {
        "line": (
            "With δt = 0 the same two tests leave X = 0: the kernel is a line.",
            "Pour δt = 0, les deux mêmes conditions ne laissent que X = 0 : le noyau est une "
            "droite.",
        ),
        "displacements": (
            "X is in the kernel if and only if this expression vanishes for every displacement "
            "tangent to the group: the equations of motion.",
            "X est dans le noyau si et seulement si cette expression s’annule pour tout "
            "déplacement tangent au groupe : ce sont les équations du mouvement.",
        ),
        "tangent": (
            "They fix the part of the acceleration that is tangent to the group; the velocity "
            "gives the rest.",
            "Elles déterminent la partie de l’accélération qui est tangente au groupe ; la "
            "vitesse donne le reste.",
        ),
        "energy": (
            "The coefficient of δ′t then vanishes as well, for {velocity} is such a displacement.",
            "Le coefficient de δ′t s’annule alors lui aussi, car {velocity} est un tel "
            "déplacement.",
        ),
        "value": (
            "The same with the value of the momentum.",
            "Les mêmes, avec la valeur du moment.",
        ),
        "values": (
            "The same with the values of the momenta.",
            "Les mêmes, avec les valeurs des moments.",
        ),
        "line_signed": (
            "With δt = 0 the same two tests leave X = 0 wherever the metric is invertible: there "
            "the kernel is a line.",
            "Pour δt = 0, les deux mêmes conditions ne laissent que X = 0 partout où la métrique "
            "est inversible : le noyau y est une droite.",
        ),
        "work": (
            "X is in the kernel if and only if dϖ(X, δ′y) vanishes for every {variation} of the "
            "Lie algebra, with the work of the forces on the right.",
            "X est dans le noyau si et seulement si dϖ(X, δ′y) s’annule pour tout {variation} de "
            "l’algèbre de Lie, le travail des forces étant à droite.",
        ),
    },
    "motions": {
        "manifold": (
            "Of two variations dϖ sees what crosses the motions, and there it is ω: it is a form "
            "on the manifold of the motions.",
            "De deux variations, dϖ ne voit que ce qui traverse les mouvements, et c’est là ω : "
            "c’est une forme sur la variété des mouvements.",
        ),
        "complete": (
            "Where every motion lasts for all times, each has one point at a given t, and this "
            "manifold is the tangent bundle of the group with the symplectic form ω.",
            "Si tout mouvement est défini à tout instant, chacun a un point à t donné, et cette "
            "variété est le fibré tangent du groupe, muni de la forme symplectique ω.",
        ),
    },
    "second_order_trivialised": {
        "carried": (
            "The velocity of X is carried to the Lie algebra, and put into this form of dϖ.",
            "On transporte la vitesse de X dans l’algèbre de Lie, et on la substitue dans cette "
            "expression de dϖ.",
        ),
    },
    "equations": {
        "exercise": (
            "The equations of motion of any group of matrices that moves points (Exercise 1), one "
            "for each direction of its Lie algebra, to which {acceleration} belongs.",
            "Les équations du mouvement pour un groupe quelconque de matrices agissant sur des "
            "points (exercice 1), une pour chaque direction de son algèbre de Lie, à laquelle "
            "appartient {acceleration}.",
        ),
    },
    "algebra": {
        "matrices": (
            "The basis, as matrices.",
            "La base, en matrices.",
        ),
        "brackets": (
            "The brackets of the basis; those that are not listed vanish.",
            "Les crochets de la base ; ceux qui ne figurent pas sont nuls.",
        ),
        "abelian": (
            "All brackets of the basis vanish.",
            "Tous les crochets de la base sont nuls.",
        ),
    },
    "advected": {
        "left": (
            "Γ is what the algebra carries along, by a representation ρ: the group takes it back "
            "to a constant, so that it varies by −ρ(ξ).",
            "Γ est ce que l’algèbre transporte, par une représentation ρ : le groupe le ramène à "
            "une constante, de sorte qu’il varie par −ρ(ξ).",
        ),
        "right": (
            "Γ is what the algebra carries along, by a representation ρ: the group makes it of a "
            "constant, so that it varies by ρ(ξ).",
            "Γ est ce que l’algèbre transporte, par une représentation ρ : le groupe le tire d’une "
            "constante, de sorte qu’il varie par ρ(ξ).",
        ),
        "names": (
            "In the names of the problem its entries are {entries}, in this order.",
            "Avec les noms du problème, ses coefficients sont {entries}, dans cet ordre.",
        ),
    },
    "momenta": {
        "basis": (
            "On the basis of the Lie algebra Π_a is the derivative of L̃ with respect to ζ_a, and "
            "Φ_a the one along E_a.",
            "Sur la base de l’algèbre de Lie, Π_a est la dérivée de L̃ par rapport à ζ_a, et Φ_a "
            "celle le long de E_a.",
        ),
        "any_lagrangian": (
            "The Lagrangian is any function of the time, of the element of the group and of the "
            "velocity Z; the momentum Π of 𝔤* is its derivative with respect to Z, and Φ the one "
            "along the group, at a fixed Z.",
            "Le lagrangien est une fonction quelconque du temps, de l’élément du groupe et de la "
            "vitesse Z ; le moment Π, élément de 𝔤*, est sa dérivée par rapport à Z, et Φ celle le "
            "long du groupe, à Z fixé.",
        ),
        "derivatives": (
            "The momentum of 𝔤* is the derivative of L̃ with respect to {velocity}, and {push} "
            "the one along the group, at a fixed velocity; both are told by what they give on 𝔤.",
            "Le moment, élément de 𝔤*, est la dérivée de L̃ par rapport à {velocity}, et {push} "
            "celle le long du groupe, à vitesse fixée ; seul compte ce qu’ils donnent sur 𝔤.",
        ),
        "affine": (
            "The angular momentum about the origin of the body and the momentum, in the body "
            "frame.",
            "Le moment cinétique par rapport à l’origine du corps et la quantité de mouvement, "
            "dans le repère du corps.",
        ),
        "linear": (
            "The angular momentum in the body frame.",
            "Le moment cinétique dans le repère du corps.",
        ),
    },
    "cartan_momentum": {
        "form": (
            "The Cartan form by the momentum.",
            "La forme de Cartan par le moment.",
        ),
    },
    "exterior_momentum": {
        "derivative": (
            "Its exterior derivative, whatever the Lagrangian: {varied}; the bracket comes from "
            "the structure equation.",
            "Sa dérivée extérieure, quel que soit le lagrangien : {varied} ; le crochet vient de "
            "l’équation de structure.",
        ),
    },
    "coadjoint": {
        "basis": (
            "The equations of motion on the basis: ξ′ is each E_a, and the coadjoint term is told "
            "by the brackets.",
            "Les équations du mouvement sur la base : ξ′ est chacun des E_a, et les crochets "
            "donnent le terme coadjoint.",
        ),
        "turning": (
            "The coefficient of Ω′ must vanish.",
            "Le coefficient de Ω′ doit s’annuler.",
        ),
        "turning_and_moving": (
            "The coefficients of Ω′ and of η′ must vanish.",
            "Les coefficients de Ω′ et de η′ doivent s’annuler.",
        ),
        "energy": (
            "That of δ′t then vanishes as well: it is the opposite of what the rest gives for "
            "{motion}.",
            "Celui de δ′t s’annule alors lui aussi : c’est l’opposé de ce que donne le reste pour "
            "{motion}.",
        ),
        "any_lagrangian": (
            "The equations of motion of any Lagrangian on the group (Euler–Poincaré): the rate of "
            "the momentum is the force, {push}, and the coadjoint term of the momentum.",
            "Les équations du mouvement de tout lagrangien sur le groupe (Euler–Poincaré) : la "
            "dérivée de l’impulsion est la force, {push}, et le terme coadjoint de l’impulsion.",
        ),
        "kirchhoff": (
            "The equations of motion by the momenta (Kirchhoff): forces, and the coadjoint terms.",
            "Les équations du mouvement par les moments (Kirchhoff) : les forces, et les termes "
            "coadjoints.",
        ),
        "euler": (
            "The equations of motion by the momentum (Euler): forces, and the coadjoint term.",
            "Les équations du mouvement par le moment (Euler) : les forces, et le terme coadjoint.",
        ),
    },
}
