"""Which names of [initial] and [[event]] does the state of a problem lack?  Told with the walk: a
program, which would refuse them, takes seconds to make."""

from __future__ import annotations

from collections.abc import Iterator

from ..algebra.groups import Group
from ..language.expression import names
from ..language.suffixed import suffixed
from ..schema.outside import Input
from ..schema.table import hint
from .problem import Problem
from .state_names import entries, known_in_lagrangian, state_names


def faults(problem: Problem) -> Iterator[str]:
    """A line for each name that the state has not; none where no names are known, as of a torus."""
    if problem.group is None:
        return
    known = numbers_followed(problem, problem.group)
    for name in problem.initial.numbers:
        if name not in known:
            told = f"the state has no such number{hint(name[:40], known)}; it has {entries(known)}"
            yield f"initial, {name[:40]}: {told}"
    watched = {*known, *known_in_lagrangian(problem.group, problem.advected), *problem.parameters}
    watched |= of_other_forms(problem.group)
    for k, event in enumerate(problem.events, 1):
        for name in dict.fromkeys(names(event.when)):
            if name not in watched:
                yield f"event {k}, when: the state has no {name[:40]}; it has {entries(known)}"


def numbers_followed(problem: Problem, group: Group) -> list[str]:
    """The numbers of the state, those of g that never change among them, and of the inputs."""
    inputs = (name for x in problem.inputs for name in _of_input(x, group))
    return [*numbers_of_state(problem, group), *inputs]


def named_twice(problem: Problem) -> str:
    """That a number of the state is a parameter, or one of an input, in words; "" where none is."""
    if problem.group is None:
        return ""
    state = {*numbers_of_state(problem, problem.group)}
    if clash := next(filter(state.__contains__, problem.parameters), ""):
        return f"parameter {clash!r}: a number of the state; choose another name"
    for k, x in enumerate(problem.inputs, 1):
        if clash := next(filter(state.__contains__, _of_input(x, problem.group)), ""):
            told = f"{clash!r} is one of its numbers, and of the state as well"
            return f"input {k}, {x.name!r}: {told}; choose another name"
    return ""


def numbers_of_state(problem: Problem, group: Group) -> list[str]:
    """The numbers of the state, those of g that never change among them."""
    if problem.lagrangian is None:
        return of_points(group)
    held = {"t"} | {suffixed("zeta", a) for a in problem.lagrangian.held}
    return [x for x in known_in_lagrangian(group, problem.advected) if x not in held]


def of_points(group: Group) -> list[str]:
    """Those of the state of a body of points: with translations the last n of the velocity are
    w."""
    shift = {}
    if group.free_translations:
        turns = group.dimension - group.n
        shift = {suffixed("zeta", turns + i): suffixed("w", i) for i in range(1, group.n + 1)}
    return [shift.get(x, x) for x in state_names(group) if x != "t"]


def of_other_forms(group: Group) -> set[str]:
    """Those of the state in a form that can be emitted beside: dg/dt, a quaternion."""
    found = {f"{x}_dot" for x in state_names(group) if x[:2] in ("A_", "T_")}
    return found | ({f"q_{k}" for k in range(4)} if group.rotates else set())


def _of_input(x: Input, group: Group) -> list[str]:
    """Those of an input: one for each coordinate of 𝔤, or of the space of a force."""
    count = group.dimension if x.kind == "covector" else group.n
    return [suffixed(x.name, i) for i in range(1, count + 1)]
