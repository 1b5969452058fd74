"""H ⋉ Rⁿ: the translation is eliminated on words, and the central moments J_c take the place of J.

The coefficient of η′ is solved for ẇ and put into that of ξ′.  What remains is the problem of the
linear parts H about the centre of mass.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import gradient, reduce, substitute, terms_with, without
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, inner, word
from ..language.tree import Tree
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .chapter import Chapter
from .inverse import cancel_scalar, cancelling, inverse_letter
from .specialisation import Special
from .wording import say_signed


@dataclass(frozen=True)
class Centred:
    """The linear problem that is left: ``inertial`` in ξ′ with ``metric`` J_c, and its ``force``.

    ``acceleration``: ẇ, as the record has it; ``rate``: the same on words in r_c and w.
    """

    inertial: Expr
    force: Expr
    metric: Letter
    acceleration: Tree
    rate: Expr
    steps: tuple[Step, ...]


def central_moments(b: Alphabet) -> tuple[Letter, Expr]:
    """The letter J_c and its value J − m⁻¹ c c̄."""
    first = word(b.c)
    return Letter("J_c", b.n, b.n, 1), word(b.J) - word(inverse_letter(b.m)) * first * first.bar


def eliminate_translation(stage: Special, c: Chapter) -> Centred:
    """The equations of the linear parts about the centre of mass, with ẇ solved for; and their
    step."""
    b, draft = stage.letters, c.draft("elimination", "elimination")
    xi, eta, w_dot = b.Z.xi_prime, b.w.xi_prime, b.w.acceleration
    cancel = cancelling(b.C)
    display: dict[Letter, Tree] = {inverse_letter(x): ("inv", x.name) for x in (b.C, b.m)}
    notation = WordNotation(display=display)

    centre, drift = Letter("r_c", b.n), Letter("w_c", b.n)
    velocity = word(b.w.velocity) + word(b.Z.velocity) * word(centre)
    from_centre = {
        b.c: word(b.m) * word(centre),
        b.w.velocity: word(b.w.velocity) + word(drift) - velocity,
    }

    def tidy(e: Expr) -> Expr:
        return cancel_scalar(reduce(e, cancel), b.m)

    left = word(inverse_letter(b.C)) if b.unit != stage.C else b.unit
    balance = gradient(stage.inertial, eta) - stage.forces[eta]
    free = tidy(word(inverse_letter(b.m)) * (left * without(balance, w_dot)))
    metric, value = central_moments(b)
    by_centre = {b.J: word(metric) + word(b.J) - value}  # not in the forces, which may have a J
    remaining = substitute(substitute(without(stage.inertial, eta), by_centre), {w_dot: -free})
    remaining = tidy(remaining - inner(stage.forces[xi], word(xi)))
    inertial = terms_with(remaining, metric)
    force = gradient(inertial - remaining, xi)
    force = tidy(substitute(force, {b.c: word(b.m) * word(centre)}))
    solved = draft.tree(tidy(substitute(-free, from_centre)), notation)
    pairing = inner(word(Letter("N_c", b.n, b.n)), word(xi))
    step = draft.step(
        (
            Equation("r_c", draft.tree(word(inverse_letter(b.m)) * word(b.c), notation)),
            Equation("w_c", draft.tree(velocity, notation)),
            Equation("ẇ", solved),
            Equation("J_c", draft.tree(value, notation)),
            Equation("N_c", draft.tree(force, notation)),
            Equation(draft.tree(inertial), draft.tree(pairing), (xi.name,)),
        ),
        say_signed("elimination.linear_parts", b.signed),
    )
    rate = tidy(substitute(-free, {b.c: from_centre[b.c]}))
    inertial, force, rate = (draft.mark(e) for e in (inertial, force, rate))
    return Centred(inertial, force, metric, solved, rate, (step,))
