"""Any U of the time and of the places of the points in space."""

from __future__ import annotations

from dataclasses import dataclass

from ..kind import Energy, Potential


@dataclass(frozen=True, kw_only=True)
class Expression(Potential):
    """``U``: in entries of r_i(t), which a file writes r1_x, r1_y, …, and t."""

    kind, rank, phrase = "expression", 3, "a potential given as an expression"
    legend = "The potential given as an expression is not drawn."
    unturned = "a potential given as an expression of the places"
    U: Energy
