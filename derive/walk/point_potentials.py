"""Potentials given point by point: springs with a length or an anchor, attraction, any U.

Each pushes its points by minus the derivative of U.  A potential of a distance ‖d‖ is
differentiated as a function of ‖d‖²: the force is  σ d  with  σ = −2 ∂U/∂‖d‖².
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ..language.derivatives import derivative, product
from ..language.tree import Tree, subtrees
from ..problem.problem import Problem
from ..record.record import Equation


def in_space(i: int) -> Tree:
    """The tree r_i(t), the place of point i in space."""
    return ("call", ("at", "r", i), "t")


def column(entries: tuple[Tree, ...]) -> Tree:
    """A vector as a matrix tree with one column."""
    return ("matrix", *(("row", x) for x in entries))


def embedded(problem: Problem, i: int, entries: tuple[Tree, ...], corner: int) -> Tree:
    """A vector of the space of point i as a column; in a product, in its block, with a corner."""
    assert problem.group is not None
    return column(problem.group.in_block(problem.block(i), entries, corner))


@dataclass(frozen=True)
class Radial:
    """A potential of ‖d‖², where d = Σ ± r_i(t) − anchor: σ_e = ``tension``, a tree in d_e."""

    d: Tree
    signs: dict[int, int]
    anchor: tuple[Tree, ...]
    tension: Tree

    @property
    def shifts(self) -> bool:
        """Does ‖d‖ stay when space is shifted?"""
        return not sum(self.signs.values())

    @property
    def sigma(self) -> Tree:
        """The tree σ_e."""
        return ("at", "σ", self.d[2])  # type: ignore[index]


@dataclass
class PointPotentials:
    """The potentials given point by point, whose sum is U_Q: ``differences``: the equations of d_e;
    ``energies``: U_e; ``radials``: those of a distance; ``forces``: −∂U/∂r_i(t) of the others."""

    problem: Problem
    differences: list[Equation] = field(default_factory=list)
    energies: list[Tree] = field(default_factory=list)
    radials: list[Radial] = field(default_factory=list)
    forces: dict[int, list[Tree]] = field(default_factory=dict)

    @property
    def shifts(self) -> bool:
        """Is U_Q a function of distances that stay when space is shifted?"""
        return not self.forces and all(x.shifts for x in self.radials)

    def add_force(self, i: int, force: Tree) -> None:
        """Add a term to the force on point i."""
        self.forces.setdefault(i, []).append(force)

    def add_energy(self, U: Tree) -> None:
        """Add a potential U of entries of places r_i(t), with its forces −∂U/∂r_i(t)."""
        self.energies.append(U)
        assert self.problem.group is not None
        span = range(1, self.problem.group.n + 1)
        for i in sorted({*_points(U)}):
            slopes = (derivative(U, ("entry", in_space(i), k)) for k in span)
            self.add_force(i, column(tuple(product(-1, x) for x in slopes)))

    def add_difference(self, ends: Tree) -> Tree:
        """Name a difference d_e, and give its tree."""
        d: Tree = ("at", "d", len(self.differences) + 1)
        self.differences.append(Equation(d, ends))
        return d

    def add_radial(
        self, energy: Tree, d: Tree, signs: dict[int, int], anchor: tuple[Tree, ...] = ()
    ) -> None:
        """Add a potential of ‖d‖²; ``signs``: those of r_i(t) in d, by the point."""
        self.energies.append(energy)
        tension = product(-2, derivative(energy, ("norm2", d)))
        self.radials.append(Radial(d, signs, anchor, tension))


def place(problem: Problem, i: int) -> Tree:
    """The place of point i in its space: r_i(t), or the entries of its block."""
    group = problem.group
    assert group is not None
    if not group.factors:
        return in_space(i)
    rows = range(1, group.n + 1)[group.of_block(problem.block(i))]
    return column(tuple(("entry", in_space(i), k) for k in rows))


def _points(t: Tree) -> Iterator[int]:
    """The numbers i of the points whose places are in a tree."""
    for _, x in subtrees(t):
        if isinstance(x, tuple) and x[:2] == ("at", "r"):
            yield x[2]
