"""An error of the engine names the step on whose way it came about."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path

from ..problem.problem import ProblemError

BROKEN = (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError)
"""The errors in which a rule may end that makes something else of an equation."""
SHOWN = 200
"""As many letters of a message are quoted."""


class WalkError(Exception):
    """An error of the engine: one of its rules is wrong, and no problem is at fault."""


@dataclass
class Way:
    """The steps that are begun, with their rules, and the one that was ended last."""

    begun: dict[str, str] = field(default_factory=dict)
    last: str = ""

    def describe(self, error: Exception) -> str:
        """Where on the way an error came about, and what it is, as one text."""
        steps = " or ".join(f"{label} ({rule})" for label, rule in self.begun.items())
        before = f"after the step {self.last}" if self.last else "before the first step of its own"
        place = f"in the step {steps}" if steps else before
        what = f"{type(error).__name__}: {error}"
        return f"{place}, in {_functions(error)}: {what[:SHOWN]}"


def _functions(error: Exception) -> str:
    """The functions of the walk in which an error came about, the innermost last."""
    room, runners = Path(__file__).parent, ("failure", "stages")
    frames = [(Path(x.filename), x.name) for x in traceback.extract_tb(error.__traceback__)]
    inside = [f"{p.stem}.{x}" for p, x in frames if p.parent == room and p.stem not in runners]
    return ", ".join(inside) or "the pipeline"


WAY: ContextVar[Way] = ContextVar("WAY")


def begin(label: str, rule: str) -> None:
    """Note that a step is being drafted."""
    if way := WAY.get(None):
        way.begun[label] = rule


def end(label: str, rule: str) -> None:
    """Note that a step is written."""
    if way := WAY.get(None):
        way.begun.pop(label, None)
        way.last = f"{label} ({rule})"


@contextmanager
def naming_steps() -> Iterator[None]:
    """Turn an error that the engine does not expect into ``WalkError``, which names the step."""
    way = Way()
    token = WAY.set(way)
    try:
        yield
    except ProblemError:
        raise
    except BROKEN as error:
        raise WalkError(way.describe(error)) from error
    finally:
        WAY.reset(token)
