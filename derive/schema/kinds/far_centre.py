"""The gravity of a far centre, U = −GM(m/R − ⟨n, Ac⟩/R² + (3⟨n, AJĀn⟩ − Tr AJĀ)/2R³), n = T/R."""

from ..kind import Own, Potential
from ..table import Scalar, Vector


class FarCentre(Potential):
    """``strength``: GM.  T is seen from the ``centre``, a place in space.

    These are the first terms of −GM Σ m_i/‖T + A r_i‖ in the size of the body over R = ‖T‖: those
    of order R⁻⁴ are dropped.
    """

    kind, phrase = "far_centre", "the gravity of a far centre"
    legend = "The far centre of attraction is not drawn."
    needs, alone = ("affine of R^3",), True
    unturned = "the gravity of a far centre, an expansion about the origin of the file,"
    letters = (
        Own(
            "T_b",
            "vector",
            "place of the body's origin from the far centre, in the body",
            "position de l’origine du corps vue du centre lointain, dans le repère du corps",
            "T_b",
        ),
        Own(
            "W",
            "scalar",
            "one over the distance of the body's origin from the far centre",
            "inverse de la distance de l’origine du corps au centre lointain",
            "W",
        ),
        Own(
            "V",
            "scalar",
            "strength of the far centre over that distance",
            "intensité du centre lointain divisée par cette distance",
            "V",
        ),
    )
    strength: Scalar
    centre: Vector = ()
