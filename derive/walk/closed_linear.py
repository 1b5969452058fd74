"""Are equations linear with constant coefficients, with those of the entries of g in them?"""

from __future__ import annotations

from collections.abc import Callable

from ..language.laurent import Laurent
from ..language.tree import Tree
from .solved_rows import Balance, depends

KNOWN = ("ζ", "w", "A", "T", "Γ")
GIVEN = ("u", "f_u")
"""Inputs: they do not count as state."""


def linear(stage: Balance, rate: Callable[[Tree], Laurent | None]) -> bool:
    """Is M constant, and β a sum of constants times entries whose rates are such sums again?

    ``rate``: that of an entry of g, or of what is carried along; ``None`` for an entry of ζ or w.
    """
    if any(_symbols(x) for row in stage.mass for x in row):
        return False
    waiting, seen = [*stage.load], set[Tree]()
    while waiting:
        found = _linear_symbols(waiting.pop())
        if found is None:
            return False
        new = found - seen
        seen |= new
        waiting += [x for x in map(rate, new) if x is not None]
    return True


def constant(stage: Balance) -> bool:
    """Do M and β not depend on the state?"""
    return not any(_symbols(x) for x in (*stage.load, *(y for row in stage.mass for y in row)))


def _symbols(p: Laurent) -> set[Tree]:
    return {s for m in p.terms for s, _ in m if depends(s)}


def _linear_symbols(p: Laurent) -> set[Tree] | None:
    """The state's entries in a sum of constants times one of these; ``None`` of any other."""
    found = set[Tree]()
    for m in p.terms:
        moving = [(s, e) for s, e in m if depends(s)]
        if not moving:
            continue
        (s, e), *more = moving
        if more or e != 1 or not isinstance(s, tuple) or s[0] != "entry":
            return None
        if s[1] in KNOWN:
            found.add(s)
        elif s[1] not in GIVEN and s[1][:2] != ("at", "f_u"):
            return None
    return found
