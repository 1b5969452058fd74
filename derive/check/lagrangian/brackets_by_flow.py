"""Poisson brackets of the momenta and of Γ at an exact point, by flows: no structure constant used.

{F, Π_b} is the rate of F along the flow of Π_b, which moves g by gE_b (on the right E_bg) and takes
covectors along: ⟨p, gE_a⟩ at g becomes ⟨p, ghE_ah⁻¹⟩, h = 1 + sE_b.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ..nilpotent import EPS, nilpotent, part
from .lagrangian_model import LagrangianModel


def brackets(model: LagrangianModel) -> Matrix:
    """The matrix of the brackets of Π_1, …, then the entries of Γ."""
    columns = [_along(model, e) for e in model.group.basis]
    d, size = len(columns), len(columns[0])
    aside = [[-columns[a][i] for i in range(d, size)] for a in range(d)]
    rows = [[*(columns[b][a] for b in range(d)), *aside[a]] for a in range(d)]
    rows += [[*(x[i] for x in columns), *(Fraction(0) for _ in aside[0])] for i in range(d, size)]
    return tuple(map(tuple, rows))


def _along(model: LagrangianModel, e: Matrix) -> list[Any]:
    """The rates of all variables along the flow of the momentum on e."""
    h, back = model.displaced((nilpotent(EPS), e))
    turned = [_conjugated(model, h, back, x) for x in model.group.basis]
    rates = [part(model.momentum(model.t, model.g, model.Z, _rate(x)), 0) for x in turned]
    if model.advected and model.advected.rows:
        moved = model.advected.at(model.moved(model.g, h))
        rates += [part(row[0], EPS) for row in moved]
    return rates


def _conjugated(model: LagrangianModel, h: Matrix, back: Matrix, x: Matrix) -> Matrix:
    """hxh⁻¹, where g moves to gh; h⁻¹xh, where it moves to hg."""
    one, two = (h, back) if model.side == "left" else (back, h)
    return q.times(q.times(one, x), two)


def _rate(x: Matrix) -> Matrix:
    """The rate of a matrix."""
    return tuple(tuple(part(y, EPS) for y in row) for row in x)
