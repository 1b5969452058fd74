"""GL(n) and SL(n): the next element, with a multiplier of the volume on SL(n), and its polynomial.

The next element is solved for from x₂S = … + θ x̄₁⁻¹, S = J, or J + ½hD where damping acts.
"""

from __future__ import annotations

from fractions import Fraction

from ...algebra.calculus import reduce, substitute, terms_with
from ...algebra.groups import Group
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Factor, Letter, number, one, trace, word
from ...language.tree import Tree, add
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..failure import WalkError
from ..inverse import cancel_scalar, cancelling, inverse_letter, inverse_tree
from ..multipliers import MULTIPLIER
from ..wording import say
from .discrete_forces import DiscreteForces
from .discrete_letters import opened
from .discrete_outside import HALF
from .linear_motion import LinearMotion

LARGEST = 4
"""The polynomial of the multiplier is written out up to this degree."""


class _Solved:
    """What is solved for x₂: ``metric`` S, what x₂ is multiplied by, ``free``: x₂ without the
    multiplier, and the letter of x̄₁⁻¹, which that has."""

    def __init__(self, motion: LinearMotion, forces: DiscreteForces):
        x, h = motion.x, Letter("h")
        n, self.x = motion.n, x
        self.metric, self.told = motion.metric, list[Equation]()
        value = word(motion.metric)
        if motion.damping is not None:
            self.metric = Letter("J_D", n, n, 1)
            value = value + HALF * word(h) * word(motion.damping)
            self.told.append(Equation(self.metric.name, tree_of(value)))
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
    draft = c.draft("motion", "solution")
    draft.depends_on(s.free)
    free = tree_of(s.free, s.notation)
    if "unimodular" not in group.relations:
        return (draft.step((*s.told, Equation(last, free)), say("motion.verlet")),)
    keeping = c.draft("relation", "relation")
    volumes = (Equation(("det", y.name), 1) for y in motion.x)
    kept = keeping.step(volumes, say("relation.discrete_volume"))
    draft.depends_on(kept)
    H = Letter("H", motion.n, motion.n)
    onward = word(H) + word(MULTIPLIER) * word(s.dual) * word(s.back)
    goes = Equation(last, tree_of(onward, s.notation), (), (MULTIPLIER.name,))
    told = draft.step((*s.told, Equation("H", free), goes), say("motion.volume"))
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
    draft = c.draft("multiplier", "elimination")
    draft.depends_on(onward)
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
