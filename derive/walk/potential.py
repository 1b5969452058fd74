"""The body and the potentials of a problem on words: Ũ pulled back, and its force.

Gravity and springs are sums over points and over springs; they are pulled back like L itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ..algebra.calculus import derivation
from ..algebra.notation import metrics, tree_of
from ..algebra.tree import Tree, add, neg
from ..algebra.words import Expr, Letter, inner, number, word
from ..mechanics.problem import MomentBody, PointBody, Problem
from ..record.record import Equation, Step
from .alphabet import Alphabet
from .lagrangian import POINT
from .pullback import sum_over


@dataclass(frozen=True)
class Potentials:
    """``energy`` = Ũ on words in A, T, c, m, γ, K."""

    energy: Expr
    steps: tuple[Step, ...]


def column(entries: tuple[Tree, ...]) -> Tree:
    """A vector as a matrix tree with one column."""
    return ("matrix", *(("row", x) for x in entries))


def body_step(problem: Problem, prefix: str, scope: str) -> Step | None:
    """The numbers of the body: its moments as parameters, or its points."""
    body = problem.body
    if isinstance(body, MomentBody):
        rows = tuple(("row", *row) for row in body.second())
        equations = [
            Equation("m", body.mass()),
            Equation("c", column(body.first())),
            Equation("J", ("matrix", *rows)),
        ]
        prose = "The moments of the body are parameters."
    elif isinstance(body, PointBody):
        equations = []
        for i, (m, r) in enumerate(zip(body.masses, body.positions, strict=True), 1):
            equations += [
                Equation(("at", "m", i), m),
                Equation(("at", "r", i), column(r)),
            ]
        prose = "The points of the body and their masses."
    else:
        return None
    return Step(f"{prefix}.body", "definition", (), tuple(equations), prose, (), scope)


def potentials(problem: Problem, a: Alphabet, prefix: str, general: str, scope: str) -> Potentials:
    """Ũ of the problem, with the vectors and matrices it needs."""
    energy, definitions, over_points = number(0), [], []
    gamma, K = Letter("γ", a.n), Letter("K", a.n, a.n, 1)
    if problem.gravity is not None:
        position = a.moved(word(a.A.position), word(a.T.position))
        summand = -word(a.m_i) * inner(word(gamma), position)
        table = {(a.m_i,): word(a.m), (a.m_i, a.r_i): word(a.c)}
        energy = energy + sum_over(summand, {a.m_i, a.r_i}, table)
        definitions.append(Equation("γ", column(problem.gravity)))
        over_points.append(neg(("sum", "i", ("mul", ("at", "m", "i"), ("inner", "γ", POINT)))))
    if problem.springs:
        k_e, s_e = Letter("k_e"), Letter("s_e", a.n)
        stretched = word(a.A.position) * word(s_e)
        summand = Fraction(1, 2) * word(k_e) * inner(stretched, stretched)
        energy = energy + sum_over(summand, {k_e, s_e}, {(k_e, s_e, s_e): word(K)})
        definitions += _springs(problem)
        family = metrics(display={k_e: ("at", "k", "e"), s_e: ("at", "s", "e")})
        over_points.append(("sum", "e", tree_of(summand, family)))
    steps = (
        Step(
            f"{prefix}.potential",
            "pull-back",
            (f"{general}.action", f"{general}.moments"),
            (
                *definitions,
                Equation("U", add(*over_points)),
                Equation("Ũ", tree_of(energy)),
            ),
            "The potential of the problem, on the points and pulled back to the group."
            + (" The springs have natural length 0." if problem.springs else ""),
            (),
            scope,
        ),
    )
    return Potentials(energy, steps)


def _springs(problem: Problem) -> list[Equation]:
    equations = []
    for e, spring in enumerate(problem.springs, 1):
        i, j = spring.between
        ends = ("add", ("at", "r", i), neg(("at", "r", j)))
        equations += [Equation(("at", "s", e), ends), Equation(("at", "k", e), spring.stiffness)]
    s: Tree = ("at", "s", "e")
    equations.append(Equation("K", ("sum", "e", ("mul", ("at", "k", "e"), s, ("T", s)))))
    return equations


def virtual_work(energy: Expr, a: Alphabet, xi: Expr, eta: Expr | None) -> Expr:
    """−dŨ(Aξ, Aη) on words."""
    g = word(a.A.position)
    images = {a.A.position: g * xi}
    if eta is not None:
        images[a.T.position] = g * eta
    return -derivation(energy, images.get)
