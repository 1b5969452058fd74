"""The kernel of dϖ of a fluid: it moves with u, and u̇ + ∇_u u is orthogonal to every field that
keeps the volume.

    η = u,  ⟨u̇ + ∇_u u, η′⟩ = 0
"""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra.calculus import gradient, terms_with, without
from ...algebra.vector_fields import with_derivatives
from ...algebra.words import Expr, word
from ...record.record import Equation, Step
from ..chapter import Chapter
from ..contraction import CONTRACTED, CONTRACTION, Contraction, velocities
from ..exterior import Exterior
from ..factorisation import factored_tree
from ..variation import Principle
from ..wording import say
from .fluid_letters import FluidAlphabet
from .trivialised import trees


@dataclass(frozen=True)
class FluidKernel:
    """``balance``: what vanishes for every η′; ``force``: the field that η′ is paired with."""

    balance: Expr
    force: Expr
    steps: tuple[Step, ...]


def kernel(stage: Exterior, principle: Principle, a: FluidAlphabet, c: Chapter) -> FluidKernel:
    """The steps ``contraction``, ``vertical``, ``second_order`` and ``kernel``: by the
    ``principle`` of the tangents of the motions."""
    w = a.w
    found = Contraction(
        stage.form.of(principle.across),
        terms_with(without(stage.form, a.dt, a.dpt), w.d_velocity, w.dp_velocity),
        stage.images,
        with_derivatives({w.xi: word(w.velocity)}),
        {w.d_velocity: w.acceleration},
        (w.dp_velocity,),
        (a.dt, a.dpt),
        trees(a),
        resting={w.dp_velocity: w.xi_prime},
    )
    putting, testing, finding = (
        c.draft("contraction", "contraction"),
        c.draft("vertical", "restriction"),
        c.draft("second_order", "kernel"),
    )
    first = putting.step(
        (Equation(CONTRACTION, found.any_vector(putting)),),
        say("contraction.extremals") + say("contraction.unknown", unknown="η, δu"),
        where=(CONTRACTED,),
    )
    found = found.marked_by(putting)
    second = testing.step(
        (Equation(CONTRACTION, found.on_vertical(testing)),),
        say("vertical.velocity"),
        where=(CONTRACTED, *found.at_rest()),
    )
    along = velocities(finding, {w.xi: testing.mark(word(w.velocity))}, [w.xi])
    third = finding.step(
        (*along, Equation(CONTRACTION, found.remaining(finding), found.rates())),
        say("second_order.fluid"),
        where=along,
    )
    draft = c.draft("kernel", "kernel")
    balance = finding.mark(without(found.second_order, a.dpt))
    moving = {x: y for x, y in found.shifts.items() if x == w.acceleration}
    shown = factored_tree(draft, balance, found.remaining_core, moving, trees(a))
    last = draft.step(
        (Equation("ġ", draft.tree(word(a.T.velocity))), Equation(shown, 0, (w.xi_prime.name,))),
        say("kernel.fluid") + say("kernel.fluid_line"),
    )
    balance = draft.mark(balance)
    return FluidKernel(balance, gradient(balance, w.xi_prime), (first, second, third, last))
