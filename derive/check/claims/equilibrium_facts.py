"""What is true of an equilibrium of reduced equations, in exact numbers.

With Λ the Poisson tensor at the point, M the derivatives of the rates and Q those, the second ones,
of a function that is kept and critical there, ΛᵀQΛ has the squares of the function on the tangent
space of the leaf, the image of Λ; −MΛ those of ω(Mv, v), since ω(Λξ, Λη) = ⟨Λξ, η⟩.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property, lru_cache

from ...language import rational as q
from ...language.quadratic import Number
from ...language.tree import Tree, nodes
from ..entries_of_an_element import Decision, decided
from .exact_spectra import characteristic, grows, real_and_not_positive, signature
from .reduced_system import ReducedSystem
from .second_order import SecondOrder, about, expansion


class Equilibrium:
    """A point of a system, by its coordinates that are not 0."""

    def __init__(self, system: ReducedSystem, point: Mapping[Tree, Number]):
        self.system, self.n = system, len(system.variables)
        self.at = tuple(point.get(x, Fraction(0)) for x in system.variables)
        self.variables = about(system.variables, self.at)

    def expansion(self, t: Tree) -> SecondOrder:
        """A polynomial about the point."""
        return expansion(t, {**self.variables, "h̃": self.energy})

    @cached_property
    def energy(self) -> SecondOrder:
        """h̃ about the point."""
        return expansion(self.system.energy, self.variables)

    @cached_property
    def rates(self) -> list[SecondOrder]:
        """The rates about the point."""
        return [expansion(x, self.variables) for x in self.system.rates]

    @cached_property
    def tensor(self) -> q.Matrix:
        """Λ at the point."""
        found = [[Fraction(0)] * self.n for _ in range(self.n)]
        for (i, j), form in self.system.tensor.forms.items():
            terms = ((c if k is None else c * self.at[k]) for k, c in form.items())
            found[i][j] = sum(terms, Fraction(0))
        return q.matrix(found)

    @cached_property
    def tangent(self) -> q.Matrix:
        """Columns that span the tangent space of the leaf."""
        pivots = q.echelon(self.tensor)[1]
        return tuple(tuple(row[j] for j in pivots) for row in self.tensor)

    @property
    def dimension(self) -> int:
        """The dimension of the leaf."""
        return len(self.tangent[0])

    @cached_property
    def linear(self) -> q.Matrix:
        """M, the derivatives of the rates."""
        return tuple(tuple(x.slopes(self.n)) for x in self.rates)

    @cached_property
    def characteristic(self) -> list[Number]:
        """det(μ − M) on the leaf, from the highest power of μ; ``ValueError`` where M leaves it."""
        if not self.dimension:
            return [Fraction(1)]
        on_the_leaf = q.solve(self.tangent, q.times(self.linear, self.tangent))
        if on_the_leaf is None:
            raise ValueError("the linearised rates leave the tangent space of the leaf")
        return characteristic(on_the_leaf)

    @cached_property
    def characteristic_of_all(self) -> list[Number]:
        """det(μ − M), not on the leaf alone."""
        return characteristic(self.linear)

    @cached_property
    def grows(self) -> bool:
        """Has an eigenvalue on the leaf a positive real part?"""
        if any(self.characteristic[1::2]):
            raise ValueError("the characteristic polynomial is not even")
        return not real_and_not_positive(self.characteristic[::2])

    # -- what is known of the point ----------------------------------------------------------------

    @cached_property
    def entries(self) -> Decision:
        """Has an element of the group the entries of g at the point?"""
        pairs = zip(self.system.variables, self.at, strict=True)
        at = {x: y for x, y in pairs if isinstance(x, tuple) and x[1] == "A"}
        one: dict[Tree, SecondOrder] = {
            x: SecondOrder(Fraction(int(x[2] == x[3]))) for x in at if isinstance(x, tuple)
        }
        alone = (f for f in self.system.casimirs if {*nodes(f)} & {*self.variables} <= {*one})
        if any(expansion(f, one).value != self.expansion(f).value for f in alone):
            return "no"
        return decided(self.system.group, {(x[2] - 1, x[3] - 1): y for x, y in at.items()})

    @cached_property
    def regular(self) -> bool:
        """Has Λ its largest rank there, as the Casimirs prove?"""
        there = self.system.anywhere
        most = self.n - there.rank(self.system.casimirs)
        return there.poisson_rank == self.dimension == most

    @cached_property
    def compact(self) -> bool:
        """Are there momenta alone, of a group that is compact by its Killing form?"""
        c, d = self.system.group.structure_constants, self.system.group.dimension
        if d < self.n:
            return False
        span = range(d)
        killing = [
            [sum((c[a][i][j] * c[b][j][i] for i in span for j in span), Fraction(0)) for b in span]
            for a in span
        ]
        return signature(killing) == (0, d)

    # -- forms ------------------------------------------------------------------------------------

    def on_the_leaf(self, form: q.Matrix) -> q.Matrix:
        """P̄QP for columns P that span the tangent space."""
        return q.times(q.times(q.transposed(self.tangent), form), self.tangent)

    def squares(self, form: q.Matrix | None) -> tuple[int, int]:
        """How many positive and how many negative squares a form has on the leaf, ω(Mv, v) where
        none is given."""
        if form is not None:
            return signature(self.on_the_leaf(form)) if self.dimension else (0, 0)
        return signature(q.scaled(-1, q.times(self.linear, self.tensor)))

    def verdict(self, form: q.Matrix | None) -> str:
        """What is proved of its stability, by a form that is kept, or else by ω(Mv, v): the name
        of the sentence."""
        if self.entries != "yes":
            return "undecided"
        if form is not None and self.n in signature(form):
            return "stable_beyond"
        if self.dimension in self.squares(form):
            if self.regular:
                return "stable"
            if self.compact:
                return "stable_compact"
            if self.dimension:
                return "on_the_leaf"
        elif self.grows:
            return "unstable"
        if self.n == self.system.momenta and grows(self.characteristic_of_all):
            return "unstable_beyond"
        return "open" if self.dimension else "point"


@lru_cache(maxsize=8)
def equilibrium(system: ReducedSystem, point: tuple[tuple[Tree, Number], ...]) -> Equilibrium:
    """The point of a system, computed once for all that is said of it."""
    return Equilibrium(system, dict(point))
