"""What a user may choose about the emitted code; every choice has a default."""

from __future__ import annotations

from dataclasses import dataclass

CHOICES: dict[str, tuple[tuple[str, ...], str]] = {
    "real": (("double", "float"), "the numbers of the code"),
    "form": (("source", "header"), "C as .h and .c, or as one header of inline functions"),
    "layout": (("row", "col"), "the entries of A row by row, or column by column"),
    "attitude": (("matrix", "quaternion"), "A as a matrix, or a unit quaternion (SO(3), SE(3))"),
    "frame": (("given", "principal"), "the body as given, or in its principal frame"),
    "velocity": (("body", "tangent"), "the state ends in Z = g^-1 dg/dt, or in dg/dt"),
}
"""Option → its values, the first one the default, and what they choose."""

ADDED: dict[str, str] = {
    "momenta": "also the motion in momenta: to them and back, rates, Poisson tensor",
    "multiplier": "add the multiplier of the volume, the integral of the pressure in a fluid",
    "conserved": "add what the motion keeps, as derive symmetries finds it",
}
"""Option that is given or not → what it adds."""

JACOBIANS = ("state", "inputs", "parameters")
"""What the equations may be linearised in, besides nothing."""


@dataclass(frozen=True)
class Options:
    """The choices of one emission, by CHOICES, JACOBIANS and ADDED; ``ValueError`` for others."""

    real: str = "double"
    form: str = "source"
    layout: str = "row"
    attitude: str = "matrix"
    frame: str = "given"
    velocity: str = "body"
    jacobian: tuple[str, ...] = ()
    conserved: bool = False
    momenta: bool = False
    multiplier: bool = False

    def __post_init__(self) -> None:
        for name, (allowed, _) in CHOICES.items():
            if getattr(self, name) not in allowed:
                raise ValueError(f"{name} must be one of {', '.join(allowed)}")
        if isinstance(self.jacobian, str):
            object.__setattr__(self, "jacobian", (self.jacobian,))
        for name in self.jacobian:
            if name not in JACOBIANS:
                raise ValueError(f"jacobian must be among {', '.join(JACOBIANS)}")
