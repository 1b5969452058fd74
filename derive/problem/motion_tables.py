"""[initial], [[event]] and [[signal]] of a problem file, and the names that they need; and
problems of kinematics of first order: [kinematics], ġ as a function of the element g.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from ..algebra.factor_charts import chart_names
from ..algebra.families import on_homogeneous
from ..algebra.groups import Group, names_by_block
from ..language.derivatives import weight
from ..language.expression import names
from ..language.limits import LEAVES
from ..language.reserved import suffixed
from ..language.tree import Tree, nodes
from ..language.values import approximate
from ..schema.kind import Kinematics, Parameter
from ..schema.motion_kinds import Event, Signal
from ..schema.table import hint, nearest
from .fields import (
    by_points,
    called_here,
    entries,
    is_entry,
    known_in_lagrangian,
    named_tables,
    state_names,
    tables,
    undeclared,
)
from .file_reader import ROTATION_KEYS, FileReader, turn_in
from .inertia import defaults, is_negative
from .problem import Initial, Problem, ProblemError

SECTIONS_KNOWN = ("name", "title", "group", "action", "parameters", "kinematics")
"""The keys of such a file."""


def kinematics_problem(
    data: Mapping[str, Any], moved: Group | None, parameters: Mapping[str, Parameter]
) -> Problem:
    """The problem of a file, on the matrices of its group, which act on (r, 1) where it is affine;
    ``ProblemError`` for what else the file says."""
    for key in data:
        if key not in SECTIONS_KNOWN:
            raise ProblemError(f"key {key!r}: [kinematics] says all of the motion; leave this out")
    if moved is None:
        raise ProblemError("key 'kinematics': a text about any group has none of its own")
    group = (on_homogeneous(moved) if moved.affine else moved).in_user_basis
    if not group.has_inner_samples:
        raise ProblemError(
            f"kinematics: no exact elements of {group.name} are known, on which f_u is tried"
        )
    reader = FileReader()
    reader.moves(group)
    reader.carries(None, parameters)
    name = reader.name_of(data)
    if not isinstance(data["kinematics"], dict):
        raise ProblemError("key 'kinematics' must be a table [kinematics]")
    found = reader.typed(Kinematics, data["kinematics"], "kinematics")
    _declared(found, group, reader)
    return Problem(
        name, group, title=reader.title_of(data, name), parameters=parameters, kinematics=found
    )


def _declared(found: Kinematics, group: Group, reader: FileReader) -> None:
    """Every name that is used is a parameter or an input, every one of these is used, and the
    expressions are not too many."""
    leaves = sum(weight(t).leaves for t in found.trees())
    if leaves > LEAVES:
        raise ProblemError(f"{leaves} names and numbers in expressions; at most {LEAVES}")
    rates = {x for row in found.rate for t in row for x in names(t)}
    used = rates | {x for t in found.noise for x in names(t)}
    inputs = {*found.inputs}
    for name in sorted(used - inputs):
        if name not in reader.parameters:
            known = {x: t for x, t in reader.state_names.items() if is_entry(t)}
            raise ProblemError(undeclared(name, "kinematics", reader.parameters, group, known))
    if within := sorted(inputs & {x for t in found.noise for x in names(t)}):
        raise ProblemError(f"kinematics, noise: {within[0]!r} is an input; give parameters alone")
    for name, density in zip(found.inputs, found.noise, strict=False):
        if is_negative(density, reader.parameters):
            raise ProblemError(
                f"kinematics, noise of {name!r}: a density is not negative, and this one is, for "
                "the defaults of the parameters"
            )
    if left := next((x for x in found.inputs if x not in rates), ""):
        raise ProblemError(f"kinematics, inputs: {left!r} is not used in 'rate'; leave it out")
    if left := next((x for x in reader.parameters if x not in used), ""):
        raise ProblemError(f"parameter {left!r} is declared but not used; leave it out")


KEYS = ("initial", "event", "signal")
TURNED = re.compile(rf"({'|'.join(ROTATION_KEYS)})[1-9]?")
"""The keys of [initial] that turn a body, or a block of a product by its number."""


def motion_fields(data: Mapping[str, Any], reader: FileReader) -> dict[str, Any]:
    """The fields of a problem that a file says by KEYS; parameters are known to the ``reader``."""
    said = next((key for key in KEYS if key in data), "")
    if said and not reader.group and "algebra" not in data:
        raise ProblemError(f"key {said!r}: a text about any group has no motion to follow")
    events = tuple(reader.typed(Event, x, w) for w, x in named_tables(data, "event").items())
    for k, x in enumerate(events, 1):
        still = {*reader.parameters} - {table.get("mass") for table in tables(data, "flow")}
        moving = [name for name in names(x.when) if name not in still]
        if not moving and "t" not in nodes(x.when):
            raise ProblemError(
                f"event {k}, when: nothing in it changes on a motion; write it of the numbers of "
                "the state, as zeta_1, or of t"
            )
    seen = [x.name for x in events]
    for k, name in enumerate(seen, 1):
        if name in seen[: k - 1]:
            raise ProblemError(f"event {k}: a second event {name!r}; give each its own name")
    start = _initial(data.get("initial", {}), reader)
    return {"initial": start, "events": events, "signals": _signals(data, start, reader)}


def _signals(data: Mapping[str, Any], start: Initial, reader: FileReader) -> tuple[Signal, ...]:
    """The tables [[signal]], each of a number of its own."""
    found: list[Signal] = []
    if "signal" in data and not data.get("input"):
        raise ProblemError("signal 1: there is no [[input]] for it")
    for k, table in enumerate(tables(data, "signal"), 1):
        where = f"signal {k}"
        x = reader.typed(Signal, table, where)
        if any(x.input == y.input for y in found):
            raise ProblemError(f"{where}: a second signal of {x.input!r}; give it one")
        if x.input in start.numbers:
            both = f"[initial] {x.input} and this both say what the input is"
            raise ProblemError(f"{where}: {both}; leave out one")
        if len(x.times or ()) != len(x.samples or ()):
            count = f"{len(x.times or ())} times and {len(x.samples or ())} values"
            raise ProblemError(f"{where}: {count}; give a value for each time")
        for t in x.trees():
            _require_declared(t, where, reader, "t" if x.u is not None else "")
        _require_increasing(x, where, reader)
        found.append(x)
    return tuple(found)


def _require_increasing(x: Signal, where: str, reader: FileReader) -> None:
    """The times of a signal begin at 0, or before, and increase for the defaults of the parameters;
    of those without a default nothing is known."""
    known = defaults(reader.parameters)
    times = [approximate(t, known, float) for t in x.times or ()]
    if times and times[0] is not None and times[0] > 0:
        raise ProblemError(f"{where}, times: the first is {times[0]:g}: a motion begins at t = 0")
    for k, (before, t) in enumerate(pairwise(times), 2):
        if before is not None and t is not None and not t > before:
            told = f"number {k}, {t:g}, does not come after {before:g}"
            raise ProblemError(f"{where}, times: {told}; give times that increase")


def named(problem: Problem) -> set[str]:
    """The names in the expressions of start, events and signals, parameters among them."""
    listed = (*problem.events, *problem.signals)
    trees = [*problem.initial.trees(), *(t for x in listed for t in x.trees())]
    return {name for t in trees for name in names(t)}


def _initial(table: Any, reader: FileReader) -> Initial:
    if not isinstance(table, dict):
        raise ProblemError("key 'initial' must be a table [initial]")
    found = _turned(table, reader)
    for name, value in table.items():
        if name == "exp" or TURNED.fullmatch(name):
            continue
        where = f"initial, {name[:40]}"
        if name in reader.parameters:
            raise ProblemError(f"{where}: a parameter has its default in [parameters]")
        if isinstance(value, list):
            first, second = (f"{name[:40]}_{k} = …" for k in (1, 2))
            lists = f"exp, {', '.join(ROTATION_KEYS)}"
            known = f"one number each, {first}, {second}; lists are {lists}{hint(name, ())}"
            raise ProblemError(f"{where}: {known}")
        called = str(reader.by_block.get(name, name))
        if called != name and called in table:
            raise ProblemError(f"{where}: the same number as {called}; leave out one")
        found[reader.identifier(called, where)] = _number(value, where, reader)
    where, exp = "initial, exp", table.get("exp", [])
    if not isinstance(exp, list):
        raise ProblemError(f"{where}: expected a list, the coordinates in the basis of 𝔤")
    if reader.group and reader.advected is None and len(exp) not in (0, reader.group.dimension):
        count = reader.group.dimension
        raise ProblemError(
            f"{where}: expected {count} coordinates in the basis, not {len(exp)}; their order is "
            f"that of {_order(reader)}"
        )
    return Initial(found, tuple(_number(x, where, reader) for x in exp))


def _number(value: Any, where: str, reader: FileReader) -> Tree:
    """An expression of the parameters."""
    found = reader.expression(value, where)
    _require_declared(found, where, reader)
    return found


def _require_declared(t: Tree, where: str, reader: FileReader, time: str = "") -> None:
    for name in names(t):
        if name not in reader.parameters and name != time:
            near = nearest(name, reader.parameters)
            raise ProblemError(f"{where}: {name[:40]!r} is not declared in [parameters]{near}")


def _turned(table: Mapping[str, Any], reader: FileReader) -> dict[str, Tree]:
    """The entries of A by the rotation that a start says, or of A1, A2, … of a product by those of
    its blocks; none where it says none."""
    group = None if reader.advected is not None else reader.group
    places = group.places if group else ()
    marks = [str(k) for k in range(1, len(places) + 1)] if len(places) > 1 else [""]
    found: dict[str, Tree] = {}
    for k, mark in enumerate(marks):
        own = {x: table[x + mark] for x in ROTATION_KEYS if x + mark in table}
        name, said = turn_in(own, f"initial{f', block {mark}' if mark else ''}")
        if name:
            turns = bool(places) and places[k][1].turns_space
            found |= _entries_turned(table, name, mark, said, reader, turns=turns)
    for name in table:
        if len(marks) > 1 and name in ROTATION_KEYS:
            blocks = f"{name}1 … {name}{marks[-1]}"
            raise ProblemError(f"initial, {name}: say of which block of the product, {blocks}")
    return found


def _entries_turned(
    table: Mapping[str, Any], name: str, mark: str, said: Any, reader: FileReader, *, turns: bool
) -> dict[str, Tree]:
    """Those of A, or of a block, by a rotation that is said under a key ``name`` with the ``mark``
    of the block; does this turn R³?"""
    where, A = f"initial, {name}{mark}", f"A{mark}"
    if not turns:
        whose = f"block {mark}" if mark else "the state"
        plane = not mark and reader.group is not None and reader.group.name in ("SO(2)", "SE(2)")
        rest = [0] * (reader.group.dimension - 1) if plane and reader.group else []
        how = f"exp = {['angle', *rest]}".replace("'", "") if plane else "its numbers"
        raise ProblemError(f"{where}: {whose} has no rotation of R^3; give {how}")
    if other := next((x for x in table if x == "exp" or x.startswith(f"{A}_")), ""):
        both = f"{name}{mark} and {other} both say where the body is"
        raise ProblemError(f"initial: {both}; leave out one")
    of_block = f"initial, block {mark}" if mark else "initial"
    rows = reader.turned(said, 3, where if name == "rotation" else of_block)
    entries = {suffixed(A, i, j): x for i, r in enumerate(rows, 1) for j, x in enumerate(r, 1)}
    for x in entries.values():
        _require_declared(x, where, reader)
    return entries


def _order(reader: FileReader) -> str:
    """The basis of the Lie algebra in words."""
    group = reader.moving()
    d, n = group.dimension, group.n
    if group.free_translations:
        return f"E_1 … E_{d}, the linear parts first, then the {n} translations"
    return f"E_1 … E_{d}" if d > 1 else "E_1"


# Which names of [initial] and [[event]] does the state of a problem lack?  Told with the walk: a
# program, which would refuse them, takes seconds to make.


def faults(problem: Problem) -> Iterator[str]:
    """A line for each name that the state has not; none where no names are known, as of a torus."""
    if problem.group is None:
        return
    known = numbers_followed(problem, problem.group)
    for name in problem.initial.numbers:
        if name not in known:
            near = called_here(name[:40], known, problem.group) or hint(name[:40], known)
            told = f"the state has no such number{near}; it has {entries(known)}"
            yield f"initial, {name[:40]}: {told}"
    watched = {*known, *known_in_lagrangian(problem.group, problem.advected), *problem.parameters}
    watched |= of_other_forms(problem.group)
    watched |= {name for x in problem.outputs for name in problem.numbers_of_output(x)}
    for k, event in enumerate(problem.events, 1):
        for name in dict.fromkeys(names(event.when)):
            if name not in watched:
                near = called_here(name[:40], known, problem.group, known)
                told = f"the state has no {name[:40]}{near}; it has {entries(known)}"
                yield f"event {k}, when: {told}"


def numbers_followed(problem: Problem, group: Group) -> list[str]:
    """The numbers of the state, those of g that never change among them, and of the inputs."""
    inputs = (name for x in problem.inputs for name in problem.numbers_of(x))
    return [*numbers_of_state(problem, group), *inputs]


def named_twice(problem: Problem) -> str:
    """That a number of the state is a parameter, or one of an input, or a signal that of none, in
    words; "" where none is."""
    if problem.group is None and problem.torus is None:
        return ""
    group = problem.group
    state = {*numbers_of_state(problem, group), *names_by_block(group).values()} if group else set()
    state |= {*problem.torus.coefficients} if problem.torus else set()
    if clash := next(filter(state.__contains__, problem.parameters), ""):
        return f"parameter {clash!r}: a number of the state; choose another name"
    for k, x in enumerate(problem.inputs, 1):
        if clash := next(filter(state.__contains__, problem.numbers_of(x)), ""):
            told = f"{clash!r} is one of its numbers, and of the state as well"
            return f"input {k}, {x.name!r}: {told}; choose another name"
    inputs = [name for x in problem.inputs for name in problem.numbers_of(x)]
    for k, z in enumerate(problem.signals, 1):
        if z.input not in inputs:
            near = nearest(z.input, inputs) or f"; there is {entries(inputs)}"
            return f"signal {k}: no number of an input {z.input!r}{near}"
    acting = [
        (f"force {k}, {x.name!r}", (x.name or "", *x.numbers()))
        for k, x in enumerate(problem.forces, 1)
    ]
    read = [
        (f"output {k}, {y.name!r}", (y.name, *problem.numbers_of_output(y)))
        for k, y in enumerate(problem.outputs, 1)
    ]
    for where, called in (*acting, *read):
        if clash := next(filter(state.__contains__, called), ""):
            return f"{where}: {clash!r} is of the state; choose another name"
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
    shift = by_points(group)
    return [shift.get(x, x) for x in state_names(group) if x != "t"]


def of_other_forms(group: Group) -> set[str]:
    """Those of the state in a form that can be emitted beside: dg/dt, charts of factors."""
    found = {f"{x}_dot" for x in state_names(group) if x[:2] in ("A_", "T_")}
    return found | {*chart_names(group.in_user_basis)}
