"""Steps 1 and 2: the Lagrangian of the points, the hypotheses, and L̃, pulled back to the group."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from ...algebra.calculus import derivation, map_terms, substitute
from ...algebra.word_trees import WordNotation, metrics, tree_of
from ...algebra.words import (
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
from ...language.read import read
from ...language.tree import Tree, add, neg, nodes, operands
from ...record.record import Equation, Hypothesis, Step, stated
from ..chapter import Chapter, say, say_signed, traced
from .alphabet import Alphabet

# What the walk supposes: hypotheses as data, by the sign of the masses.
#
# With positive masses the metric of the kinetic energy is definite on the group. Without that it
# is a quadratic form, degenerate for some bodies and, where it changes from place to place, at
# some elements of the group: then the steps hold wherever it is invertible, and say so.

ALWAYS = ("A", "Â", "C", read("Ā"), "g_1", ("T", "g_1"), "A_1", ("T", "A_1"))
"""The element of the group and C = ĀA, which have inverses without a hypothesis."""


# -- data ----------------------------------------------------------------------------------------


def kinetic_metric(kinetic: Expr, a: Alphabet) -> Hypothesis:
    """The hypothesis that the form ⟨δg, δ′g⟩ is not degenerate, half of which at δg = δ′g = ν is
    the kinetic energy."""
    form = derivation(kinetic, {p.velocity: word(p.d_position) for p in a.parts}.get)
    form = substitute(form, {p.velocity: word(p.dp_position) for p in a.parts})
    return regular(tree_of(form, metrics() if a.affine else metrics("J")), "T_g G")


def regular(form: Tree, space: str) -> Hypothesis:
    """The hypothesis that a form on a space is not degenerate; of ⟨Ω, Ω′⟩_I that I has an
    inverse."""
    if isinstance(form, tuple) and form[0] == "metric" and {*form[2:]} == {"Ω", "Ω′"}:
        return Hypothesis("invertible", form[1])
    return Hypothesis("nondegenerate", form, space)


def vertical_metric(
    vertical: Expr, horizontal: Mapping[Letter, Expr], notation: WordNotation, space: str
) -> Hypothesis:
    """The hypothesis that the metric is not degenerate, as it stands in −dϖ(δ, δ′) for a δ′ that
    varies the velocity alone.

    ``horizontal``: δ′v ↦ δ′x, of the same kind.
    """
    return regular(tree_of(-substitute(vertical, horizontal), notation), space)


def of_masses(a: Alphabet) -> tuple[Hypothesis, ...]:
    """The hypothesis that the masses are positive; none where they may have any sign."""
    return () if a.signed else (Hypothesis("positive", read("mᵢ")),)


def of_moments(signed: bool) -> tuple[Hypothesis, ...]:
    """The hypotheses that m, c, J are those of some positive masses: m > 0, and J − m⁻¹cc̄ has no
    negative square; none where masses may be negative."""
    if signed:
        return ()
    return Hypothesis("positive", "m"), Hypothesis("semidefinite", read("J − m⁻¹cc̄"))


MATRICES = frozenset({"J", "J_c", "J_D", "I", "I_c", "M", "K_G"})
"""The names that are matrices, among those that are inverted."""


def supposing(step: Step) -> Step:
    """The step with hypotheses for all that its equations divide by, or invert."""
    trees = (t for e in step.equations for side in (e.lhs, e.rhs) for t in _inverted(side))
    needed = (Hypothesis("invertible" if _matrix(t) else "nonzero", t) for t in trees)
    return replace(step, hypotheses=tuple(dict.fromkeys((*step.hypotheses, *needed))))


def _matrix(t: Tree) -> bool:
    if isinstance(t, tuple):
        return t[0] == "matrix" or (t[0] == "add" and _matrix(t[1]))
    return t in MATRICES


def completed(steps: Iterable[Step]) -> tuple[Step, ...]:
    """Every step with all those that it uses, and hypotheses for what it divides by, or inverts."""
    return tuple(map(supposing, traced(steps)))


def _inverted(t: Tree) -> Iterator[Tree]:
    """The trees that stand in a denominator of a tree, or are inverted; without numbers, A
    and C."""
    if not isinstance(t, tuple):
        return
    for x in operands(t):
        yield from _inverted(x)
    inverse = t[0] in ("inv", "div") or (t[0] == "pow" and t[2] < 0)
    below = t[2] if t[0] == "div" else t[1] if inverse else 1
    if below not in ALWAYS and not _constant(below):
        yield below


def _constant(t: Tree) -> bool:
    """Is a tree a number as it stands, made of numbers and π alone?"""
    leaves = (x for x in nodes(t) if not operands(x))
    return all(x == "π" or isinstance(x, (int, Fraction)) or x == ("one",) for x in leaves)


# Step 1. The Lagrangian of the points (3), the motion that the group gives them (7)–(10), (14).
#
# L = Σᵢ ½ mᵢ ‖vᵢ‖² − U,  rᵢ(t) = A rᵢ + T,  vᵢ = α rᵢ + τ

POINT = read("rᵢ(t)")
"""r_i(t), the point in space; r_i alone is the point in the body."""


@dataclass(frozen=True)
class PointLagrangian:
    """The Lagrangian of the points, on words: ``kinetic``: the summand ½ m_i ⟨v_i, v_i⟩, with v_i
    given by ``velocity``.

    ``position``: the place of a point in space, ``variation``: its δ.
    """

    kinetic: Expr
    v_i: Letter
    position: Expr
    velocity: Expr
    variation: Expr
    steps: tuple[Step, ...]


def kinetic_energy(v_i: Letter, a: Alphabet) -> Expr:
    """The summand ½ m_i ⟨v_i, v_i⟩ of L = Σ_i ½ m_i ⟨v_i, v_i⟩ − U."""
    return Fraction(1, 2) * word(a.m_i) * inner(word(v_i), word(v_i))


def velocities(position: Expr, a: Alphabet) -> tuple[Expr, Expr]:
    """The velocity v_i = α r_i + τ and the variation δr_i(t) = δA r_i + δT, from r_i(t) = A r_i +
    T."""
    velocity = derivation(position, {p.position: word(p.velocity) for p in a.parts}.get)
    variation = derivation(position, {p.position: word(p.d_position) for p in a.parts}.get)
    return velocity, variation


def lagrangian(a: Alphabet, c: Chapter) -> PointLagrangian:
    """L, and the places and velocities that an element of the group and a tangent vector give to
    the points."""
    first = c.draft("lagrangian", "definition")
    kinetic = kinetic_energy(v_i := Letter("v_i", a.n), a)
    acting = c.draft("action", "definition")
    position = acting.mark(a.acted_on(word(a.A.position), word(a.T.position)))
    varied = c.draft("velocity", "variation")
    velocity, variation = velocities(position, a)
    varied.depends_on(velocity, variation)
    steps = (
        first.step(
            (Equation("L", add(("sum", "i", indexed_tree(kinetic, v_i, a)), neg("U"))),),
            say("lagrangian.points"),
            (3,),
        ),
        acting.step(
            (Equation(POINT, indexed_tree(position, v_i, a)),),
            say("action.affine" if a.affine else "action.linear"),
            (7, 8),
        ),
        varied.step(
            (
                Equation(read("vᵢ"), indexed_tree(velocity, v_i, a)),
                Equation(read("δ(rᵢ(t))"), indexed_tree(variation, v_i, a)),
            ),
            say(f"velocity.{'affine' if a.affine else 'linear'}") + say("velocity.independent"),
            (9, 10, 14),
        ),
    )
    velocity, variation = varied.mark(velocity), varied.mark(variation)
    return PointLagrangian(first.mark(kinetic), v_i, position, velocity, variation, steps)


def indexed_tree(e: Expr, v_i: Letter, a: Alphabet, v: Tree = "") -> Tree:
    """The tree of a summand, with m_i, r_i, v_i as members of indexed families; ``v``: the tree for
    v_i."""
    display = {a.m_i: read("mᵢ"), a.r_i: read("rᵢ"), v_i: v or read("vᵢ")}
    return tree_of(e, metrics(display=display))


def moving_tree(stage: PointLagrangian, a: Alphabet) -> Tree:
    """The tree of the summand ½ m_i ‖v_i‖², with the velocity of the motion for v_i."""
    return indexed_tree(stage.kinetic, stage.v_i, a, indexed_tree(stage.velocity, stage.v_i, a))


# Step 2. L̃, the Lagrangian pulled back to the group (11)–(22), and the force on the group (24).
#
# L̃ = Σᵢ ½ mᵢ ‖α rᵢ + τ‖² − Ũ,  L̃ = ½ Tr αJᾱ + ⟨αc, τ⟩ + ½m ‖τ‖² − Ũ
#
# The sum over the points is carried out on words: what stands between the members of an indexed
# family is common to all of them, so  m_i r_i r̄_i → J,  m_i r_i → c,  m_i → m  (18)(19), and
# F_i r̄_i → N,  F_i → F  for the forces.

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


def pulled_back(stage: PointLagrangian, moments: Moments, a: Alphabet) -> Expr:
    """L̃ + Ũ = Σ_i ½ m_i ‖α r_i + τ‖²: the velocities put in, and the sum carried out."""
    kinetic = substitute(stage.kinetic, {stage.v_i: stage.velocity})
    return sum_over(kinetic, {a.m_i, a.r_i}, moments)


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


def pullback(stage: PointLagrangian, a: Alphabet, c: Chapter) -> Pullback:
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
        stated("m = Σᵢ mᵢ,  c = Σᵢ mᵢ rᵢ,  J = Σᵢ mᵢ rᵢ r̄ᵢ"), say("moments.only"), (18, 19)
    )
    table = {(a.m_i,): a.m, (a.m_i, a.r_i): a.c, (a.m_i, a.r_i, a.r_i): a.J}
    return {key: draft.mark(word(x)) for key, x in table.items()}, step


def _force(stage: PointLagrangian, a: Alphabet, c: Chapter) -> tuple[Expr, Moments, Step]:
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
