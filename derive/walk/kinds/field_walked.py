"""A uniform field on charged points: −q_i ⟨E(t), r_i(t)⟩ for each of them."""

from __future__ import annotations

from ...language.tree import add, mul
from ...problem.problem import Problem
from ...schema.potential_kinds import Field
from ..given.potentials import PointPotentials, in_space

KIND = Field


def pointwise(found: PointPotentials, p: Field, problem: Problem) -> None:
    """Add −Σ q_i ⟨E, r_i(t)⟩, each place in its block."""
    group = problem.group
    assert group is not None
    terms = []
    for i, charge in enumerate(p.charges, 1):
        rows = range(1, group.n + 1)[group.of_block(problem.block(i))]
        pairs = zip(p.E, rows, strict=True)
        along = add(*(mul(x, ("entry", in_space(i), k)) for x, k in pairs))
        terms.append(mul(-1, charge, along))
    if (U := add(*terms)) != 0:
        found.add_energy(U)
