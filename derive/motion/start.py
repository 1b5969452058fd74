"""Where a motion starts: an element of the group, a velocity, parameters, inputs, inertia."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import add, mul
from pathlib import Path
from typing import Any, NamedTuple, SupportsFloat

import numpy as np

from ..code.emit import problem_hash
from ..code.program import Program
from ..code.torus.lattice_state import turned
from ..language import rational as q
from ..language.derivatives import derivative
from ..language.expression import names
from ..language.limits import Refused
from ..language.reserved import did_you_mean, near_name
from ..language.tree import Tree, replaced
from ..language.values import approximate, value
from ..problem.fields import state_names
from ..problem.problem import Problem
from ..problem.stated_motion import named
from ..record.as_json import decode
from ..record.record import Derivation
from ..schema.body_kinds import Body
from ..schema.kind import Lagrangian
from .run import Array, Run, known, read

# The numbers that a motion starts with, as lists; :class:`Start` has them as arrays.
#
# Unless something is said, the element is the identity, the velocity and the inputs are zero, and
# the parameters have their defaults. What [initial] of the problem file says comes first, then
# what is given.


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
    emitted = {name: default for name, default, _, _ in program.parameters}
    apart = {name for name in named(problem) if name in problem.parameters}
    defaults = emitted | {x: problem.parameters[x].default for x in sorted(apart - {*emitted})}
    zero = dict.fromkeys((*program.inputs, *program.state), 0.0)
    values: dict[str, float | None] = {**defaults, **zero}
    _known(values, given, program.name)
    values |= {name: x for name, x in given.items() if name in defaults}
    numbers, stated = _stated(problem, values)
    _known(zero, numbers, f"{program.name}, [initial],")
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


def _known(values: Collection[str], given: Mapping[str, float], where: str) -> None:
    """``MotionError`` for a name that means nothing, and for a number that is none."""
    for name, number in given.items():
        if name not in values:
            near = did_you_mean(near_name(name, [*values]), after=" ")
            if components := [x for x in values if x.startswith(f"{name}_")]:
                near = f"give its components {_listed(components)}; "
            if name == "exp":
                near = "a tilt is set by --exp, varied by a parameter that [initial] exp uses; "
            if (other := turned(name)) in values:
                near = f"ω̂(−𝐧) is the conjugate of ω̂(𝐧): give {other}; "
            raise MotionError(
                f"{where} has no {name[:40]!r}; {near}its numbers: {_listed([*values])}"
            )
        if not math.isfinite(number):
            raise MotionError(f"{where}: {name} = {number} is no finite number")


def _stated(
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
            f"{program.name}: exp takes {len(basis)} numbers, the coordinates in the basis of the "
            f"Lie algebra, not {len(exponent)}"
        )
    span = range(len(basis[0]))
    terms = [*zip(exponent, basis, strict=False)]
    g = exponential([[sum(a * float(E[i][j]) for a, E in terms) for j in span] for i in span])
    places = state_names(group)
    own = {x: t for x in program.state if isinstance(t := places.get(x), tuple) and t[1] == "A"}
    return {name: g[t[2] - 1][t[3] - 1] for name, t in own.items()}


def exponential(X: Sequence[Sequence[float]]) -> list[list[float]]:
    """The exponential of a matrix: Taylor's series of X/2ˢ, of norm below ½, squared s times."""
    size = max(sum(abs(x) for x in row) for row in X)
    halvings = max(0, math.ceil(math.log2(size)) + 1) if size > 0 else 0
    span = range(len(X))
    term = [[float(i == j) for j in span] for i in span]
    total = term
    for k in range(1, 18):  # 2^-17/17! is below rounding
        term = _product(term, [[x / (2**halvings * k) for x in row] for row in X])
        total = [[*map(add, *rows)] for rows in zip(total, term, strict=True)]
    for _ in range(halvings):
        total = _product(total, total)
    return total


def _product(a: Sequence[Sequence[float]], b: Sequence[Sequence[float]]) -> list[list[float]]:
    columns = [*zip(*b, strict=True)]
    return [[sum(map(mul, row, column)) for column in columns] for row in a]


