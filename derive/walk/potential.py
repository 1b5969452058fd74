"""The potentials of a problem on words: Ũ pulled back, and its force.

A kind that has words (``walk/kinds``) is pulled back like L itself: gravity, springs of natural
length 0, torsion, a far centre.  The others enter as U_Q, with the forces Q_i on the points.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..algebra.calculus import derivation
from ..algebra.words import Expr, Letter, number, word
from ..language.tree import Tree, add
from ..problem.problem import Problem
from ..record.record import Equation, Step
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Chapter
from .kinds import walked
from .point_forces import applied, point_forces_step
from .point_potentials import PointPotentials
from .potential_letters import PotentialLetter, Words, moved
from .wording import say

U_Q = Letter("U_Q")


@dataclass(frozen=True)
class Potentials:
    """The potentials of a problem: ``energy`` = Ũ on words in A, T, c, m, γ, K, U_Q; ``work(ξ, η)``
    of what U_Q exerts.

    ``pointwise``: what is in U_Q; ``timed``: does U depend on the time by itself? ``own``: letters
    of the potentials beside these.
    """

    energy: Expr
    steps: tuple[Step, ...]
    work: Callable[[Expr, Expr | None], Expr]
    pointwise: PointPotentials
    timed: bool
    own: tuple[PotentialLetter, ...] = ()

    def moved(
        self, a: Alphabet, xi: Expr, eta: Expr | None = None, axis: Expr | None = None
    ) -> dict[Letter, Expr]:
        """The images of the letters of Ũ under δA = Aξ, δT = Aη; ``axis``: x for ξ = j(x)."""
        g = word(a.A.position)
        images = {a.A.position: g * xi, U_Q: -self.work(xi if axis is None else axis, eta)}
        return moved(self.own, images if eta is None else images | {a.T.position: g * eta})


def potentials(problem: Problem, a: Alphabet, c: Chapter, C: Expr | None = None) -> Potentials:
    """The potentials of the problem, with the step of Ũ, and of the forces that are given point by
    point.

    ``C``: ĀA = 1, where the forces are to be said in vectors.
    """
    draft = c.draft("potential", "pull-back")
    vectors = C is not None
    modules = walked()
    having = [m for m in modules.values() if hasattr(m, "words")]
    parts: list[Words] = [w for m in having if (w := m.words(problem, a, vectors=vectors))]
    found, forces = PointPotentials(problem), applied(a, "Q", vectors=vectors)
    for p in problem.potentials:
        if hasattr(modules[p.kind], "pointwise"):
            modules[p.kind].pointwise(found, p, problem)
    energy = sum((w.energy for w in parts), number(0))
    definitions = [x for w in parts for x in w.definitions]
    over_points = [x for w in parts for x in w.over_points] + found.energies
    if found.energies:
        energy = energy + word(U_Q)
        definitions += [*found.differences, Equation("U_Q", add(*found.energies))]
    shown = [*over_points[: len(over_points) - len(found.energies)]]
    energies = [
        Equation("U", add(*shown, *([U_Q.name] if found.energies else []))),
        Equation("Ũ", draft.tree(energy)),
    ]
    prose = sum((w.prose for w in parts), _opening(over_points))
    steps = [draft.step((*definitions, *energies), prose)]
    if found.energies:
        steps.append(point_forces_step(found, forces, a, c, C))
    timed = any(map(_timed, over_points))
    own = tuple(x for w in parts for x in w.own)
    return Potentials(draft.mark(energy), tuple(steps), forces.work, found, timed, own)


def _opening(over_points: list[Tree]) -> Prose:
    if not over_points:
        return say("potential.none")
    return say("potential.pulled_back")


def _timed(t: Tree) -> bool:
    """Does t stand in a tree outside the places r_i(t)?"""
    if not isinstance(t, tuple):
        return t == "t"
    return t[0] != "call" and any(map(_timed, t[1:]))


def virtual_work(
    v: Potentials, a: Alphabet, xi: Expr, eta: Expr | None, axis: Expr | None = None
) -> Expr:
    """−dŨ(Aξ, Aη) on words; the moments of Q are paired with the axis of ξ = j(axis), if that is
    said."""
    return -derivation(v.energy, v.moved(a, xi, eta, axis).get)
