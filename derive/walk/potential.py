"""The body and the potentials of a problem on words: Ũ pulled back, and its force.

Gravity and springs of natural length 0 are sums over points and over springs; they are pulled back
like L itself.  What else there is enters as U_Q, with the forces Q_i that it exerts on the points.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from ..algebra.calculus import derivation
from ..algebra.words import Expr, Letter, inner, number, word
from ..language.tree import Tree, add, neg
from ..problem.problem import PointBody, Problem, Spring
from ..record.record import Equation, Step
from ..record.sentence import Prose, say
from .alphabet import Alphabet
from .chapter import Chapter
from .lagrangian import POINT
from .point_forces import applied, pushes_step
from .pointwise import column, elements
from .pullback import sum_over

U_Q = Letter("U_Q")


@dataclass(frozen=True)
class Potentials:
    """``energy`` = Ũ on words in A, T, c, m, γ, K, U_Q; ``work(ξ, η)`` of what U_Q exerts."""

    energy: Expr
    steps: tuple[Step, ...]
    work: Callable[[Expr, Expr | None], Expr]

    def moved(
        self, a: Alphabet, xi: Expr, eta: Expr | None = None, axis: Expr | None = None
    ) -> dict[Letter, Expr]:
        """What δA = Aξ, δT = Aη make of the letters of Ũ; ``axis``: x for ξ = j(x)."""
        g = word(a.A.position)
        images = {a.A.position: g * xi, U_Q: -self.work(xi if axis is None else axis, eta)}
        return images if eta is None else images | {a.T.position: g * eta}


def potentials(problem: Problem, a: Alphabet, c: Chapter, gram: Expr | None = None) -> Potentials:
    """Ũ of the problem, with the vectors and matrices it needs.

    ``gram``: ĀA = 1, where the forces are to be said in vectors.
    """
    draft = c.draft("potential", "pull-back")
    energy, definitions, over_points = _summed(problem, a)
    found, forces = elements(problem), applied(a, "Q", vectors=gram is not None)
    spread = problem.gravity is not None and not isinstance(problem.body, PointBody)
    spread = spread and problem.body is not None
    if found.energies:
        energy = energy + word(U_Q)
        over_points += found.energies
        definitions += found.differences
        definitions.append(Equation("U_Q", add(*found.energies)))
    steps = [
        draft.step(
            (
                *definitions,
                Equation("U", add(*over_points)),
                Equation("Ũ", draft.tree(energy)),
            ),
            _prose(over_points, spread=spread, springs=bool(problem.springs)),
        )
    ]
    if found.energies:
        steps.append(pushes_step(found, forces, a, c, gram))
    return Potentials(draft.said(energy), tuple(steps), forces.work)


def _prose(over_points: list[Tree], *, spread: bool, springs: bool) -> Prose:
    if not over_points:
        return say("No potential: the motion is free.")
    prose = say("The potential of the problem, on the points and pulled back to the group.")
    if spread:
        prose += say("Here Σ m_i stands for the sum over the whole body.")
    if springs:
        prose += say(
            "K is the sum over the springs of natural length 0; s_e joins the ends of one "
            "of them in the body."
        )
    return prose


def _summed(problem: Problem, a: Alphabet) -> tuple[Expr, list[Equation], list[Tree]]:
    """Gravity and quadratic springs: their energy on words, definitions, and sums over points."""
    energy, definitions, over_points = number(0), [], []
    gamma, K = Letter("γ", a.n), Letter("K", a.n, a.n, 1)
    if problem.gravity is not None:
        general = Chapter(a.chapter)
        position = a.moved(word(a.A.position), word(a.T.position)).marked(general.label("action"))
        summand = -word(a.m_i) * inner(word(gamma), position)
        table = {
            (a.m_i,): word(a.m).marked(general.label("moments")),
            (a.m_i, a.r_i): word(a.c).marked(general.label("moments")),
        }
        energy = energy + sum_over(summand, {a.m_i, a.r_i}, table)
        assert problem.group is not None
        definitions.append(Equation("γ", column(problem.group.in_every_block(problem.gravity))))
        over_points.append(neg(("sum", "i", ("mul", ("at", "m", "i"), ("inner", "γ", POINT)))))
    if problem.springs:
        k_e, s_e = Letter("k_e"), Letter("s_e", a.n)
        turned = word(a.A.position).marked(Chapter(a.chapter).label("action"))
        stretched = turned * word(s_e)
        summand = Fraction(1, 2) * word(k_e) * inner(stretched, stretched)
        energy = energy + sum_over(summand, {k_e, s_e}, {(k_e, s_e, s_e): word(K)})
        definitions += _springs(problem)
        over_points += [_on_points(e, spring) for e, spring in enumerate(problem.springs, 1)]
    return energy, definitions, over_points


def _on_points(e: int, spring: Spring) -> Tree:
    """½ k_e ‖r_i(t) − r_j(t)‖²."""
    i, j = (("call", ("at", "r", x), "t") for x in spring.between)
    return ("mul", Fraction(1, 2), ("at", "k", e), ("norm2", ("add", i, neg(j))))


def _springs(problem: Problem) -> list[Equation]:
    equations = []
    for e, spring in enumerate(problem.springs, 1):
        i, j = spring.between
        ends = ("add", ("at", "r", i), neg(("at", "r", j)))
        equations += [Equation(("at", "s", e), ends), Equation(("at", "k", e), spring.stiffness)]
    s: Tree = ("at", "s", "e")
    equations.append(Equation("K", ("sum", "e", ("mul", ("at", "k", "e"), s, ("T", s)))))
    return equations


def virtual_work(
    v: Potentials, a: Alphabet, xi: Expr, eta: Expr | None, axis: Expr | None = None
) -> Expr:
    """−dŨ(Aξ, Aη) on words; the moments of Q are paired with the axis of ξ = j(axis), if given."""
    return -derivation(v.energy, v.moved(a, xi, eta, axis).get)