__all__ = ("OFF_THE_GROUP", "MotionError", "Start", "continued", "start", "state_file")

OFF_THE_GROUP = 1e-9
"""A larger defect of a start is taken for a mistake."""


@dataclass(frozen=True)
class Start:
    """The numbers that a motion starts with, in the order of the emitted code; all parameters by
    name, with those that only [initial] and [[event]] have."""

    x: Array
    p: Array
    u: Array
    parameters: Mapping[str, float]


def start(
    program: Program,
    problem: Problem,
    given: Mapping[str, float],
    exponent: Sequence[float] = (),
) -> Start:
    """The start with some numbers ``given``, of the state, the parameters and the inputs by name;
    the element of the group is exp of ``exponent``, coordinates in the basis of 𝔤.

    ``MotionError`` for a name that means nothing, a parameter without a number, a number that is
    none.
    """
    found = first_numbers(program, problem, given, exponent)
    x, p, u = (np.array(numbers) for numbers in found[:3])
    return Start(x, p, u, found.parameters)


def state_file(path: Path, problem: Problem, record: Derivation) -> tuple[dict[str, float], str]:
    """Name → number, of a TOML file of such pairs, or of a run, which is continued, and what is to
    be told of it."""
    if known(path.name):
        try:
            return continued(read(path), problem, record)
        except MotionError as error:
            raise MotionError(f"{path}: {error}") from None
    try:
        found: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise MotionError(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise MotionError(f"{path}: {error}") from None
    for name, number in found.items():
        if type(number) not in (int, float):
            raise MotionError(f"{path}: {name[:40]} must be a number, as zeta_1 = 0.5")
    return {name: float(number) for name, number in found.items()}, ""


def continued(run: Run, problem: Problem, record: Derivation) -> tuple[dict[str, float], str]:
    """The end of a run with its parameters and inputs; of a run of other equations on the group of
    the problem the state alone, and that this is so, in words.  ``MotionError`` for other runs."""
    if not len(run.table):
        raise MotionError("a run of no instants")
    facts, state = run.facts, {x: float(a[-1]) for x, a in run.of_kind("state").items()}
    if facts.get("hash") == problem_hash(record):
        again = "its equations depend on t, which begins again at 0"
        told = again if TIME in drives(record.problem or {}, {}) else ""
        return {**facts.get("parameters", {}), **facts.get("inputs", {}), **state}, told
    other, group = facts.get("problem", "?"), facts.get("group", "?")
    whose = f"a run of {other!r}, not of {problem.name!r}"
    if other == problem.name:
        whose = f"a run of another {other!r}, as the file was then"
    if group != problem.group_name:
        raise MotionError(f"{whose}: it moves by {group}, this by {problem.group_name}")
    return state, f"{whose}: its state alone is taken, not its parameters and inputs"


# What changes the energy of a motion, or the kinetic energy, which is kept where nothing does.

DAMPING, TIME, INPUTS = "damping", "the time", "inputs"


def drives(
    problem: Mapping[str, Any],
    inputs: Mapping[str, float],
    parameters: Mapping[str, float] | None = None,
) -> list[str]:
    """What changes it, in the problem of a record, by held inputs and for some numbers of the
    ``parameters``, any where there are none: damping, the time where it stands in U or ℓ by itself,
    inputs that are not 0."""
    numbers = parameters or {}
    forces = (decode(x["coefficient"], "problem") for x in problem.get("damping") or ())
    damped = any(approximate(t, numbers, float) != 0 for t in forces)
    zero = [["par", name] for name, x in numbers.items() if x == 0]
    timed = _timed([problem.get(x) for x in ("potentials", "lagrangian")], zero)
    there = {DAMPING: damped, TIME: timed, INPUTS: any(inputs.values())}
    return [what for what, is_there in there.items() if is_there]


def weight(problem: Mapping[str, Any]) -> list[Any]:
    """The entries of all accelerations of gravity in the problem of a record, as JSON has them."""
    given = (p["g"] for p in problem.get("potentials") or () if p["kind"] == "gravity")
    return [x for g in given for x in g]


def is_weightless(problem: Mapping[str, Any], given: Mapping[str, float]) -> bool:
    """Has the problem of a record gravity, which is 0 for some numbers of the parameters, the
    others at their defaults?"""
    numbers = {name: x.get("default") for name, x in problem.get("parameters", {}).items()}
    known = {name: x for name, x in {**numbers, **given}.items() if x is not None}
    entries = [decode(x, "problem") for x in weight(problem)]
    return bool(entries) and all(approximate(t, known, float) == 0 for t in entries)


def is_free(problem: Mapping[str, Any]) -> bool:
    """Does a motion keep the kinetic energy, as nothing can act on the body?"""
    acting = any(problem.get(x) for x in ("potentials", "inputs", "damping"))
    return not acting and not _placed(problem.get("lagrangian"))


def _placed(data: Any) -> bool:
    """Does what tells where a body is stand in ℓ, an entry of g or of a vector that it carries?"""
    if isinstance(data, dict):
        return any(map(_placed, data.values()))
    if not isinstance(data, list | tuple):
        return False
    return ([*data[:1]] == ["entry"] and data[1] != "ζ") or any(map(_placed, data))


def _timed(data: Any, zero: Sequence[Any]) -> bool:
    """Does the time stand in data of a record, but as what a place r(t) depends on, and in products
    with a parameter that is ``zero``?"""
    if isinstance(data, dict):
        return any(_timed(x, zero) for x in data.values())
    if isinstance(data, list | tuple):
        vanishes = [*data[:1]] == ["mul"] and any(x in zero for x in data)
        return [*data[:1]] != ["call"] and not vanishes and any(_timed(x, zero) for x in data)
    return bool(data == "t")


# The tensor of inertia of a body of which only its Lagrangian is told.

VELOCITY: tuple[Tree, ...] = tuple(("entry", "ζ", a) for a in (1, 2, 3))
"""The coordinates of Z that turn a body about its axes, in SO(3) and SE(3)."""


def inertia_of(lagrangian: Lagrangian, numbers: Mapping[str, float]) -> Array | None:
    """I of ℓ = ½⟨ζ, Iζ⟩ + …, (3, 3), where the momentum ∂ℓ/∂ζ is Iζ, I positive; ``None`` for
    another ℓ, as that of a gyrostat, of a body that drags a fluid, or of a thin rod."""
    if lagrangian.trivialisation != "left":
        return None
    try:
        momentum = [derivative(lagrangian.L, x) for x in VELOCITY]
        second = [[derivative(p, x) for x in VELOCITY] for p in momentum]
    except ValueError:  # a function that has no derivative
        return None
    rows = [[approximate(t, numbers, float) for t in row] for row in second]
    rest = [approximate(_at_rest(p), numbers, float) for p in momentum]
    if rest != [0, 0, 0] or any(x is None for row in rows for x in row):
        return None
    found = np.array(rows, float)
    return found if bool((np.linalg.eigvalsh(found) > 0).all()) else None


def _at_rest(t: Tree) -> Tree:
    for x in VELOCITY:
        t = replaced(t, x, 0)
    return t


# The tensor of inertia by which a body turns that is free in space, as the walk tells it.

UNIT = "1"


def central_inertia(record: Derivation, body: Body, numbers: Mapping[str, float]) -> Array | None:
    """I_c, (3, 3), by the equations of a record for J_c and for it; ``None`` where that has none,
    as on SO(3), and for a body without mass."""
    told = [(x, record.definition(x)) for x in ("J_c", "I_c")]
    if not all(found for _, found in told):
        return None

    def number(t: Tree) -> float | None:
        return approximate(t, numbers, float)

    own = body.moments()
    known = {
        UNIT: q.identity(3),
        "m": number(own.m),
        "c": tuple((number(x),) for x in own.c),
        "J": tuple(tuple(map(number, row)) for row in own.J),
    }
    if not known["m"]:
        return None
    for x, found in told:
        assert found
        known[x] = value(replaced(found[1].rhs, ("one",), UNIT), known, number=float)
    return np.array(known["I_c"], float)
