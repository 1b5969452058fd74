"""Which inputs and velocities keep a state as it is: exact, or within bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...code.program import Program
from ...language.univariate import Number, RootError
from ...problem.problem import Problem
from .enclosed_trim import EnclosedQuestion
from .exact_trim import ExactQuestion
from .steady_velocity import NotExactError, NoTrimError
from .trim import Trim


def trimmed(
    problem: Problem, program: Program, at: Mapping[str, Number], free: Sequence[str] | None = None
) -> Trim:
    """The inputs, velocities and turns of g ``free``, or all inputs that are not given, for a state
    and other inputs: those ``at`` has, else g = 1 and 0; ``program``: with its jacobian.
    ``NoTrimError`` where there is none, or several."""
    try:
        return ExactQuestion(problem, program, at, free).answered()
    except (NotExactError, RootError) as error:
        return EnclosedQuestion(problem, program, at, free).answered(str(error))
    except ZeroDivisionError:
        raise NoTrimError("what acts has no value in this state: it divides by 0") from None
