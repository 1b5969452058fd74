"""Which names of [initial] does the state of a problem lack?  Told in the page with the walk: a
program, which would tell it, takes seconds to make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from derive.algebra.groups import Group
from derive.language.suffixed import suffixed
from derive.problem.state_names import entries, known_in_lagrangian, state_names


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
    if own is None:
        return [*of_points(group), *inputs(problem)]
    held = {"t"} | {suffixed("zeta", a) for a in own.held}
    known = known_in_lagrangian(group, problem.advected)
    return [*(x for x in known if x not in held), *inputs(problem)]


def of_points(group: Group) -> list[str]:
    """Those of the state of a body of points: with translations the last n of the velocity are
    w."""
    shift = {}
    if group.free_translations:
        turns = group.dimension - group.n
        shift = {suffixed("zeta", turns + i): suffixed("w", i) for i in range(1, group.n + 1)}
    return [shift.get(x, x) for x in state_names(group) if x != "t"]


def inputs(problem: Any) -> Iterator[str]:
    """Those of the inputs: one for each coordinate of 𝔤, or of the space of a force."""
    for x in problem.inputs:
        count = problem.group.dimension if x.kind == "covector" else problem.group.n
        yield from (suffixed(x.name, i) for i in range(1, count + 1))
