"""Forces outside dϖ: inputs, given at every call, and damping."""

from dataclasses import dataclass

from .table import End, Frame, Name, Points, Stiffness, Table


@dataclass(frozen=True, kw_only=True)
class CovectorInput(Table):
    """A covector of the Lie algebra: power ⟨u, ζ⟩."""

    kind = "covector"
    name: Name


@dataclass(frozen=True, kw_only=True)
class ForceInput(Table):
    """A force on a point or a place; ``frame``: its components are in space or body."""

    kind = "force"
    name: Name
    on: End
    frame: Frame = "space"


@dataclass(frozen=True, kw_only=True)
class Damping(Table):
    """−κ v on points: a Rayleigh function ½ κ |v|², no potential."""

    coefficient: Stiffness
    on: Points


Input = CovectorInput | ForceInput
INPUTS: dict[str, type[CovectorInput] | type[ForceInput]] = {
    "covector": CovectorInput,
    "force": ForceInput,
}
