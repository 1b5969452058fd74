"""Step 3.  Momentum p̃ = ∂L̃/∂ν, energy, Cartan form ϖ (15), (16), (20), (23), carried to 𝔤.

h̃ = p̃(α) − L̃,  ϖ(δy) = ⟨α, δA⟩_J − h̃ δt
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import derivation, gradient, substitute
from ..algebra.word_trees import WordNotation, metrics, tree_of
from ..algebra.words import Expr, word
from ..language.read import read
from ..language.tree import add, mul
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .pullback import Pullback
from .trivialisation import at_identity, trivialisation
from .wording import say


@dataclass(frozen=True)
class Cartan:
    """The Cartan form on words: ``momentum`` = p̃(δg), ``energy`` = h̃, ``form`` = ϖ(δ) = momentum
    − energy δt.

    ``work`` = −dŨ(δg).
    """

    momentum: Expr
    energy: Expr
    form: Expr
    work: Expr
    steps: tuple[Step, ...]


def fibre_derivative(lagrangian: Expr, a: Alphabet) -> Expr:
    """p̃ = ∂L̃/∂ν, on the displacement δg."""
    return derivation(lagrangian, {p.velocity: word(p.d_position) for p in a.parts}.get)


def legendre(momentum: Expr, lagrangian: Expr, a: Alphabet) -> Expr:
    """h̃ = p̃(ν) − L̃."""
    return substitute(momentum, {p.d_position: word(p.velocity) for p in a.parts}) - lagrangian


def cartan_form(momentum: Expr, energy: Expr, a: Alphabet) -> Expr:
    """ϖ(δy) = p̃(δg) − h̃ δt."""
    return momentum - energy * word(a.dt)


def cartan(stage: Pullback, a: Alphabet, c: Chapter) -> Cartan:
    """The Cartan form in the variables (t, g, ν), with the steps ``momentum``, ``energy``,
    ``cartan``."""
    moving, resting, whole = (
        c.draft("momentum", "fibre derivative"),
        c.draft("energy", "Legendre transform"),
        c.draft("cartan", "Cartan form"),
    )
    lagrangian = stage.kinetic - word(a.U)
    momentum = fibre_derivative(lagrangian, a)
    energy = legendre(moving.mark(momentum), lagrangian, a)
    velocities = ", ".join(p.velocity.name for p in a.parts)
    notation = metrics() if a.affine else metrics("J")
    steps = (
        moving.step(
            _momentum_equations(moving, momentum, a, notation),
            say("momentum.affine") if a.affine else say("momentum.linear"),
            (16, 20) if a.affine else (16,),
        ),
        resting.step(
            (
                Equation("h̃", read(f"p̃({velocities}) − L̃")),
                Equation("h̃", resting.tree(energy, notation)),
            ),
            say("energy.paired"),
            (16,) if a.affine else (16, 23),
        ),
        whole.step(
            (
                Equation(
                    read("ϖ(δy)"),
                    add(whole.tree(moving.mark(momentum), notation), read("−h̃ δt")),
                ),
            ),
            say("cartan.form"),
            (15,) if a.affine else (15, 23),
        ),
    )
    rest = resting.mark(energy)
    form = cartan_form(whole.mark(momentum), rest, a)
    return Cartan(moving.mark(momentum), rest, form, stage.work, steps)


def _momentum_equations(
    d: Draft, momentum: Expr, a: Alphabet, notation: WordNotation
) -> list[Equation]:
    variations = tuple(p.d_position.name for p in a.parts)
    equations = [Equation(("call", "p̃", *variations), d.tree(momentum, notation))]
    if a.affine:
        # part by part, with the coefficient of each displacement gathered: the form of (20)
        for part in a.parts:
            covector = gradient(momentum, part.d_position)
            zeros = tuple(x if x == part.d_position.name else 0 for x in variations)
            equations.append(
                Equation(
                    ("call", "p̃", *zeros),
                    ("tr", ("mul", tree_of(covector.bar), part.d_position.name))
                    if part is a.A
                    else ("inner", tree_of(covector), part.d_position.name),
                )
            )
    return equations


def trivialise(stage: Cartan, a: Alphabet, c: Chapter) -> Cartan:
    """The Cartan form in the variables (t, g, Z), with ξ = g⁻¹δg."""
    draft = c.draft("cartan_trivialised", "trivialisation")
    momentum, energy = at_identity(stage.momentum, a), at_identity(stage.energy, a)
    step = draft.step(
        (form_equation(draft, momentum, energy, metrics()),),
        say("cartan_trivialised.form"),
    )
    form = draft.mark(cartan_form(momentum, energy, a))
    steps = (trivialisation(a, c), step)
    work = at_identity(stage.work, a)
    return Cartan(draft.mark(momentum), draft.mark(energy), form, work, steps)


def form_equation(d: Draft, momentum: Expr, energy: Expr, notation: WordNotation) -> Equation:
    """The equation ϖ(δy) = p̃ − (h̃) δt, with the energy written out."""
    return Equation(
        read("ϖ(δy)"),
        add(d.tree(momentum, notation), mul(-1, d.tree(energy, notation), "δt")),
    )
