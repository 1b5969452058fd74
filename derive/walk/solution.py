"""The kernel solved for the acceleration: through the normal space of 𝔤, or by the mass matrix."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.groups import Group
from ..record.record import Step
from .centre import seen_from_centres
from .chapter import Chapter
from .coordinates import coordinates_step
from .mass import mass_steps
from .multipliers import multiplier_steps
from .specialisation import Special
from .translation import Centred

MULTIPLIERS = 1
"""The kernel is solved through the normal space of 𝔤 where it has at most so many dimensions: the
counted operations of the emitted code are then fewer than through the mass matrix
(tests/walk/test_roads.py)."""


@dataclass(frozen=True)
class Solution:
    """The steps that solve the kernel; ``motion``: that of the equations of motion."""

    motion: Step
    steps: tuple[Step, ...]


def solution(
    stage: Special, centred: Centred | None, group: Group, here: Chapter, c: Chapter
) -> Solution:
    """The acceleration from ``stage.inertial`` = the work of ``stage.forces``, or from what is left
    of it once the translation is eliminated, for every ξ′ in 𝔤; ``c``: here, where inputs act."""
    b = stage.letters
    inertial, force, metric = stage.inertial, stage.forces[b.Z.xi_prime], b.J
    if centred is not None:
        inertial, force, metric = centred.inertial, centred.force, centred.metric
    multiplied = len(group.normal_space_of_linear_parts) <= MULTIPLIERS
    place = coordinates_step(group, b, here, with_rates=multiplied or bool(group.centred))
    if multiplied:
        _, motion, _ = solved = multiplier_steps(inertial, force, metric, group, b, c, centred)
        return Solution(motion, (*solved, place))
    central = seen_from_centres(inertial, force, group, b, c)
    if central is not None:
        _, motion = solved = mass_steps(
            central.inertial, central.force, place, b, c, balanced=False, central=central
        )
        return Solution(motion, (*central.steps, *solved, place))
    _, motion = solved = mass_steps(
        inertial, force, place, b, c, centred, balanced=stage.bodies is None
    )
    return Solution(motion, (place, *solved))
