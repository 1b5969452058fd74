"""The checker of claims: what sentences say beside the equations, computed again from the trees of
the record and the matrices of its group, by none of the searches that found it."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from random import Random

from ...record.claims import Claim, fault
from ...record.record import Derivation, RecordError, Step
from ..problem_group import group_of
from ..verdict import no_sense
from .reduced_system import ReducedSystem, dimension_fault


class ClaimChecker:
    """The claims of one record; what they speak of is read once."""

    def __init__(self, d: Derivation, seed: int | str):
        self.record, self.random = d, Random(f"{seed} claims")

    @cached_property
    def reduced(self) -> ReducedSystem:
        """The Lie–Poisson equations of the record; ``RecordError`` where it has none."""
        group = group_of(self.record.problem)
        if group is None:
            raise RecordError("reduced equations are of a group")
        return ReducedSystem(self.record, group)

    def fault(self, step: Step) -> str:
        """What is wrong with the claims of a step, or with a sentence that is a claim and has none;
        "" if nothing is."""
        if reason := fault(step.prose, step.claims):
            return reason
        for claim in step.claims:
            try:
                reason = JUDGES[claim.kind](self, step, claim)
            except (ArithmeticError, LookupError, TypeError, ValueError) as error:
                reason = no_sense(error)
            if reason:
                return f"the claim {claim.kind}: {reason}"
        return ""


Judge = Callable[[ClaimChecker, Step, Claim], str]
"""What is wrong with a claim of a step, in words; "" if nothing is."""

JUDGES: dict[str, Judge] = {
    "poisson.group": lambda c, step, x: dimension_fault(c.reduced, x, momenta_alone=True),
    "poisson.advected": lambda c, step, x: dimension_fault(c.reduced, x, momenta_alone=False),
}
"""How each kind of claim is judged."""
