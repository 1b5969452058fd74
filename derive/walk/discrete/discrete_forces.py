"""Forces of a discrete motion: from potentials, inputs and damping; what it keeps by Noether."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from ...algebra.calculus import derivation, gradient, reduce, substitute, without
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, inner, number, one, word, zero
from ...language.tree import add, neg, replaced
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ...record.sentence import enumerated
from ..chapter import Chapter, WalkError, say
from ..given.body_and_potentials import Potentials, body_step, potentials
from ..given.inputs import acts, damping_coefficients, external_matrices, where_given
from ..matrices.conserved import kept_momenta
from ..spine.alphabet import Alphabet, cancel_scalar, cancelling, inverse_letter
from ..spine.lagrangian import sum_over
from .discrete_blocks import Blocks
from .discrete_road import DiscreteAlphabet, DiscreteMotion, OneForms, opened, rewritten

# The forces of a problem at g₁: N₁ and f₁ on words, as its potential gives them.


@dataclass(frozen=True)
class DiscreteForces:
    """``moments`` N₁ and ``resultant`` f₁ on words in g₁, or A₁, and its ``inverse``;
    ``potential``: on words in A and T, of ``letters``, which the step ``place`` says."""

    moments: Expr
    resultant: Expr
    potential: Potentials
    letters: Alphabet
    notation: WordNotation
    inverse: Expr
    place: Step
    steps: tuple[Step, ...]


def forces(
    problem: Problem, group: Group, general: DiscreteAlphabet, a: Alphabet, c: Chapter
) -> DiscreteForces:
    """The numbers of the body, the potential where A is that of g₁, and its forces there.

    ``general``: the letters of any group, for the name of their chapter.
    """
    place: tuple[str, ...] = ("A_1", "T_1") if group.affine else ("g_1",)
    naming, acting = c.draft("place", "definition"), c.draft("force", "variation")
    located = [*zip(a.parts, place, strict=True)]
    parts = (Equation(x.position.name, y) for x, y in located)
    named = naming.step(parts, say("place.discrete"))
    v = potentials(problem, a, c)
    heard = {f"{a.chapter}.action": named.label}
    heard[f"{a.chapter}.moments"] = Chapter(general.chapter).label("moments")
    # a step of the continuous walk by the steps of this record that say what it uses
    steps_of_potentials = tuple(
        replace(s, uses=tuple(dict.fromkeys(heard.get(x, x) for x in s.uses))) for s in v.steps
    )
    back, moved = inverse_letter(a.A.position), (a.A.d_position, a.T.d_position)
    eta = word(back) * word(moved[1]) if a.affine else None
    images = v.displaced(a, word(back) * word(moved[0]), eta)
    work = reduce(-derivation(v.energy, images.get), cancelling(a.A.position))
    at_element = {x.position: word(replace(x.position, name=y)) for x, y in located}
    inverse = Letter(f"{place[0]}⁻¹", a.n, a.n)
    turned = "orthogonal" in group.relations
    at_element[back] = at_element[a.A.position].bar if turned else word(inverse)
    moments, resultant = (substitute(gradient(work, x), at_element) for x in moved)
    notation = WordNotation(display={inverse: ("inv", place[0])})
    equations = [Equation("U_1", "Ũ"), Equation("N_1", acting.tree(moments, notation))]
    if a.affine:
        equations.append(Equation("f_1", acting.tree(resultant, notation)))
    steps = (
        *body_step(problem, None, a, c),
        named,
        *steps_of_potentials,
        acting.step(equations, say("force.at_element")),
    )
    moments, resultant = acting.mark(moments), acting.mark(resultant)
    return DiscreteForces(moments, resultant, v, a, notation, at_element[back], named, steps)


# Inputs and damping in the discrete motion, by d'Alembert's principle: their work in a step is
# taken half at either end, so that at g₁ half of two steps meets.
#
# Inputs are held at g₁; a damping −κ v has in each step the velocity of that step.

HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Outside:
    """What acts from outside L_d: ``moments`` and ``resultant`` of the inputs in the body, on
    words; ``damping``: D, Σ κ r r̄, of the size of the group's matrices, or none; ``tested``: what
    they add to the balance on ξ."""

    moments: Expr
    resultant: Expr
    damping: Letter | None
    tested: Expr
    steps: tuple[Step, ...]


def outside(
    problem: Problem, stage: DiscreteMotion, group: Group, forces: DiscreteForces, c: Chapter
) -> Outside | None:
    """What acts from outside, with its steps and the balance with it; ``None`` where nothing
    does."""
    if not acts(problem):
        return None
    a, b = DiscreteAlphabet(group.size, affine=group.affine), Blocks(group.n, group.size)
    steps: list[Step] = []
    moments, resultant = zero(b.n, b.n), zero(b.n)
    tested = number(0)
    if problem.inputs:
        steps.append(_inputs(problem, group, forces, c))
        letters = replace(b.N, name="N_u"), replace(b.F, name="F_u")
        moments, resultant = (word(x).marked(steps[-1].label) for x in letters)
        balance = b.in_one_matrix(moments, resultant) if group.affine else moments
        tested = tested - word(a.h) * inner(balance, word(a.xi))
    damping = Letter("D\u0302" if group.affine else "D", group.size, group.size, 1)
    if problem.damping:
        step = _damping(problem, damping, a, c)
        steps.append(step)
        tested = tested + drag(damping, a).marked(step.label)
    draft = c.draft("dalembert", "kernel")
    balance = rewritten(stage.tested, a.letters, 1) + tested
    if "orthogonal" in group.relations and not group.affine:
        balance = _on_skew(balance, a)
    equation = Equation(draft.tree(balance, a.notation), 0, (a.xi.name,))
    steps.append(draft.step((equation,), say("dalembert.balance")))
    found = damping if problem.damping else None
    return Outside(moments, resultant, found, draft.mark(tested), tuple(steps))


def _on_skew(e: Expr, a: DiscreteAlphabet) -> Expr:
    """What a skew ξ feels, by ḡ₁g₁ = 1."""

    def turning(x: Factor, y: Factor) -> Expr | None:
        return one(a.n) if (x, y) == ((a.g[1], True), (a.g[1], False)) else None

    skew = word(replace(a.xi, symmetry=-1))
    return reduce(substitute(substitute(e, opened(a.g)), {a.xi: skew}), turning)


def _inputs(problem: Problem, group: Group, forces: DiscreteForces, c: Chapter) -> Step:
    """The step of the moments of inputs in the body."""
    a = forces.letters
    turned = "orthogonal" in group.relations
    C = a.unit if turned else word(a.C)
    found = external_matrices(replace(problem, damping=()), a, C, c)
    assert found is not None
    (step,) = found.steps
    stretched = ("mul", ("T", "A"), "A")
    equations = tuple(Equation(e.lhs, replaced(e.rhs, "C", stretched)) for e in step.equations)
    return replace(step, equations=equations, prose=say("input.discrete") + where_given(problem))


def drag(D: Letter, a: DiscreteAlphabet) -> Expr:
    """Minus the work of damping at g₁ on ξ: of a force −κ v, half of that of each step."""
    kappa, r = Letter("κ_i"), a.r_i
    moved = word(a.g[1]) * word(a.xi) * word(r)
    total = number(0)
    for x, y in pairwise(a.g):
        across = word(y) - word(x)
        velocity = word(inverse_letter(a.h)) * across * word(r)
        total = total + HALF * word(a.h) * word(kappa) * inner(velocity, moved)
    found = sum_over(total, {kappa, r}, {(kappa, r, r): word(D)})
    return cancel_scalar(found, a.h)


def _damping(problem: Problem, D: Letter, a: DiscreteAlphabet, c: Chapter) -> Step:
    """The step of κ_i and D."""
    term = ("mul", ("at", "κ", "i"), a.place, ("T", a.place))
    equations = [*damping_coefficients(problem), Equation(D.name, ("sum", "i", term))]
    return c.draft("damping", "input").step(equations, say("damping.discrete"))


# What the discrete motion keeps, by Noether's theorem: the momentum Θ⁺(Yg) = Θ⁻(Yg) of a
# displacement of space Y that the group has and that leaves the potential alone.
#
# Which displacements these are, the continuous walk says (``matrices.conserved``).


def conserved(
    stage: OneForms,
    motion: DiscreteMotion,
    ends: DiscreteAlphabet,
    group: Group,
    forces: DiscreteForces,
    c: Chapter,
) -> tuple[Step, ...]:
    """The step of the momenta that the discrete motion keeps; none where it keeps none."""
    momenta = kept_momenta(group, forces.potential, forces.letters, vectors=False)
    if not momenta:
        return ()
    draft = c.draft("conserved", "conservation", motion.balance)
    b = Blocks(group.n, group.size)
    a = DiscreteAlphabet(group.size, affine=group.affine)
    definitions, laws = [], []
    for x in momenta:
        momentum = _momentum(stage, ends, a, b, turning=x.turning)
        draft.depends_on(momentum, forces.potential.energy)
        names = ("ℓ_0", "ℓ_1") if x.turning else ("p_0", "p_1")
        for name, e in zip(names, (momentum, _onward(momentum, a, b)), strict=True):
            definitions.append(Equation(name, tree_of(e, b.notation)))
        change = add(names[1], neg(names[0]))
        rate = replaced(x.rate, "ℓ̇" if x.turning else "ṗ", change)
        laws.append(Equation(rate, 0))
    sentence = enumerated(sum((x.law for x in momenta), ()))
    prose = say("conserved.discrete", kept=sentence)
    return (draft.step((*definitions, *laws), prose),)


def _momentum(
    stage: OneForms, ends: DiscreteAlphabet, a: DiscreteAlphabet, b: Blocks, *, turning: bool
) -> Expr:
    """What Θ⁺(Yg) without the forces has on Y, twice the skew part of that; on a shift, Y = b.
    Θ⁻(Yg) must have the same."""
    Y, shift = Letter("Y", b.n, b.n, -1), Letter("b", b.n)
    images, moving = {}, word(Y)
    if a.affine:
        images, moving = b.images(a), b.in_one_matrix(word(Y), word(shift))
    found = []
    for k, form in ((1, stage.plus), (0, stage.minus)):
        e = rewritten(without(form, ends.d_U[k]), (*a.letters, *a.d_g), 1)
        e = substitute(e, {a.d_g[k]: moving * word(a.g[k])})
        e = reduce(substitute(e, images), b.relation)
        found.append(2 * gradient(e, Y) if turning else gradient(e, shift))
    plus, minus = found
    if plus != minus:
        raise WalkError("a displacement of space has two momenta on a step")
    return plus


def _onward(e: Expr, a: DiscreteAlphabet, b: Blocks) -> Expr:
    """The momentum of the next step."""
    moved = {x[k]: word(x[k + 1]) for x in (a.g, b.A, b.T) for k in range(2)}
    return substitute(e, moved)
