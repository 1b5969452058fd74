"""SO(3) in a unit quaternion: W = 1 + 2q j(x) + 2 j(x)² for a step of (q, x), and hM in it.

A skew M is read as a vector by Tr j(u) j(y)‾ = 2⟨u, y⟩: what it has on j(y) tells its axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...algebra.calculus import gradient, reduce, substitute
from ...algebra.space import double, fold_inertia, hat, normal_form
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, one, word
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..hat import anticommute, inertia_of
from ..inverse import cancel_scalar, inverse_letter
from ..wedge import vector_sum
from ..wording import say

TESTED = Letter("y", 3)
SCALE = Letter("Tr J")
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Turning:
    """Two steps W and their momenta M by the moments ``metric``: ``momentum``: that of W₁,
    ``before``: that of W₀ after it, ``force``: what the forces add; all three skew."""

    W: tuple[Letter, ...]
    M: tuple[Letter, ...]
    momentum: Expr
    before: Expr
    force: Expr
    metric: Letter


def in_quaternions(t: Turning, notation: WordNotation, c: Chapter) -> tuple[Step, ...]:
    """The quaternions of the steps W, their momenta and the motion in them."""
    inertia = Letter("I" + t.metric.name.removeprefix("J"), 3, 3, 1)
    q, x = ([Letter(f"{s}_{k}", *size) for k in range(2)] for s, size in (("q", ()), ("x", (3,))))
    h = Letter("h")
    naming, telling = c.draft("quaternion", "identification"), c.draft("turning", "kernel")

    def turned(e: Expr, k: int) -> Expr:
        """The axis of a skew sum, with W in the quaternion of the k-th step."""
        return axis_of(substitute(e, {y: unit(q[k], x[k]) for y in t.W}), t.metric, inertia)

    equations = [Equation(inertia.name, naming.tree(inertia_of(t.metric)))]
    for k, (W, M) in enumerate(zip(t.W, t.M, strict=True)):
        square = word(q[k]) * word(q[k]) + inner(word(x[k]), word(x[k]))
        found = (q[k].name, x[k].name)
        equations.append(Equation(W.name, tree_of(unit(q[k], x[k])), (), found))
        equations.append(Equation(tree_of(square), 1))
        axis = vector_sum(turned(t.momentum, k), notation)
        equations.append(Equation(M.name, ("hat", axis)))
    naming.depends_on(t.momentum)
    named = naming.step(equations, say("quaternion.steps"))
    telling.depends_on(named)
    total, momenta = turned(t.before, 0), list[Equation]()
    if t.force:
        free = cancel_scalar(word(inverse_letter(h)) * t.force, h)
        momenta.append(Equation(("hat", "μ_1"), telling.tree(free, notation)))
        total = total + word(h) * word(Letter("μ_1", 3))
    after = Equation(t.M[1].name, ("hat", vector_sum(total, notation)))
    return named, telling.step((*momenta, after), say("turning.quaternion"))


def unit(q: Letter, x: Letter) -> Expr:
    """The rotation 1 + 2q j(x) + 2 j(x)² of a unit quaternion (q, x)."""
    j = word(hat(x))
    return one(3) + 2 * word(q) * j + 2 * j * j


def axis_of(e: Expr, metric: Letter, inertia: Letter) -> Expr:
    """The axis of a skew matrix in j's and the moments J, with the tensor J = (Tr J) 1 − I."""
    paired = fold_inertia(inner(e, word(hat(TESTED))), metric, word(inertia))
    tensor = word(SCALE) * one(3) - word(inertia)
    paired = normal_form(substitute(reduce(paired, double), {metric: tensor}))
    return normal_form(HALF * gradient(reduce(paired, anticommute(TESTED)), TESTED))
