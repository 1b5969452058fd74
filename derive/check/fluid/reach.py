"""How much the points at which a claim about a fluid is tried must tell apart.

On tori a field has as many frequencies as there are fields in a term, in a ball its polynomials are
of the degree of the derivatives: else a claim may hold where it is tried, and not otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from ...language.tree import Tree
from ...record.record import Equation
from ..grades import common_degree, indeterminate
from .ball import DEGREE
from .field_values import FluidValues
from .flat_torus import FREQUENCIES
from .fluid_sides import coefficients, functions, sides
from .functions import ORDERS

MOST_FIELDS, MOST_DERIVATIVES = 6, 4
"""That are tried; a claim with more is refused."""
SLOTS = indeterminate().degree.num.slots
"""Of a coefficient of a field, by which fields are counted; frequencies and lengths have none."""
BOUNDARY = frozenset({"n", "∂ₙ"})
DENSITIES = dict.fromkeys(("ρ", "ρ_0", "ρ̇", "κ", "κ̇"), 1)
_WHOLE = "inner metric norm2 ∫ p̃ dŨ ϖ dϖ h̃ L L̃ U Ũ"
INTEGRALS = dict.fromkeys(_WHOLE.split(), 1)
_LOCAL = "nabla grad div ∇ D ∂ₙ δ δ′ d/dt ∂_s"
DERIVATIVES = {**dict.fromkeys(_LOCAL.split(), 1), "Δ": 2}
LIMITS = (
    ("densities", DENSITIES, 1),
    ("integrals", INTEGRALS, 1),
    ("derivatives", DERIVATIVES, MOST_DERIVATIVES),
)
"""What is counted in a term, by the heads and names that are counted, and the most that is tried:
products of two integrals would need modes in which each of them alone has the sum 0."""
MORE = "a product with more {} than those that are tried can tell"


class Reach(NamedTuple):
    """Of points that tell claims apart with so many ``fields`` in a term, or with so many
    ``derivatives`` of one."""

    fields: int = FREQUENCIES
    derivatives: int = DEGREE


LEAST = Reach()


def too_much(equation: Equation) -> str:
    """Of what an equation has more than can be tried, in words; "" if of nothing."""
    over = (what for what, counted, limit in LIMITS if most(counted, equation) > limit)
    return next(map(MORE.format, over), "")


def most(counted: Mapping[str, int], of: Equation | Tree) -> int:
    """The most of what is counted in a term of a tree, of either side of an equation."""
    if isinstance(of, Equation):
        return max(most(counted, of.lhs), most(counted, of.rhs))
    if not isinstance(of, tuple):
        return counted.get(of, 0) if isinstance(of, str) else 0
    own, found = counted.get(of[0], 0), [most(counted, x) for x in of[1:]]
    one_of = of[0] == "add" or of[:2] == ("call", "∫")  # under which ⟨a, b⟩ is at each place
    return own + (max(found) if one_of else sum(found))


def needed(equation: Equation, graded: FluidValues | None) -> Reach:
    """The reach that an equation needs, by its values in ``graded`` numbers on a torus; ``None`` at
    the boundary, of which tori tell nothing and balls must tell one derivative more."""
    derivatives = most(DERIVATIVES, equation) - (graded is not None)
    counted = FREQUENCIES if graded is None else fields(equation, graded)
    return Reach(max(counted, FREQUENCIES), max(derivatives, DEGREE))


def fields(equation: Equation, graded: FluidValues) -> int:
    """The most fields in a term of the sides, less one under an integral; of densities to the order
    s alone, as :data:`~derive.check.fluid.functions.ORDERS` says."""
    listed = [*zip(*map(functions, sides(equation, graded)), strict=True)]
    whole = all(x.is_constant for both in listed for x in both)
    each = (pair for x, y in listed for m, pair in coefficients(x, y) if m[-1] < ORDERS - 1)
    slots = max((common_degree(pair).numerator.slots for pair in each), default=0)
    return slots // SLOTS - whole
