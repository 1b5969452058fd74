"""The gravity of a homogeneous ellipsoid on itself.

With X = K_G ĀA, P(u) = det(X + u) and δP = Tr adj(X + u) δX,

    δ ∫ P^(−½) du = −½ ∫ P^(−3/2) Tr adj(X + u) K_G δ(ĀA) du,

where adj(X + u) K_G is a polynomial in u: its coefficients are :func:`_adjugate`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from ...algebra.calculus import derivation
from ...algebra.words import Expr, Factor, Letter, one, trace, word
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.kinds.self_gravity import SelfGravity
from ..alphabet import Alphabet
from ..inverse import inverse_letter
from ..potential_letters import PotentialLetter, Words
from ..wording import say

KIND = SelfGravity
HALF, SHARE = Fraction(1, 2), Fraction(3, 10)
"""SHARE: the energy of a homogeneous ball of radius a is −(3/5) Gm²/a, and there Ψ = 2/a."""

CARRIED: Tree = ("mul", "A", "K_G", ("T", "A"))
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
    A, energy, B = word(a.A.position), Letter("U_G"), Letter("B_G", a.n, a.n, 1)
    scale = mul(SHARE, p.G, ("pow", "m", 2))
    unimodular = "unimodular" in problem.group.relations
    return Words(
        word(energy),
        [
            *_invariants(unimodular=unimodular),
            Equation("U_G", mul(-1, scale, _integral("Ψ"))),
            Equation("B_G", mul(scale, _summed(_adjugate()))),
        ],
        ["U_G"],
        say("potential.self_gravity"),
        [GradientLetter(energy, A.bar * A, gradient=B, slope=_slope(a))],
    )


def _invariants(*, unimodular: bool) -> list[Equation]:
    """The equations of K_G, of the adjugates, and of the coefficients of det(AK_GĀ + u)."""
    volume, inverse = ("det", "K_G"), ("inv", "A")
    return [
        Equation("K_G", mul(("div", 5, "m"), "J")),
        Equation("K_a", mul(volume, ("inv", "K_G"))),
        Equation("A_a", inverse if unimodular else mul(("det", "A"), inverse)),
        Equation("C_a", mul("A_a", ("T", "A_a"))),
        Equation("I_1", ("tr", CARRIED)),
        Equation("I_2", ("tr", ("mul", "K_a", "C_a"))),
        Equation("I_3", volume if unimodular else mul(volume, ("pow", ("det", "A"), 2))),
    ]


def _slope(a: Alphabet) -> Expr:
    """B_G as a word: K_G is J but for a factor, and each Ψ_k and invariant is a number."""
    K, C = 5 * word(inverse_letter(a.m)) * word(a.J), word(a.C)
    first, last, C_a = word(Letter("I_1")), word(Letter("det_K")), word(Letter("C_a", a.n, a.n, 1))
    coefficients = (last * C_a, first * K - K * C * K, K)
    integrals = (word(Letter(f"Ψ_{k}")) for k in range(3))
    return sum((x * y for x, y in zip(integrals, coefficients, strict=True)), start=K * 0)


def _adjugate() -> tuple[Tree, Tree, Tree]:
    """The coefficients of 1, u and u² in adj(X + u) K_G, for X = K_G ĀA: adj(X) K_G, which is
    det(K_G) adj(ĀA), then (Tr X − X) K_G, and K_G."""
    carried = mul("K_G", ("T", "A"), "A", "K_G")
    return mul(("det", "K_G"), "C_a"), add(mul("I_1", "K_G"), neg(carried)), "K_G"


def _summed(coefficients: tuple[Tree, ...]) -> Tree:
    """The sum of the coefficients of u^k, each times ∫ u^k P^(−3/2) du = Ψ_k."""
    return add(*(mul(_integral(f"Ψ_{k}"), x) for k, x in enumerate(coefficients)))


def _integral(name: str) -> Tree:
    return ("call", name, *INVARIANTS)
