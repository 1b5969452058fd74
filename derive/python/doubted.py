"""A problem with what may be meant otherwise in it, as warnings of Python."""

from __future__ import annotations

import warnings
from pathlib import Path

from ..problem.problem import Problem


def warned(problem: Problem, *, frames: int = 1) -> Problem:
    """A problem, with a warning for each of its doubts, at the line so many ``frames`` above."""
    from ..problem.doubts import doubts

    for doubt in doubts(problem, {}):
        warnings.warn(f"{problem.name}: {doubt}", stacklevel=frames + 2)
    return problem


def loaded(problem: Problem | str | Path) -> Problem:
    """A problem, one of a file or a ready-made one, of which doubts are told."""
    from ..command.loading import load_problem

    if isinstance(problem, Problem):
        return problem
    return warned(load_problem(str(problem)), frames=2)
