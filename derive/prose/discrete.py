"""What is said of the discrete road.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "moments": {
        "discrete": (
            "Of the masses, the matrix J is all that the kinetic energy sees.",
            "Des masses, l’énergie cinétique ne voit que la matrice J.",
        ),
        "discrete_affine": (
            "An affine map is its matrix on (r, 1) here, with a hat on what has its size, so that "
            "one road serves both actions; of the masses, this matrix is all that the kinetic "
            "energy sees.",
            "Une application affine est ici sa matrice sur (r, 1), avec un chapeau sur ce qui a "
            "cette taille, si bien qu’une seule route sert aux deux actions ; des masses, "
            "l’énergie cinétique ne voit que cette matrice.",
        ),
    },
    "lagrangian": {
        "discrete": (
            "Time goes in steps of length h: the points have a constant velocity from g_0 to g_1, "
            "and the potential is taken at both ends, half and half.",
            "Le temps avance par intervalles de durée h : les points ont une vitesse constante "
            "de g_0 à "
            "g_1, et le potentiel est pris aux deux bouts, par moitié.",
        ),
    },
    "pullback": {
        "discrete": (
            "The sum over the points is carried out.",
            "La somme sur les points est effectuée.",
        ),
    },
    "force": {
        "discrete": (
            "The moments of the forces are what the potential says on a displacement, at each end.",
            "Les moments des forces sont ce que dit le potentiel sur un déplacement, à chaque "
            "bout.",
        ),
        "at_element": (
            "The forces of this problem in space, at the element in the middle: the potential is "
            "varied over all matrices, of which those of the group are a part.",
            "Les forces de ce problème dans l’espace, à l’élément du milieu : le potentiel est "
            "varié sur toutes les matrices, dont celles du groupe font partie.",
        ),
    },
    "one_forms": {
        "ends": (
            "A variation of L_d has a part at each end: one Lagrangian, two one-forms.",
            "Une variation de L_d a une partie à chaque bout : un lagrangien, deux formes.",
        ),
    },
    "exterior": {
        "discrete": (
            "Their difference is exact, so that both have one exterior derivative, the symplectic "
            "form; the potential leaves it, its second derivatives commute. A step of the motion "
            "carries Θ⁺ to Θ⁻, and so keeps this form.",
            "Leur différence est exacte, si bien que toutes deux ont une même dérivée extérieure, "
            "la forme symplectique ; le potentiel en sort, ses dérivées secondes commutent. "
            "Un intervalle du mouvement porte Θ⁺ sur Θ⁻, et conserve donc cette forme.",
        ),
    },
    "motion": {
        "discrete": (
            "The sum L_d(g_0, g_1) + L_d(g_1, g_2) is stationary at g_1: Θ⁺ of the one step and Θ⁻ "
            "of the next agree on every δg_1 tangent to the group. Where a displacement leaves L_d "
            "alone, both are equal on a step as well: the motion keeps their value.",
            "La somme L_d(g_0, g_1) + L_d(g_1, g_2) est stationnaire en g_1 : Θ⁺ d’un "
            "intervalle et Θ⁻ du "
            "suivant sont égales sur tout δg_1 tangent au groupe. Là où un déplacement laisse L_d "
            "invariant, elles le sont aussi sur un même intervalle : le mouvement conserve "
            "leur valeur.",
        ),
        "moser_veselov": (
            "The motion carries the momentum of a step to that of the next, by the equations of "
            "Moser and Veselov; W_1 is then solved for from its momentum, and g_2 = g_1W_1.",
            "Le mouvement porte le moment d’un intervalle sur celui du suivant, par les "
            "équations de "
            "Moser et Veselov ; on tire ensuite W_1 de son moment, et g_2 = g_1W_1.",
        ),
        "verlet": (
            "Every matrix is tangent to the group: the method of Störmer and Verlet, which is "
            "explicit.",
            "Toute matrice est tangente au groupe : la méthode de Störmer et Verlet, qui est "
            "explicite.",
        ),
        "volume": (
            "What is orthogonal to all matrices of trace 0 is a multiple of 1: the multiplier θ. H "
            "is where the body would go without it; θ is such that the next element keeps the "
            "volume.",
            "Ce qui est orthogonal à toutes les matrices de trace nulle est un multiple de 1 : le "
            "multiplicateur θ. H est là où irait le corps sans lui ; θ est tel que l’élément "
            "suivant conserve le volume.",
        ),
        "basis": (
            "On a basis of the Lie algebra these are as many equations as g_2 has unknowns.",
            "Sur une base de l’algèbre de Lie, ce sont autant d’équations que g_2 a d’inconnues.",
        ),
    },
    "conserved": {
        "discrete": (
            "A displacement of space that leaves U alone moves L_d by Θ⁺ − Θ⁻ = 0, so that both "
            "have one momentum on a step, and the motion hands it on to the next (Noether). Of "
            "those of rotations and translations, the discrete motion keeps, without inputs: "
            "{kept}.",
            "Un déplacement de l’espace qui laisse U invariant fait varier L_d de Θ⁺ − Θ⁻ = 0, si "
            "bien que toutes deux ont un même moment sur un intervalle, et que le mouvement le "
            "transmet au suivant (Noether). De ceux des rotations et des translations, le "
            "mouvement discret conserve, sans entrées : {kept}.",
        ),
    },
    "trivialisation": {
        "discrete": (
            "The displacement is carried to the identity by g_1.",
            "Le déplacement est porté à l’identité par g_1.",
        ),
    },
    "balance": {
        "discrete": (
            "The same for every element of the Lie algebra; g_2 is the element of the group near "
            "2g_1 − g_0 for which it holds, where the step is short enough for one.",
            "De même pour tout élément de l’algèbre de Lie ; g_2 est l’élément du groupe proche de "
            "2g_1 − g_0 pour lequel cela a lieu, si l’intervalle est assez court pour qu’il "
            "existe.",
        ),
    },
    "step": {
        "moser_veselov": (
            "Two steps seen from the body, and the momentum of each: the skew part of what Θ⁻ has "
            "on ξ, without the forces.",
            "Deux intervalles vus du corps, et le moment de chacun : la partie antisymétrique "
            "de ce que Θ⁻ "
            "a sur ξ, sans les forces.",
        ),
    },
    "quaternion": {
        "steps": (
            "A step is that of a unit quaternion of which q_k is the real part and x_k the other "
            "three; the momentum of a step, a skew matrix, is read as a vector, by the tensor of "
            "inertia.",
            "Un intervalle est celui d’un quaternion unitaire dont q_k est la partie réelle et x_k "
            "les trois autres ; le moment d’un intervalle, une matrice antisymétrique, se lit "
            "comme un vecteur, par le tenseur d’inertie.",
        ),
    },
    "turning": {
        "quaternion": (
            "Seen from the body after it, the momentum of a step has the opposite of x_0 in the "
            "quaternion; μ_1 is the torque of the forces. What is to be solved for (q_1, x_1) has "
            "three equations of degree 2.",
            "Vu du corps après lui, le moment d’un intervalle a l’opposé de x_0 dans le "
            "quaternion ; μ_1 est le moment des forces. Ce qu’il faut résoudre pour (q_1, x_1) a "
            "trois équations de degré 2.",
        ),
    },
    "blocks": {
        "discrete": (
            "An affine map in blocks, for ι: r ↦ (r, 0) and o = (0, 1): the linear part of a "
            "matrix, and its translation.",
            "Une application affine en blocs, pour ι : r ↦ (r, 0) et o = (0, 1) : la partie "
            "linéaire d’une matrice, et sa translation.",
        ),
    },
    "apart": {
        "discrete": (
            "The same in blocks, the last row of a displacement being 0.",
            "De même en blocs, la dernière ligne d’un déplacement étant 0.",
        ),
    },
    "input": {
        "discrete": (
            "Forces and covectors that are given as functions of time and state: their moments in "
            "the body, on a displacement by ξ; they are those of the element in the middle.",
            "Les forces et covecteurs donnés en fonction du temps et de l’état : leurs moments "
            "dans le corps, sur un déplacement par ξ ; ce sont ceux de l’élément du milieu.",
        ),
    },
    "damping": {
        "discrete": (
            "A damping is a force −κ v on a point, with the velocity of the step; half of its work "
            "is at either end.",
            "Un amortissement est une force −κ v sur un point, avec la vitesse de l’intervalle ; "
            "la moitié de son travail est à chaque bout.",
        ),
    },
    "dalembert": {
        "balance": (
            "By d’Alembert’s principle what acts from outside L_d works at g_1 by half in each "
            "of the two steps, and its work joins the balance.",
            "Par le principe de d’Alembert, ce qui agit en dehors de L_d travaille en g_1 pour "
            "moitié dans chacun des deux intervalles, et son travail se joint à l’équilibre.",
        ),
    },
    "place": {
        "discrete": (
            "The potential is that of the element in the middle, at its time.",
            "Le potentiel est celui de l’élément du milieu, à son instant.",
        ),
    },
    "centre": {
        "discrete": (
            "The centre of mass in space, and the moments about it. A displacement (ξ, η − m⁻¹ξc) "
            "turns the body about its centre and moves this by η.",
            "Le centre de masse dans l’espace, et les moments par rapport à lui. Un déplacement "
            "(ξ, η − m⁻¹ξc) tourne le corps autour de son centre et meut celui-ci de η.",
        ),
    },
    "translation": {
        "discrete": (
            "The centre of mass moves by itself, by the resultant of the forces.",
            "Le centre de masse se meut de lui-même, par la résultante des forces.",
        ),
    },
    "multiplier": {
        "polynomial": (
            "The next element is a shift of Y by the multiplier, so that its determinant is a "
            "polynomial in θ; it is 1 at the root near 0, where the step is short enough for one.",
            "L’élément suivant est Y décalé du multiplicateur, si bien que son déterminant est un "
            "polynôme en θ ; il vaut 1 à la racine proche de 0, si l’intervalle est assez court "
            "pour qu’elle existe.",
        ),
    },
    "relation": {
        "discrete_volume": (
            "All elements of the group keep the volume.",
            "Tous les éléments du groupe conservent le volume.",
        ),
    },
}
