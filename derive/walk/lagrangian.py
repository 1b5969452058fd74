"""Step 1.  The Lagrangian of the points (3), the motion that the group gives them (7)–(10), (14).

L = Σᵢ ½ mᵢ ‖vᵢ‖² − U,  rᵢ(t) = A rᵢ + T,  vᵢ = α rᵢ + τ
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra.calculus import derivation, substitute
from ..algebra.word_trees import metrics, tree_of
from ..algebra.words import Expr, Letter, inner, word
from ..language.read import read
from ..language.tree import Tree, add, neg
from ..record.record import Equation, Step
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Chapter
from .wording import say

POINT = read("rᵢ(t)")
"""r_i(t), the point in space; r_i alone is the point in the body."""


@dataclass(frozen=True)
class Lagrangian:
    """The Lagrangian of the points, on words: ``kinetic``: the summand ½ m_i ⟨v_i, v_i⟩, with v_i
    given by ``velocity``.

    ``position``: the place of a point in space, ``variation``: its δ.
    """

    kinetic: Expr
    v_i: Letter
    position: Expr
    velocity: Expr
    variation: Expr
    steps: tuple[Step, ...]


def kinetic_energy(v_i: Letter, a: Alphabet) -> Expr:
    """The summand ½ m_i ⟨v_i, v_i⟩ of L = Σ_i ½ m_i ⟨v_i, v_i⟩ − U."""
    return Fraction(1, 2) * word(a.m_i) * inner(word(v_i), word(v_i))


def velocities(position: Expr, a: Alphabet) -> tuple[Expr, Expr]:
    """The velocity v_i = α r_i + τ and the variation δr_i(t) = δA r_i + δT, from r_i(t) = A r_i +
    T."""
    velocity = derivation(position, {p.position: word(p.velocity) for p in a.parts}.get)
    variation = derivation(position, {p.position: word(p.d_position) for p in a.parts}.get)
    return velocity, variation


def lagrangian(a: Alphabet, c: Chapter) -> Lagrangian:
    """L, and the places and velocities that an element of the group and a tangent vector give to
    the points."""
    first = c.draft("lagrangian", "definition")
    kinetic = kinetic_energy(v_i := Letter("v_i", a.n), a)
    acting = c.draft("action", "definition")
    position = acting.mark(a.moved(word(a.A.position), word(a.T.position)))
    varied = c.draft("velocity", "variation")
    velocity, variation = velocities(position, a)
    varied.depends_on(velocity, variation)
    steps = (
        first.step(
            (Equation("L", add(("sum", "i", indexed_tree(kinetic, v_i, a)), neg("U"))),),
            say("lagrangian.points"),
            (3,),
        ),
        acting.step(
            (Equation(POINT, indexed_tree(position, v_i, a)),),
            _moved(a),
            (7, 8),
        ),
        varied.step(
            (
                Equation(read("vᵢ"), indexed_tree(velocity, v_i, a)),
                Equation(read("δ(rᵢ(t))"), indexed_tree(variation, v_i, a)),
            ),
            _velocities(a) + say("velocity.independent"),
            (9, 10, 14),
        ),
    )
    velocity, variation = varied.mark(velocity), varied.mark(variation)
    return Lagrangian(first.mark(kinetic), v_i, position, velocity, variation, steps)


def _moved(a: Alphabet) -> Prose:
    if a.affine:
        return say("action.affine")
    return say("action.linear")


def _velocities(a: Alphabet) -> Prose:
    if a.affine:
        return say("velocity.affine")
    return say("velocity.linear")


def indexed_tree(e: Expr, v_i: Letter, a: Alphabet, v: Tree = "") -> Tree:
    """The tree of a summand, with m_i, r_i, v_i as members of indexed families; ``v``: the tree for
    v_i."""
    display = {a.m_i: read("mᵢ"), a.r_i: read("rᵢ"), v_i: v or read("vᵢ")}
    return tree_of(e, metrics(display=display))


def moving_tree(stage: Lagrangian, a: Alphabet) -> Tree:
    """The tree of the summand ½ m_i ‖v_i‖², with the velocity of the motion for v_i."""
    return indexed_tree(stage.kinetic, stage.v_i, a, indexed_tree(stage.velocity, stage.v_i, a))


def kinetic_of_motion(stage: Lagrangian) -> Expr:
    """The summand ½ m_i ⟨v_i, v_i⟩ on words, with the velocity of the motion for v_i."""
    return substitute(stage.kinetic, {stage.v_i: stage.velocity})
