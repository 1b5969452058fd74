"""A continuous body: L, ϖ and the group's action as integrals over it (36)–(38), and its moments.

What was said of a point of mass m_i is said of one of mass dm: r, its place in the body, and v, its
velocity in space, are functions on the body.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..algebra.calculus import derivation, substitute
from ..algebra.word_trees import WordNotation
from ..algebra.words import Expr, Letter, number, word
from ..language.read import read
from ..language.tree import Tree, add, coefficient, mul, neg
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .lagrangian import Lagrangian
from .wording import say


def continuum(points: Lagrangian, a: Alphabet, c: Chapter) -> Step:
    """The step that says g(r), v, L, ϖ and h̃ of a body with a measure of mass, as integrals
    (36)–(38)."""
    draft = c.draft("continuum", "definition")
    varied = Letter("δr", a.n)
    shown: dict[Letter, Tree] = {varied: read("δ(g(r))")}
    momentum = derivation(points.kinetic, {points.v_i: word(varied)}.get)
    kinetic, paired = (integral(draft, e, a, points.v_i, shown) for e in (points.kinetic, momentum))
    notation = _notation(a, points.v_i, shown)
    return draft.step(
        (
            Equation(read("g(r)"), draft.tree(points.position, notation)),
            Equation("v", draft.tree(points.velocity, notation)),
            Equation("L", add(kinetic, neg("U"))),
            Equation(read("ϖ(δy)"), add(paired, read("−h̃ δt"))),
            Equation("h̃", add(kinetic, "U")),
        ),
        say("continuum.integrals"),
        (36, 37, 38),
    )


def _notation(a: Alphabet, v_i: Letter, shown: Mapping[Letter, Tree]) -> WordNotation:
    """How the place and the velocity of a point are written without their index."""
    return WordNotation(display={a.r_i: "r", v_i: "v", **shown})


def integral(
    d: Draft, e: Expr, a: Alphabet, v_i: Letter, shown: Mapping[Letter, Tree] | None = None
) -> Tree:
    """The tree ∫ … dm for the summand m_i … ."""
    notation = _notation(a, v_i, shown or {})
    factor, inside = coefficient(d.tree(substitute(e, {a.m_i: number(1)}), notation))
    return mul(factor, ("call", "∫", inside))
