"""U(det A), the internal energy of what is deformed homogeneously."""

from ..kind import Own, Potential
from ..table import OfVolume


class Volume(Potential):
    """``U``: in ``det_A``, the volume over the one at A = 1, t and the parameters."""

    kind, phrase, several = "volume", "an energy of the volume", "{n} energies of the volume"
    legend = "An energy of the volume is not drawn."
    needs = ("volumes",)
    unturned = "an energy of the volume"
    letters = (
        Own(
            "V_A",
            "scalar",
            "volume over the one of the body itself",
            "volume, rapporté à celui du corps lui-même",
            "V_A",
        ),
        Own(
            "U_V",
            "scalar",
            "part of the potential that the volume gives",
            "partie du potentiel que donne le volume",
            "U_V",
        ),
        Own(
            "p_V",
            "scalar",
            "integral of the pressure over the volume, −V_A dU_V/dV_A",
            "intégrale de la pression sur le volume, −V_A dU_V/dV_A",
            "p_V",
        ),
    )
    U: OfVolume
