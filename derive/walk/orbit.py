"""The body on an orbit of the group: what tells g_t (8), and what becomes of distances (1)(6).

The points of the body are where they are by one element of the group.  Sums over them, at an
instant, tell which; and the distance of two of them changes through C = ĀA alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra.calculus import derivation, gradient, reduce, substitute
from ..algebra.notation import metrics
from ..algebra.tree import Tree, add, neg
from ..algebra.words import Expr, Letter, inner, word
from ..record.hypotheses import Hypothesis
from ..record.record import Equation, Step
from ..record.sentence import say
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .lagrangian import POINT, Lagrangian
from .pullback import Moments, sum_over
from .supposed import CENTRAL
from .trivialisation import frame_rule, gram

R_I, R_J, M_I = (("at", x, i) for x, i in (("r", "i"), ("r", "j"), ("m", "i")))
OTHER: Tree = ("call", R_J, "t")
APART: Tree = add(POINT, neg(OTHER))
VARIED: Tree = add(("call", "δ", POINT), neg(("call", "δ", OTHER)))


def unique(points: Lagrangian, moments: Moments, a: Alphabet, c: Chapter) -> Step:
    """Σ m_i r_i(t) r̄_i = AJ, and for an affine action two equations for A and T."""
    draft = c.draft("unique", "pull-back")
    any_matrix, any_vector = Letter("Y", a.n, a.n), Letter("y", a.n)
    placed, members = word(a.m_i) * points.position, {a.m_i, a.r_i}
    paired = sum_over(inner(placed * word(a.r_i).bar, word(any_matrix)), members, moments)
    second: Tree = ("sum", "i", ("mul", M_I, POINT, ("T", R_I)))
    equations = [Equation(second, draft.tree(gradient(paired, any_matrix)))]
    if a.affine:
        paired = sum_over(inner(placed, word(any_vector)), members, moments)
        first: Tree = ("sum", "i", ("mul", M_I, POINT))
        equations.insert(0, Equation(first, draft.tree(gradient(paired, any_vector))))
    return draft.step(
        equations,
        (
            say(
                "The places of the points tell g where the points are not in one hyperplane: g_t "
                "is then the only element that moves the body so, and is as smooth in t as they "
                "are."
            )
            if a.affine
            else say(
                "The places of the points tell g where the points span the space: g_t is then the "
                "only element that moves the body so, and is as smooth in t as they are."
            )
        )
        + say(
            "Elsewhere the path is told by its start, if no tangent vector but 0 leaves all the "
            "points at rest."
        ),
        (8,),
        hypotheses=(
            (Hypothesis("nonzero", "m"), Hypothesis("invertible", CENTRAL))
            if a.affine
            else (Hypothesis("invertible", "J"),)
        ),
    )


@dataclass(frozen=True)
class Distances:
    """‖r_i(t) − r_j(t)‖² and half its variation, by r_i − r_j."""

    square: Expr
    varied: Expr
    step: Step


def _equations(d: Draft, square: Expr, varied: Expr, a: Alphabet) -> tuple[Equation, ...]:
    notation = metrics("C", display={a.apart: add(R_I, neg(R_J))})
    return (
        Equation(("norm2", APART), d.tree(square, notation)),
        Equation(("inner", APART, VARIED), d.tree(varied, notation)),
    )


def distances(points: Lagrangian, a: Alphabet, c: Chapter) -> Distances:
    """The square of a distance by C, and its variation."""
    draft = c.draft("distances", "trivialisation")
    other = Letter("r_j", a.n)
    beside = substitute(points.position, {a.r_i: word(other)})
    between = substitute(points.position, {a.r_i: word(other) + word(a.apart)}) - beside
    square, rule = inner(between, between), frame_rule(a, gram(a))
    turned = {a.A.position: word(a.A.position) * word(a.Z.xi)}
    varied = reduce(derivation(square, turned.get), rule) * Fraction(1, 2)
    square = reduce(square, rule)
    step = draft.step(
        _equations(draft, square, varied, a),
        say("The distances of the points change through C alone, the Cauchy–Green matrix."),
    )
    return Distances(draft.said(square), draft.said(varied), step)


def rigid(general: Distances, unit: Expr, a: Alphabet, c: Chapter) -> Step:
    """C = 1: the distances are kept, and by their variations (6)."""
    draft = c.draft("rigid", "relation")
    square, varied = (a.respell(e, unit).of(unit) for e in (general.square, general.varied))
    return draft.step(
        _equations(draft, square, varied, a),
        say(
            "The body is rigid: C = 𝟏 says that the distances of its points are kept, so that it "
            "moves on an orbit of the isometries."
        ),
        (1, 6),
    )
