"""Potentials given point by point: springs with a length or an anchor, attraction, any U.

Each pushes its points by minus the derivative of U.  A potential of a distance ‖d‖ is
differentiated as a function of ‖d‖²: the force is  σ d  with  σ = −2 ∂U/∂‖d‖².
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

from ..language.differentiate import derivative, product
from ..language.tree import Tree, add, mul, neg, subtrees
from ..problem.problem import Attraction, Expression, Problem, Spring
from ..record.record import Equation


def in_space(i: int) -> Tree:
    """r_i(t)."""
    return ("call", ("at", "r", i), "t")


def column(entries: tuple[Tree, ...]) -> Tree:
    """A vector as a matrix tree with one column."""
    return ("matrix", *(("row", x) for x in entries))


def embedded(problem: Problem, i: int, entries: tuple[Tree, ...], corner: int) -> Tree:
    """A vector of the space of point i; in a product, in its block, with a corner."""
    assert problem.group is not None
    return column(problem.group.in_block(problem.block(i), entries, corner))


@dataclass(frozen=True)
class Radial:
    """A potential of ‖d‖², with d = Σ ± r_i(t) − anchor: σ_e = ``tension``, as a tree in d_e."""

    d: Tree
    signs: dict[int, int]
    anchor: tuple[Tree, ...]
    tension: Tree

    @property
    def sigma(self) -> Tree:
        """σ_e."""
        return ("at", "σ", self.d[2])  # type: ignore[index]


@dataclass
class Elements:
    """``differences``: d_e; ``energies``: U_e; ``pushes``: −∂U/∂r_i(t) of those given as U."""

    problem: Problem
    differences: list[Equation] = field(default_factory=list)
    energies: list[Tree] = field(default_factory=list)
    radials: list[Radial] = field(default_factory=list)
    pushes: dict[int, list[Tree]] = field(default_factory=dict)

    def push(self, i: int, force: Tree) -> None:
        """A term of the force on point i."""
        self.pushes.setdefault(i, []).append(force)

    def difference(self, ends: Tree) -> Tree:
        """A new d_e."""
        d: Tree = ("at", "d", len(self.differences) + 1)
        self.differences.append(Equation(d, ends))
        return d

    def radial(
        self, energy: Tree, d: Tree, signs: dict[int, int], anchor: tuple[Tree, ...] = ()
    ) -> None:
        """A potential of ‖d‖²."""
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


def elements(problem: Problem) -> Elements:
    """The definitions of all that the problem gives point by point."""
    found = Elements(problem)
    for p in problem.elements:
        if isinstance(p, Spring):
            _spring(found, p, problem)
        elif isinstance(p, Attraction):
            _attraction(found, p, problem)
        else:
            _expression(found, p, problem)
    return found


def _spring(found: Elements, p: Spring, problem: Problem) -> None:
    i, j = p.between
    other = column(p.anchor) if j is None else place(problem, j)
    d = found.difference(add(place(problem, i), neg(other)))
    square: Tree = ("norm2", d)
    stretched = square
    if p.length != 0:
        stretched = ("pow", add(("fun", "sqrt", square), neg(p.length)), 2)
    energy = mul(Fraction(1, 2), p.stiffness, stretched)
    found.radial(energy, d, {i: 1} if j is None else {i: 1, j: -1}, p.anchor)


def _attraction(found: Elements, p: Attraction, problem: Problem) -> None:
    body = problem.points
    for i, m in p.on or enumerate(body.masses if body else (), 1):
        centre = neg(column(p.centre)) if p.centre else 0
        d = found.difference(add(place(problem, i), centre))
        distance: Tree = ("fun", "sqrt", ("norm2", d))
        energy = product(-1, m, p.strength, ("div", 1, distance))
        found.radial(energy, d, {i: 1}, p.centre)


def _expression(found: Elements, p: Expression, problem: Problem) -> None:
    found.energies.append(p.energy)
    group = problem.group
    assert group is not None
    for i in sorted({*_points(p.energy)}):
        slopes = [derivative(p.energy, ("entry", in_space(i), k)) for k in range(1, group.n + 1)]
        found.push(i, column(tuple(product(-1, x) for x in slopes)))


def _points(t: Tree) -> Iterator[int]:
    for _, x in subtrees(t):
        if isinstance(x, tuple) and x[:2] == ("at", "r"):
            yield x[2]
