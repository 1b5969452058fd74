"""Which symmetries a reduction is by: of L̃ itself, without time, each commuting with the others."""

from __future__ import annotations

from itertools import groupby

from ..problem.problem import ProblemError
from ..symmetries.found import Found
from ..symmetries.quantity_names import axis
from ..symmetries.symmetry import Symmetry
from ..symmetries.tree_matrices import full


def chosen(found: Found) -> tuple[Symmetry, ...]:
    """The symmetries that are taken; ``ProblemError`` where there is none.

    They are taken in turn, kind by kind, of several axes the last first; listed in their order.
    """
    fit = [k for k, x in enumerate(found.symmetries) if _fits(x)]
    if not fit:
        raise ProblemError(f"{found.problem.name}: {_why_not(found)}, so that nothing is reduced")
    taken: list[int] = []
    for _, group in groupby(fit, key=lambda k: found.symmetries[k].kind):
        for k in sorted(group, key=lambda k: axis(found.symmetries[k]), reverse=True):
            if all({k, j} in found.commuting for j in taken):
                taken.append(k)
    return tuple(found.symmetries[k] for k in sorted(taken))


def _fits(x: Symmetry) -> bool:
    """Does it leave L̃ alone, at δt = 0, by a field that does not depend on the time?"""
    return x.exact and x.tau == 0 and not any(map(full, x.moving))


def _why_not(found: Found) -> str:
    """Why no symmetry fits, in words."""
    others = [x for x in found.symmetries if x.kind != "time"]
    if not others:
        return "there is no symmetry of L but of the time"
    if all(x.exact for x in others):
        return "its symmetries move the time as well"
    return "its symmetries leave L alone only up to dF, or depend on the time"
