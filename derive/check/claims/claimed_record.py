"""What the claims of a record speak of, read once: its reduced equations."""

from __future__ import annotations

from functools import cached_property
from random import Random

from ...record.record import Derivation, RecordError
from ..problem_group import group_of
from .reduced_system import ReducedSystem


class ClaimedRecord:
    """A record, and the random numbers with which its claims are tried."""

    def __init__(self, d: Derivation, seed: int | str):
        self.record, self.random = d, Random(f"{seed} claims")

    @cached_property
    def reduced(self) -> ReducedSystem:
        """The Lie–Poisson equations of the record; ``RecordError`` where it has none."""
        group = group_of(self.record.problem)
        if group is None:
            raise RecordError("reduced equations are of a group")
        return ReducedSystem(self.record, group, self.random)
