"""Where a motion starts: an element of the group, a velocity, parameters, inputs."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..code.program import Program
from ..problem.problem import Problem
from .first_numbers import MotionError, first_numbers
from .run import Array
from .run_files import known, read

__all__ = ("OFF_THE_GROUP", "MotionError", "Start", "start", "state_file")

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


def state_file(path: Path) -> dict[str, float]:
    """Name → number, of a TOML file of such pairs, or of the last instant of a run."""
    if known(path.name):
        run = read(path)
        if not len(run.table):
            raise MotionError(f"{path}: a run of no instants")
        return {name: float(column[-1]) for name, column in run.of_kind("state").items()}
    try:
        found: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise MotionError(f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise MotionError(f"{path}: {error}") from None
    for name, number in found.items():
        if type(number) not in (int, float):
            raise MotionError(f"{path}: {name[:40]} must be a number, as zeta_1 = 0.5")
    return {name: float(number) for name, number in found.items()}
