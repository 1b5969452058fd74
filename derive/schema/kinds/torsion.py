"""U = ½ k Tr(1 − R̄A), a spring that turns the body back to the rotation R."""

from ..kind import Potential
from ..table import Rotation, Stiffness


class Torsion(Potential):
    """At rest at A = ``rest``; without that at A = 1.  For an angle θ from there U = k(1 − cos θ)
    in R³."""

    kind, phrase, several = "torsion", "a torsion spring", "{n} torsion springs"
    legend = "Torsion springs are not drawn."
    needs = ("rotations",)
    unturned = "a torsion spring, which rests at axes of the file,"
    stiffness: Stiffness
    rest: Rotation = ()
