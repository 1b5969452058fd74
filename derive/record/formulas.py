"""Equations as they are printed."""

from __future__ import annotations

import re

from ..language.read import read
from .record import Equation


def stated(text: str, *parameters: str, for_all: tuple[str, ...] = ()) -> list[Equation]:
    """``Z = A⁻¹α,  w = A⁻¹τ``: equations, with a comma and two spaces between them."""
    sides = (x.split(" = ") for x in re.split(r",\s\s+", text))
    return [Equation(read(lhs, *parameters), read(rhs, *parameters), for_all) for lhs, rhs in sides]
