"""SE(3): the translation is eliminated; the inertia about the centre of mass appears.

The equations of :mod:`derive.walk.vector` hold for any origin in the body.  The coefficient of ẇ is
the scalar m, so ẇ is solved for and put into the other equation; what then multiplies ζ̇ is the
tensor of inertia about the centre of mass.  Nothing is assumed about c.  Then everything is said
from the centre of mass r_c, by c = m r_c and its velocity w_c, and the terms in c fall together.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import coefficient_of, reduce, substitute, without
from ..algebra.space import hat, normal_form
from ..algebra.word_trees import WordNotation, tree_of
from ..algebra.words import Expr, Letter, word
from ..language.tree import Tree, add, mul
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .chapter import Chapter
from .hat import INERTIA, OMEGA_P, ZETA, ZETA_DOT, anticommute
from .inverse import cancel_scalar, inverse_letter, inverse_tree
from .translation import central_moments
from .vector import VectorForm
from .wedge import vector_sum
from .wording import say, say_signed

CENTRAL = Letter("I_c", 3, 3, 1)
CENTRE, CENTRE_VELOCITY = Letter("r_c", 3), Letter("w_c", 3)


@dataclass(frozen=True)
class Eliminated:
    """The equations of SE(3), solved: ``torque`` = I_c ζ̇ and ``acceleration`` = ẇ on words, in ζ,
    w_c, r_c, m⁻¹, μ, F_b."""

    torque: Expr
    acceleration: Expr
    steps: tuple[Step, ...]

    @property
    def inertia(self) -> Step:
        """The step that says I_c."""
        return self.steps[0]


def notation(a: Alphabet) -> WordNotation:
    """The notation that writes the letter m⁻¹ as an inverse."""
    return WordNotation(display={inverse_letter(a.m): inverse_tree(a.m)})


def eliminate(stage: VectorForm, a: Alphabet, c: Chapter) -> Eliminated:
    """The balance of forces solved for ẇ, and put into the balance of moments."""
    draft, w_dot = c.draft("elimination", "elimination"), a.w.acceleration
    forces, moments = stage.balance[a.w.xi_prime], stage.balance[OMEGA_P]
    acceleration = -simplified(word(inverse_letter(a.m)) * without(forces, w_dot), a)
    reduced = simplified(substitute(moments, {w_dot: acceleration}), a)
    tensor = coefficient_of(reduce(reduced, anticommute(ZETA_DOT)), ZETA_DOT)
    J_c, moments_c = central_moments(a)
    by_moments = substitute(tensor, {INERTIA: stage.inertia})
    central = substitute(by_moments, {a.J: word(J_c) + word(a.J) - moments_c})
    rest = -simplified(reduced - tensor * word(ZETA_DOT), a)
    shift = {INERTIA: word(CENTRAL) + word(INERTIA) - tensor}
    torque = from_centre(substitute(rest, shift), a)
    velocity = word(a.w.velocity) + word(hat(ZETA)) * word(CENTRE)
    carried = word(a.w.velocity) + word(CENTRE_VELOCITY) - velocity
    ending = reduce(acceleration, anticommute(a.w.velocity))
    acceleration = from_centre(substitute(ending, {a.w.velocity: carried}), a)
    draft.depends_on(acceleration, central, torque)
    step = draft.step(
        (
            Equation(CENTRE.name, tree_of(word(inverse_letter(a.m)) * word(a.c), notation(a))),
            Equation(CENTRE_VELOCITY.name, vector_tree(velocity, a)),
            Equation(w_dot.name, vector_tree(acceleration, a)),
            Equation(J_c.name, tree_of(moments_c, notation(a))),
            Equation(CENTRAL.name, tree_of(tensor, notation(a))),
            Equation(CENTRAL.name, tree_of(central, notation(a))),
            Equation(("mul", CENTRAL.name, "ζ̇"), vector_tree(torque, a)),
        ),
        say_signed("elimination.mass", a.signed) + say("elimination.velocity"),
    )
    return Eliminated(draft.mark(torque), draft.mark(acceleration), (step,))


def simplified(e: Expr, a: Alphabet) -> Expr:
    """The normal form of an expression, with m m⁻¹ = 1."""
    return cancel_scalar(normal_form(e), a.m)


def from_centre(e: Expr, a: Alphabet) -> Expr:
    """An expression with m r_c for c, simplified."""
    mass = word(a.m)
    images = {a.c: mass * word(CENTRE), hat(a.c): mass * word(hat(CENTRE))}
    return simplified(substitute(e, images), a)


def vector_tree(e: Expr, a: Alphabet) -> Tree:
    """The tree of a sum of vectors, the terms with m⁻¹ together behind one m⁻¹."""
    light, heavy = without(e, inverse_letter(a.m)), coefficient_of(e, inverse_letter(a.m))
    parts = [vector_sum(light, notation(a))] if light else []
    if heavy:
        parts.append(mul(inverse_tree(a.m), vector_sum(heavy, notation(a))))
    return add(*parts)
