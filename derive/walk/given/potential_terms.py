"""What potentials are made of: letters of their own and words; or, point by point, distances.

``POINTWISE``: what the walk makes of one potential of a kind that is given point by point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from ...algebra.calculus import PairRule, derivation, reduce
from ...algebra.words import Expr, Factor, Letter, word
from ...language.derivatives import derivative, product
from ...language.tree import Tree, add, mul, neg, nodes
from ...problem.problem import Problem
from ...record.record import Equation
from ...record.sentence import Prose
from ...schema.potential_kinds import Attraction, Expression, Field, Spring, quadratic

# Potentials as words in A, T, m, c, J and letters of their own.
#
# A letter of its own stands for a word that g moves, or for a power of one: what a displacement
# makes of it is derived from that word, and products in it are written by the letters again.


@dataclass(frozen=True)
class PotentialLetter:
    """A letter of a potential's own, which stands for ``value``; for a product āb, if that is one:
    ``factors`` (a, b) and the ``share`` of the letter that āb is.

    ``axial``: in R³, the vector of the letter N, ⟨axial, x⟩ = Tr N j(x)‾.
    """

    letter: Letter
    value: Expr
    factors: tuple[Letter, Letter] | None = None
    share: Fraction = Fraction(1)
    axial: Letter | None = None

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter along a displacement, whose value on other letters is
        ``delta``."""
        return derivation(self.value, delta)

    def written(self, left: Factor, right: Factor) -> Expr | None:
        """The product āb, or b̄a, by the letter; ``None`` for another pair of factors."""
        if self.factors:
            a, b = self.factors
            if (left, right) == ((a, True), (b, False)):
                return self.share * word(self.letter)
            if (left, right) == ((b, True), (a, False)):
                return self.share * word(self.letter).bar
        return None


@dataclass(frozen=True)
class FunctionLetter(PotentialLetter):
    """A letter x for a function of a scalar q, its ``value``: δx = slope · δq.

    ``rules``: what reduces δq.
    """

    slope: Expr = field(kw_only=True)
    rules: tuple[PairRule, ...] = ()

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter, by the chain rule."""
        return self.slope * reduce(derivation(self.value, delta), *self.rules)


def power_letter(x: Letter, value: Expr, exponent: Fraction, over: Expr) -> FunctionLetter:
    """A letter for a power of a scalar; ``over``: the scalar's inverse by letters."""
    return FunctionLetter(x, value, slope=exponent * word(x) * over)


def displaced_letters(
    own: Iterable[PotentialLetter], images: Mapping[Letter, Expr]
) -> dict[Letter, Expr]:
    """The images of A, T and so on under a displacement, completed by those of own letters."""
    found, listed = dict(images), [*own]
    rules: list[PairRule] = [x.written for x in listed]
    for x in listed:
        found[x.letter] = reduce(x.varied(found.get), *rules)
    return found


@dataclass(frozen=True)
class Words:
    """The potentials of one kind on words: ``energy``: what they add to Ũ; the same
    ``over_points``, as trees.

    ``definitions``: of the letters that are its own; ``prose``: what is said of them; ``own``: how
    those move, each after those that it stands for.
    """

    energy: Expr
    definitions: Sequence[Equation]
    over_points: Sequence[Tree]
    prose: Prose = ()
    own: Sequence[PotentialLetter] = ()


# Potentials given point by point: springs with a length or an anchor, attraction, any U.
#
# Each pushes its points by minus the derivative of U.  A potential of a distance ‖d‖ is
# differentiated as a function of ‖d‖²: the force is  σ d  with  σ = −2 ∂U/∂‖d‖².


def in_space(i: int) -> Tree:
    """The tree r_i(t), the place of point i in space."""
    return ("call", ("at", "r", i), "t")


def column(entries: Iterable[Tree]) -> Tree:
    """A vector as a matrix tree with one column."""
    return ("matrix", *(("row", x) for x in entries))


def embedded(problem: Problem, i: int, entries: tuple[Tree, ...], corner: int) -> Tree:
    """A vector of the space of point i as a column; in a product, in its block, with a corner."""
    return column(problem.own_group.in_block(problem.block(i), entries, corner))


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
        span = range(1, self.problem.own_group.n + 1)
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
    group = problem.own_group
    if not group.factors:
        return in_space(i)
    rows = range(1, group.n + 1)[group.of_block(problem.block(i))]
    return column(tuple(("entry", in_space(i), k) for k in rows))


def _points(t: Tree) -> Iterator[int]:
    """The numbers i of the points whose places are in a tree."""
    for x in nodes(t):
        if isinstance(x, tuple) and x[:2] == ("at", "r"):
            yield x[2]


def spring_pointwise(found: PointPotentials, p: Spring, problem: Problem) -> None:
    """A spring: add ½ k (‖d‖ − ℓ)², unless the spring is in K."""
    if p in quadratic((p,), problem.block):
        return
    i, j = p.ends
    anchor = p.anchor or ()
    other = column(anchor) if j is None else place(problem, j)
    d = found.add_difference(add(place(problem, i), neg(other)))
    square: Tree = ("norm2", d)
    stretched = square
    if p.length != 0:
        stretched = ("pow", add(("fun", "sqrt", square), neg(p.length)), 2)
    energy = mul(Fraction(1, 2), p.stiffness, stretched)
    found.add_radial(energy, d, {i: 1} if j is None else {i: 1, j: -1}, anchor)


def attraction_pointwise(found: PointPotentials, p: Attraction, problem: Problem) -> None:
    """Add −m_i μ / ‖r_i(t) − centre‖ for each point."""
    for i, m in p.on or enumerate((x.mass for x in problem.points), 1):
        centre = neg(column(p.centre)) if p.centre else 0
        d = found.add_difference(add(place(problem, i), centre))
        distance: Tree = ("fun", "sqrt", ("norm2", d))
        energy = product(-1, m, p.strength, ("div", 1, distance))
        found.add_radial(energy, d, {i: 1}, p.centre)


def field_pointwise(found: PointPotentials, p: Field, problem: Problem) -> None:
    """Add −Σ q_i ⟨E, r_i(t)⟩, each place in its block."""
    group = problem.own_group
    terms = []
    for i, charge in enumerate(p.charges, 1):
        rows = range(1, group.n + 1)[group.of_block(problem.block(i))]
        pairs = zip(p.E, rows, strict=True)
        along = add(*(mul(x, ("entry", in_space(i), k)) for x, k in pairs))
        terms.append(mul(-1, charge, along))
    if (U := add(*terms)) != 0:
        found.add_energy(U)


def any_energy_pointwise(found: PointPotentials, p: Expression, _problem: Problem) -> None:
    """Add U, with its forces −∂U/∂r_i(t)."""
    found.add_energy(p.U)


POINTWISE: dict[type, Callable[[PointPotentials, Any, Problem], None]] = {
    Attraction: attraction_pointwise,
    Expression: any_energy_pointwise,
    Field: field_pointwise,
    Spring: spring_pointwise,
}
