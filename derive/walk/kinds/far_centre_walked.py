"""The gravity of a far centre, with T_b = ĀT, W = 1/‖T‖, V = GM/‖T‖, T seen from the centre:

    Ũ = −V(m − W²⟨T_b, c⟩ + ½ W²(3W²⟨T_b, J T_b⟩ − Tr AJĀ)),

the sum over the points of −V m_i (1 + s)^(−½), s = W²(2⟨T, x⟩ + ‖x‖²), x = A r_i, to the second
order in x.
"""

from __future__ import annotations

from fractions import Fraction

from ...algebra.calculus import reduce, substitute
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.tree import Tree, add, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation
from ...schema.potential_kinds import FarCentre
from ..chapter import Chapter, say
from ..given.potentials import PotentialLetter, Words, column, power_letter
from ..spine.alphabet import Alphabet
from ..spine.lagrangian import POINT, sum_over

KIND = FarCentre
HALF = Fraction(1, 2)
V, W = Letter("V"), Letter("W")


def words(problem: Problem, a: Alphabet, *, vectors: bool) -> Words | None:
    """The expansion on words, summed over the points; ``None`` without a far centre."""
    del vectors
    p = next((p for p in problem.potentials if isinstance(p, FarCentre)), None)
    if p is None:
        return None
    x, T_b = Letter("x", a.n), Letter("T_b", a.n)
    T = Letter("T − a", a.n) if p.centre else a.T.position
    seen: Tree = add("T", neg(column(p.centre))) if p.centre else "T"
    arm: Tree = add(POINT, neg("T"))
    distance: Tree = ("fun", "sqrt", ("norm2", seen))
    shown = WordNotation(display={a.m_i: ("at", "m", "i"), T: seen, x: arm})
    square, over = inner(word(T), word(T)), word(W) * word(W)
    near = inner(word(T), word(x))
    body = PotentialLetter(T_b, word(a.A.position).bar * word(T), (a.A.position, T))
    own = (
        *((PotentialLetter(T, word(a.T.position)),) if p.centre else ()),
        body,
        power_letter(W, square, -HALF, over),
        power_letter(V, square, -HALF, over),
    )
    return Words(
        _summed(a, x, T, body),
        [
            Equation("T_b", mul(("T", "A"), seen)),
            Equation("W", ("div", 1, distance)),
            Equation("V", ("div", p.strength, distance)),
        ],
        [("sum", "i", tree_of(_summand(a, x, near, near * near), shown))],
        say("potential.far_orders"),
        own,
    )


def _summand(a: Alphabet, x: Letter, near: Expr, squared: Expr) -> Expr:
    """The summand −V m_i (1 + s)^(−½), by the binomial series, with ``near`` = ⟨T, x⟩ and its
    square."""
    first, second = -HALF, -HALF * (-HALF - 1) / 2
    over = word(W) * word(W)
    linear = over * (2 * near + inner(word(x), word(x)))
    quadratic = 4 * over * over * squared
    return -word(a.m_i) * word(V) * (number(1) + first * linear + second * quadratic)


def _summed(a: Alphabet, x: Letter, T: Letter, body: PotentialLetter) -> Expr:
    """The sum over the points, where ⟨T, x⟩² is ⟨x, T T̄ x⟩, with T_b."""
    general, TT = Chapter(a.chapter), Letter("T T̄", a.n, a.n, 1)
    squared = inner(word(x), word(TT) * word(x))
    summand = _summand(a, x, inner(word(T), word(x)), squared)
    turned = (word(a.A.position) * word(a.r_i)).marked(general.label("action"))
    moments = {(a.m_i,): a.m, (a.m_i, a.r_i): a.c, (a.m_i, a.r_i, a.r_i): a.J}
    table = {k: word(x).marked(general.label("moments")) for k, x in moments.items()}
    total = sum_over(substitute(summand, {x: turned}), {a.m_i, a.r_i}, table)
    return reduce(substitute(total, {TT: word(T) * word(T).bar}), body.written)
