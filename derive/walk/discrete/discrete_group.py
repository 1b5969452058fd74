"""The discrete motion on one group: restricted to its Lie algebra, and solved for what is next."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import gradient, reduce, substitute, terms_with
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, inner, number, one, trace, word, zero
from ...language.tree import Tree, add
from ...problem.problem import Problem, ProblemError
from ...record.record import Equation, Step
from ..chapter import Chapter, WalkError, say
from ..matrices.solution import MULTIPLIER
from ..matrices.specialisation import turns_whole
from ..spine.alphabet import Alphabet, cancel_scalar, cancelling, inverse_letter, inverse_tree
from .discrete_blocks import (
    BlockMotion,
    Blocks,
    QuaternionTurning,
    about_the_centre,
    in_quaternions,
)
from .discrete_forces import HALF, DiscreteForces, Outside
from .discrete_road import DiscreteAlphabet, DiscreteMotion, opened, rewritten, stepped

# The motion of the linear parts of a group: of the group itself, or about the centre of mass.


@dataclass(frozen=True)
class LinearMotion:
    """The motion of the linear parts ``x`` = (x₀, x₁, x₂) of a group: ``balance`` vanishes paired
    with x₁ξ; ``metric``: J, or J_c about the centre of mass; ``damping``: D, by which
    ½(x₂ − x₀)D is added."""

    x: tuple[Letter, ...]
    metric: Letter
    balance: Expr
    damping: Letter | None = None
    steps: tuple[Step, ...] = ()

    @property
    def n(self) -> int:
        """The size of the matrices."""
        assert isinstance(self.metric.rows, int)
        return self.metric.rows

    @property
    def drag(self) -> Expr:
        """What damping adds to the balance, ½(x₂ − x₀)D."""
        if self.damping is None:
            return zero(self.n, self.n)
        return HALF * (word(self.x[2]) - word(self.x[0])) * word(self.damping)

    @property
    def notation(self) -> WordNotation:
        """How words in x are written, with m⁻¹."""
        m = Letter("m")
        display = stepped(self.x, Letter("h")).display
        return WordNotation(display={**display, inverse_letter(m): inverse_tree(m)})


# GL(n) and SL(n): the next element, with a multiplier of the volume on SL(n), and its polynomial.
#
# The next element is solved for from x₂S = … + θ x̄₁⁻¹, S = J, or J + ½hD where damping acts.

LARGEST = 4
"""The polynomial of the multiplier is written out up to this degree."""


class _Solved:
    """What is solved for x₂: ``metric`` S, what x₂ is multiplied by, ``free``: x₂ without the
    multiplier, and the letter of x̄₁⁻¹, which that has."""

    def __init__(self, motion: LinearMotion, forces: DiscreteForces):
        x, h = motion.x, Letter("h")
        n, self.x = motion.n, x
        self.metric, self.equations = motion.metric, list[Equation]()
        value = word(motion.metric)
        if motion.damping is not None:
            self.metric = Letter("J_D", n, n, 1)
            value = value + HALF * word(h) * word(motion.damping)
            self.equations.append(Equation(self.metric.name, tree_of(value)))
        balance = substitute(motion.balance, opened(x)) + motion.drag
        balance = cancel_scalar(word(h) * balance, h)
        if terms_with(balance, x[2]) != word(x[2]) * value:
            raise WalkError("the next element is not multiplied by the moments")
        self.back = inverse_letter(self.metric)
        rest = word(x[2]) * value - balance
        self.free = reduce(rest * word(self.back), cancelling(self.metric))
        self.dual = Letter(f"{x[1].name}‾⁻¹", n, n)
        display = {**motion.notation.display, **forces.notation.display}
        display |= {self.dual: ("inv", ("T", x[1].name)), self.back: inverse_tree(self.metric)}
        self.notation = WordNotation(display=display)


def solved(
    motion: LinearMotion, group: Group, forces: DiscreteForces, c: Chapter
) -> tuple[Step, ...]:
    """The steps of x₂: of GL(n), or with the multiplier of the volume on SL(n)."""
    s, last = _Solved(motion, forces), motion.x[2].name
    draft = c.draft("motion", "solution", s.free)
    free = tree_of(s.free, s.notation)
    if "unimodular" not in group.relations:
        return (draft.step((*s.equations, Equation(last, free)), say("motion.verlet")),)
    keeping = c.draft("relation", "relation")
    volumes = (Equation(("det", y.name), 1) for y in motion.x)
    kept = keeping.step(volumes, say("relation.discrete_volume"))
    draft.depends_on(kept)
    H = Letter("H", motion.n, motion.n)
    onward = word(H) + word(MULTIPLIER) * word(s.dual) * word(s.back)
    goes = Equation(last, tree_of(onward, s.notation), (), (MULTIPLIER.name,))
    told = draft.step((*s.equations, Equation("H", free), goes), say("motion.volume"))
    return (kept, told, *_multiplier(draft.mark(onward), H, s, c))


def _multiplier(onward: Expr, H: Letter, s: _Solved, c: Chapter) -> tuple[Step, ...]:
    """The step of the polynomial in θ: det(x₂) det(S) = det(x₂Sx̄₁) = det(HSx̄₁ + θ)."""
    x, n = s.x, onward.rows
    if not isinstance(n, int) or n > LARGEST:
        return ()

    def cancel(left: Factor, right: Factor) -> Expr | None:
        """x̄₁⁻¹x̄₁ = 1."""
        return one(n) if (left, right) == ((s.dual, False), (x[1], True)) else None

    Y, theta = Letter("Y", n, n), word(MULTIPLIER)
    across = word(s.metric) * word(x[1]).bar
    value = word(H) * across
    if reduce(onward * across, cancelling(s.metric), cancel) != value + theta * one(n):
        raise WalkError("the multiplier of the volume is not a shift of HSx̄₁")
    draft = c.draft("multiplier", "elimination", onward)
    whole = number(0)
    for e in elementary(word(Y), n):
        whole = (whole + e) * theta
    volume: Tree = ("mul", ("det", x[2].name), ("det", s.metric.name))
    polynomial = add(tree_of(whole), ("det", "Y"))
    equations = (
        Equation("Y", tree_of(value, s.notation)),
        Equation(volume, polynomial, (), (MULTIPLIER.name,)),
    )
    return (draft.step(equations, say("multiplier.polynomial")),)


def elementary(y: Expr, n: int) -> list[Expr]:
    """e₀ … e_{n−1} of a matrix, by Newton's identities: k e_k = Σ (−1)^{i−1} e_{k−i} Tr yⁱ."""
    found, traces, power = [number(1)], [number(n)], one(n)
    for k in range(1, n):
        power = power * y
        traces.append(trace(power))
        total = number(0)
        for i in range(1, k + 1):
            total = total + (-1) ** (i - 1) * found[k - i] * traces[i]
        found.append(total * Fraction(1, k))
    return found


