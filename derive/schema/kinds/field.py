"""U = −Σ q_i ⟨E(t), r_i⟩, a uniform field on charged points."""

from ..kind import Potential
from ..table import Charges, Vector


class Field(Potential):
    """``E``: the field, a vector of space; ``charges``: q_i, one for each point."""

    kind, phrase, several = "field", "a field on charged points", "{n} fields on charged points"
    legend = "Fields are not drawn."
    needs = ("one space",)
    unturned = "a field on charged points"
    E: Vector
    charges: Charges
