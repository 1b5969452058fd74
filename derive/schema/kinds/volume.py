"""U(det A), the internal energy of what is deformed homogeneously."""

from ..kind import Potential
from ..table import OfVolume


class Volume(Potential):
    """``U``: in ``det_A``, the volume over the one at A = 1, t and the parameters."""

    kind, phrase, several = "volume", "an energy of the volume", "{n} energies of the volume"
    legend = "An energy of the volume is not drawn."
    needs = ("volumes",)
    unturned = "an energy of the volume"
    U: OfVolume
