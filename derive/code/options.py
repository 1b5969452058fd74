"""What a user may choose about the emitted code; every choice has a default."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..language.reserved import did_you_mean, near_name

CHOICES: dict[str, tuple[tuple[str, ...], str]] = {
    "real": (("double", "float"), "the numbers of the code"),
    "form": (("source", "header"), "C as .h and .c, or as one header"),
    "layout": (("row", "col"), "the entries of A by rows, or by columns"),
    "attitude": (
        ("matrix", "quaternion", "angle", "shortest"),
        "A as matrix, quaternion, angle, or shortest",
    ),
    "frame": (("given", "principal"), "the body in its own axes, or in principal ones"),
    "velocity": (("body", "tangent"), "Z = g^-1 dg/dt, or dg/dt"),
    "state": (("whole", "moving"), "all entries of g, or those that vary"),
}
"""Option → its values, the first one the default, and what they choose."""

ADDED: dict[str, str] = {
    "conserved": "what the motion keeps: derive symmetries",
    "momenta": "the motion in momenta, with its Poisson tensor",
    "dynamics": "mass matrix, bias, inverse dynamics",
    "exponential": "exp, log, Jacobians, in a file NAME_group",
    "multiplier": "of the volume: the integral of the pressure",
    "ensemble": "many motions at once, over all cores (C)",
}
"""Option that is given or not → what it adds."""

REPEATED: dict[str, tuple[tuple[str, ...], str]] = {
    "step": (("gauss", "rk4", "vern9", "discrete", "gauss_jax"), "a step in time"),
    "jacobian": (
        ("state", "inputs", "parameters", "raw", "outputs", "step"),
        "the linearised equations",
    ),
}
"""Option of several values, none by default → those that there are, and what they add."""


DEPENDENT: dict[str, tuple[tuple[str, ...], str]] = {
    "order": (("2", "4", "6", "8"), "of --step discrete (default: 2)"),
}
"""Option that another one has → its values, and what they choose; none where it is not given."""


@dataclass(frozen=True)
class Options:
    """The choices of one emission, by the tables above; ``ValueError`` for others."""

    real: str = "double"
    form: str = "source"
    layout: str = "row"
    attitude: str = "matrix"
    frame: str = "given"
    velocity: str = "body"
    state: str = "whole"
    jacobian: tuple[str, ...] = ()
    step: tuple[str, ...] = ()
    order: str = ""
    conserved: bool = False
    momenta: bool = False
    dynamics: bool = False
    exponential: bool = False
    multiplier: bool = False
    ensemble: bool = False

    @property
    def varied(self) -> tuple[str, ...]:
        """What the equations are linearised in for variations of the state."""
        return tuple(x for x in self.jacobian if x != "raw")

    @property
    def moves(self) -> bool:
        """Is there code that moves a motion?"""
        return bool(self.step) or self.ensemble

    def __post_init__(self) -> None:
        for name, (allowed, _) in CHOICES.items():
            if getattr(self, name) not in allowed:
                raise ValueError(f"{name} must be one of {', '.join(allowed)}")
        for name, (allowed, _) in REPEATED.items():
            if isinstance(given := getattr(self, name), str):
                object.__setattr__(self, name, (given,))
            if not {*getattr(self, name)} <= {*allowed}:
                raise ValueError(f"{name} must be among {', '.join(allowed)}")
        for name, (allowed, _) in DEPENDENT.items():
            object.__setattr__(self, name, str(getattr(self, name)))
            if getattr(self, name) not in ("", *allowed):
                raise ValueError(f"{name} must be one of {', '.join(allowed)}")


def options_of(choices: Mapping[str, Any], *others: str) -> Options:
    """The options of these choices by name; ``ValueError`` for a name that is none, with the
    nearest of them and of ``others`` that are known there."""
    known = (*CHOICES, *REPEATED, *DEPENDENT, *ADDED)
    if wrong := next((x for x in choices if x not in known), ""):
        near = did_you_mean(near_name(wrong, (*known, *others)), after=" ")
        raise ValueError(f"no choice {wrong}; {near}there are {', '.join((*others, *known))}")
    return Options(**choices)
