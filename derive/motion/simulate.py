"""From a start to a run: steps until the last instant, then what the motion keeps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from ..code.step.step_numbers import parts
from ..language.expression import names
from ..language.show import show
from ..language.tree import Tree, nodes, replaced
from ..language.values import approximate
from ..problem.inertia import defaults, fault_of_quadrics, metric_is_positive
from ..problem.problem import Problem, points_of
from ..schema.body_kinds import GivenBody, PointBody, by_block
from ..schema.potential_kinds import Attraction, Spring
from .emitted import Emitted
from .emitted_code import Column
from .first_numbers import MotionError, drives
from .native import CompileError, Motion
from .run import Array, Run
from .signals import Given, InputsInTime, inputs_in_time
from .start import OFF_THE_GROUP, Start, start
from .trajectory import (
    INTERRUPTED,
    Method,
    Trajectory,
    instants,
    not_near,
    reflection,
    taken_to_group,
    why_unreached,
)

LONG, TURN = 500, 2.0
"""A motion of more steps is compiled, where there is a compiler; in a step for a tolerance no part
of the state changes by more than about TURN of its size."""

TURNS = 10
"""How many turns are followed, about, where no time is given."""

NEGLIGIBLE, INSTANTS, SEEN, BEFORE = 1e-9, 257, 65, 0.999
"""A mass of a point below 0 by so much of its first size is 0 but for rounding; the instants of a
motion at which masses are looked at, and at which the metric of all is; how near to the end of a
mass an event is waited for."""

CHUNKS = 200
"""The parts of a run between which it can be stopped and its progress is shown."""

Progress = Callable[[Iterable[Any], int], Iterator[Any]]


def run(
    code: Emitted,
    problem: Problem,
    method: Method,
    duration: float | None,
    points: int,
    *,
    given: Mapping[str, float],
    exponent: Sequence[float] = (),
    project: bool = False,
    compiled: bool | None = None,
    progress: Progress = lambda parts, _: iter(parts),
    inputs: Given | None = None,
    linear: bool = False,
) -> Run:
    """The motion of a problem from 0 to ``duration``, for ``None`` :func:`some_turns`, from
    :func:`start`, as a table; by C or by Python, or, for ``None``, by C where that pays and there
    is a compiler; with the signals of the problem and ``inputs`` in time, as
    :func:`.signals.inputs_in_time` takes them."""
    if duration is not None:
        instants(method, duration, points)  # refused before the start is looked at
    begin = beginning(code, problem, given=given, exponent=exponent, project=project)
    duration = some_turns(code, begin) if duration is None else duration
    times = instants(method, duration, points)
    named, numbers = code.program.inputs, begin.parameters
    driven = inputs_in_time(problem, named, begin.u, numbers, given, inputs, linear=linear)
    begin = replace(begin, u=driven.at(0.0, begin.x)) if driven else begin
    follow = following(code, begin, method, duration, compiled, driven)
    used_up = require_mass(code, problem, begin, duration)
    if used_up <= duration:  # an event is to end the motion before
        times = np.append(times[times < BEFORE * used_up], BEFORE * used_up)
    found = simulate(code, begin, method, times, follow, progress)
    if used_up <= duration and not found.ended:
        require_mass(code, problem, begin, duration, ends=False)
    require_mass_left(code, problem, found)
    return found


def following(
    code: Emitted,
    begin: Start,
    method: Method,
    duration: float,
    compiled: bool | None = None,
    driven: InputsInTime | None = None,
) -> Trajectory:
    """The motion at its begin; ``CompileError`` where C is asked for and there is no compiler."""
    k, u = code.constants(begin.p), begin.u
    ends = {x.name: x.terminal for x in code.events}
    if compiled is not False and (compiled or is_long(code, k, begin, method, duration)):
        try:
            motion = code.motion(k, u, begin.x, compiled=True)
        except CompileError:
            if compiled:
                raise
        else:
            return Trajectory(motion, method, ends, driven)
    return Trajectory(code.motion(k, u, begin.x, compiled=False), method, ends, driven)


def is_long(code: Emitted, k: Array, begin: Start, method: Method, duration: float) -> bool:
    """Does the Python take longer for a motion than a compiler for its C?"""
    if method.dt:
        return duration / method.dt > LONG
    fastest = max((rate / size for size, rate in speeds(code, k, begin) if size), default=0.0)
    return bool(duration * fastest / TURN > LONG)


def speeds(code: Emitted, k: Array, begin: Start) -> list[tuple[float, float]]:
    """Of each part of the state at the start its size, and that of its rate."""
    dx = np.abs(code.python.rhs(0.0, begin.x, k, begin.u))
    return [(np.abs(begin.x[a:b]).max(), dx[a:b].max()) for a, b in parts(code.program)]


def some_turns(code: Emitted, begin: Start) -> float:
    """The time of TURNS turns at the rates of the start, or of swings that begin at rest there, to
    one digit; 10 where nothing moves."""
    measured = speeds(code, code.constants(begin.p), begin)
    fastest = max(rate / size if size else math.sqrt(rate) for size, rate in measured)
    return float(f"{2 * math.pi * TURNS / fastest:.0e}") if fastest else 10.0


def beginning(
    code: Emitted,
    problem: Problem,
    *,
    given: Mapping[str, float],
    exponent: Sequence[float] = (),
    project: bool = False,
) -> Start:
    """From :func:`start`, on the group, with rates that are finite; ``MotionError`` for no such."""
    begin = on_the_group(code, start(code.program, problem, given, exponent), project=project)
    if fault := fault_of_quadrics(problem.body, begin.parameters, "these parameters"):
        raise MotionError(f"{code.name}: {fault}")
    require_values(code, begin)
    k = _constants(code, problem, begin)
    if not has_inertia(code, problem, begin.x, begin.p):
        state = dict(zip(code.program.state, begin.x, strict=True))
        masses = ", ".join(f"{x} = {state[x]:g}" for x in problem.stored)
        told = f"the mass matrix is singular or not positive at the start, with {masses}"
        raise MotionError(f"{code.name}: {told}")
    with np.errstate(all="ignore"):
        rates = code.python.rhs(0.0, begin.x, k, begin.u)
        energy = float(code.python.energy(0.0, begin.x, k))
    if not (np.isfinite(rates).all() and math.isfinite(energy)):
        why = why_not_finite(problem, begin, energy)
        raise MotionError(f"{code.name}: the equations have no finite value at the start: {why}")
    return begin


def require_mass(
    code: Emitted, problem: Problem, begin: Start, duration: float, *, ends: bool = True
) -> float:
    """The time at which a mass that flows is used up, or the metric of what is left no longer
    positive, within a motion or never; ``MotionError`` says it, unless an event may end the motion
    before (``ends``)."""
    if not problem.flows:
        return math.inf
    assert isinstance(problem.body, PointBody | GivenBody)
    found = [(_used_up(x.mass, begin, duration), show(x.mass)) for x in points_of(problem.body)]
    whole = [x.moments().m for x in by_block(problem.body).values()]
    found += [(_used_up(x, begin, duration, whole=True), "") for x in whole]
    when, mass = min(found)
    told = f"the mass {mass} of a point" if mass else "the mass of the body"
    told += " is used up"
    # where a mass is used up the metric may be singular, which says less
    until = min(duration, BEFORE * when)
    if (singular := _without_inertia(problem, begin, until)) <= until:
        when, told = singular, "the mass matrix is singular or not positive"
    if when <= duration and not (ends and any(x.terminal for x in code.events)):
        raise MotionError(
            f"{code.name}: {told} at t = {when:.6g}, and the motion is to go on to "
            f"t = {duration:g}: let it end before, by --t or a terminal [[event]]"
        )
    return when


def require_mass_left(code: Emitted, problem: Problem, run: Run) -> None:
    """``MotionError`` where a mass that is of the state went below 0 in a run."""
    masses = [(f"{show(x.mass)} of a point", x.mass) for x in points_of(problem.body)]
    masses += [(x, ("par", x)) for x in problem.stored]
    for i, t in enumerate(run.t.tolist() if problem.stored else ()):
        known = {**run.facts["parameters"]} | {x: float(run[x][i]) for x in problem.stored}
        for told, mass in masses:
            left = approximate(replaced(mass, "t", Fraction(t)), known, float) or 0.0
            if left < -NEGLIGIBLE:
                raise MotionError(
                    f"{code.name}: the mass {told} is used up before t = {t:.6g}: "
                    "let an input be 0 then, or a terminal [[event]] end the motion, as when = "
                    f'"{next(iter(problem.stored))}"'
                )


def _used_up(mass: Tree, begin: Start, duration: float, *, whole: bool = False) -> float:
    """The first time at which a mass is negative, or, of the ``whole``, 0; infinite for none, and
    where masses of the state are in it."""

    def left(t: float) -> float:
        return approximate(replaced(mass, "t", Fraction(t)), begin.parameters, float) or 0.0

    if "t" not in nodes(mass) or not {*names(mass)} <= {*begin.parameters}:
        return math.inf
    least = 0.0 if whole else -NEGLIGIBLE * abs(left(0.0))
    return _first(lambda t: left(t) <= least, duration)


def _without_inertia(problem: Problem, begin: Start, duration: float) -> float:
    """The first time at which the metric of moments that are functions of the time is not positive;
    infinite for none, and where masses of the state are in it."""
    body, known = problem.body, {**defaults(problem.parameters), **begin.parameters}
    each = by_block(body).values() if body is not None else ()
    trees = [y for x in each for y in x.moments().trees()]
    used = {x for y in trees for x in names(y)}
    if body is None or not any("t" in nodes(x) for x in trees) or {*problem.stored} & used:
        return math.inf
    return _first(
        lambda t: not metric_is_positive(problem.own_group, body, known, t), duration, SEEN
    )


def _first(fails: Callable[[float], bool], duration: float, instants: int = INSTANTS) -> float:
    """The first time after 0, to rounding, at which something fails that then fails at one of some
    instants; infinite for none."""
    times: list[float] = np.linspace(0.0, duration, instants).tolist()
    late = next((b for b in times[1:] if fails(b)), None)
    if late is None:
        return math.inf
    early = late - times[1]
    while early < (middle := (early + late) / 2) < late:
        early, late = (early, middle) if fails(middle) else (middle, late)
    return late


def _constants(code: Emitted, problem: Problem, begin: Start) -> Array:
    """k of the start; ``MotionError``, with the negative masses, where no body has them."""
    try:
        return code.constants(begin.p)
    except MotionError as error:
        masses = [x.mass for x in points_of(problem.body)]
        found = [(show(m), approximate(m, begin.parameters, float)) for m in masses]
        wrong = [f"{name} = {m:g}" for name, m in found if m is not None and m < 0]
        why = f": a mass is negative, {', '.join(wrong)}" if wrong else ""
        raise MotionError(f"{error}{why}") from None


def has_inertia(code: Emitted, problem: Problem, x: Array, p: Array) -> bool:
    """Is the metric positive at a start, of masses of the state, which ``constants`` does not
    know?"""
    if not problem.stored or problem.body is None:
        return True
    emitted = [x[0] for x in code.program.parameters]
    numbers = zip((*emitted, *code.program.state), (*p, *x), strict=True)
    values = {**defaults(problem.parameters), **dict(numbers)}
    return metric_is_positive(problem.own_group, problem.body, values)


def require_values(code: Emitted, begin: Start) -> None:
    """``MotionError`` for an event in which nothing is finite at the start."""
    listed = zip((*code.program.inputs, *code.program.state), (*begin.u, *begin.x), strict=True)
    numbers = {**begin.parameters, **dict(listed)}
    if code.program.outputs and code.events:
        k = code.constants(begin.p)
        with np.errstate(all="ignore"):
            read = code.python.outputs(0.0, begin.x, k, begin.u)
        numbers |= dict(zip(code.program.outputs, read.tolist(), strict=True))
    for event in code.events:
        found = approximate(replaced(event.when, "t", 0), numbers, float)
        if found is None or not math.isfinite(found):
            raise MotionError(f"{code.name}: event {event.name}: no finite value at the start")


def on_the_group(code: Emitted, begin: Start, *, project: bool) -> Start:
    """The start, taken to the group where that is asked for; ``MotionError`` where it is off."""
    if "defect" not in code.program.functions:
        return begin
    x, blocks = begin.x, code.program.blocks
    if fault := reflection(blocks, x):
        raise MotionError(f"{code.name}: the start is not on the group: {fault}")
    if project:
        x = taken_to_group(code.python.project, blocks, x)
    with np.errstate(all="ignore"):
        off = float(code.python.defect(x))
    if not off <= OFF_THE_GROUP:
        told = f"not taken to the group: {why_unreached(blocks, begin.x)}"
        if not project:
            near = not_near(blocks, x) or "--project takes it there"
            told = f"not on the group: {near}; its defect is {off:.3g}"
        raise MotionError(f"{code.name}: the start is {told}")
    if fault := reflection(blocks, x):
        raise MotionError(f"{code.name}: the start is not taken to the group: {fault}")
    return replace(begin, x=x)


def simulate(
    code: Emitted,
    begin: Start,
    method: Method,
    times: Array,
    follow: Trajectory,
    progress: Progress,
) -> Run:
    """The run of a problem; one that must stop, or that Ctrl-C or a terminal event stops, keeps
    what is done, and ``run.ended`` says why; ``MotionError`` where there is no first step."""
    k = code.constants(begin.p)
    chunks = np.array_split(times[1:], min(CHUNKS, len(times) - 1))
    states, ended = [begin.x[None]], ""
    try:
        for part in progress(iter(chunks), len(chunks)):
            found, ended = follow.reach(part)
            states.append(found)
            if ended:
                break
    except KeyboardInterrupt:  # between two parts
        ended = INTERRUPTED
    x = np.concatenate(states)
    t = times[: len(x)]
    if (last := behind(follow, t, ended)) is not None:
        t, x = np.append(t, last[0]), np.append(x, last[1][None], axis=0)
    elif len(x) == 1 and ended not in ("", INTERRUPTED) and not follow.happened:
        raise MotionError(f"{code.name}: {ended}")
    u = begin.u
    if follow.driven is not None:
        u = np.array([follow.driven.at(*pair) for pair in zip(t.tolist(), x, strict=True)])
    inputs = dict(zip(code.program.inputs, np.atleast_2d(u)[-1].tolist(), strict=True))
    largest = dict(zip(inputs, np.abs(np.atleast_2d(u)).max(axis=0).tolist(), strict=True))
    columns, table = code.columns(), code.table(t, x, k, u)
    if follow.driven is not None:
        columns += tuple(Column(name, "input", "") for name in inputs)
        table = np.column_stack([table, u])
    facts = {
        **code.facts,
        "parameters": dict(begin.parameters),
        "inputs": inputs,
        "drives": drives(code.record.problem or {}, largest, begin.parameters),
        "method": str(method),
        "language": "C" if isinstance(follow.motion, Motion) else "Python",
        "evaluations": follow.motion.evaluations,
        "ended": ended,
        "vanishing": code.vanishing(k),
        "events": [one.plain() for one in follow.happened],
        "body": code.body(begin.p),
        "potential": code.potential(table, begin.parameters),
    }
    there = [k for k, y in enumerate(table.T) if not np.isnan(y).all()]  # along 0 there is none
    return Run(tuple(columns[k] for k in there), table[:, there], facts)


def behind(follow: Trajectory, t: Array, ended: str) -> tuple[float, Array] | None:
    """Time and state of a last row behind the instants t: where Ctrl-C stopped the motion, or it
    must stop before an instant, or its last event, that no event lies behind the table."""
    ends = [(x.t, x.state) for x in follow.happened[-1:]]
    if ended == INTERRUPTED or (ended and len(t) == 1):
        ends.append((follow.motion.t, follow.motion.x))
    return next(((when, x) for when, x in reversed(ends) if when > t[-1]), None)


# Why the equations have no finite value at a start, as far as can be told, in words.

LARGE = 1e60
"""Products of a few numbers that are larger leave the range of doubles, 1e308."""


def why_not_finite(problem: Problem, begin: Start, energy: float) -> str:
    """The reason that fits: numbers too large, the function itself, ∂²ℓ/∂Z², or a collision.

    ``energy``: that of the start.
    """
    largest = max((*begin.parameters.values(), *begin.u, *begin.x), key=abs, default=0.0)
    if abs(largest) > LARGE:
        return f"its numbers are too large, as {largest:g}"
    given, finite = problem.lagrangian, math.isfinite(energy)
    if given is not None:
        if finite:
            return "the second derivative of L in the velocity is singular there"
        return "L has no finite value there, as the root of a negative number or a division by 0"
    kinds = {type(x) for x in problem.potentials}
    if Spring in kinds:
        return "look at the state, as two ends of a spring at one place"
    if Attraction in kinds:
        return "look at the state, as a mass at the centre of attraction"
    if finite:
        return "the mass matrix is singular there, or a force is not finite"
    return "a potential has no finite value there, as the root of a negative number"
