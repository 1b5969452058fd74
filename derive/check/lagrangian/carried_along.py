"""What an algebra carries along, at an exact point: Γ with ρ(g)^ε Γ = Γ₀, no rule of δΓ used."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...algebra.carried import block
from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix


class CarriedAlong:
    """Γ as a function of g near 1; ``start``: Γ₀, a column of any numbers."""

    def __init__(self, problem: Mapping[str, Any], group: Group, side: str):
        size = sum(x["size"] for x in problem["advected"])
        self.rows, self.side = range(group.n - size, group.n), side
        self.start: Matrix = ()

    def at(self, g: Matrix) -> Matrix:
        """ρ(g)⁻¹Γ₀ on the left, ρ(g)Γ₀ on the right; ρ(g) is a block of g."""
        if not self.rows:
            return ()
        whole = block(g, self.rows)
        return q.times(near_one(whole) if self.side == "left" else whole, self.start)


def near_one(m: Matrix) -> Matrix:
    """The inverse of 1 + x, x nilpotent in three parameters: 1 − x + x² − x³."""
    one = q.identity(len(m))
    x = q.minus(one, m)
    found = one
    for _ in range(3):
        found = q.plus(one, q.times(x, found))
    return found
