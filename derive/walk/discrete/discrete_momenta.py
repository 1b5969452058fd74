"""What the discrete motion keeps, by Noether's theorem: the momentum Θ⁺(Yg) = Θ⁻(Yg) of a
displacement of space Y that the group has and that leaves the potential alone.

Which displacements these are, the continuous walk says (:mod:`derive.walk.conserved`).
"""

from __future__ import annotations

from ...algebra.calculus import gradient, reduce, substitute, without
from ...algebra.groups import Group
from ...algebra.word_trees import tree_of
from ...algebra.words import Expr, Letter, word
from ...language.tree import add, neg, replaced
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..conserved import Kept, kept_momenta
from ..failure import WalkError
from ..wording import enumerated, say
from .discrete_blocks import Blocks
from .discrete_forces import DiscreteForces
from .discrete_letters import DiscreteAlphabet, respelled
from .discrete_road import DiscreteMotion, OneForms


def conserved(
    stage: OneForms,
    motion: DiscreteMotion,
    ends: DiscreteAlphabet,
    group: Group,
    forces: DiscreteForces,
    c: Chapter,
) -> tuple[Step, ...]:
    """The step of the momenta that the discrete motion keeps; none where it keeps none."""
    kept = kept_momenta(group, forces.potential, forces.letters, vectors=False)
    if not kept:
        return ()
    draft = c.draft("conserved", "conservation")
    b = Blocks(group.n, group.size)
    a = DiscreteAlphabet(group.size, affine=group.affine)
    draft.depends_on(motion.balance)
    definitions, laws = [], []
    for x in kept:
        momentum = _momentum(stage, ends, a, b, turning=x.turning)
        draft.depends_on(momentum, forces.potential.energy)
        names = _names(x)
        for name, e in zip(names, (momentum, _onward(momentum, a, b)), strict=True):
            definitions.append(Equation(name, tree_of(e, b.notation)))
        change = add(names[1], neg(names[0]))
        rate = replaced(x.rate, "ℓ̇" if x.turning else "ṗ", change)
        laws.append(Equation(rate, 0))
    told = enumerated(sum((x.law for x in kept), ()))
    prose = say("conserved.discrete", kept=told)
    return (draft.step((*definitions, *laws), prose),)


def _names(x: Kept) -> tuple[str, str]:
    return ("ℓ_0", "ℓ_1") if x.turning else ("p_0", "p_1")


def _momentum(
    stage: OneForms, ends: DiscreteAlphabet, a: DiscreteAlphabet, b: Blocks, *, turning: bool
) -> Expr:
    """What Θ⁺(Yg) without the forces has on Y, twice the skew part of that; on a shift, Y = b.
    Θ⁻(Yg) must have the same."""
    Y, shift = Letter("Y", b.n, b.n, -1), Letter("b", b.n)
    images, moving = {}, word(Y)
    if a.affine:
        images, moving = b.images(a), b.whole(word(Y), word(shift))
    found = []
    for k, form in ((1, stage.plus), (0, stage.minus)):
        e = respelled(without(form, ends.d_U[k]), (*a.letters, *a.d_g), 1)
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
