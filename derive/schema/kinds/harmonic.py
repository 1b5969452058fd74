"""U = ½ Σ m_i ⟨r_i, W r_i⟩, a force per mass that is linear in the place."""

from ..kind import Potential
from ..table import Symmetric


class Harmonic(Potential):
    """``W``: symmetric, the squares of the frequencies of a point by itself, along their axes; the
    force of a mass m at r is −m W r, so that with negative numbers it is driven away."""

    kind, phrase, several = "harmonic", "a harmonic force", "{n} harmonic forces"
    legend = "A harmonic force is not drawn."
    unturned = "a harmonic force, which has axes in space,"
    linear = True
    needs = ("no turning",)
    W: Symmetric
