"""Forces outside dϖ: inputs, given at every call, and damping."""

from collections.abc import Sequence
from typing import Any

from .table import End, Frame, Name, Number, Points, Stiffness, Table, place


class CovectorInput(Table):
    """A covector of the Lie algebra: power ⟨u, ζ⟩."""

    kind, section, called = "covector", "input", "Covector"
    name: Name

    @classmethod
    def word(cls, name: str) -> Any:
        """An input: a covector of the Lie algebra, by its values on the basis."""
        return {"name": name}


class ForceInput(Table):
    """A force on a point or a place; ``frame``: its components are in space or body."""

    kind, section, called = "force", "input", "Force"
    name: Name
    on: End
    frame: Frame = "space"

    @classmethod
    def word(
        cls,
        name: str,
        on: int | Sequence[Number],
        frame: str = "space",
        block: int | None = None,
    ) -> Any:
        """An input: a force on a point, or at a place of the body, in a product of that of a block;
        its frame is "space" or "body"."""
        return {"name": name, "frame": frame} | place(on, block)


class Damping(Table):
    """−κ v on points: a Rayleigh function ½ κ |v|², no potential."""

    section = "damping"
    coefficient: Stiffness
    on: Points

    @classmethod
    def word(
        cls,
        coefficient: Number,
        on: Sequence[int] | None = None,
        at: Sequence[Number] | None = None,
        block: int | None = None,
    ) -> Any:
        """The force −κ v on points (all by default), or on a place of the body, in a product of
        that of a block, outside dϖ."""
        return {"coefficient": coefficient, "on": on, "at": at, "block": block}


Input = CovectorInput | ForceInput
INPUTS: dict[str, type[CovectorInput] | type[ForceInput]] = {
    "covector": CovectorInput,
    "force": ForceInput,
}
