"""Options of an emission that exclude one another, the group or the Lagrangian: one line each."""

from __future__ import annotations

from ..algebra.groups import Group
from ..language.limits import SLOPES, SLOPES_BY_PARAMETERS
from ..record.record import Derivation
from .momentum_state import refuse
from .options import Options
from .program import LoweringError
from .step import discrete_step


def require_written(d: Derivation, group: Group, chosen: Options) -> None:
    """``LoweringError`` for options that exclude one another or the group, and for a Jacobian of
    more entries than compilers manage."""
    rows = 2 * group.dimension
    columns = {
        "state": (rows, SLOPES),
        "parameters": (len(d.problem["parameters"]), SLOPES_BY_PARAMETERS),
    }
    for by, (width, most) in columns.items():
        if by in chosen.jacobian and rows * width > most:
            raise LoweringError(
                f"{d.name}: --jacobian {by} is a matrix of {rows * width} entries on {group.name}, "
                f"of dimension {group.dimension}; compilers manage {most}: leave it out"
            )
    if "inputs" in chosen.jacobian and not d.problem.get("inputs"):
        raise LoweringError(f"{d.name}: there are no inputs to linearise in")
    if "advected" in d.problem:
        _refused_without_element(d, chosen)
    if d.problem.get("lagrangian", {}).get("held"):
        _refused_where_held(d, chosen)
    if d.problem.get("lagrangian", {}).get("trivialisation") == "right":
        _refused_on_the_right(d, chosen)
    if chosen.multiplier and d.definition("θ") is None:
        raise LoweringError(
            f"{d.name}: --multiplier is for a group with one relation, as SL(n) or SAff(n) that "
            f"keep volumes; {group.name} has none or several: leave it out"
        )
    if chosen.frame == "principal" and chosen.multiplier:
        raise LoweringError(
            f"{d.name}: --multiplier is written in the frame of the parameters: leave out --frame"
        )
    if chosen.momenta:
        refuse(d, group, chosen)
    if "discrete" in chosen.step:
        discrete_step.refuse(d, group, chosen)
    if chosen.attitude == "quaternion" and not group.rotates:
        raise LoweringError(f"{d.name}: a quaternion needs SO(3) or SE(3), not {group.name}")
    if chosen.attitude == "quaternion" and chosen.velocity == "tangent":
        raise LoweringError(
            f"{d.name}: a quaternion goes with the velocity of the body, not tangent"
        )
    if chosen.attitude == "quaternion" and chosen.layout == "col":
        raise LoweringError(f"{d.name}: with a quaternion there is no matrix to lay out by columns")
    if chosen.frame == "principal" and chosen.conserved:
        raise LoweringError(
            f"{d.name}: --conserved is written in the frame of the parameters: leave out --frame"
        )
    if chosen.frame == "principal" and "parameters" in chosen.jacobian:
        raise LoweringError(
            f"{d.name}: the principal frame is not smooth in the parameters; "
            "linearise in them without --frame"
        )


def _refused_without_element(d: Derivation, chosen: Options) -> None:
    """What is written for a state with an element of the group."""
    for on, option in (
        (chosen.velocity == "tangent", "--velocity tangent"),
        (chosen.attitude == "quaternion", "--attitude quaternion"),
        (chosen.layout == "col", "--layout col"),
        (chosen.state == "moving", "--state moving"),
        (chosen.varied, f"--jacobian {' '.join(chosen.varied)}"),
    ):
        if on:
            raise LoweringError(
                f"{d.name}: {option} is for a state with an element of the group, and [algebra] "
                "has none: leave it out"
            )


def _refused_where_held(d: Derivation, chosen: Options) -> None:
    """What is written for a motion that the whole velocity tells."""
    for on, option in (
        (chosen.velocity == "tangent", "--velocity tangent"),
        (chosen.varied, f"--jacobian {' '.join(chosen.varied)}"),
    ):
        if on:
            raise LoweringError(
                f"{d.name}: {option} is for motions on the whole group, and these are on a "
                "quotient of it: leave it out"
            )


def _refused_on_the_right(d: Derivation, chosen: Options) -> None:
    """What is written for Z = g⁻¹ġ alone."""
    for on, option in (
        (chosen.velocity == "tangent", "--velocity tangent"),
        (chosen.attitude == "quaternion", "--attitude quaternion"),
    ):
        if on:
            raise LoweringError(
                f"{d.name}: {option} is for Z = g^-1 dg/dt, and this Lagrangian is trivialised on "
                "the right: leave it out"
            )
