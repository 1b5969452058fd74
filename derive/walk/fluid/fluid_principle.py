"""The principle for a fluid: a lift is an extremal of the action if and only if its tangent is in
the kernel of dϖ.

    δ[ϖ(X)] = dϖ(δy, X) + d/dt ϖ(δy),  dϖ(δy, X) = −⟨ν̇ − Gf, δg − ν δt⟩
"""

from __future__ import annotations

from ...algebra.calculus import gradient, terms_with, without
from ...algebra.word_trees import PLAIN
from ...algebra.words import word
from ...record.record import Equation
from ..cartan import Cartan
from ..chapter import Chapter
from ..factorisation import factored_tree
from ..variation import ACROSS, Principle, extremal
from ..wording import say
from .fluid_letters import FluidAlphabet
from .fluid_points import Points


def principle(points: Points, form: Cartan, a: FluidAlphabet, c: Chapter) -> Principle:
    """The variation of the action by dϖ, and what dϖ is there: the steps ``extremal`` and
    ``dalembert``."""
    varying, working = c.draft("extremal", "variation"), c.draft("dalembert", "contraction")
    first, across = extremal(varying, points.lagrangian, form.form, form.work, a)
    moved, acceleration = a.T.d_position, a.T.acceleration
    resting = without(across, a.dt)
    shifts = {
        moved: word(moved) - word(a.T.velocity) * word(a.dt),
        acceleration: -gradient(resting, moved),
    }
    core = terms_with(resting, acceleration)
    second = working.step(
        (
            Equation(
                ACROSS,
                factored_tree(working, across, core, shifts, PLAIN),
                (acceleration.name,),
            ),
        ),
        say("dalembert.extremal") + say("dalembert.fluid"),
        (2, 5),
        first.given,
    )
    return Principle(working.mark(across), (first, second))
