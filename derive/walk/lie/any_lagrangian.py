"""Exercise 1 for any Lagrangian: what holds whatever L̃(t, g, Z) is, on the left or on the right.

    δL̃ = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ + ∂ₜL̃ δt,  h̃ = ⟨Π, Z⟩ − L̃,  ϖ = ⟨Π, ξ⟩ − h̃ δt,  Π̇ = Φ + ε ad*_Z Π

The sign ε is that of the bracket in the structure equation, which follows from δg = gξ, or ξg.
Makes the steps of the chapters ``left`` and ``right``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...algebra import forms
from ...algebra.calculus import substitute
from ...algebra.forms import Trivialisation
from ...algebra.word_trees import WordNotation, tree_of
from ...algebra.words import Expr, Letter, inner, number, word
from ...language.read import read
from ...language.tree import Tree
from ...record.record import Equation, Hypothesis, Step, stated
from ..alphabet import Alphabet
from ..chapter import Chapter
from ..contraction import CONTRACTED, CONTRACTION, Contraction
from ..factorisation import at_constant_time
from ..momentum import any_lagrangian_forms, contact
from ..wording import say
from .moment_map import moment_map
from .orbit_form import orbit_form, sign_of

SIDES: dict[str, Trivialisation] = {"left": forms.left, "right": forms.right}
REGULAR = Hypothesis("nondegenerate", read("M̃(ξ, ξ′)"), "𝔤")


@dataclass(frozen=True)
class AnyLagrangian:
    """``epsilon``: the sign in ⟨Π̇ − Φ, ξ′⟩ − ε⟨Π, [Z, ξ′]⟩, which vanishes on the kernel for every
    ξ′; ``velocity``: Ȧ by Z, as AZ or ZA."""

    epsilon: int
    velocity: Tree
    steps: tuple[Step, ...]

    def __getitem__(self, label: str) -> Step:
        """A step by its label, without the chapter."""
        return next(x for x in self.steps if x.label.endswith(f".{label}"))


def structure(a: Alphabet, moved: Trivialisation) -> Expr:
    """δξ′ − δ′ξ, from δ(δ′g) = δ′(δg)."""
    xi, xi_prime = a.Z.xi, a.Z.xi_prime
    return forms.structure_equation(a.A.position, xi, xi_prime, xi, xi_prime, moved)


def by_bracket(e: Expr, a: Alphabet) -> Expr:
    """An expression in ξ′ξ and ξξ′ by the letter of [ξ′, ξ]; ``ValueError`` if it is none."""
    xi, xi_prime = word(a.Z.xi), word(a.Z.xi_prime)
    return (sign_of(e, xi_prime * xi - xi * xi_prime) * word(a.bracket)).of(e)


def any_lagrangian(a: Alphabet, side: str, c: Chapter) -> AnyLagrangian:
    """The forms of any Lagrangian, and its kernel."""
    moved = SIDES[side]
    crossed = by_bracket(structure(a, moved).marked(c.label("structure")), a)
    second_order = c.label("second_order")
    form, balance, told = any_lagrangian_forms(a, c, {a.Z.xi_prime: crossed}, second_order)
    written, derived, motion = told
    momenta, energy = _momenta(c), _energy(c)
    first = (_carried(a, side, c), momenta, energy, _structure(a, crossed, c), written)
    other = moment_map(balance, a, moved, c)
    orbit = orbit_form(form, a, moved, other, c)
    steps = (*first, derived, *_kernel(form, a, c), motion, other, orbit)
    velocity = tree_of(moved(word(a.A.position), word(a.Z.velocity)))
    return AnyLagrangian(_epsilon(balance, a), velocity, steps)


def _epsilon(balance: Expr, a: Alphabet) -> int:
    """The sign of the bracket in the balance, where Π̇ and Φ are 0."""
    Z, xi_prime = word(a.Z.velocity), word(a.Z.xi_prime)
    turning = substitute(balance, dict.fromkeys((a.Pi.rate, a.Pi.force), number(0)))
    return -sign_of(turning, inner(word(a.Pi.momentum), Z * xi_prime - xi_prime * Z))


def _carried(a: Alphabet, side: str, c: Chapter) -> Step:
    """Z, ξ and ξ′, by the velocity and the variations of g."""
    definitions = {
        "left": "Z = A⁻¹α,  ξ = A⁻¹δA,  ξ′ = A⁻¹δ′A",
        "right": "Z = αA⁻¹,  ξ = δAA⁻¹,  ξ′ = δ′AA⁻¹",
    }
    told = say(f"trivialisation.{side}") + say("trivialisation.matrices")
    return c.draft("trivialisation", "trivialisation").step(
        stated(definitions[side]), told, (27,) if side == "left" else ()
    )


def _momenta(c: Chapter) -> Step:
    """Π and Φ: the derivatives of L̃ along Z and along the group."""
    return c.draft("momenta", "fibre derivative").step(
        stated("δ(L̃) = ⟨Π, δZ⟩ + ⟨Φ, ξ⟩ + ∂ₜL̃ δt"), say("momenta.any_lagrangian")
    )


def _energy(c: Chapter) -> Step:
    """h̃ = ⟨Π, Z⟩ − L̃."""
    draft = c.draft("energy", "Legendre transform")
    return draft.step(stated("h̃ = ⟨Π, Z⟩ − L̃"), say("energy.any_lagrangian"), (16,))


def _structure(a: Alphabet, crossed: Expr, c: Chapter) -> Step:
    """The structure equation, with the sign of its bracket."""
    shown = tree_of(crossed, WordNotation(display={a.bracket: read("[ξ′, ξ]")}))
    draft = c.draft("structure", "structure equation")
    return draft.step((Equation(read("δ(ξ′) − δ′(ξ)"), shown),), say("structure.crossed"))


def _kernel(form: Expr, a: Alphabet, c: Chapter) -> tuple[Step, ...]:
    """X in dϖ, its vertical part, and the velocity that X has where ∂²L̃/∂Z² is invertible."""
    notation = _notation(a)
    contraction = Contraction(
        form,
        at_constant_time(form, a.dt, a.dpt),
        _images(a),
        {a.Z.xi: word(a.Z.velocity)},
        {a.Pi.d_momentum: a.Pi.rate},
        (a.Pi.dp_momentum,),
        (a.dt, a.dpt),
        notation,
    )
    putting, testing, finding = (
        c.draft("contraction", "contraction"),
        c.draft("vertical", "restriction"),
        c.draft("second_order", "kernel"),
    )
    first = putting.step(
        [Equation(CONTRACTION, contraction.any_vector(putting))],
        say("contraction.extremals") + say("contraction.unknown", unknown="ξ, δΠ"),
        where=(CONTRACTED,),
    )
    contraction = contraction.marked_by(putting)
    second = testing.step(
        [
            Equation(CONTRACTION, contraction.on_vertical(testing)),
            *stated("⟨δ′Π, ξ⟩ = M̃(ξ, δ′Z)"),
        ],
        say("vertical.velocity"),
        where=(CONTRACTED, Equation("δ′t", 0), Equation("ξ′", 0)),
    )
    finding.depends_on(second)
    along = stated("ξ(X) = Z")
    third = finding.step(
        along, say("second_order.any_lagrangian"), where=along, hypotheses=(REGULAR,)
    )
    return first, second, third


def _images(a: Alphabet) -> Mapping[Letter, Expr]:
    return contact([(a.Pi, a.Z)], a, {})


def _notation(a: Alphabet) -> WordNotation:
    """Pairings with 𝔤* as ⟨·, ·⟩, and the letter of the bracket written out."""
    display = {a.bracket: read("[ξ′, ξ]")}
    return WordNotation(display=display, covectors=frozenset(a.Pi.letters))
