"""What a step uses: the steps that its equations were made from, and those from which it has its
names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache

from ..language.tree import Tree
from ..record.record import Step
from ..record.uses import position_of
from ..record.vocabulary import DERIVATIVE_OF, VOCABULARY

FREE = ("letter", "value on X", "function")
"""Roles of the names that the walk starts from, which no equation gives."""
OPERATORS = ("δ", "δ′", "d/dt", "∫", "grad")
"""The functions that the walk starts from."""


def traced(steps: Iterable[Step]) -> tuple[Step, ...]:
    """The steps in the order of the record, with ``uses`` completed: every name comes from one of
    these.

    A name that is in none of the steps used comes from the first step that speaks of it.
    """
    order: dict[str, int] = {}
    spoken: dict[str, set[str]] = {}
    first: dict[str, str] = {}
    found = []
    for step in steps:
        here = {x for e in step.equations for side in (e.lhs, e.rhs) for x in subjects(side)}
        heard = set().union(*(spoken[x] for x in step.uses))
        naming = {first[x] for x in here - heard if x in first}
        uses = sorted({*step.uses, *naming}, key=order.__getitem__)
        order[step.label], spoken[step.label] = len(order), here
        first |= dict.fromkeys(here - {*first}, step.label)
        found.append(replace(step, uses=tuple(uses)))
    return tuple(found)


def subjects(t: Tree) -> Iterator[str]:
    """The names that a tree speaks of, without those that the walk starts from; ``m_`` of a member
    m_i."""
    if isinstance(t, str):
        x = DERIVATIVE_OF.get(t, t)
        if _is_defined(x, "value") or _is_defined(x, "function"):
            yield x
    elif isinstance(t, tuple) and t[0] == "at":
        if _is_defined(str(t[1]), "member"):
            yield f"{t[1]}_"
    elif isinstance(t, tuple) and t[0] != "par":
        for part in t[1:]:
            yield from subjects(part)


@cache
def _is_defined(name: str, way: str) -> bool:
    """Is a name, in this position, given by an equation, not one that the walk starts from?"""
    uses = VOCABULARY[name].uses if name in VOCABULARY else ()
    roles = [use.role for use in uses if position_of(use.type) == way]
    free = FREE if name in OPERATORS or way != "function" else FREE[:2]
    return not {*roles} <= {*free}
