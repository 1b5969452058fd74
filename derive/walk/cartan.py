"""Step 3.  Momentum, energy and the Cartan form ϖ (15)–(23), and its trivialised form (27)–(28)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..algebra.calculus import PairRule, derivation, gradient, reduce, substitute
from ..algebra.notation import Notation, metrics, tree_of
from ..algebra.tree import Tree, add, neg
from ..algebra.words import Expr, Factor, Letter, word
from ..record.record import Equation, Step
from ..record.sentence import say
from .alphabet import Alphabet
from .pullback import Pullback


@dataclass(frozen=True)
class Cartan:
    """``momentum`` = p̃(δg) and ``energy`` = h̃ on words, so that ϖ(δ) = momentum − energy δt."""

    momentum: Expr
    energy: Expr
    steps: tuple[Step, ...]

    def form(self, a: Alphabet) -> Expr:
        """ϖ(δ) on words."""
        return self.momentum - self.energy * word(a.dt)


def cartan(stage: Pullback, a: Alphabet, prefix: str) -> Cartan:
    """p̃ = ∂L̃/∂ν,  h̃ = p̃(ν) − L̃,  ϖ(δ) = p̃(δg) − h̃ δt."""
    potential = word(a.U)
    momentum = derivation(stage.kinetic, {p.velocity: word(p.d_position) for p in a.parts}.get)
    along = substitute(momentum, {p.d_position: word(p.velocity) for p in a.parts})
    energy = along - (stage.kinetic - potential)
    variations = tuple(p.d_position.name for p in a.parts)
    velocities = tuple(p.velocity.name for p in a.parts)
    notation = metrics() if a.affine else metrics("J")
    momentum_tree = tree_of(momentum, notation)
    steps = (
        Step(
            f"{prefix}.momentum",
            "fibre derivative",
            (f"{prefix}.pullback",),
            tuple(_momentum_equations(momentum, momentum_tree, a, variations)),
            say(
                "The momentum is the derivative of the Lagrangian with respect to the velocity, "
                "for every (δA, δT), in particular for those tangent to the group."
            )
            if a.affine
            else say(
                "The momentum is the derivative of the Lagrangian with respect to the velocity."
            ),
            (16, 20) if a.affine else (16,),
        ),
        Step(
            f"{prefix}.energy",
            "Legendre transform",
            (f"{prefix}.momentum", f"{prefix}.pullback"),
            (
                Equation("h̃", ("add", ("call", "p̃", *velocities), neg("L̃"))),
                Equation("h̃", tree_of(energy, notation)),
            ),
            say("The energy is the momentum paired with the velocity, less the Lagrangian."),
            (16,) if a.affine else (16, 23),
        ),
        Step(
            f"{prefix}.cartan",
            "Cartan form",
            (f"{prefix}.momentum", f"{prefix}.energy"),
            (
                Equation(
                    ("call", "ϖ", "δy"),
                    add(momentum_tree, neg(("mul", "h̃", "δt"))),
                ),
            ),
            say("The Cartan form: momentum on the displacement, less energy on the time."),
            (15,) if a.affine else (15, 23),
        ),
    )
    return Cartan(momentum, energy, steps)


def _momentum_equations(
    momentum: Expr, shown: Tree, a: Alphabet, variations: tuple[str, ...]
) -> list[Equation]:
    equations = [Equation(("call", "p̃", *variations), shown)]
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


def frame_rule(a: Alphabet, gram: Expr) -> PairRule:
    """``ĀA = gram``, ``ĀN = N_b``, ``ĀF = F_b``: what g leaves in a word carried to 1.

    ``gram`` is the letter C for any group and the identity for isometries.
    """
    pairs = {a.A.position: gram, a.N: word(a.N_body), a.F: word(a.F_body)}

    def rule(left: Factor, right: Factor) -> Expr | None:
        if left == (a.A.position, True) and not right[1] and right[0] in pairs:
            return pairs[right[0]]
        if right == (a.A.position, False) and left[1] and left[0] in (a.N, a.F):
            return pairs[left[0]].bar
        return None

    return rule


def varied_gram(a: Alphabet, xi: Letter) -> Expr:
    """δC for C = ĀA and δA = Aξ."""
    g = word(a.A.position)
    return reduce(derivation(g.bar * g, {a.A.position: g * word(xi)}.get), frame_rule(a, word(a.C)))


def trivial_images(a: Alphabet) -> dict[Letter, Expr]:
    """ν = gZ, δg = gξ, δ′g = gξ′, F̃ = A f, and the velocities varied by the product rule."""
    g = word(a.A.position)
    images: dict[Letter, Expr] = {a.F_group: g * word(a.f)}
    for part, frame in zip(a.parts, a.frames, strict=True):
        images[part.velocity] = g * word(frame.velocity)
        images[part.d_position] = g * word(frame.xi)
        images[part.dp_position] = g * word(frame.xi_prime)
        delta = {a.A.position: g * word(a.Z.xi), frame.velocity: word(frame.d_velocity)}
        images[part.d_velocity] = derivation(images[part.velocity], delta.get)
        delta = {a.A.position: g * word(a.Z.xi_prime), frame.velocity: word(frame.dp_velocity)}
        images[part.dp_velocity] = derivation(images[part.velocity], delta.get)
    return images


def rates(a: Alphabet, turned: Mapping[Letter, Expr] | None = None) -> list[Equation]:
    """Ȧ = AZ and Ṫ = Aw, with Z as given."""
    images = trivial_images(a)
    return [
        Equation(p.rate, tree_of(substitute(images[p.velocity], turned or {}))) for p in a.parts
    ]


def carry(e: Expr, a: Alphabet) -> Expr:
    """A scalar expression carried to the identity."""
    return reduce(substitute(e, trivial_images(a)), frame_rule(a, word(a.C)))


def trivialise(stage: Cartan, a: Alphabet, prefix: str) -> Cartan:
    """ϖ in the variables (g, Z), with ξ = g⁻¹δg."""
    momentum, energy = carry(stage.momentum, a), carry(stage.energy, a)
    inverse: Tree = ("inv", "A")
    definitions = [
        Equation(frame_letter.name, ("mul", inverse, part_letter.name))
        for part, frame in zip(a.parts, a.frames, strict=True)
        for frame_letter, part_letter in (
            (frame.velocity, part.velocity),
            (frame.xi, part.d_position),
            (frame.xi_prime, part.dp_position),
        )
    ]
    if a.affine:
        definitions += [Equation(f"{x}_b", ("mul", ("T", "A"), x)) for x in ("N", "F")]
    else:
        definitions.append(Equation("f", ("mul", inverse, "F̃")))
    images = trivial_images(a)
    steps = (
        Step(
            f"{prefix}.trivialisation",
            "trivialisation",
            (f"{prefix}.action",),
            (
                *definitions,
                Equation("C", ("mul", ("T", "A"), "A")),
                *(Equation(p.d_velocity.name, tree_of(images[p.d_velocity])) for p in a.parts),
                Equation("δC", tree_of(varied_gram(a, a.Z.xi))),
            ),
            say(
                "Tangent vectors are carried to the Lie algebra by g⁻¹ (Maurer–Cartan); the metric "
                "depends on g through C = ĀA only."
            ),
            (27, 30),
        ),
        Step(
            f"{prefix}.cartan_trivialised",
            "trivialisation",
            (f"{prefix}.cartan", f"{prefix}.energy", f"{prefix}.trivialisation"),
            (form_equation(momentum, energy, metrics()),),
            say("The Cartan form in this trivialisation."),
        ),
    )
    return Cartan(momentum, energy, steps)


def form_equation(momentum: Expr, energy: Expr, notation: Notation) -> Equation:
    """ϖ(δy) = p̃ − (h̃) δt with the energy written out."""
    return Equation(
        ("call", "ϖ", "δy"),
        add(tree_of(momentum, notation), ("mul", -1, tree_of(energy, notation), "δt")),
    )
