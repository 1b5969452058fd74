"""U = ½ k Tr(1 − R̄A), a spring that turns the body back to the rotation R."""

from ..kind import Own, Potential
from ..table import Rotation, Stiffness


class Torsion(Potential):
    """At rest at A = ``rest``; without that at A = 1.  For an angle θ from there U = k(1 − cos θ)
    in R³."""

    kind, phrase, several = "torsion", "a torsion spring", "{n} torsion springs"
    legend = "Torsion springs are not drawn."
    needs = ("rotations",)
    unturned = "a torsion spring, which rests at axes of the file,"
    letters = (
        Own(
            "k_A",
            "scalar",
            "stiffness of the torsion springs, the sum of all",
            "raideur des ressorts de torsion, la somme de toutes",
            "k_A",
        ),
        Own(
            "N_A",
            "matrix",
            "moments of the torsion springs, in the body frame",
            "moments des ressorts de torsion, dans le repère du corps",
            "N_A",
        ),
        Own(
            "μ_A",
            "vector",
            "moment of the torsion springs, as a vector",
            "moment des ressorts de torsion, en vecteur",
            r"\mu_A",
        ),
    )
    stiffness: Stiffness
    rest: Rotation = ()
