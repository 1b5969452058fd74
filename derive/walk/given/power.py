"""The rate of the energy: the power of what acts from outside dϖ."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import count

from ...algebra.calculus import substitute
from ...algebra.groups import Group
from ...algebra.word_trees import tree_of
from ...algebra.words import Expr, inner, number, trace, word
from ...language.derivatives import rate
from ...language.reserved import rate_of_mass
from ...language.tree import Tree, add, mul, names, neg, replaced
from ...problem.fields import coordinates
from ...problem.problem import Problem
from ...record.record import Equation, Step
from ..chapter import Chapter, Steps, say
from ..lie.any_lagrangian import AnyLagrangian
from ..lie.at_places import from_outside, works_by_name
from ..spine.alphabet import Alphabet
from ..spine.cartan import Cartan
from ..vectors.isomorphism import ZETA, vector_sum
from .inputs import External
from .potentials import Potentials

# With the work u(ξ) of the forces beside it, dϖ(X, δy) = u(ξ − Z δt) for every δ. Along the motion
# the coefficient of δt says ḣ + ∂ₜL̃ = u(Z): the work in a displacement, with Z in its place.


def of_points(
    problem: Problem,
    external: External | None,
    b: Alphabet,
    C: Expr,
    trivial: Cartan,
    body: Steps,
    moments: Steps,
    found: Potentials,
    kept: Steps | None,
    motion: Step,
    c: Chapter,
) -> tuple[Step, ...]:
    """ḣ = ⟨μ_u, ζ⟩ + ⟨F_u, w⟩ + ∂ₜŨ, on matrices Tr(Z N̄_u) for the first; no step where nothing
    acts and Ũ leaves the time alone; ``kept``: what is without forces.  Where mass flows the
    energy changes with the moments, too: ``trivial`` has h̃, ``body`` and ``moments`` say m, c, J, C
    what ĀA is."""
    draft = c.draft("power", "power")
    terms: list[Tree] = []
    apart: dict[str, Tree] = {}
    if external:
        turning = _power_of_moments(external, b)
        pulling = inner(external.resultant, word(b.w.velocity)) if b.affine else number(0)
        draft.depends_on(whole := turning + pulling)
        terms.append(vector_sum(whole))
        apart = _apart(problem, external, vector_sum(turning), vector_sum(pulling))
    sums = [s for s in moments if any(e.lhs == b.J.name for e in s.equations)]
    stored: dict[Tree, Tree] = {("par", x): ("par", rate_of_mass(x)) for x in problem.stored}
    known = _rates([*body, *sums], stored) if problem.flows else {}
    in_time = _in_time(b, found.steps[0], known)
    timed: list[Tree] = [b.dU_dt.name] if problem.timed or in_time != 0 else []
    own = [Equation(b.dU_dt.name, in_time)] if timed else []
    if problem.flows:
        kinetic = substitute(trivial.energy + word(b.U), {b.U: number(0), b.C: C})
        draft.depends_on(kinetic, *body, *sums)
        timed.append(rate(tree_of(kinetic), known))
    if not terms and not timed:
        return ()
    draft.depends_on(motion, *(kept or found.steps))
    prose = say("power.acting" if external else "power.none")
    prose += say("power.apart") if apart else ()
    prose += say("power.timed", rate=b.dU_dt.name) if own else ()
    prose += say("power.flow") if problem.flows else ()
    prose += say("power.stored") if problem.stored else ()
    return (draft.step([*own, *_balance(terms, timed, apart)], prose),)


def _power_of_moments(external: External, b: Alphabet) -> Expr:
    """⟨μ_u, ζ⟩ of vectors of R³; Tr(Z N̄_u) of matrices, as the work of N_u is Tr(ξ′N̄_u)."""
    moments = external.moments
    if (moments.rows, moments.cols) == (3, 1):
        return inner(moments, word(ZETA))
    return trace(word(b.Z.velocity) * moments.bar)


def _in_time(b: Alphabet, potential: Step, moments: Mapping[Tree, Tree]) -> Tree:
    """∂ₜŨ, from the equations of Ũ and of what stands in it, by the rates of the moments."""
    return _rates([potential], moments).get(b.U.name, 0)


def _rates(steps: Sequence[Step], known: Mapping[Tree, Tree] | None = None) -> dict[Tree, Tree]:
    """The rates of what equations say by the time, and by what is known."""
    found: dict[Tree, Tree] = {"t": 1, **(known or {})}
    for e in (e for s in steps for e in s.equations):
        found |= {e.lhs: x} if e.lhs != "U" and (x := rate(e.rhs, found)) != 0 else {}
    return found


def _apart(problem: Problem, external: External, turning: Tree, pulling: Tree) -> dict[str, Tree]:
    """The power of what acts by each name, the whole with its part in the place of each sum."""
    sums = tree_of(external.moments), tree_of(external.resultant)
    found: dict[str, list[Tree]] = {}
    for x in external.parts:
        both = zip((turning, pulling), sums, (x.moment, x.pull), strict=True)
        powers = (replaced(t, whole, part) for t, whole, part in both if part != 0)
        found.setdefault(x.name, []).extend(powers)
    return _named(problem, {name: add(*powers) for name, powers in found.items()})


def _named(problem: Problem, powers: Mapping[str, Tree]) -> dict[str, Tree]:
    """Powers by their names, P_drag of ``drag``, with more underscores where a number of the
    problem has this name; none where one thing acts alone, and all of ḣ is its power."""
    taken = {*problem.parameters, *problem.named_numbers}
    taken |= {name for x in problem.inputs for name in problem.numbers_of(x)}
    taken |= {name for x in problem.outputs for name in problem.numbers_of_output(x)}
    found: dict[str, Tree] = {}
    for name, power in powers.items() if len(powers) > 1 or problem.flows else ():
        free = (f"P{'_' * k}{name}" for k in count(1))
        found[next(x for x in free if x not in taken)] = power
    return found


def _balance(whole: list[Tree], timed: list[Tree], apart: Mapping[str, Tree]) -> list[Equation]:
    """ḣ as a whole, the powers apart and ḣ as their sum."""
    named: list[Tree] = [("par", name) for name in apart]
    return [
        Equation("ḣ", add(*whole, *timed)),
        *(Equation(name, x) for name, x in zip(named, apart.values(), strict=True)),
        *([Equation("ḣ", add(*named, *timed))] if named else []),
    ]


def of_lagrangian(
    problem: Problem, group: Group, general: AnyLagrangian, balance: Steps, c: Chapter
) -> tuple[Step, ...]:
    """ḣ = Σ u_a ζ_a − ∂ₜL̃; no step where nothing acts and L̃ leaves the time alone."""
    assert problem.lagrangian is not None
    power = _along([add(*terms) for terms in from_outside(problem, group)], group)
    timed = [neg("∂ₜL̃")] if "t" in names(problem.lagrangian.L) else []
    if power == 0 and not timed:
        return ()
    draft = c.draft("power", "power")
    motion = next(x for x in balance if x.label == c.label("motion"))
    draft.depends_on(general["moment_map"], motion)
    found: dict[str, list[Tree]] = {}
    for name, work in works_by_name(problem, group):
        found.setdefault(name, []).append(_along(work, group))
    apart = _named(problem, {name: add(*powers) for name, powers in found.items()})
    prose = say("power.none" if power == 0 else "power.acting")
    prose += say("power.apart") if apart else ()
    prose += say("power.timed", rate="∂ₜL̃") if timed else ()
    return (draft.step(_balance([power], timed, apart), prose),)


def _along(work: Sequence[Tree], group: Group) -> Tree:
    """A covector by its values on the basis, at Z."""
    return add(*(mul(x, z) for x, z in zip(work, coordinates(group), strict=True)))
