"""The numbers that a motion starts with, as lists, :class:`.Start` has them as arrays; and what
changes its energy then, or the kinetic energy, which is kept where nothing does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, NamedTuple, SupportsFloat

from ..algebra.factor_charts import QUATERNION
from ..algebra.groups import Group
from ..code.program import Program
from ..code.slots import horn
from ..code.torus_program import turned
from ..language import rational as q
from ..language.expression import names
from ..language.limits import Refused
from ..language.rational import Matrix
from ..language.tree import Tree
from ..language.values import approximate
from ..problem.fields import called_here, element, entry_places
from ..problem.motion_tables import named
from ..problem.problem import Problem
from ..record.as_json import decode

DAMPING, TIME, INPUTS, FORCES = "damping", "the time", "inputs", "forces"


def drives(
    problem: Mapping[str, Any],
    inputs: Mapping[str, float],
    parameters: Mapping[str, float] | None = None,
) -> list[str]:
    """What changes it, in the problem of a record, by held inputs and for some numbers of the
    ``parameters``, any where there are none: damping, the time where it stands in U or ℓ by itself,
    inputs that are not 0, forces of the state."""
    numbers = parameters or {}
    forces = (decode(x["coefficient"], "problem") for x in problem.get("damping") or ())
    damped = any(approximate(t, numbers, float) != 0 for t in forces)
    zero = [["par", name] for name, x in numbers.items() if x == 0]
    timed = _timed([problem.get(x) for x in ("potentials", "lagrangian")], zero)
    there = {DAMPING: damped, TIME: timed, INPUTS: any(inputs.values())}
    there[FORCES] = bool(problem.get("forces") or problem.get("flows"))
    return [what for what, is_there in there.items() if is_there]


def weight(problem: Mapping[str, Any]) -> list[Any]:
    """The entries of all accelerations of gravity in the problem of a record, as JSON has them; 1
    for one that depends on the time."""
    given = (p["g"] for p in problem.get("potentials") or () if p["kind"] == "gravity")
    return [1 if _timed(x, ()) else x for g in given for x in g]


def is_weightless(problem: Mapping[str, Any], given: Mapping[str, float]) -> bool:
    """Has the problem of a record gravity, which is 0 for some numbers of the parameters, the
    others at their defaults?"""
    numbers = {name: x.get("default") for name, x in problem.get("parameters", {}).items()}
    known = {name: x for name, x in {**numbers, **given}.items() if x is not None}
    entries = [decode(x, "problem") for x in weight(problem)]
    return bool(entries) and all(approximate(t, known, float) == 0 for t in entries)


def is_free(problem: Mapping[str, Any]) -> bool:
    """Does a motion keep the kinetic energy, as nothing can act on the body?"""
    acting = any(problem.get(x) for x in ("potentials", "inputs", "damping", "forces", "flows"))
    return not acting and not _anywhere(problem.get("lagrangian"), _placed)


def _anywhere(data: Any, found: Callable[[Sequence[Any]], bool]) -> bool:
    """Is there a list in data of a record that is ``found``?"""
    if isinstance(data, dict):
        return any(_anywhere(x, found) for x in data.values())
    if not isinstance(data, list | tuple):
        return False
    return found(data) or any(_anywhere(x, found) for x in data)


def _placed(x: Sequence[Any]) -> bool:
    """Does it tell where a body is: an entry of g, or of a vector that it carries?"""
    return [*x[:1]] == ["entry"] and x[1] != "ζ"


def _timed(data: Any, zero: Sequence[Any]) -> bool:
    """Does the time stand in data of a record, but as what a place r(t) depends on, and in products
    with a parameter that is ``zero``?"""
    if isinstance(data, dict):
        return any(_timed(x, zero) for x in data.values())
    if isinstance(data, list | tuple):
        vanishes = [*data[:1]] == ["mul"] and any(x in zero for x in data)
        return [*data[:1]] != ["call"] and not vanishes and any(_timed(x, zero) for x in data)
    return bool(data == "t")


class MotionError(Refused, ValueError):
    """A motion that cannot be started, or no method of it: the message says what to do."""


class FirstNumbers(NamedTuple):
    """The state, the parameters and the inputs in the order of the emitted code; all parameters by
    name, with those that only [initial] and [[event]] have."""

    x: list[float]
    p: list[float]
    u: list[float]
    parameters: Mapping[str, float]


def first_numbers(
    program: Program,
    problem: Problem,
    given: Mapping[str, float],
    exponent: Sequence[float] = (),
) -> FirstNumbers:
    """The start with some numbers ``given``, of the state, the parameters and the inputs by name;
    the element of the group is exp of ``exponent``, coordinates in the basis of 𝔤.

    ``MotionError`` for a name that means nothing, a parameter without a number, a number that is
    none.
    """
    given = program.by_state(given, MotionError)
    emitted = {name: default for name, default, _, _ in program.parameters}
    stored = {name: problem.parameters[name].default for name in problem.stored}
    apart = {name for name in named(problem) if name in problem.parameters} - {*stored}
    defaults = emitted | {x: problem.parameters[x].default for x in sorted(apart - {*emitted})}
    zero = dict.fromkeys((*program.inputs, *program.matrix_state, *program.state), 0.0)
    values: dict[str, float | None] = {**defaults, **zero, **stored}
    _known(values, given, program.name, program, problem.group)
    values |= {name: x for name, x in given.items() if name in defaults}
    numbers, stated = _initial_numbers(problem, values)
    _known(zero, numbers, f"{program.name}, [initial],", program, problem.group)
    element = _at(problem, program, exponent if len(exponent) else stated)
    if len(exponent):
        if all(name in given for name in element):
            first = next(iter(element))
            raise MotionError(
                f"{program.name}: exp and {first}, … both say where the body is: leave out one"
            )
        numbers = {name: x for name, x in numbers.items() if name not in element}
    values |= element | numbers | dict(given)
    missing = [name for name, value in values.items() if value is None]
    if missing:
        raise MotionError(
            f"{program.name}: no value for {', '.join(missing)}: give --set {missing[0]}=NUMBER"
        )
    found = {name: float(value) for name, value in values.items() if value is not None}
    if program.charts:
        by_charts = _by_charts(program, problem, found)
        found |= {x: y for x, y in by_charts.items() if x not in numbers and x not in given}
    x, p, u = (
        [found[name] for name in listed] for listed in (program.state, emitted, program.inputs)
    )
    return FirstNumbers(x, p, u, {name: found[name] for name in defaults})


def require_numbers(given: Any, exponent: Any, **single: Any) -> None:
    """``MotionError`` for what is no number by name, no list of numbers, or no number or ``None``,
    as Python may give them."""
    if not isinstance(given, Mapping | None):
        raise MotionError('start: expected numbers by name, as {"zeta_1": 0.5}')
    if isinstance(exponent, str) or not isinstance(exponent, Iterable):
        raise MotionError("exp: expected a list of numbers")
    named = [*single.items(), *(given or {}).items(), *(("exp", x) for x in exponent)]
    for name, x in named:
        if not (isinstance(x, SupportsFloat) or (x is None and name in single)):
            raise MotionError(f"{name}: expected a number, not {x!r:.40}")


def _known(
    values: Collection[str],
    given: Mapping[str, float],
    where: str,
    program: Program,
    group: Group | None,
) -> None:
    """``MotionError`` for a name that means nothing, and for a number that is none."""
    for name, number in given.items():
        if name not in values:
            near = f"{called_here(name, values, group, values, ';')} ".removeprefix("; ").lstrip()
            if components := [x for x in values if x.startswith(f"{name}_")]:
                near = f"give its components {_listed(components)}; "
            if name == "exp":
                near = "a tilt is set by --exp, varied by a parameter that [initial] exp uses; "
            if (other := turned(name)) in values:
                near = f"ω̂(−𝐧) is the conjugate of ω̂(𝐧): give {other}; "
            listed = _listed([*values, *program.by_block])
            raise MotionError(f"{where} has no {name[:40]!r}; {near}its numbers: {listed}")
        if not math.isfinite(number):
            raise MotionError(f"{where}: {name} = {number} is no finite number")


def _initial_numbers(
    problem: Problem, values: Mapping[str, float | None]
) -> tuple[dict[str, float], list[float]]:
    """The numbers and the exponent of [initial], by the values of the parameters."""
    known = {name: x for name, x in values.items() if x is not None}

    def number(name: str, t: Tree) -> float:
        found = approximate(t, known, float)
        if found is None:
            raise MotionError(
                f"{problem.name}: initial, {name}: no finite number for these parameters: "
                f"{', '.join(dict.fromkeys(names(t))) or 'there are none'}"
            )
        return found

    numbers = {name: number(name, t) for name, t in problem.initial.numbers.items()}
    return numbers, [number("exp", t) for t in problem.initial.exp]


def _listed(names: Sequence[str], most: int = 30) -> str:
    """Some names, the first and the last where there are too many for a line."""
    short = [*names] if len(names) <= most else [*names[: most - 1], "…", names[-1]]
    return ", ".join(short)


def _at(problem: Problem, program: Program, exponent: Sequence[float]) -> dict[str, float]:
    """Name → number of the entries of the element of the group, empty where the state has none."""
    group = problem.group
    if group is None or problem.advected is not None:
        if len(exponent):
            raise MotionError(f"{program.name}: its state has no element of a group: no exp")
        return {}
    basis = program.basis
    if len(exponent) not in (0, len(basis)):
        raise MotionError(
            f"{program.name}: exp takes {len(basis)} number{'s' * (len(basis) != 1)}, the "
            f"coordinates in the basis of the Lie algebra, not {len(exponent)}"
        )
    span = range(len(basis[0]))
    terms = [*zip(exponent, basis, strict=False)]
    g = exponential([[sum(a * float(E[i][j]) for a, E in terms) for j in span] for i in span])
    listed = program.matrix_state or program.state
    return {x: g[i][j] for x, (i, j) in entry_places(group).items() if x in listed}


def _by_charts(program: Program, problem: Problem, found: Mapping[str, float]) -> dict[str, float]:
    """Name → number of what tells the factors that have charts, by the entries of g; an angle
    between −π and π, but where a shift tells how often it went round."""
    g = tuple(tuple(map(float, row)) for row in element(problem.own_group, found))
    numbers: dict[str, float] = {}
    for chart in program.charts:
        if chart.kind == QUATERNION:
            own = range(chart.offset, chart.offset + chart.size)
            told = _quaternion(tuple(tuple(g[i][j] for j in own) for i in own))
            numbers |= dict(zip(chart.names, told, strict=True))
        for block in chart.blocks:
            if block.growth:
                told = [math.log(block.scaled(g)) / float(block.growth)]
            elif not block.turn:
                told = [*block.logarithm(g)]
            else:
                shift, cosine, sine = block.turned(g)
                angle = math.atan2(sine, cosine) / float(block.turn)
                told = [angle if shift is None else shift]
            numbers |= dict(zip(block.names, told, strict=True))
    return numbers


def _quaternion(R: Matrix) -> list[float]:
    """That of a rotation, its scalar not negative: the longest column of 4 q q̄."""
    columns = [[x + (i == j) for j, x in enumerate(row)] for i, row in enumerate(horn(R))]
    longest = max(columns, key=lambda x: math.hypot(*x))
    scale = math.copysign(math.hypot(*longest), longest[0])
    return [x / scale for x in longest]


def exponential(X: Sequence[Sequence[float]]) -> Matrix:
    """The exponential of a matrix: Taylor's series of X/2ˢ, of norm below ½, squared s times."""
    size = max(sum(abs(x) for x in row) for row in X)
    halvings = max(0, math.ceil(math.log2(size)) + 1) if size > 0 else 0
    span = range(len(X))
    term: Matrix = tuple(tuple(float(i == j) for j in span) for i in span)
    total = term
    for k in range(1, 18):  # 2^-17/17! is below rounding
        term = q.times(term, [[x / (2**halvings * k) for x in row] for row in X])
        total = q.plus(total, term)
    for _ in range(halvings):
        total = q.times(total, total)
    return total
