"""Step 2.  L̃, the Lagrangian pulled back to the group (11)–(22), and the force on the group (24).

The sum over the points is carried out on words: what stands between the members of an indexed
family is common to all of them, so  m_i r_i r̄_i → J,  m_i r_i → c,  m_i → m  (18)(19), and
F_i r̄_i → N,  F_i → F  for the forces.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..algebra.calculus import substitute
from ..algebra.notation import metrics, tree_of
from ..algebra.tree import Tree, neg
from ..algebra.words import (
    Expr,
    Letter,
    Word,
    expr_of_word,
    inner,
    number,
    rotations,
    row_dim,
    trace,
    transpose_word,
    word,
)
from ..record.record import Equation, Step
from ..record.sentence import say
from .alphabet import Alphabet
from .lagrangian import Lagrangian, kinetic_of_motion

Moments = Mapping[tuple[Letter, ...], Expr]
"""Σ of a product of members: (m, r, r) ↦ Σ m_i r_i r̄_i, (F, r) ↦ Σ F_i r̄_i, (m,) ↦ Σ m_i, …"""


@dataclass(frozen=True)
class Pullback:
    """``kinetic``: the quadratic part of L̃ on words, so that L̃ = kinetic − Ũ."""

    kinetic: Expr
    steps: tuple[Step, ...]


def sum_over(e: Expr, members: set[Letter], moments: Moments) -> Expr:
    """Σ_i of a scalar summand in which the members of indexed families are the given letters.

    ``ValueError`` for a product of two moments; ``KeyError`` for a moment that is not in the table.
    """
    total = number(0)
    for (traces, _), c in e.terms.items():
        term = number(c)
        weights: list[Letter] = []
        holders: list[Word] = []
        for w in traces:
            if len(w) == 1 and w[0][0] in members:
                weights.append(w[0][0])
            elif any(x in members for x, _ in w):
                holders.append(w)
            else:
                term = term * Expr(1, 1, {((w,), ()): number(1).terms[(), ()]})
        if len(holders) > 1:
            raise ValueError("a product of two moments is not a moment")
        inside = _moment(tuple(weights), holders[0], members, moments) if holders else None
        total = total + term * (moments[tuple(weights)] if inside is None else inside)
    return total


def _moment(weights: tuple[Letter, ...], w: Word, members: set[Letter], moments: Moments) -> Expr:
    """A scalar word x̄ W y summed over its members: Tr W Σ y x̄, or (Σ x)‾ W y."""
    sign, opened = 1, next(t for t in rotations(w) if row_dim(t[0]) == 1)
    if opened[0][0] not in members:
        sign, opened = transpose_word(opened)
    x, y = opened[0][0], opened[-1][0]
    if y not in members:
        return sign * (moments[(*weights, x)].bar * expr_of_word(opened[1:], x.rows, 1))
    key = (*weights, y, x)
    second = moments[key] if key in moments else moments[(*weights, x, y)].bar
    middle = opened[1:-1]
    if not middle:
        return sign * trace(second)
    return sign * trace(expr_of_word(middle, x.rows, y.rows) * second)


def pullback(stage: Lagrangian, a: Alphabet, prefix: str) -> Pullback:
    """Put the motion into L and sum over the points; then the force on the group."""
    table = {(a.m_i,): word(a.m), (a.m_i, a.r_i): word(a.c), (a.m_i, a.r_i, a.r_i): word(a.J)}
    kinetic = sum_over(kinetic_of_motion(stage), {a.m_i, a.r_i}, table)
    notations = (metrics(),) if a.affine else (metrics(), metrics("J"))
    step = Step(
        f"{prefix}.pullback",
        "pull-back",
        (f"{prefix}.lagrangian", f"{prefix}.velocity", f"{prefix}.moments"),
        tuple(Equation("L̃", tree_of(kinetic - word(a.U), n)) for n in notations),
        say(
            "The Lagrangian is pulled back to the group: the velocities of the motion are put in "
            "and the sum over the points is carried out."
        )
        + say(
            "From here on the masses are positive and no tangent vector of the group but 0 "
            "leaves all the points at rest: the kinetic energy is then half the square of a "
            "norm, a metric on the group."
        ),
        (11, 12, 13, 17) if a.affine else (11, 12, 13, 21, 22),
    )
    steps = [_moments(a, prefix), step, _force(stage, a, prefix)]
    if not a.affine:
        steps.append(_gradient(a, prefix))
    return Pullback(kinetic, tuple(steps))


def _moments(a: Alphabet, prefix: str) -> Step:
    r_i: Tree = ("at", "r", "i")
    m_i: Tree = ("at", "m", "i")
    equations = [
        Equation("m", ("sum", "i", m_i)),
        Equation("c", ("sum", "i", ("mul", m_i, r_i))),
        Equation("J", ("sum", "i", ("mul", m_i, r_i, ("T", r_i)))),
    ]
    return Step(
        f"{prefix}.moments",
        "definition",
        (),
        tuple(equations),
        say(
            "The body enters the kinetic energy through its moments only: mass, first moment, "
            "matrix of moments."
        ),
        (18, 19),
    )


def _force(stage: Lagrangian, a: Alphabet, prefix: str) -> Step:
    """dŨ by the forces on the points, F_i = −∂U/∂r_i: a sum like that of the moments."""
    F_i = Letter("F_i", a.n)
    varied = substitute(stage.position, {p.position: word(p.d_position) for p in a.parts})
    table = {(F_i, a.r_i): word(a.N), (F_i,): word(a.F)}
    work = sum_over(inner(word(F_i), varied), {F_i, a.r_i}, table)
    pair: Tree = ("mul", ("at", "F", "i"), ("T", ("at", "r", "i")))
    definitions = [Equation("N", ("sum", "i", pair))]
    if a.affine:
        definitions.append(Equation("F", ("sum", "i", ("at", "F", "i"))))
    variations = tuple(p.d_position.name for p in a.parts)
    return Step(
        f"{prefix}.force",
        "pull-back",
        (f"{prefix}.lagrangian", f"{prefix}.velocity"),
        (*definitions, Equation(("call", "dŨ", *variations), tree_of(-work))),
        say(
            "The forces F_i, opposite to the derivatives of U with respect to the places "
            "r_i(t) in space, act on the group through their moments."
        ),
        (2,),
    )


def _gradient(a: Alphabet, prefix: str) -> Step:
    pairing = inner(word(a.F_group), word(a.A.d_position), word(a.J))
    return Step(
        f"{prefix}.gradient",
        "definition",
        (f"{prefix}.force",),
        (Equation(tree_of(pairing, metrics("J")), neg(("call", "dŨ", "δA")), ("δA",)),),
        say(
            "The force F̃, tangent to the group, is the opposite of the gradient of Ũ in the metric."
        ),
        (24,),
    )
