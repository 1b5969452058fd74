"""Which names of [initial] does the state of a problem lack?  Told in the page with the walk: a
program, which would tell it, takes seconds to make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from derive.language.suffixed import suffixed
from derive.problem.state_names import entries, known_in_lagrangian


def faults(problem: Any) -> Iterator[str]:
    """A line for each name that the state has not."""
    told = problem.initial.numbers
    if not told or problem.group is None:
        return
    known = names(problem)
    for name in told:
        if name not in known:
            yield f"initial, {name[:40]}: the state has no such number; it has {entries(known)}"


def names(problem: Any) -> list[str]:
    """The numbers of the state, those of g that never change among them, and of the inputs."""
    group, own = problem.group, problem.lagrangian
    found = [x for x in known_in_lagrangian(group, problem.advected) if x != "t"]
    if own is not None:
        held = {suffixed("zeta", a) for a in own.held}
        found = [x for x in found if x not in held]
    elif group.free_translations:
        turns = group.dimension - group.n
        shift = {suffixed("zeta", turns + i): suffixed("w", i) for i in range(1, group.n + 1)}
        found = [shift.get(x, x) for x in found]
    return [*found, *inputs(problem)]


def inputs(problem: Any) -> Iterator[str]:
    """Those of the inputs: one for each coordinate of 𝔤, or of the space of a force."""
    for x in problem.inputs:
        count = problem.group.dimension if x.kind == "covector" else problem.group.n
        yield from (suffixed(x.name, i) for i in range(1, count + 1))
