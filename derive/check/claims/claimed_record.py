"""What the claims of a record speak of, read once: its reduced equations, its
symmetries."""

from __future__ import annotations

from functools import cached_property
from random import Random

from ...algebra.groups import Group
from ...record.record import Derivation, RecordError
from ..problem_group import group_of
from .reduced_system import ReducedSystem
from .symmetry_count import SymmetryCount


class ClaimedRecord:
    """A record, and the random numbers with which its claims are tried."""

    def __init__(self, d: Derivation, seed: int | str):
        self.record, self.random = d, Random(f"{seed} claims")

    @cached_property
    def reduced(self) -> ReducedSystem:
        """The Lie–Poisson equations of the record; ``RecordError`` where it has none."""
        return ReducedSystem(self.record, self.group, self.random)

    @cached_property
    def group(self) -> Group:
        """The group of the problem; ``RecordError`` where it has none."""
        group = group_of(self.record.problem)
        if group is None:
            raise RecordError("the claim is of a group")
        return group

    @cached_property
    def symmetries(self) -> SymmetryCount:
        """The symmetries of its Lagrangian; ``KeyError`` where it has none of its own."""
        return SymmetryCount(self.record.problem, self.group, self.random)
