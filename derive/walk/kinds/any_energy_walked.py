"""Any U of the places: its forces are its derivatives by their entries."""

from __future__ import annotations

from ...problem.problem import Problem
from ...schema.potential_kinds import Expression
from ..given.potentials import PointPotentials

KIND = Expression


def pointwise(found: PointPotentials, p: Expression, problem: Problem) -> None:
    """Add U, with its forces −∂U/∂r_i(t)."""
    del problem
    found.add_energy(p.U)
