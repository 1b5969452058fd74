"""Attraction: −m_i μ / ‖r_i − centre‖ for each point that has a mass."""

from __future__ import annotations

from ...language.derivatives import product
from ...language.tree import Tree, add, neg
from ...problem.problem import Problem
from ...schema.potential_kinds import Attraction
from ..given.potentials import PointPotentials, column, place

KIND = Attraction


def pointwise(found: PointPotentials, p: Attraction, problem: Problem) -> None:
    """Add −m_i μ / ‖r_i(t) − centre‖ for each point."""
    for i, m in p.on or enumerate((x.mass for x in problem.points), 1):
        centre = neg(column(p.centre)) if p.centre else 0
        d = found.add_difference(add(place(problem, i), centre))
        distance: Tree = ("fun", "sqrt", ("norm2", d))
        energy = product(-1, m, p.strength, ("div", 1, distance))
        found.add_radial(energy, d, {i: 1}, p.centre)
