"""The rate of the energy: the power of what acts from outside dϖ."""

from __future__ import annotations

from ...algebra.groups import Group
from ...algebra.words import Expr, inner, trace, word
from ...language.tree import Tree, add, mul, names, neg
from ...problem.fields import coordinates
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ..chapter import Chapter, Steps, say
from ..lie.any_lagrangian import AnyLagrangian
from ..lie.at_places import from_outside
from ..spine.alphabet import Alphabet
from ..vectors.isomorphism import ZETA, vector_sum
from .inputs import External

# With the work u(ξ) of the forces beside it, dϖ(X, δy) = u(ξ − Z δt) for every δ. Along the motion
# the coefficient of δt says ḣ + ∂ₜL̃ = u(Z): the work in a displacement, with Z in its place.


def of_vectors(
    problem: Problem, external: External | None, b: Alphabet, kept: Steps, motion: Step, c: Chapter
) -> tuple[Step, ...]:
    """ḣ = ⟨μ_u, ζ⟩ + ⟨F_u, w⟩ + ∂ₜŨ; no step where nothing acts and Ũ leaves the time alone."""
    turning = inner(external.moments, word(ZETA)) if external else None
    return _of_points(problem, external, turning, b, kept, motion, c)


def of_matrices(
    problem: Problem, external: External | None, b: Alphabet, kept: Steps, motion: Step, c: Chapter
) -> tuple[Step, ...]:
    """ḣ = Tr(Z N̄_u) + ⟨F_u, w⟩ + ∂ₜŨ, as ``of_vectors``: the work of N_u is Tr(ξ′N̄_u)."""
    turning = trace(word(b.Z.velocity) * external.moments.bar) if external else None
    return _of_points(problem, external, turning, b, kept, motion, c)


def _of_points(
    problem: Problem,
    external: External | None,
    turning: Expr | None,
    b: Alphabet,
    kept: Steps,
    motion: Step,
    c: Chapter,
) -> tuple[Step, ...]:
    """The step, by the power of the moments; ``kept``: what is without forces."""
    draft = c.draft("power", "power")
    terms: list[Tree] = []
    if external and turning is not None:
        whole = turning
        if b.affine:
            whole = whole + inner(external.resultant, word(b.w.velocity))
        draft.depends_on(whole)
        terms.append(vector_sum(whole))
    if problem.timed:
        terms.append(b.dU_dt.name)
    if not terms:
        return ()
    draft.depends_on(motion, *kept)
    sentence = "acting" if external else "none"
    timed = say("power.timed", rate=b.dU_dt.name) if problem.timed else ()
    return (draft.step([Equation("ḣ", add(*terms))], say(f"power.{sentence}") + timed),)


def of_lagrangian(
    problem: Problem, group: Group, general: AnyLagrangian, balance: Steps, c: Chapter
) -> tuple[Step, ...]:
    """ḣ = Σ u_a ζ_a − ∂ₜL̃; no step where nothing acts and L̃ leaves the time alone."""
    assert problem.lagrangian is not None
    along = [add(*terms) for terms in from_outside(problem, group)]
    power = add(*(mul(x, z) for x, z in zip(along, coordinates(group), strict=True)))
    timed = "t" in names(problem.lagrangian.L)
    if power == 0 and not timed:
        return ()
    draft = c.draft("power", "power")
    motion = next(x for x in balance if x.label == c.label("motion"))
    draft.depends_on(general["moment_map"], motion)
    prose = say("power.none" if power == 0 else "power.acting")
    prose += say("power.timed", rate="∂ₜL̃") if timed else ()
    return (draft.step([Equation("ḣ", add(power, neg("∂ₜL̃") if timed else 0))], prose),)
