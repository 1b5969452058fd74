"""The choices of notation that a reader has."""

from __future__ import annotations

from dataclasses import dataclass

NOTATIONS = {
    "transpose": (("bar", "top"), "a transpose as a bar, or as a raised T"),
    "hat": (("j", "wedge"), "the skew matrix of a vector as j(x), or as x with a raised wedge"),
}
"""Choice → its values, the first one the default, and what they choose."""


@dataclass(frozen=True)
class Notation:
    """How transposes and skew matrices are written, by NOTATIONS; ``ValueError`` for others."""

    transpose: str = "bar"
    hat: str = "j"

    def __post_init__(self) -> None:
        for name, (allowed, _) in NOTATIONS.items():
            if getattr(self, name) not in allowed:
                raise ValueError(f"{name} must be one of {', '.join(allowed)}")
