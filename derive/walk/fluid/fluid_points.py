"""The points of the fluid: L, and the forms of any motion of a continuum, (36)–(38) and (25).

L = ½ ∫ ‖v‖² dm,  ϖ = ⟨ν, δg⟩ − h̃ δt,  dϖ = ⟨δν, δ′g − ν δ′t⟩ − ⟨δ′ν, δg − ν δt⟩
"""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra.calculus import substitute
from ...algebra.word_trees import PLAIN
from ...algebra.words import Expr, Letter, number, word, zero
from ...language.read import read
from ...language.tree import add
from ...record.formulas import stated
from ...record.record import Equation, Step
from ..cartan import Cartan, cartan_form, fibre_derivative, legendre
from ..chapter import Chapter
from ..continuum import integral
from ..exterior import DOMEGA, Exterior, contact_images, derivative
from ..factorisation import at_constant_time, factored_tree
from ..lagrangian import kinetic_energy
from ..wording import say
from .fluid_letters import FluidAlphabet


@dataclass(frozen=True)
class Points:
    """``lagrangian``: L̃ = ½⟨ν, ν⟩ on words, by the velocity of all the points together."""

    lagrangian: Expr
    steps: tuple[Step, ...]


def points(a: FluidAlphabet, c: Chapter) -> Points:
    """L of the points by their velocity, and L̃ of the group that moves them: the steps
    ``lagrangian``, ``action``."""
    first, acting = c.draft("lagrangian", "definition"), c.draft("action", "pull-back")
    summand = kinetic_energy(v_i := Letter("v_i", a.n), a)
    kinetic = substitute(summand, {a.m_i: number(1), v_i: word(v := Letter("v", a.n))})
    moving = substitute(first.mark(kinetic), {v: word(a.T.velocity)})
    density = "advected" if a.advected else "homogeneous"
    steps = (
        first.step(
            (
                Equation("L", integral(first, summand, a, v_i)),
                Equation("L", first.tree(kinetic)),
            ),
            say("lagrangian.fluid") + say(f"lagrangian.{density}"),
            (36,),
        ),
        acting.step(
            (*stated("v = ν"), Equation("L̃", "L"), Equation("L̃", acting.tree(moving))),
            say("action.fluid"),
            (13, 38),
        ),
    )
    return Points(acting.mark(moving), steps)


def in_space(stage: Points, a: FluidAlphabet, c: Chapter) -> Cartan:
    """ϖ in the variables (t, g, ν): the steps ``momentum``, ``energy`` and ``cartan``."""
    moving, resting, whole = (
        c.draft("momentum", "fibre derivative"),
        c.draft("energy", "Legendre transform"),
        c.draft("cartan", "Cartan form"),
    )
    momentum = fibre_derivative(stage.lagrangian, a)
    energy = legendre(moving.mark(momentum), stage.lagrangian, a)
    steps = (
        moving.step(
            (Equation(read("p̃(δg)"), moving.tree(momentum)),), say("momentum.linear"), (16,)
        ),
        resting.step(
            (Equation("h̃", read("p̃(ν) − L̃")), Equation("h̃", resting.tree(energy))),
            say("energy.paired"),
            (16, 37),
        ),
        whole.step(
            (Equation(read("ϖ(δy)"), add(whole.tree(moving.mark(momentum)), read("−h̃ δt"))),),
            say("cartan.form"),
            (37,),
        ),
    )
    momentum, rest = whole.mark(momentum), resting.mark(energy)
    return Cartan(momentum, rest, cartan_form(momentum, rest, a), zero(), steps)


def exterior_in_space(stage: Cartan, a: FluidAlphabet, c: Chapter) -> Exterior:
    """dϖ in the variables (t, g, ν): the step ``exterior``."""
    draft = c.draft("exterior", "exterior derivative")
    form = derivative(stage.form, stage.work, a)
    images = contact_images(form, a)
    shown = factored_tree(draft, form, at_constant_time(form, a.dt, a.dpt), images, PLAIN)
    step = draft.step((Equation(DOMEGA, shown),), say("exterior.derivative"), (25,))
    return Exterior(draft.mark(form), {x: draft.mark(y) for x, y in images.items()}, (step,))
