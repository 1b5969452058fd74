"""The gravity of a far centre, U = −GM(m/R − ⟨n, Ac⟩/R² + (3⟨n, AJĀn⟩ − Tr AJĀ)/2R³), n = T/R."""

from ..kind import Potential
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
    strength: Scalar
    centre: Vector = ()
