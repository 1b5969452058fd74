"""Step 2.  L̃, the Lagrangian pulled back to the group (11)–(22), and the force on the group (24).

L̃ = Σᵢ ½ mᵢ ‖α rᵢ + τ‖² − Ũ,  L̃ = ½ Tr αJᾱ + ⟨αc, τ⟩ + ½m ‖τ‖² − Ũ

The sum over the points is carried out on words: what stands between the members of an indexed
family is common to all of them, so  m_i r_i r̄_i → J,  m_i r_i → c,  m_i → m  (18)(19), and
F_i r̄_i → N,  F_i → F  for the forces.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from ..algebra.calculus import map_terms
from ..algebra.word_trees import metrics
from ..algebra.words import (
    Expr,
    Letter,
    Traces,
    Word,
    expr_of_word,
    inner,
    rotations,
    row_dim,
    scalar_of,
    trace,
    transpose_word,
    word,
)
from ..language.read import read
from ..language.tree import add, neg
from ..record.record import Equation, Hypothesis, Step, stated
from .alphabet import Alphabet
from .chapter import Chapter
from .lagrangian import Lagrangian, kinetic_of_motion, moving_tree
from .regularity import kinetic_metric, of_masses
from .wording import say, say_signed

Moments = Mapping[tuple[Letter, ...], Expr]
"""Σ of a product of members: (m, r, r) ↦ Σ m_i r_i r̄_i, (F, r) ↦ Σ F_i r̄_i, (m,) ↦ Σ m_i, …"""


@dataclass(frozen=True)
class Pullback:
    """L̃ on words: ``kinetic``: its quadratic part, so that L̃ = kinetic − Ũ.

    ``work``: −dŨ(δg), by the force on the group, or by the moments of forces for an affine action;
    ``moment_work``: by these always. ``moments``: of masses and of forces.
    """

    kinetic: Expr
    work: Expr
    moment_work: Expr
    moments: Moments
    steps: tuple[Step, ...]


def pulled_back(stage: Lagrangian, moments: Moments, a: Alphabet) -> Expr:
    """L̃ + Ũ = Σ_i ½ m_i ‖α r_i + τ‖²: the velocities put in, and the sum carried out."""
    return sum_over(kinetic_of_motion(stage), {a.m_i, a.r_i}, moments)


def sum_over(e: Expr, members: set[Letter], moments: Moments) -> Expr:
    """The sum Σ_i of a scalar summand, in which ``members`` are the letters of indexed families, by
    a table of moments.

    ``ValueError`` for a product of two moments; ``KeyError`` for a moment that is not in the table.
    """

    def summed(traces: Traces, _: Word, c: Fraction) -> Expr:
        among = [w for w in traces if any(x in members for x, _ in w)]
        weights = tuple(w[0][0] for w in among if len(w) == 1)
        holders = [w for w in among if len(w) > 1]
        if len(holders) > 1:
            raise ValueError("a product of two moments is not a moment")
        common = scalar_of(tuple(w for w in traces if w not in among), c)
        moment = _moment(weights, holders[0], members, moments) if holders else moments[weights]
        return common * moment

    return map_terms(e, summed)


def _moment(weights: tuple[Letter, ...], w: Word, members: set[Letter], moments: Moments) -> Expr:
    """The sum of a scalar word x̄ W y over its members: Tr W Σ y x̄, or (Σ x)‾ W y."""
    sign, opened = 1, next(t for t in rotations(w) if row_dim(t[0]) == 1)
    if opened[0][0] not in members:
        sign, opened = transpose_word(opened)
    x, y = opened[0][0], opened[-1][0]
    if y not in members:
        return sign * (moments[(*weights, x)].bar * expr_of_word(opened[1:]))
    key = (*weights, y, x)
    second = moments[key] if key in moments else moments[(*weights, x, y)].bar
    middle = opened[1:-1]
    if not middle:
        return sign * trace(second)
    return sign * trace(expr_of_word(middle) * second)


def pullback(stage: Lagrangian, a: Alphabet, c: Chapter) -> Pullback:
    """L̃: the motion put into L and summed over the points; then the force on the group."""
    moments, definitions = _moments(a, c)
    draft = c.draft("pullback", "pull-back")
    kinetic = pulled_back(stage, moments, a)
    metric = kinetic_metric(kinetic, a)
    notations = (metrics(),) if a.affine else (metrics(), metrics("J"))
    step = draft.step(
        [
            Equation("Ũ", "U"),
            Equation("L̃", add(("sum", "i", moving_tree(stage, a)), neg("Ũ"))),
            *(Equation("L̃", draft.tree(kinetic - word(a.U), n)) for n in notations),
        ],
        say("pullback.pulled") + say_signed("pullback.metric", a.signed),
        (11, 12, 13, 17) if a.affine else (11, 12, 13, 21, 22),
        hypotheses=(*of_masses(a), metric),
    )
    moment_work, sums, force = _force(stage, a, c)
    moments, steps = {**moments, **sums}, (definitions, step, force)
    if a.affine:
        return Pullback(draft.mark(kinetic), moment_work, moment_work, moments, steps)
    work, gradient = _gradient(a, c, metric)
    return Pullback(draft.mark(kinetic), work, moment_work, moments, (*steps, gradient))


def _moments(a: Alphabet, c: Chapter) -> tuple[Moments, Step]:
    """The table of m, c and J, the letters that the sums over the points become, and the step that
    defines them."""
    draft = c.draft("moments", "definition")
    step = draft.step(
        stated("m = Σᵢ mᵢ,  c = Σᵢ mᵢ rᵢ,  J = Σᵢ mᵢ rᵢ r̄ᵢ"),
        say("moments.only"),
        (18, 19),
    )
    table = {(a.m_i,): a.m, (a.m_i, a.r_i): a.c, (a.m_i, a.r_i, a.r_i): a.J}
    return {key: draft.mark(word(x)) for key, x in table.items()}, step


def _force(stage: Lagrangian, a: Alphabet, c: Chapter) -> tuple[Expr, Moments, Step]:
    """−dŨ(δg) by the forces on the points, F_i = −∂U/∂r_i, a sum like that of the moments; the
    table of their moments, and the step."""
    table = {(a.F_i, a.r_i): word(a.N), (a.F_i,): word(a.F)}
    draft = c.draft("force", "pull-back")
    work = sum_over(inner(word(a.F_i), stage.variation), {a.F_i, a.r_i}, table)
    definitions = stated("N = Σᵢ Fᵢ r̄ᵢ,  F = Σᵢ Fᵢ" if a.affine else "N = Σᵢ Fᵢ r̄ᵢ")
    varied = read("dŨ(δA, δT)" if a.affine else "dŨ(δA)")
    acting = neg(("sum", "i", read("⟨Fᵢ, δ(rᵢ(t))⟩")))
    step = draft.step(
        (*definitions, Equation(varied, acting), Equation(varied, draft.tree(-work))),
        say("force.points"),
        (2,),
    )
    return draft.mark(work), {key: draft.mark(e) for key, e in table.items()}, step


def _gradient(a: Alphabet, c: Chapter, metric: Hypothesis) -> tuple[Expr, Step]:
    """−dŨ(δA) = ⟨F̃, δA⟩_J by the force on the group, and the step that says so (24)."""
    draft = c.draft("gradient", "definition")
    pairing = inner(word(a.F_group), word(a.A.d_position), word(a.J))
    step = draft.step(
        (Equation(draft.tree(pairing, metrics("J")), read("−dŨ(δA)"), ("δA",)),),
        say("gradient.metric"),
        (24,),
        hypotheses=(metric,),
    )
    return draft.mark(pairing), step
