"""U = −Σ m_i μ / ‖r_i − centre‖."""

from ..kind import Potential
from ..table import Masses, Scalar, Vector


class Attraction(Potential):
    """Over the points that have a mass; or over those of ``on`` (counted from 1) with the masses
    there, whatever they weigh in the body."""

    kind, rank, phrase, drawn = "attraction", 2, "the attraction of a centre", True
    unturned = ""
    legend = "Dashed lines lead to the centre of attraction."
    needs = ("points alone", "one space")
    strength: Scalar
    centre: Vector = ()
    on: Masses = ()
