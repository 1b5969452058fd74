"""The discrete motion on one group: restricted to its Lie algebra, and solved for what is next.

Where 𝔤 is all skew matrices, the equations of Moser and Veselov:  hM = WJ − JW̄,  W = ḡ₀g₁.
Where it is all matrices, the method of Störmer and Verlet; all of trace 0, with a multiplier.
H ⋉ Rⁿ is that of H about the centre of mass, which moves by itself.
"""

from __future__ import annotations

from ...algebra.calculus import gradient, reduce, substitute, terms_with
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, inner, one, word
from ...problem.problem import Problem, ProblemError
from ...record.record import Equation, Step
from ..alphabet import Alphabet
from ..chapter import Chapter
from ..failure import WalkError
from ..inverse import cancel_scalar
from ..specialisation import turns_whole
from ..wording import say
from .discrete_blocks import BlockMotion, Blocks, about_the_centre
from .discrete_forces import DiscreteForces
from .discrete_letters import DiscreteAlphabet, opened, respelled
from .discrete_outside import Outside
from .discrete_quaternion import Turning, in_quaternions
from .discrete_road import DiscreteMotion
from .discrete_solved import solved
from .linear_motion import LinearMotion


def require(problem: Problem) -> None:
    """``ProblemError`` for a problem that the discrete road does not serve, with the reason."""
    reason = ""
    if problem.fluid:
        reason = problem.without_matrices
    elif problem.torus or problem.lagrangian or problem.advected:
        reason = "its Lagrangian is not one of points"
    elif problem.group and len(problem.group.factors) > 1:
        reason = "its group is a product"
    if reason:
        told = "there is no discrete motion of this problem"
        raise ProblemError(f"{problem.name}: {told}, for {reason}")


def of_group(
    stage: DiscreteMotion,
    blocks: BlockMotion | None,
    group: Group,
    forces: DiscreteForces,
    outside: Outside | None,
    c: Chapter,
) -> tuple[Step, ...]:
    """The steps of a group: by its kind, or dim 𝔤 equations on a basis."""
    n, linear = group.n, len(group.linear_basis)
    damping = outside.damping if outside else None
    skew = turns_whole(group)
    whole = linear >= n**2 - ("unimodular" in group.relations)
    if not (skew or whole) or (group.affine and (damping or not group.free_translations)):
        return (_on_basis(stage, group, forces, outside, c),)
    moments, resultant = forces.moments, forces.resultant
    if outside:
        dual = forces.inverse.bar
        moments = moments + dual * outside.moments
        resultant = resultant + dual * outside.resultant if group.affine else resultant
    if blocks:
        motion = _about_the_centre(blocks, forces.letters, moments, resultant, c)
    else:
        a = DiscreteAlphabet(n)
        balance = respelled(stage.balance, a.letters, n)
        motion = LinearMotion(a.g, a.J, substitute(balance, {a.N[1]: moments}), damping)
    if skew:
        return (*motion.steps, *_rotations(motion, group, c))
    return (*motion.steps, *solved(motion, group, forces, c))


def _about_the_centre(
    blocks: BlockMotion, b: Alphabet, moments: Expr, resultant: Expr, c: Chapter
) -> LinearMotion:
    found = about_the_centre(blocks, b, resultant, c)
    x = tuple(Letter(f"A_{k}", b.n, b.n) for k in range(3))
    acting = {Letter("N_1", b.n, b.n): moments, Letter("f_1", b.n): resultant}
    balance = cancel_scalar(substitute(found.balance, acting), b.m)
    return LinearMotion(x, found.metric, balance, None, found.steps)


def _rotations(motion: LinearMotion, group: Group, c: Chapter) -> tuple[Step, ...]:
    """SO(n): the momentum M of a step W, and what it is after the next."""
    n, x, notation = motion.n, motion.x, motion.notation
    W = tuple(Letter(f"W_{k}", n, n) for k in range(2))
    M = tuple(Letter(f"M_{k}", n, n, -1) for k in range(2))
    here, xi = word(x[1]), Letter("ξ", n, n, -1)
    along = {x[2]: here * word(W[1]), x[0]: here * word(W[0]).bar}

    def turning(left: Factor, right: Factor) -> Expr | None:
        """x̄₁x₁ = 1 and W̄₀W₀ = 1."""
        same = left[0] == right[0] and left[1] and not right[1]
        return one(n) if same and left[0] in (x[1], W[0]) else None

    def inside(balance: Expr) -> Expr:
        """Twice what a skew ξ feels of a balance."""
        tested = inner(substitute(balance, opened(x)), here * word(xi))
        return 2 * gradient(reduce(substitute(tested, along), turning), xi)

    whole, drag = inside(motion.balance), inside(motion.drag)
    momentum = terms_with(whole, W[1])
    before = word(W[0]).bar * substitute(momentum, {W[1]: word(W[0])}) * word(W[0])
    before = reduce(before, turning)
    force = momentum - before - whole
    if terms_with(force, *W):
        raise WalkError("the discrete motion is no balance of two momenta")
    naming, telling = c.draft("step", "definition"), c.draft("motion", "kernel")
    naming.depends_on(momentum)
    across = (Equation(y.name, ("mul", ("T", x[k].name), x[k + 1].name)) for k, y in enumerate(W))
    momenta = (substitute(momentum, {W[1]: word(y)}) for y in W)
    told = (Equation(y.name, tree_of(e, notation)) for y, e in zip(M, momenta, strict=True))
    named = naming.step((*across, *told), say("step.moser_veselov"))
    telling.depends_on(named)
    carried = word(W[0]).bar * word(M[0]) * word(W[0])
    slowed, slowing = terms_with(drag, W[1]), terms_with(drag, W[0])
    after = telling.tree(word(M[1]) + slowed, notation)
    last = Equation(after, telling.tree(carried + force - slowing, notation))
    steps = named, telling.step((last,), say("motion.moser_veselov"))
    if not group.turns_space or drag:
        return steps
    turned = Turning(W, M, momentum, before, force, motion.metric)
    return (*steps, *in_quaternions(turned, notation, c))


def _on_basis(
    stage: DiscreteMotion, group: Group, forces: DiscreteForces, outside: Outside | None, c: Chapter
) -> Step:
    """Any group: the balance on the elements of a basis, as many equations as 𝔤 has dimensions."""
    a = DiscreteAlphabet(group.size, affine=group.affine)
    E = Letter("E_a", a.n, a.n)
    draft = c.draft("motion", "kernel")
    acting = forces.moments
    if group.affine:
        acting = Blocks(group.n, group.size).whole(acting, forces.resultant)
    tested = substitute(respelled(stage.tested, a.letters, 1), {a.N[1]: acting})
    if outside:
        tested = tested + outside.tested
    display = {**a.notation.display, **forces.notation.display, E: ("at", "E", "a")}
    on_E = draft.tree(substitute(tested, {a.xi: word(E)}), WordNotation(display=display))
    return draft.step((Equation(on_E, 0),), say("motion.basis"))
