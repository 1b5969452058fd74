"""derive: equations of motion by the road  L → L̃ on a group → ϖ → dϖ → kernel.

``from derive import Problem, SO, Points, Gravity, derive`` and the other words of
:mod:`derive.api`; they are imported when they are asked for.
"""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

WORDS = (
    *("Aff", "Attraction", "Covector", "Damping", "Derived", "Force", "GL", "Gravity", "Group"),
    *("Moments", "Points", "Potential", "Problem", "SAff", "SE", "SL", "SO", "SU", "Sim", "Solid"),
    *("Sp", "Spring", "U", "UT", "derive"),
)
__all__ = [*WORDS, "CompileError", "Compiled", "ProblemError", "compile"]


def __getattr__(name: str) -> Any:
    if name in WORDS:
        return getattr(import_module("derive.api"), name)
    if name in ("compile", "Compiled", "CompileError"):
        return getattr(import_module("derive.compiled"), name)
    if name == "ProblemError":
        return import_module("derive.mechanics.problem").ProblemError
    raise AttributeError(f"module 'derive' has no attribute {name!r}")