# The discrete motion on one group: restricted to its Lie algebra, and solved for what is next.
#
# Where 𝔤 is all skew matrices, the equations of Moser and Veselov:  hM = WJ − JW̄,  W = ḡ₀g₁.
# Where it is all matrices, the method of Störmer and Verlet; all of trace 0, with a multiplier.
# H ⋉ Rⁿ is that of H about the centre of mass, which moves by itself.


def require(problem: Problem) -> None:
    """``ProblemError`` for a problem that the discrete road does not serve, with the reason."""
    reason = ""
    if problem.fluid:
        reason = problem.without_matrices
    elif problem.kinematics:
        reason = "kinematics of first order have no Lagrangian"
    elif problem.torus or problem.lagrangian or problem.advected:
        reason = "its Lagrangian is not one of points"
    elif problem.group and len(problem.group.factors) > 1:
        reason = "its group is a product"
    elif problem.flows:
        reason = "mass flows, and a step has no velocity at an instant"
    elif problem.forces:
        reason = "a [[force]] may depend on the velocity at an instant, and a step has none"
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
        balance = rewritten(stage.balance, a.letters, n)
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
    naming, telling = c.draft("step", "definition", momentum), c.draft("motion", "kernel")
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
    turned = QuaternionTurning(W, M, momentum, before, force, motion.metric)
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
        acting = Blocks(group.n, group.size).in_one_matrix(acting, forces.resultant)
    tested = substitute(rewritten(stage.tested, a.letters, 1), {a.N[1]: acting})
    if outside:
        tested = tested + outside.tested
    display = {**a.notation.display, **forces.notation.display, E: ("at", "E", "a")}
    on_E = draft.tree(substitute(tested, {a.xi: word(E)}), WordNotation(display=display))
    return draft.step((Equation(on_E, 0),), say("motion.basis"))
