"""Where a motion starts: an element of the group, a velocity, parameters, inputs, inertia."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..code.emit import problem_hash
from ..code.program import Program
from ..language import rational as q
from ..language.derivatives import derivative
from ..language.tree import Tree, replaced
from ..language.values import approximate, value
from ..problem.problem import Problem
from ..record.record import Derivation
from ..schema.body_kinds import Body
from ..schema.kind import Lagrangian
from .first_numbers import TIME, MotionError, drives, first_numbers
from .run import Array, Run, known, read

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
        signals = {x.input for x in problem.signals}
        inputs = {x: v for x, v in facts.get("inputs", {}).items() if x not in signals}
        what = "signals" if signals else "equations"
        timed = signals or TIME in drives(record.problem or {}, {})
        told = f"its {what} depend on t, which begins again at 0" if timed else ""
        return {**facts.get("parameters", {}), **inputs, **state}, told
    other, group = facts.get("problem", "?"), facts.get("group", "?")
    whose = f"a run of {other!r}, not of {problem.name!r}"
    if other == problem.name:
        whose = f"a run of another {other!r}, as the file was then"
    if group != problem.group_name:
        raise MotionError(f"{whose}: it moves by {group}, this by {problem.group_name}")
    return state, f"{whose}: its state alone is taken, not its parameters and inputs"


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
