"""Compositions have their orders: every condition, in the free algebra, in 24 digits.

A symmetric step h is the exponential of h X_1 + h³ X_3 + h⁵ X_5 + …, with X that do not commute; a
composition of parts γ_i h has the order p where its product is exp(h X_1) in all words up to h^p.
"""

from decimal import Decimal, localcontext
from math import factorial

import pytest

from derive.code.step.tableaux import weights

STAGES = {2: 1, 4: 5, 6: 9, 8: 17}
SMALL, CLEAR = Decimal(10) ** -23, Decimal(10) ** -6
"""What the decimals may leave of a condition that holds, and the least of one that does not."""


def product(a, b, most):
    """The product of two sums of words up to a degree; a word is the degrees of its letters."""
    found = {}
    for v, x in a.items():
        for w, y in b.items():
            if sum(v) + sum(w) <= most:
                found[v + w] = found.get(v + w, Decimal(0)) + x * y
    return found


def exponential(letters, most):
    """exp of a sum of letters."""
    total, power = {(): Decimal(1)}, {(): Decimal(1)}
    for k in range(1, most + 1):
        power = product(power, letters, most)
        for w, x in power.items():
            total[w] = total.get(w, Decimal(0)) + x / factorial(k)
    return total


@pytest.mark.parametrize("order", STAGES)
def test_a_composition_has_its_order_and_no_higher(order):
    with localcontext() as context:
        context.prec = 50
        parts, most = weights(order), order + 1
        assert len(parts) == STAGES[order]
        assert parts == parts[::-1]
        whole = {(): Decimal(1)}
        for part in parts:
            step = {(k,): part**k for k in range(1, most + 1, 2)}
            whole = product(whole, exponential(step, most), most)
        wanted = exponential({(1,): Decimal(1)}, most)
        left = {w: abs(x - wanted.get(w, Decimal(0))) for w, x in whole.items()}
        assert len(left) > order
        assert max(x for w, x in left.items() if sum(w) <= order) < SMALL
        assert max(x for w, x in left.items() if sum(w) > order) > CLEAR
