"""derive: equations of motion by the road  L → L̃ on a group → ϖ → dϖ → kernel.

``from derive import Problem, SO, Points, Gravity, derive`` and the other words of
:mod:`derive.python.api`; they are imported when they are asked for.
"""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

WORDS = (
    *(
        "Advected",
        "Aff",
        "Algebra",
        "AppliedCovector",
        "AppliedForce",
        "Covector",
        "Damping",
        "Flow",
        "Event",
        "Fluid",
        "Force",
        "GL",
        "Gravity",
        "Group",
        "Inertia",
        "Kinematics",
        "Lagrangian",
        "Laplacian",
    ),
    *("Moments", "Output", "Points", "Potential", "Problem", "R", "SAff", "SE", "SL", "SO", "SU"),
    *("Scalar", "Signal", "Sim", "Solid"),
    *("Sp", "Spring", "Torque", "Torus", "U", "UT"),
)
"""And a word for each other kind of potential: ``Attraction`` and so on."""
PLACES = dict.fromkeys(WORDS, "derive.python.api") | {
    **dict.fromkeys(("Derived", "derive"), "derive.python.derived"),
    **dict.fromkeys(("FirstIntegrals", "first_integrals"), "derive.python.found"),
    **dict.fromkeys(("Compiled", "CompileError", "compile"), "derive.python.compiled"),
    "StepError": "derive.motion.native",
    "MotionError": "derive.motion.first_numbers",
    "EmitError": "derive.code.emit",
    "ProblemError": "derive.problem.problem",
    "Refused": "derive.language.limits",
}
"""Where each name is to be had."""


def __getattr__(name: str) -> Any:
    if name in PLACES:
        return getattr(import_module(PLACES[name]), name)
    if name == "__all__":
        return sorted({*PLACES, *_words()})
    if name[:1].isupper() and name in _words():
        return getattr(import_module("derive.python.api"), name)
    raise AttributeError(f"module 'derive' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*(x for x in globals() if x.startswith("__")), *PLACES, *_words()})


def _words() -> Any:
    return import_module("derive.schema.python_words").words()
