"""Every step uses the steps from which it has its names.

Of every name but those that all begins with, the first step that has it must say what it is
(:mod:`derive.check.definitions`); a later one must use a step in which it stands.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from ..language.tree import Tree
from ..record.record import Step
from .definitions import PRIMITIVE

MEMBERS = frozenset(f"{x}_" for x in ("m", "r", "r̂", "v", "F", "E"))
"""The families that the walk starts from: a member m_i is another name than the sum m."""


def unused(steps: Iterable[Step], primitive: Collection[str] = PRIMITIVE) -> Iterator[str]:
    """For each step a name of earlier steps, but of none that it uses; "" if there is none.

    ``primitive``: the names that the walk starts from.
    """
    mentions: dict[str, set[str]] = {}
    known: set[str] = set()
    for step in steps:
        here = {
            x for e in step.equations for side in (e.lhs, e.rhs) for x in mentioned(side, primitive)
        }
        mentioned_before = set().union(*(mentions.get(x, ()) for x in step.uses))
        yield next(iter(sorted((here & known) - mentioned_before)), "")
        mentions[step.label] = here
        known |= here


def mentioned(t: Tree, primitive: Collection[str] = PRIMITIVE) -> Iterator[str]:
    """The names in a tree, without those of the beginning; dϖ counts as ϖ, m_i is ``m_``."""
    if isinstance(t, str):
        if t not in primitive:
            yield t.removeprefix("d") if t == "dϖ" else t
    elif isinstance(t, tuple) and t[0] == "at":
        if f"{t[1]}_" not in MEMBERS:
            yield f"{t[1]}_"
    elif isinstance(t, tuple) and t[0] != "par":
        for part in t[1:]:
            yield from mentioned(part, primitive)
