"""Equations as they are printed."""

from __future__ import annotations

import re

from ..language.read import FormulaError, read
from .record import Equation


def stated(text: str, *parameters: str, for_all: tuple[str, ...] = ()) -> list[Equation]:
    """``Z = A⁻¹α,  w = A⁻¹τ``: equations, with a comma and two spaces between them."""
    found = []
    for equation in re.split(r",\s\s+", text):
        lhs, equal, rhs = equation.partition(" = ")
        if not equal:
            raise FormulaError(f"{equation!r} is no equation")
        found.append(Equation(read(lhs, *parameters), read(rhs, *parameters), for_all))
    return found
