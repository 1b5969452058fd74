"""The body on an orbit of the group: what tells g_t (8), and what becomes of distances (1)(6).

The points of the body are where they are by one element of the group.  Sums over them, at an
instant, tell which; and the distance of two of them changes through C = ĀA alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra import forms
from ..algebra.calculus import derivation, gradient, reduce, substitute, terms_with, without
from ..algebra.word_trees import WordNotation, metrics
from ..algebra.words import Expr, Letter, inner, number, word
from ..language.read import read
from ..language.tree import add, neg
from ..record.record import Equation, Step
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .lagrangian import Lagrangian
from .pullback import Moments, sum_over
from .trivialisation import body_rule, cauchy_green
from .wording import say, say_signed


def unique(points: Lagrangian, moments: Moments, a: Alphabet, c: Chapter) -> Step:
    """The step that tells A, and for an affine action T, by sums over the points where they are."""
    draft = c.draft("unique", "pull-back")
    centre = Letter("m⁻¹c", a.n)
    arm = word(a.r_i) - word(centre) if a.affine else word(a.r_i)
    turned = _summed(points, arm, moments, a)
    inertia = forms.strip_left(terms_with(turned, a.A.position), a.A.position)
    # what is left of T, nothing as m m⁻¹c = c
    rest = substitute(without(turned, a.A.position), {a.c: word(a.m) * word(centre)})
    notation = WordNotation(display={centre: read("m⁻¹c")})
    second = read("Σᵢ mᵢ rᵢ(t)(rᵢ − m⁻¹c)‾" if a.affine else "Σᵢ mᵢ rᵢ(t) r̄ᵢ")
    turning = add(second, neg(draft.tree(rest, notation)))
    named: list[Equation] = []
    second_moment = draft.tree(inertia, notation)
    if a.affine:
        named, second_moment = [Equation("J_c", second_moment)], "J_c"
    equations = [*named, Equation(("mul", turning, ("inv", second_moment)), "A")]
    if a.affine:
        mass = moments[a.m_i,]
        others = _summed(points, number(1), moments, a) - mass * word(a.T.position)
        left = add(read("Σᵢ mᵢ rᵢ(t)"), neg(draft.tree(others)))
        equations.append(Equation(("mul", ("inv", draft.tree(mass)), left), "T"))
    return draft.step(equations, _prose(a), (8,))


def _summed(points: Lagrangian, arm: Expr, moments: Moments, a: Alphabet) -> Expr:
    """The sum over the points Σ m_i r_i(t) x̄ for a vector x = ``arm`` of each, or Σ m_i r_i(t) for
    x = 1."""
    tested = Letter("Y", a.n, arm.rows)
    summand = inner(word(a.m_i) * points.position * arm.bar, word(tested))
    return gradient(sum_over(summand, {a.m_i, a.r_i}, moments), tested)


def _prose(a: Alphabet) -> Prose:
    where = say_signed("unique.affine_span" if a.affine else "unique.span", a.signed)
    return where + say("unique.elsewhere")


@dataclass(frozen=True)
class Distances:
    """The words for ‖r_i(t) − r_j(t)‖² and half its variation, by r_i − r_j."""

    square: Expr
    varied: Expr
    steps: tuple[Step, ...]


def _equations(d: Draft, square: Expr, varied: Expr, a: Alphabet) -> tuple[Equation, ...]:
    notation = metrics("C", display={a.difference: read("rᵢ − rⱼ")})
    return (
        Equation(read("‖rᵢ(t) − rⱼ(t)‖²"), d.tree(square, notation)),
        Equation(
            read("⟨rᵢ(t) − rⱼ(t), δ(rᵢ(t)) − δ(rⱼ(t))⟩"),
            d.tree(varied, notation),
        ),
    )


def distances(points: Lagrangian, a: Alphabet, c: Chapter) -> Distances:
    """‖r_i(t) − r_j(t)‖² by C, and half its variation, with their step."""
    draft = c.draft("distances", "trivialisation")
    other = Letter("r_j", a.n)
    beside = substitute(points.position, {a.r_i: word(other)})
    between = substitute(points.position, {a.r_i: word(other) + word(a.difference)}) - beside
    square, rule = inner(between, between), body_rule(a, cauchy_green(a))
    turned = {a.A.position: word(a.A.position) * word(a.Z.xi)}
    varied = reduce(derivation(square, turned.get), rule) * Fraction(1, 2)
    square = reduce(square, rule)
    step = draft.step(
        _equations(draft, square, varied, a),
        say("distances.cauchy_green"),
    )
    return Distances(draft.mark(square), draft.mark(varied), (step,))


def rigid(general: Distances, unit: Expr, a: Alphabet, c: Chapter) -> Step:
    """The step that says that C = 1 keeps the distances of the points, and that their variations
    vanish (6)."""
    draft = c.draft("rigid", "relation")
    square, varied = (a.respell(e, unit).of(unit) for e in (general.square, general.varied))
    return draft.step(
        _equations(draft, square, varied, a),
        say("rigid.orbit"),
        (1, 6),
    )
