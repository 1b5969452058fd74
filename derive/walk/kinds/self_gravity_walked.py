"""The gravity of a homogeneous ellipsoid on itself.

With X = K_G ĀA and P(u) = det(X + u), whose derivatives are δP = Tr adj(X + u) δX,

    δ ∫ P^(−½) du = −½ ∫ P^(−3/2) Tr adj(X + u) K_G δ(ĀA) du.

adj(X + u) is a polynomial in u by the theorem of Cayley and Hamilton, and P′(u) is its trace.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from ...algebra.calculus import (
    adjugate,
    derivation,
    determinant,
    determinant_letter,
    power_of,
    reduce,
    substitute,
)
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, number, one, trace, word
from ...language.tree import Tree, add, mul
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.potential_kinds import SelfGravity
from ..chapter import say
from ..given.potentials import PotentialLetter, Words
from ..spine.alphabet import Alphabet, inverse_letter

KIND = SelfGravity
HALF, SHARE = Fraction(1, 2), Fraction(3, 10)
"""SHARE: the energy of a homogeneous ball of radius a is −(3/5) Gm²/a, and there Ψ = 2/a."""

INVARIANTS = ("I_1", "I_2", "I_3")


@dataclass(frozen=True)
class GradientLetter(PotentialLetter):
    """A scalar letter x, a function of the symmetric ``value``, with δx = ½ Tr B δ(value).

    ``gradient``: B, which stands for ``slope``, in letters of the body and C.
    """

    gradient: Letter = field(kw_only=True)
    slope: Expr = field(kw_only=True)

    def varied(self, delta: Callable[[Letter], Expr | None]) -> Expr:
        """The derivative of the letter, by its gradient."""
        return HALF * trace(word(self.gradient) * derivation(self.value, delta))

    @staticmethod
    def adjugate(left: Factor, right: Factor) -> Expr | None:
        """C C_a = C_a C = det C 1."""
        both = {left[0].name, right[0].name} == {"C", "C_a"}
        return word(Letter("det_C")) * one(left[0].rows) if both else None


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """Self-gravity as the letter U_G; ``None`` without it."""
    del vectors
    p = next((p for p in problem.potentials if isinstance(p, SelfGravity)), None)
    if p is None:
        return None
    assert problem.group is not None
    ellipsoid = _Ellipsoid(a, unimodular="unimodular" in problem.group.relations)
    A, energy, B = word(a.A.position), Letter("U_G"), Letter("B_G", a.n, a.n, 1)
    scale = mul(SHARE, p.G, ("pow", "m", 2))
    return Words(
        word(energy),
        [
            *ellipsoid.definitions(),
            Equation("U_G", mul(-1, scale, _integral("Ψ"))),
            Equation("B_G", mul(scale, ellipsoid.summed())),
        ],
        ["U_G"],
        say("potential.self_gravity"),
        [GradientLetter(energy, A.bar * A, gradient=B, slope=ellipsoid.slope())],
    )


class _Ellipsoid:
    """K_G with the coefficients of 1, u, u² in adj(X + u)K_G; ``unimodular``: is det A = 1?"""

    def __init__(self, a: Alphabet, *, unimodular: bool) -> None:
        self.a, self.unimodular = a, unimodular
        self.K, self.K_a, self.C_a, self.A_a = (
            Letter(x, a.n, a.n, symmetry)
            for x, symmetry in (("K_G", 1), ("K_a", 1), ("C_a", 1), ("A_a", 0))
        )
        u, self.X = Letter("u"), Letter("X_G", a.n, a.n)
        X = word(self.X)
        shifted = adjugate(X + word(u) * one(a.n))
        last, self.among, highest = (power_of(shifted, u, k) for k in range(3))
        if last != adjugate(X):
            raise ValueError("adj(X + u) at u = 0 is not adj X")
        self.last = word(self.C_a) * word(self.K_a)  # adj X, the adjugate of a product
        among = self._by_C(self.among)
        self.first = Fraction(1, 2) * trace(among)  # I_1, for P′ = 3u² + 2I_1u + I_2
        products = (self.last, among, highest)
        self.coefficients = tuple(reduce(x * word(self.K), self._adjugates) for x in products)

    def _by_C(self, e: Expr) -> Expr:
        """An expression with X_G = K_G C."""
        return substitute(e, {self.X: word(self.K) * word(self.a.C)})

    def _adjugates(self, left: Factor, right: Factor) -> Expr | None:
        """K_a K_G = det K_G 1."""
        pair = {left[0], right[0]} == {self.K_a, self.K}
        return word(determinant_letter(self.K)) * one(self.a.n) if pair else None

    def definitions(self) -> list[Equation]:
        """The equations of K_G, of the adjugates, and of the coefficients of det(AK_GĀ + u)."""
        volume, inverse = ("det", "K_G"), ("inv", "A")
        return [
            Equation("K_G", mul(("div", 5, "m"), "J")),
            Equation("K_a", mul(volume, ("inv", "K_G"))),
            Equation("X_G", self._tree(self._by_C(word(self.X)))),
            Equation("A_a", inverse if self.unimodular else mul(("det", "A"), inverse)),
            Equation("C_a", tree_of(word(self.A_a) * word(self.A_a).bar)),  # adj ĀA = adj A adj Ā
            Equation("I_1", self._tree(self.first)),
            Equation("I_2", self._tree(trace(self.last))),
            Equation(
                "I_3", mul(*map(self._tree, map(determinant, (word(self.K), word(self.a.C)))))
            ),
        ]

    def _without_metric(self, e: Expr) -> Expr:
        """An expression with C = ĀA, and det C the square of det A."""
        A = word(self.a.A.position)
        square = number(1) if self.unimodular else determinant(A.bar * A)
        return substitute(e, {self.a.C: A.bar * A, determinant_letter(self.a.C): square})

    def _tree(self, e: Expr) -> Tree:
        letters = {determinant_letter(x): ("det", x.name) for x in (self.K, self.a.A.position)}
        return tree_of(self._without_metric(e), WordNotation(display=letters))

    def summed(self) -> Tree:
        """The sum of the coefficients of u^k, each times ∫ u^k P^(−3/2) du = Ψ_k."""
        last, _, highest = map(self._tree, self.coefficients)
        among = mul(self._tree(self.among), "K_G")  # as it stands: in the code its terms cancel
        return add(*(mul(_integral(f"Ψ_{k}"), x) for k, x in enumerate((last, among, highest))))

    def slope(self) -> Expr:
        """The same as a word: K_G is J but for a factor, and each Ψ_k and invariant is a number."""
        K = 5 * word(inverse_letter(self.a.m)) * word(self.a.J)
        terms = (word(Letter(f"Ψ_{k}")) * x for k, x in enumerate(self.coefficients))
        return substitute(sum(terms, start=K * 0), {self.K: K})


def _integral(name: str) -> Tree:
    return ("call", name, *INVARIANTS)
