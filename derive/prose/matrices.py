"""What is said of a group: its relations, its equations solved, what its motions keep.

Label of a step, then a name for the sentence: English, French.
"""

from __future__ import annotations

STEPS: dict[str, dict[str, tuple[str, str]]] = {
    "relation": {
        "isometries": (
            "For isometries ĀA = 𝟏, so that C drops out, and Z and ξ are skew.",
            "Pour les isométries, ĀA = 𝟏 : C disparaît, et Z et ξ sont antisymétriques.",
        ),
        "displacements": (
            "For isometries ĀA = 𝟏, so that C drops out, and Z and ξ are skew; w and η are any "
            "vectors.",
            "Pour les isométries, ĀA = 𝟏 : C disparaît, et Z et ξ sont antisymétriques ; w et η "
            "sont des vecteurs quelconques.",
        ),
        "skew": (
            "The matrices of the Lie algebra are skew, so ĀA = 𝟏 and C drops out.",
            "Les matrices de l’algèbre de Lie sont antisymétriques, donc ĀA = 𝟏 et C disparaît.",
        ),
        "skew_parts": (
            "The linear parts of the Lie algebra are skew, so ĀA = 𝟏 and C drops out.",
            "Les parties linéaires de l’algèbre de Lie sont antisymétriques, donc ĀA = 𝟏 et C "
            "disparaît.",
        ),
        "traceless": (
            "The matrices of the Lie algebra have trace zero, so the volume is kept; C does not "
            "drop out.",
            "Les matrices de l’algèbre de Lie sont de trace nulle, donc le volume est conservé ; "
            "C ne disparaît pas.",
        ),
        "volume": (
            "The matrices of the Lie algebra have trace zero, so the volume is kept.",
            "Les matrices de l’algèbre de Lie sont de trace nulle, donc le volume est conservé.",
        ),
        "lengths": (
            "Between two elements of the Lie algebra C drops out: A keeps the lengths of all that "
            "is in their images.",
            "Entre deux éléments de l’algèbre de Lie, C disparaît : les longueurs de tout ce qui "
            "est dans leurs images sont conservées.",
        ),
        "left_invariant": (
            "The metric is left-invariant for this body, although C is not 𝟏: C drops out of it, "
            "and stays in the forces of the potential.",
            "La métrique est invariante à gauche pour ce corps, bien que C ne soit pas 𝟏 : C en "
            "disparaît, et reste dans les forces du potentiel.",
        ),
        "traceless_parts": (
            "The linear parts of the Lie algebra have trace zero, so the volume is kept; C does "
            "not drop out.",
            "Les parties linéaires de l’algèbre de Lie sont de trace nulle, donc le volume est "
            "conservé ; C ne disparaît pas.",
        ),
        "fixed_origin": (
            "Only maps that fix the origin are allowed: a constraint, whose reaction at the "
            "origin is α̇c less the sum of the forces.",
            "Seules les applications qui fixent l’origine sont permises : c’est une contrainte, "
            "dont la réaction à l’origine est α̇c moins la somme des forces.",
        ),
        "more": (
            "There are more relations: the Lie algebra has dimension {dimension}, and its "
            "elements are those in the step of the coordinates.",
            "Les relations sont plus nombreuses : l’algèbre de Lie est de dimension {dimension}, "
            "et ses éléments sont ceux de l’étape des coordonnées.",
        ),
        "reaction": (
            "It vanishes if c = 0 and the forces have no resultant.",
            "Elle s’annule si c = 0 et si les forces sont de résultante nulle.",
        ),
    },
    "brackets": {
        "commutative": (
            "The group is commutative: the bracket vanishes, and with it the coadjoint term of "
            "the momentum.",
            "Le groupe est commutatif : le crochet est nul, et avec lui le terme coadjoint de "
            "l’impulsion.",
        ),
        "central": (
            "A bracket commutes with the whole Lie algebra: in the directions of brackets the "
            "momentum has no coadjoint term.",
            "Un crochet commute avec toute l’algèbre de Lie : dans les directions des crochets, "
            "l’impulsion n’a pas de terme coadjoint.",
        ),
        "nilpotent": (
            "The matrices of the Lie algebra are nilpotent: along its one-parameter groups the "
            "points move by polynomials in the time.",
            "Les matrices de l’algèbre de Lie sont nilpotentes : le long de ses groupes à un "
            "paramètre, les points se déplacent par des polynômes du temps.",
        ),
    },
    "coordinates": {
        "basis": (
            "Coordinates of the Lie algebra in the basis of the group.",
            "Coordonnées de l’algèbre de Lie dans la base du groupe.",
        ),
        "reduced": (
            "Coordinates in the basis of the Lie algebra. L̃ depends on the element of the group "
            "only by what the algebra carries along, so that the state has no such element.",
            "Coordonnées dans la base de l’algèbre de Lie. L̃ ne dépend de l’élément du groupe que "
            "par ce que l’algèbre transporte : l’état ne contient pas cet élément.",
        ),
        "column": (
            "In the names of the problem, T is the last column of A.",
            "Avec les noms du problème, T est la dernière colonne de A.",
        ),
        "blocks": (
            "In the names of the problem, the blocks of A on the diagonal are {blocks}.",
            "Avec les noms du problème, les blocs de A, sur la diagonale, sont {blocks}.",
        ),
        "block": (
            "{name} from row {row} on",
            "{name} à partir de la ligne {row}",
        ),
        "block_and_column": (
            "{name} from row {row} on, with the column {column} beside it",
            "{name} à partir de la ligne {row}, avec la colonne {column} à côté",
        ),
        "linear_parts": (
            "Coordinates of the linear parts of the Lie algebra in the basis of the group.",
            "Coordonnées des parties linéaires de l’algèbre de Lie dans la base du groupe.",
        ),
        "stated": (
            "The problem states a basis of its own: the coordinates of the velocity in it are z, "
            "and they are those of the emitted state; ζ is the angular velocity still.",
            "Le problème donne sa propre base : les coordonnées de la vitesse dans celle-ci sont "
            "z, et ce sont celles de l’état du code ; ζ reste la vitesse angulaire.",
        ),
    },
    "multiplier": {
        "none": (
            "The equations hold for every matrix ξ′, so that its coefficient vanishes.",
            "Les équations valent pour toute matrice ξ′, dont le coefficient s’annule donc.",
        ),
        "normal": (
            "The difference of the two sides is orthogonal to the Lie algebra: a multiple of Λ.",
            "La différence des deux membres est orthogonale à l’algèbre de Lie : c’est un "
            "multiple de Λ.",
        ),
        "volume": (
            "The difference of the two sides is orthogonal, for Tr ab̄, to every matrix of trace "
            "zero: a multiple θ of 𝟏, the multiplier of the volume.",
            "La différence des deux membres est orthogonale, pour Tr ab̄, à toute matrice de "
            "trace nulle : c’est un multiple θ de 𝟏, le multiplicateur du volume.",
        ),
    },
    "null": {
        "symmetries": (
            "Along these directions L̃ has no kinetic energy, and they keep it: the equations say "
            "nothing there. The kernel of dϖ has dimension {size}, and the motion is one of the "
            "quotient of the group by these symmetries.",
            "Le long de ces directions, L̃ n’a pas d’énergie cinétique, et elles le conservent : "
            "les équations n’en disent rien. Le noyau de dϖ est de dimension {size}, et le "
            "mouvement est celui du quotient du groupe par ces symétries.",
        ),
    },
    "mass": {
        "held": (
            "One coordinate for each direction without kinetic energy may move in any way; it is "
            "held, with 1 in M and 0 in β.",
            "Une coordonnée par direction sans énergie cinétique peut varier à volonté ; on la "
            "fixe, avec 1 dans M et 0 dans β.",
        ),
        "basis_of_lagrangian": (
            "Π̇_a is written out: M is the matrix of the second derivatives of L̃ with respect to "
            "the ζ_a, and β_a what is left without the acceleration, for M ζ̇ = β.",
            "On développe Π̇_a : M est la matrice des dérivées secondes de L̃ par rapport aux ζ_a, "
            "et β_a ce qui reste sans l’accélération, pour M ζ̇ = β.",
        ),
        "centres": (
            "For ξ′ = E_a(𝟏 − S) and Ż = Σ ψ_b E_b(𝟏 − S) the equations of motion are linear in "
            "the ψ_b: M is the mass matrix of these, β_a the load along E_a(𝟏 − S).",
            "Pour ξ′ = E_a(𝟏 − S) et Ż = Σ ψ_b E_b(𝟏 − S), les équations du mouvement sont "
            "linéaires en les ψ_b : M est la matrice de masse de ceux-ci, β_a la charge le long "
            "de E_a(𝟏 − S).",
        ),
        "basis": (
            "For ξ′ = E_a and Ż = Σ ζ̇_b E_b the equations of motion are linear in the ζ̇_b: M is "
            "the mass matrix of the basis, β_a the load along E_a.",
            "Pour ξ′ = E_a et Ż = Σ ζ̇_b E_b, les équations du mouvement sont linéaires en les "
            "ζ̇_b : M est la matrice de masse de la base, β_a la charge le long de E_a.",
        ),
    },
    "space": {
        "linear": (
            "The same in space, by C⁻¹ = A⁻¹Ā⁻¹: A(Ż + Z²) is the acceleration of A.",
            "La même équation dans l’espace, par C⁻¹ = A⁻¹Ā⁻¹ : A(Ż + Z²) est l’accélération de A.",
        ),
        "affine": (
            "The same in space, by C⁻¹ = A⁻¹Ā⁻¹: A(Ż + Z²) is the acceleration of A, A(ẇ + Zw) "
            "that of T.",
            "La même chose dans l’espace, par C⁻¹ = A⁻¹Ā⁻¹ : A(Ż + Z²) est l’accélération de A, "
            "A(ẇ + Zw) celle de T.",
        ),
    },
    "quadric": {
        "stokes": (
            "The body is ⟨r, Q_r r⟩ ≤ 1. The field r(1 − ⟨r, Q_r r⟩) vanishes at its boundary, so "
            "that the integral of its derivatives vanishes (divergence theorem), and the trace of "
            "that gives Tr Q_r J.",
            "Le corps est ⟨r, Q_r r⟩ ≤ 1. Le champ r(1 − ⟨r, Q_r r⟩) s’annule au bord, si bien que "
            "l’intégrale de ses dérivées s’annule (théorème de la divergence), et la trace de cela "
            "donne Tr Q_r J.",
        ),
        "layers": (
            "The body is ⟨r, Q_r r⟩ ≤ 1, and its density ρ_r depends on the level s_r alone. The "
            "integral σ_r of ρ_r over the levels from s_r to 1 has by the chain rule −ρ_r times "
            "the gradient of s_r for its gradient. The field σ_r r vanishes at the boundary, so "
            "that the integral of its derivatives vanishes (divergence theorem); dm/ρ_r is the "
            "element of volume.",
            "Le corps est ⟨r, Q_r r⟩ ≤ 1, et sa masse volumique ρ_r ne dépend que du niveau s_r. "
            "L’intégrale σ_r de ρ_r sur les niveaux de s_r à 1 a pour gradient, par dérivation des "
            "fonctions composées, −ρ_r fois le gradient de s_r. Le champ σ_r r s’annule au bord, "
            "si bien que l’intégrale de ses dérivées s’annule (théorème de la divergence) ; "
            "dm/ρ_r est l’élément de volume.",
        ),
    },
    "pressure": {
        "layers": (
            "The multiple of σ_r whose gradient balances the acceleration; p_0 is its value in the "
            "middle.",
            "Le multiple de σ_r dont le gradient équilibre l’accélération ; p_0 est sa valeur au "
            "centre.",
        ),
        "balance": (
            "The pressure p_r, which vanishes at the boundary, is a function of the place r in the "
            "body; its gradient in space is its derivative there by Ā⁻¹. Euler’s equation of a "
            "fluid holds at every point: density times acceleration is the force less the gradient "
            "of the pressure, for the forces per mass are linear in the place.",
            "La pression p_r, qui s’annule au bord, est une fonction de la position r dans le "
            "corps ; son gradient dans l’espace est sa dérivée dans le corps, par Ā⁻¹. L’équation "
            "d’Euler des fluides est vérifiée en chaque point : la masse volumique fois "
            "l’accélération est la force moins le gradient de la pression, car les forces par "
            "unité de masse sont linéaires en la position.",
        ),
        "gravity": (
            "The gravity of a homogeneous ellipsoid on its own points is linear in the place, too "
            "(Newton, Maclaurin).",
            "L’attraction d’un ellipsoïde homogène sur ses propres points est linéaire, elle "
            "aussi, en la position (Newton, Maclaurin).",
        ),
    },
    "total": {
        "layers": (
            "As dm/ρ_r is the element of volume in space, too, the multiplier is the integral of "
            "the pressure.",
            "Comme dm/ρ_r est aussi l’élément de volume dans l’espace, le multiplicateur est "
            "l’intégrale de la pression.",
        ),
        "pressure": (
            "As dm over the density is the element of volume in space, too, the multiplier is the "
            "integral of the pressure.",
            "Comme dm sur la masse volumique est aussi l’élément de volume dans l’espace, le "
            "multiplicateur est l’intégrale de la pression.",
        ),
        "sign": (
            "As long as θ > 0 the pressure is positive inside: the body may be a fluid, which the "
            "constraint does not hold together; where θ < 0 it would have to be a jelly.",
            "Tant que θ > 0, la pression est positive à l’intérieur : le corps peut être un "
            "fluide, que la liaison ne retient pas ; là où θ < 0, il faudrait que ce soit une "
            "gelée.",
        ),
    },
    "virial": {
        "needed": (
            "The trace of the balance. Of a pressure that vanishes at the boundary and balances "
            "acceleration and forces at every point θ would be the integral, by the divergence "
            "theorem: the total pressure that is needed. That there is one is not said here, where "
            "the body is not given as one ellipsoid whose centre is the fixed point, or the forces "
            "per mass are not linear in the place.",
            "La trace du bilan. D’une pression qui s’annule au bord et qui équilibre "
            "l’accélération et les forces en chaque point, θ serait l’intégrale, par le théorème "
            "de la divergence : la pression totale qu’il faut. Son existence "
            "n’est pas affirmée ici, où le corps n’est pas donné comme un seul ellipsoïde dont le "
            "centre est le point fixe, ou bien les forces par unité de masse ne sont pas linéaires "
            "en la position.",
        ),
    },
    "circulation": {
        "kept": (
            "The circulation, whatever J: what the pressure adds to Āα̇ is symmetric, and so is "
            "what the forces add.",
            "La circulation, quel que soit J : ce que la pression ajoute à Āα̇ est symétrique, et "
            "de même ce que les forces ajoutent.",
        ),
        "gravity": (
            "The circulation: what the pressure adds to Āα̇ is symmetric, and so is what the "
            "gravity of the body on itself adds: −CB_G J⁻¹, as K_G is a multiple of J, and CC_a "
            "of 𝟏.",
            "La circulation : ce que la pression ajoute à Āα̇ est symétrique, et de même ce que "
            "l’attraction du corps sur lui-même ajoute : −CB_G J⁻¹, car K_G est un multiple de J, "
            "et CC_a de 𝟏.",
        ),
        "changed": (
            "The circulation: what the pressure adds to Āα̇ is symmetric, and drops out; what the "
            "forces add may not be.",
            "La circulation : ce que la pression ajoute à Āα̇ est symétrique, et disparaît ; ce "
            "que les forces ajoutent ne l’est pas forcément.",
        ),
        "centred": (
            "What acts by the first moment adds nothing, for c = 0.",
            "Ce qui agit par le premier moment n’ajoute rien, car c = 0.",
        ),
        "relabelling": (
            "It is the momentum of the relabellings of the body by matrices h that keep J, "
            "hJh̄ = J; their velocities V are V = JS with skew matrices S.",
            "C’est le moment des réétiquetages du corps par les matrices h qui conservent J, "
            "hJh̄ = J ; leurs vitesses V sont V = JS avec des matrices antisymétriques S.",
        ),
    },
    "tetrahedron": {
        "kept": (
            "The volume of the tetrahedron, here six times, is det A times that in the body, and "
            "its variation Tr ξ times it. If it is not 0, it is kept if and only if det A = 1, and "
            "its variation vanishes if and only if Tr ξ = 0.",
            "Le volume du tétraèdre, ici multiplié par six, est celui dans le corps fois det A, et "
            "sa variation est Tr ξ fois ce volume. S’il n’est pas 0, il est conservé si et "
            "seulement si det A = 1, et sa variation s’annule si et seulement si Tr ξ = 0.",
        ),
        "affine": (
            "The configurations of the same volume are one orbit of this group, of dimension "
            "{orbit}: four points have 12 coordinates, and this is one condition.",
            "Les configurations de même volume forment une orbite de ce groupe, de dimension "
            "{orbit} : quatre points ont 12 coordonnées, et ceci est une condition.",
        ),
        "linear": (
            "In space the configurations of the same volume are one orbit of the affine maps that "
            "keep it, of dimension {orbit}; of these dimensions the linear maps here are {linear}, "
            "without the translations.",
            "Dans l’espace, les configurations de même volume forment une orbite des applications "
            "affines qui le conservent, de dimension {orbit} ; les applications linéaires, ici, en "
            "sont {linear} dimensions, sans les translations.",
        ),
    },
    "no_rotation": {
        "free": (
            "In a rigid rotation exp(tΩ)A₀, Ω skew, the velocity Z is A₀⁻¹ΩA₀, and Ż = 0. The "
            "number of rows is odd, so that every skew matrix is singular, as Υ is: so are Ω, Ω² "
            "and Z², which is A₀⁻¹Ω²A₀. Without forces Z² = θC⁻¹J⁻¹; then θ = 0, Ω² = 0 and Ω = 0: "
            "nothing rotates rigidly, for any A₀.",
            "Dans une rotation rigide exp(tΩ)A₀, Ω antisymétrique, la vitesse Z est A₀⁻¹ΩA₀, et "
            "Ż = 0. Le nombre de lignes est impair, donc toute matrice antisymétrique est "
            "singulière, comme l’est Υ : donc Ω, Ω² et Z², qui est A₀⁻¹Ω²A₀, le sont. Sans forces "
            "Z² = θC⁻¹J⁻¹ ; alors θ = 0, Ω² = 0 et Ω = 0 : rien ne tourne rigidement, pour tout "
            "A₀.",
        ),
    },
    "elimination": {
        "mass": (
            "As m > 0, the balance of forces gives ẇ; inserted into the balance of moments, it "
            "makes I_c appear there, the tensor of inertia about the centre of mass r_c, which "
            "follows from J_c as I does from J.",
            "Comme m > 0, le bilan des forces donne ẇ ; reporté dans le bilan des moments, il "
            "fait apparaître I_c, le tenseur d’inertie par rapport au centre de masse r_c, qui se "
            "déduit de J_c comme I de J.",
        ),
        "velocity": (
            "The velocity of the centre of mass, in the body frame, is w_c.",
            "La vitesse du centre de masse, dans le repère du corps, est w_c.",
        ),
        "linear_parts": (
            "As the group has every translation, the coefficient of η′ gives ẇ; put into that of "
            "ξ′, it leaves the equations of the linear parts about the centre of mass r_c, with "
            "the moments of masses and forces about it; here ξ′ runs over the linear parts of 𝔤.",
            "Comme le groupe contient toutes les translations, le coefficient de η′ donne ẇ ; "
            "substitué dans celui de ξ′, il laisse les équations des parties linéaires par "
            "rapport au centre de masse r_c, avec les moments des masses et des forces pris en ce "
            "point ; ici ξ′ parcourt les parties linéaires de 𝔤.",
        ),
        "centres": (
            "Each factor with all its translations is seen from its centre of mass: that place is "
            "in S, so that ZS is in the Lie algebra again and SZ = 0.",
            "Chaque facteur qui a toutes ses translations est vu de son centre de masse : cette "
            "place est dans S, de sorte que ZS est encore dans l’algèbre de Lie et que SZ = 0.",
        ),
        "mass_signed": (
            "Wherever m is not 0, the balance of forces gives ẇ; inserted into the balance of "
            "moments, it makes I_c appear there, the tensor of inertia about the centre of mass "
            "r_c, which follows from J_c as I does from J.",
            "Partout où m n’est pas nul, le bilan des forces donne ẇ ; reporté dans le bilan des "
            "moments, il fait apparaître I_c, le tenseur d’inertie par rapport au centre de masse "
            "r_c, qui se déduit de J_c comme I de J.",
        ),
        "linear_parts_signed": (
            "As the group has every translation, the coefficient of η′ gives ẇ wherever m is not "
            "0; put into that of ξ′, it leaves the equations of the linear parts about the centre "
            "of mass r_c, with the moments of masses and forces about it; here ξ′ runs over the "
            "linear parts of 𝔤.",
            "Comme le groupe contient toutes les translations, le coefficient de η′ donne ẇ "
            "partout où m n’est pas nul ; substitué dans celui de ξ′, il laisse les équations des "
            "parties linéaires par rapport au centre de masse r_c, avec les moments des masses et "
            "des forces par rapport à lui ; ici ξ′ parcourt les parties linéaires de 𝔤.",
        ),
    },
    "motion": {
        "lagrangian": (
            "The equations of motion of this problem, solved for the accelerations: M is "
            "invertible where the kernel is transverse to the planes t = const.",
            "Les équations du mouvement de ce problème, résolues par rapport aux accélérations : M "
            "est inversible là où le noyau est transverse aux plans t = const.",
        ),
        "rotation": (
            "The equations of motion of this problem, solved for the accelerations: the tensor I "
            "is invertible where the masses are not all on one line through the fixed point.",
            "Les équations du mouvement de ce problème, résolues par rapport aux accélérations : "
            "le tenseur I est inversible lorsque les masses ne sont pas toutes sur une même "
            "droite passant par le point fixe.",
        ),
        "displacement": (
            "The equations of motion of this problem, solved for the accelerations: the tensor "
            "I_c is invertible where the masses are not all on one line.",
            "Les équations du mouvement de ce problème, résolues par rapport aux accélérations : "
            "le tenseur I_c est inversible lorsque les masses ne sont pas toutes alignées.",
        ),
        "given_torque": (
            "The given torque u, outside dϖ, adds ⟨u, Ω′⟩ to the work.",
            "Le moment donné u, extérieur à dϖ, ajoute ⟨u, Ω′⟩ au travail.",
        ),
        "given_wrench": (
            "The given moment u and force f_u, outside dϖ, add ⟨u, Ω′⟩ + ⟨f_u, η′⟩ to the work.",
            "Le moment u et la force f_u donnés, extérieurs à dϖ, ajoutent ⟨u, Ω′⟩ + ⟨f_u, η′⟩ au "
            "travail.",
        ),
        "maps": (
            "The equations of motion of this problem: {metric} is invertible where the masses "
            "span the space.",
            "Les équations du mouvement de ce problème : {metric} est inversible lorsque les "
            "points engendrent l’espace.",
        ),
        "maps_of_a_volume": (
            "The equations of motion of this problem: {metric} is invertible where the masses "
            "span the space, and that Ż is in the Lie algebra gives θ.",
            "Les équations du mouvement de ce problème : {metric} est inversible lorsque les "
            "points engendrent l’espace, et l’appartenance de Ż à l’algèbre de Lie donne θ.",
        ),
        "affine_maps": (
            "The equations of motion of this problem: {metric} is invertible where the masses do "
            "not lie in one hyperplane.",
            "Les équations du mouvement de ce problème : {metric} est inversible lorsque les "
            "masses ne sont pas dans un même hyperplan.",
        ),
        "affine_maps_of_a_volume": (
            "The equations of motion of this problem: {metric} is invertible where the masses do "
            "not lie in one hyperplane, and that Ż is in the Lie algebra gives θ.",
            "Les équations du mouvement de ce problème : {metric} est inversible lorsque les "
            "masses ne sont pas dans un même hyperplan, et l’appartenance de Ż à l’algèbre de Lie "
            "donne θ.",
        ),
        "problem": (
            "The equations of motion of this problem.",
            "Les équations du mouvement de ce problème.",
        ),
        "mass_matrix": (
            "M is invertible where no direction of the group leaves every mass in its place.",
            "M est inversible lorsqu’aucune direction du groupe ne laisse toutes les masses en "
            "place.",
        ),
        "rotation_signed": (
            "The equations of motion of this problem, solved for the accelerations wherever the "
            "tensor I is invertible.",
            "Les équations du mouvement de ce problème, résolues par rapport aux accélérations "
            "partout où le tenseur I est inversible.",
        ),
        "displacement_signed": (
            "The equations of motion of this problem, solved for the accelerations wherever the "
            "tensor I_c is invertible and m is not 0.",
            "Les équations du mouvement de ce problème, résolues par rapport aux accélérations "
            "partout où le tenseur I_c est inversible et m non nul.",
        ),
        "affine_maps_of_a_volume_signed": (
            "The equations of motion of this problem, wherever m is not 0, {metric} is invertible "
            "and θ has a value: that Ż is in the Lie algebra gives it.",
            "Les équations du mouvement de ce problème, partout où m n’est pas nul, où {metric} "
            "est inversible et où θ a une valeur : l’appartenance de Ż à l’algèbre de Lie la "
            "donne.",
        ),
        "affine_maps_signed": (
            "The equations of motion of this problem, wherever m is not 0 and {metric} is "
            "invertible.",
            "Les équations du mouvement de ce problème, partout où m n’est pas nul et où {metric} "
            "est inversible.",
        ),
        "maps_of_a_volume_signed": (
            "The equations of motion of this problem, wherever {metric} is invertible and θ has a "
            "value: that Ż is in the Lie algebra gives it.",
            "Les équations du mouvement de ce problème, partout où {metric} est inversible et où "
            "θ a une valeur : l’appartenance de Ż à l’algèbre de Lie la donne.",
        ),
        "maps_signed": (
            "The equations of motion of this problem, wherever {metric} is invertible.",
            "Les équations du mouvement de ce problème, partout où {metric} est inversible.",
        ),
        "mass_matrix_signed": (
            "They are solved for the ζ̇_b wherever M is invertible.",
            "On les résout par rapport aux ζ̇_b partout où M est inversible.",
        ),
    },
    "separation": {
        "kinetic": (
            "With the centre of mass R in place of T the kinetic energy is that of the linear "
            "part about the centre of mass and that of the whole mass at it.",
            "Avec le centre de masse R à la place de T, l’énergie cinétique est la somme de celle "
            "de la partie linéaire autour du centre de masse et de celle de la masse totale "
            "placée en ce point.",
        ),
        "condition": (
            "Where the group has every translation, the two motions separate if the potential is "
            "such a sum too.",
            "Lorsque le groupe contient toutes les translations, les deux mouvements se séparent "
            "si le potentiel est lui aussi une telle somme.",
        ),
        "separates": (
            "No term of the potential has both the linear part and the centre of mass: the motion "
            "separates into theirs.",
            "Aucun terme du potentiel ne contient à la fois la partie linéaire et le centre de "
            "masse : leurs mouvements se séparent.",
        ),
        "outside": (
            "No term of the potential has both the linear part and the centre of mass; the forces "
            "outside dϖ, {forces}, may tie the two.",
            "Aucun terme du potentiel ne contient à la fois la partie linéaire et le centre de "
            "masse ; les forces extérieures à dϖ ({forces}) peuvent coupler les deux.",
        ),
        "pointwise": (
            "The motion separates if U_Q, which is given point by point, is a sum of a function "
            "of the linear part and one of R.",
            "Le mouvement se sépare si U_Q, donné point par point, est la somme d’une fonction de "
            "la partie linéaire et d’une fonction de R.",
        ),
        "rest": (
            "The rest of the potential is such a sum.",
            "Le reste du potentiel est une telle somme.",
        ),
        "outside_too": (
            "The forces outside dϖ, {forces}, may tie the two as well.",
            "Les forces extérieures à dϖ ({forces}) peuvent elles aussi coupler les deux.",
        ),
        "damping": (
            "damping",
            "amortissement",
        ),
        "inputs": (
            "inputs",
            "entrées",
        ),
        "differences": (
            "U_Q is made of differences of places, in which R cancels.",
            "U_Q est fait de différences de positions, où R s’élimine.",
        ),
    },
    "conserved": {
        "kept": (
            "Without inputs and damping the motion keeps {kept}.",
            "Sans entrées ni amortissement, le mouvement conserve {kept}.",
        ),
        "tried": (
            "Tried were the energy and, of the displacements of space, {displacements}; derive "
            "symmetries finds all symmetries.",
            "Ont été essayés l’énergie et, parmi les déplacements de l’espace, {displacements} ; "
            "derive symmetries trouve toutes les symétries.",
        ),
        "rotations": (
            "the rotations about the origin (all, or those about one line)",
            "les rotations autour de l’origine (toutes, ou celles autour d’une droite)",
        ),
        "translations": (
            "the translations (all, or those across gravity)",
            "les translations (toutes, ou celles perpendiculaires à la pesanteur)",
        ),
        "rotations_together": (
            "all rotations about the origin together",
            "toutes les rotations autour de l’origine à la fois",
        ),
        "translations_together": (
            "all translations together",
            "toutes les translations à la fois",
        ),
        "alone": (
            "The energy alone was tried here, and no displacement of space; derive symmetries "
            "finds all symmetries.",
            "Seule l’énergie a été essayée ici, sans aucun déplacement de l’espace ; derive "
            "symmetries trouve toutes les symétries.",
        ),
        "by_coordinates": (
            "Part of the potential is told by coordinates of places, so that no displacement of "
            "space was tried here; derive symmetries finds all symmetries.",
            "Une partie du potentiel est donnée par des coordonnées, si bien qu’aucun "
            "déplacement de l’espace n’a été essayé ici ; derive symmetries trouve toutes les "
            "symétries.",
        ),
        "noether": (
            "The Cartan form, on an infinitesimal symmetry of L̃, is constant along the motion "
            "(Noether).",
            "La forme de Cartan, évaluée sur une symétrie infinitésimale de L̃, est constante le "
            "long du mouvement (Noether).",
        ),
        "energy": (
            "the energy",
            "l’énergie",
        ),
        "angular_momentum": (
            "the angular momentum ℓ about the origin of space",
            "le moment cinétique ℓ par rapport à l’origine de l’espace",
        ),
        "along_gravity": (
            "the component along gravity of the angular momentum ℓ about the origin of space",
            "la composante le long de la pesanteur du moment cinétique ℓ par rapport à l’origine "
            "de l’espace",
        ),
        "along_axis": (
            "the component of the angular momentum ℓ, taken about the origin of space, along an "
            "axis about which the potential may be turned",
            "la composante du moment cinétique ℓ, pris par rapport à l’origine de l’espace, le "
            "long d’un axe autour duquel on peut tourner le potentiel",
        ),
        "momentum": (
            "the momentum p",
            "l’impulsion p",
        ),
        "across_gravity": (
            "the momentum p across gravity",
            "l’impulsion p transverse à la pesanteur",
        ),
    },
}
