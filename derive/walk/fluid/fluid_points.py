"""The points of the fluid: L, and the forms of any motion of a continuum, (36)–(38).

L = ½ ∫ ‖v‖² dm − U,  ϖ = ⟨ν, δg⟩ − h̃ δt,  dϖ = ⟨δν, δ′g − ν δ′t⟩ − ⟨δ′ν, δg − ν δt⟩
"""

from __future__ import annotations

from dataclasses import dataclass

from ...algebra.calculus import derivation, gradient, substitute
from ...algebra.word_trees import PLAIN
from ...algebra.words import Expr, Letter, inner, number, word, zero
from ...language.read import read
from ...language.tree import add, neg
from ...record.record import Equation, Step, stated
from ..cartan import Cartan, cartan_form, fibre_derivative, legendre
from ..chapter import Chapter
from ..continuum import integral
from ..exterior import DOMEGA, Exterior, contact_images, derivative, primed
from ..factorisation import at_constant_time, factored_tree, solve_for
from ..lagrangian import kinetic_energy
from ..wording import say
from .fluid_letters import FluidAlphabet

GRADIENT_OF_V = Letter("grad V", "n")
"""grad V as one vector."""


@dataclass(frozen=True)
class Points:
    """``lagrangian``: L̃ = ½⟨ν, ν⟩ − Ũ on words, by the velocity of all the points together;
    ``work``: −dŨ(δg); ``potential``: f = −grad V, told by its step."""

    lagrangian: Expr
    work: Expr
    potential: Expr
    steps: tuple[Step, ...]


def points(a: FluidAlphabet, c: Chapter) -> Points:
    """L of the points by their velocity, and L̃ of the group that moves them: the steps
    ``lagrangian``, ``action``."""
    first, acting = c.draft("lagrangian", "definition"), c.draft("action", "pull-back")
    summand = kinetic_energy(v_i := Letter("v_i", a.n), a)
    kinetic = substitute(summand, {a.m_i: number(1), v_i: word(v := Letter("v", a.n))})
    moving = substitute(first.mark(kinetic), {v: word(a.T.velocity)})
    density = "advected" if a.advected else "homogeneous"
    potential = [neg("U")] if a.forced else []
    moving = moving - word(a.U) if a.forced else moving
    forces = "forced" if a.forced else "free"
    steps = (
        first.step(
            (
                Equation("L", add(integral(first, summand, a, v_i), *potential)),
                Equation("L", add(first.tree(kinetic), *potential)),
            ),
            say("lagrangian.fluid") + say(f"lagrangian.{forces}") + say(f"lagrangian.{density}"),
            (36,),
        ),
        acting.step(
            (
                *stated("v = ν,  Ũ = U" if a.forced else "v = ν"),
                Equation("L̃", "L"),
                Equation("L̃", acting.tree(moving)),
            ),
            say("action.fluid"),
            (13, 38),
        ),
    )
    if not a.forced:
        return Points(acting.mark(moving), zero(), zero(a.n, 1), steps)
    work, force, pulling = _force(a, c)
    return Points(acting.mark(moving), work, force, (*steps, pulling))


def _force(a: FluidAlphabet, c: Chapter) -> tuple[Expr, Expr, Step]:
    """−dŨ(δg) = ⟨Gf, δg⟩, and −grad V as one vector: the step ``force``."""
    draft = c.draft("force", "pull-back")
    V, moved, f = Letter("V"), Letter("δr", a.n), word(a.force)
    # at each place, where dV is −f by the definition of f; and there f is that of the place g(r)
    varied = derivation(word(V), {V: -inner(f, word(moved))}.get)
    here = {a.force: word(a.A.position) * f, moved: word(a.T.d_position)}
    work = -substitute(varied, here)
    step = draft.step(
        (
            Equation("Ũ", ("call", "∫", ("mul", "G", "V"))),
            *stated("f = −grad V"),
            Equation(read("dŨ(δg)"), draft.tree(-work)),
        ),
        say("force.potential"),
        (2,),
    )
    return draft.mark(work), draft.mark(-word(GRADIENT_OF_V)), step


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
    return Cartan(momentum, rest, cartan_form(momentum, rest, a), stage.work, steps)


def exterior_in_space(stage: Cartan, a: FluidAlphabet, c: Chapter) -> Exterior:
    """dϖ in the variables (t, g, ν): the step ``exterior``."""
    draft = c.draft("exterior", "exterior derivative")
    form = derivative(stage.form, stage.work, a)
    images = contact_images(form, a) | _driven(form, a)
    shown = factored_tree(draft, form, at_constant_time(form, a.dt, a.dpt), images, PLAIN)
    step = draft.step((Equation(DOMEGA, shown),), say("exterior.derivative"))
    return Exterior(draft.mark(form), {x: draft.mark(y) for x, y in images.items()}, (step,))


def _driven(form: Expr, a: FluidAlphabet) -> dict[Letter, Expr]:
    """δν ↦ δν − Gf δt, and for δ′: the acceleration by the force, read off dϖ."""
    x, moved = a.T.d_velocity, a.T.dp_position
    found = solve_for(gradient(form, moved), x) if a.forced else None
    if found is None:
        return {}
    image = word(x) - found
    return {x: image, a.T.dp_velocity: primed(image, a)}
