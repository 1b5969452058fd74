"""The kernel in coordinates of 𝔤: the mass matrix M of a basis, for any group.

With ξ′ = E_a and Ż = Σ ζ̇_b E_b the equations of motion are  Σ_b M_ab ζ̇_b = β_a.
"""

from __future__ import annotations

from ..algebra.calculus import gradient, substitute, without
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, inner, word
from ..language.read import read
from ..record.record import Equation, Step, stated
from .alphabet import Alphabet
from .centre import CentralEquations
from .chapter import Chapter, Draft
from .inverse import inverse_letter
from .translation import Centred
from .trivialisation import rates
from .wording import say, say_signed

RATE = Letter("ζ̇_b")


def mass_steps(
    inertial: Expr,
    force: Expr,
    place: Step,
    b: Alphabet,
    c: Chapter,
    centred: Centred | None = None,
    *,
    balanced: bool = True,
    central: CentralEquations | None = None,
) -> tuple[Step, ...]:
    """The steps ``mass`` and ``motion``: M, β and the solved equations, from  inertial = Tr ξ′
    force‾  for every ξ′ in 𝔤.

    ``place``: the step of the coordinates, Ż = Σ ζ̇_b E_b. ``balanced``: is there a B, the balance
    as a matrix? Not where C dropped out for what pairs with 𝔤 alone. ``central``: the equations
    seen from the centres of mass; the coordinates ψ are then those of Ż(1 + S).
    """
    weighing, solving = c.draft("mass", "components"), c.draft("motion", "solution")
    E_a, E_b = basis_member("a", b), basis_member("b", b)
    notation = WordNotation(display={E_a: read("E_a"), E_b: read("E_b")})
    rate = word(RATE) * word(E_b)
    rate = rate if central else rate.marked(place.label)
    along = {b.Z.xi_prime: word(E_a), b.Z.acceleration: rate}
    mass = gradient(substitute(inertial, along), RATE)
    rest = force - gradient(without(inertial, b.Z.acceleration), b.Z.xi_prime)
    lighter = WordNotation(display={inverse_letter(b.m): read("m⁻¹")})
    if centred:
        solving.depends_on(*centred.steps)
    translation = (Equation("ẇ", centred.acceleration),) if centred else ()
    balance = [Equation("B", weighing.tree(rest, lighter))] if balanced else []
    load = inner(word(E_a), word(Letter("B", b.n, b.n)) if balanced else rest)
    found = "ψ" if central else "ζ̇"
    mass_step = weighing.step(
        (
            Equation(read("M_ab"), weighing.tree(mass, notation)),
            *balance,
            Equation(read("β_a"), weighing.tree(load, notation)),
            *stated(f"Σ_b M_ab {found}_b = β_a"),
        ),
        say("mass.centres" if central else "mass.basis"),
    )
    solving.depends_on(mass_step)
    solved = stated(f"{found} = M⁻¹β")
    motion = solving.step(
        (*rates(solving, b), *solved, *_whole(solving, b, central), *translation),
        say("motion.problem") + say_signed("motion.mass_matrix", b.signed),
    )
    return mass_step, motion


def _whole(d: Draft, b: Alphabet, central: CentralEquations | None) -> list[Equation]:
    """The equation of Ż by its coordinates, where ẇ or ζ̇ needs it."""
    if central is None:
        return stated("Ż = Σ_a ζ̇_a E_a") if b.affine else []
    rate = b.Z.acceleration
    whole = word(rate) - word(rate) * central.shift
    return [Equation("Ż", d.tree(whole, WordNotation(display={rate: read("Σ_a ψ_a E_a")})))]


def basis_member(index: str, b: Alphabet) -> Letter:
    """The letter E_a of a basis matrix, skew or traceless where Z is."""
    z = b.Z.velocity
    return Letter(f"E_{index}", b.n, b.n, z.symmetry, z.traceless)
