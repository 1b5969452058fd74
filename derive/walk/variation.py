"""The principle: a lift is an extremal of the action (5), δt and δg being 0 at both ends, if and
only if its tangent is in the kernel of dϖ.

A curve t ↦ (t, g, ν) is a lift where ν = ġ.  With X its tangent, δ′ is the derivative d/dt along
it, which commutes with δ:

    δ[ϖ(X)] = dϖ(δy, X) + d/dt ϖ(δy).

The left side is varied from L̃ alone, through lifts.  No regularity is used.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra import forms
from ..algebra.calculus import derivation, substitute
from ..algebra.word_trees import WordNotation, tree_of
from ..algebra.words import Expr, Letter, inner, number, word
from ..language.read import read
from ..language.tree import Tree, add
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .cartan import Cartan
from .chapter import Chapter, Draft
from .exterior import natural_variations, primes
from .lagrangian import Lagrangian, indexed_tree
from .pullback import Pullback, sum_over
from .wording import say

ACROSS = read("dϖ(δy, X)")
LATER = Letter("d/dt δt")
"""The derivative of δt along a lift."""


@dataclass(frozen=True)
class Principle:
    """The variation of the action: ``across``: dϖ(δy, X) on lifts, which vanishes on extremals
    alone."""

    across: Expr
    steps: tuple[Step, Step]


def principle(
    points: Lagrangian, pulled: Pullback, form: Cartan, a: Alphabet, c: Chapter
) -> Principle:
    """The variation of the action by dϖ, and what dϖ is there, d’Alembert's principle: the steps
    ``extremal`` and ``dalembert``."""
    varying, working = c.draft("extremal", "variation"), c.draft("dalembert", "contraction")
    lagrangian = pulled.kinetic - word(a.U)
    first, across = extremal(varying, lagrangian, form.form, pulled.moment_work, a)
    summand, shown = _work(points, a)
    balance = sum_over(summand, {a.m_i, a.r_i, a.F_i}, pulled.moments)
    moving = {p.position: word(p.velocity) for p in a.parts}
    if derivation(points.position, moving.get) != points.velocity:
        raise ValueError("the velocity of a point is not the derivative of its place")
    any_rate = tuple(p.acceleration.name for p in a.parts)
    across_points = add(("mul", -1, ("sum", "i", shown)), working.tree(across + balance))
    second = working.step(
        (
            Equation(read("d/dt(rᵢ(t))"), read("vᵢ")),
            Equation(
                read("d/dt(vᵢ)"), indexed_tree(_acceleration(points, a), points.v_i, a), any_rate
            ),
            Equation(ACROSS, across_points, any_rate),
        ),
        say("dalembert.extremal") + say("dalembert.points"),
        (2, 5),
        first.given,
    )
    return Principle(working.mark(across), (first, second))


def extremal(
    varying: Draft, lagrangian: Expr, form: Expr, work: Expr, a: Alphabet
) -> tuple[Step, Expr]:
    """The step ``extremal`` by L̃ and ϖ, with −dŨ(δg) = ``work``; and dϖ(δy, X) on lifts, as what
    remains of the variation of L̃."""
    twins, tangent = primes(a), tangent_of_lift(a)
    onto = {x: tangent[y] for x, y in twins.items() if y in tangent}
    excess = substitute(form, onto) - lagrangian
    delta, delta_prime = natural_variations(work, a)
    exterior = substitute(forms.exterior(form, twins, delta, delta_prime), tangent)
    varied, rate = _varied(lagrangian, work, a), _rate(form, work, a)
    step = varying.step(
        (
            Equation(read("ϖ(X)"), add("L̃", varying.tree(excess))),
            Equation(
                read("δ(ϖ(X))"),
                add(ACROSS, read("d/dt(ϖ(δy))"), varying.tree(varied - exterior - rate)),
            ),
        ),
        say("extremal.action") + say("extremal.lifts"),
        (5, 11),
        [Equation(("call", p.d_position.name, "X"), p.velocity.name) for p in a.parts],
    )
    return step, varying.mark(varied) - rate


def tangent_of_lift(a: Alphabet) -> dict[Letter, Expr]:
    """The values of δ′ as d/dt along a lift: δ′t = 1, δ′g = ν, δ′ν = ν̇."""
    tangent = {a.dpt: number(1)}
    for p in a.parts:
        tangent |= {p.dp_position: word(p.velocity), p.dp_velocity: word(p.acceleration)}
    return tangent


def _varied(lagrangian: Expr, work: Expr, a: Alphabet) -> Expr:
    """δ(L̃ dt) / dt through lifts: ν = dg/dt, whose variation is d(δg)/dt − ν d(δt)/dt."""
    later = word(LATER)
    delta = {a.U: word(a.dU_dt) * word(a.dt) - work}
    for p in a.parts:
        delta[p.position] = word(p.d_position)
        delta[p.velocity] = word(p.second) - word(p.velocity) * later
    return derivation(lagrangian, delta.get) + lagrangian * later


def _rate(form: Expr, work: Expr, a: Alphabet) -> Expr:
    """d/dt of ϖ(δy) along a lift."""
    along = substitute(work, {p.d_position: word(p.velocity) for p in a.parts})
    rate = {a.U: word(a.dU_dt) - along, a.dt: word(LATER)}
    for p in a.parts:
        rate |= {p.position: word(p.velocity), p.velocity: word(p.acceleration)}
        rate[p.d_position] = word(p.second)
    return derivation(form, rate.get)


def _acceleration(points: Lagrangian, a: Alphabet) -> Expr:
    """α̇ r_i + τ̇."""
    return substitute(points.velocity, {p.velocity: word(p.acceleration) for p in a.parts})


def _work(points: Lagrangian, a: Alphabet) -> tuple[Expr, Tree]:
    """⟨m_i r̈_i − F_i, δr_i − v_i δt⟩ on words, with the acceleration at hand; and as written."""
    acceleration = _acceleration(points, a)
    varied = Letter("δr_i", a.n)
    balance = word(a.m_i) * acceleration - word(a.F_i)
    moved = word(varied) - word(points.v_i) * word(a.dt)
    members = {a.m_i: "m", a.r_i: "r", a.F_i: "F", points.v_i: "v"}
    display: dict[Letter, Tree] = {x: ("at", name, "i") for x, name in members.items()}
    notation = WordNotation(display=display | {varied: read("δ(rᵢ(t))")})
    shown: Tree = ("inner", tree_of(balance, notation), tree_of(moved, notation))
    images = {varied: points.variation, points.v_i: points.velocity}
    return inner(balance, substitute(moved, images)), shown
