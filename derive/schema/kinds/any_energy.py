"""Any U of the time and of the places of the points in space."""

from typing import Any

from ..kind import Potential
from ..table import Energy


class Expression(Potential):
    """``U``: in entries of r_i(t), which a file writes r1_x, r1_y, …, and t."""

    kind, called, rank = "expression", "Potential", 3
    phrase = "a potential given as an expression"
    legend = "The potential given as an expression is not drawn."
    unturned = "a potential given as an expression of the places"
    U: Energy

    @classmethod
    def word(cls, U: str) -> Any:
        """Any potential, an expression U in r1_x, r2_y, …, t and the parameters."""
        return {"U": U}
