"""The tension c(s − l)/s of a spring between ends at the distance s = √q, where l may be 0.

As c − cl/s it is c where l is 0, if only s is not 0 there: then q is added to by as good as
nothing.  Where l is not 0 nothing is added, and at distance 0 there is no direction and no number.
"""

from __future__ import annotations

from fractions import Fraction

from ..language.tree import Tree

SLACK = {"double": Fraction(1, 10**37), "float": Fraction(1, 10**20)}
"""Added to the square of a distance that may be 0; its root has a third power that is not 0.

That of doubles is a number of 32 bits as well, for arrays of these.
"""


def tension(t: Tree) -> tuple[tuple[Tree, ...], Tree, Tree, Tree] | None:
    """The factors of c, then s = √q, q and l of a spring's tension c(s − l)/s, l a parameter.

    ``None`` for any other tree.
    """
    match t:
        case ("div", ("mul", *factors), ("fun", "sqrt", q) as s):
            for k, x in enumerate(factors):
                match x:
                    case ("add", a, ("mul", -1, ("par", _) as length)) if a == s:
                        return (*factors[:k], *factors[k + 1 :]), s, q, length
    return None
