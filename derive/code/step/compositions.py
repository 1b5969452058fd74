"""Symmetric compositions of a symmetric step of order 2, which raise its order.

Steps γ_1 h, …, γ_s h one after the other, γ_i = γ_(s+1−i) and Σ γ_i = 1, are one of a higher order
where Σ γ_i³ = 0, and so on.  For order 4 these are Suzuki's five, for which there is a formula
(M. Suzuki, Physics Letters A 146 (1990), 319–323); for 6 and 8 the nine and the seventeen of least
size that W. Kahan and R.-C. Li found (*Composition constants for raising the orders of
unconventional schemes for ordinary differential equations*, Mathematics of Computation 66 (1997),
1089–1099), to 26 decimals: digit by digit those of E. Hairer, C. Lubich and G. Wanner, *Geometric
Numerical Integration*, V.3.2, (3.12) and (3.14), as OrdinaryDiffEq.jl (``KahanLi6``,
``KahanLi8``) and REBOUND's ``janus`` have them, too.  A test holds them against every order
condition.
"""

from __future__ import annotations

from decimal import Decimal, localcontext

from .collocation import DIGITS

FOUND = {
    6: (
        "0.39216144400731413927925056",
        "0.33259913678935943859974864",
        "-0.70624617255763935980996482",
        "0.08221359629355080023149045",
    ),
    8: (
        "0.13020248308889008087881763",
        "0.56116298177510838456196441",
        "-0.38947496264484728640807860",
        "0.15884190655515560089621075",
        "-0.39590389413323757733623154",
        "0.18453964097831570709183254",
        "0.25837438768632204729397911",
        "0.29501172360931029887096624",
    ),
}
"""Order → γ_1, γ_2, … before the one in the middle."""


def weights(order: int) -> list[Decimal]:
    """γ_1 … γ_s of the composition of an order, 2, 4, 6 or 8; their sum is 1."""
    with localcontext() as context:
        context.prec = DIGITS
        if order == 2:
            first: list[Decimal] = []
        elif order == 4:
            first = [1 / (4 - Decimal(4) ** (Decimal(1) / 3))] * 2
        else:
            first = [*map(Decimal, FOUND[order])]
        return [*first, 1 - 2 * sum(first, Decimal(0)), *reversed(first)]
