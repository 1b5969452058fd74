"""Inputs and damping in the discrete motion, by d'Alembert's principle: their work in a step is
taken half at either end, so that at g₁ half of two steps meets.

Inputs are held at g₁; a damping −κ v has in each step the velocity of that step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from ...algebra.calculus import reduce, substitute
from ...algebra.groups import Group
from ...algebra.words import Expr, Factor, Letter, inner, number, one, word, zero
from ...language.tree import replaced
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..inputs import acts, damping_coefficients, external_matrices, where_given
from ..inverse import cancel_scalar, inverse_letter
from ..pullback import sum_over
from ..wording import say
from .discrete_blocks import Blocks
from .discrete_forces import DiscreteForces
from .discrete_letters import DiscreteAlphabet, opened, respelled
from .discrete_road import DiscreteMotion

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
    problem: Problem,
    stage: DiscreteMotion,
    group: Group,
    forces: DiscreteForces,
    c: Chapter,
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
        whole = b.whole(moments, resultant) if group.affine else moments
        tested = tested - word(a.h) * inner(whole, word(a.xi))
    damping = Letter("D\u0302" if group.affine else "D", group.size, group.size, 1)
    if problem.damping:
        step = _damping(problem, damping, a, c)
        steps.append(step)
        tested = tested + drag(damping, a).marked(step.label)
    draft = c.draft("dalembert", "kernel")
    whole = respelled(stage.tested, a.letters, 1) + tested
    if "orthogonal" in group.relations and not group.affine:
        whole = _on_skew(whole, a)
    told = Equation(draft.tree(whole, a.notation), 0, (a.xi.name,))
    steps.append(draft.step((told,), say("dalembert.balance")))
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
    told = tuple(Equation(e.lhs, replaced(e.rhs, "C", stretched)) for e in step.equations)
    return replace(step, equations=told, prose=say("input.discrete") + where_given(problem))


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
    own = ("mul", ("at", "κ", "i"), a.place, ("T", a.place))
    equations = [*damping_coefficients(problem), Equation(D.name, ("sum", "i", own))]
    return c.draft("damping", "input").step(equations, say("damping.discrete"))
