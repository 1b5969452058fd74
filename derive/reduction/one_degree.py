"""Do the symmetries of a problem leave one degree of freedom, and what are their momenta called?"""

from __future__ import annotations

from ..symmetries.found import Found
from ..symmetries.quantity_names import named
from .commuting import chosen


def leaves_one(found: Found) -> bool:
    """Do the symmetries that a reduction takes leave one degree of freedom?"""
    problem = found.problem
    assert problem.group is not None
    assert problem.lagrangian is not None
    left = problem.group.dimension - len(problem.lagrangian.held) - len(chosen(found))
    return left == 1


def momenta_of(found: Found) -> tuple[str, ...]:
    """The names of 𝒥_1, 𝒥_2, … of the symmetries that a reduction takes."""
    names = dict(zip(map(id, found.symmetries), named(found), strict=True))
    return tuple(names[id(x)] for x in chosen(found))
