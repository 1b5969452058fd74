"""Any U of the time and of the places of the points in space."""

from dataclasses import dataclass

from ..kind import Potential
from ..table import Energy


@dataclass(frozen=True, kw_only=True)
class Expression(Potential):
    """``U``: in entries of r_i(t), which a file writes r1_x, r1_y, …, and t."""

    kind, rank, phrase = "expression", 3, "a potential given as an expression"
    legend = "The potential given as an expression is not drawn."
    unturned = "a potential given as an expression of the places"
    U: Energy
