"""The forces of the potentials that are given point by point, and their sums over the points."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.calculus import gradient, reduce, substitute, without
from ..algebra.space import hat
from ..algebra.word_trees import WordNotation, metrics, tree_of
from ..algebra.words import Expr, Letter, inner, word, zero
from ..language.tree import Tree, add, mul, replaced
from ..problem.problem import Problem
from ..record.record import Equation, Step
from ..record.sentence import Prose
from .alphabet import Alphabet
from .chapter import Chapter, Draft
from .hat import OMEGA_P, anticommute
from .point_potentials import PointPotentials, Radial, column, embedded
from .trivialisation import body_rule
from .wording import say


@dataclass(frozen=True)
class Applied:
    """The letters of the sums over the points of some forces: N and F, or the vectors μ and F."""

    moments: Letter
    resultant: Letter

    def work(self, xi: Expr, eta: Expr | None) -> Expr:
        """The virtual work of the forces, ⟨N, ξ⟩ + ⟨F, η⟩."""
        pairing = inner(word(self.moments), xi)
        return pairing if eta is None else pairing + inner(word(self.resultant), eta)


def applied(a: Alphabet, mark: str, *, vectors: bool) -> Applied:
    """N and F, or μ and F in vectors, with a mark behind: N_Q, μ_Q, F_Q."""
    moments = Letter(f"μ_{mark}", 3) if vectors else Letter(f"N_{mark}", a.n, a.n)
    return Applied(moments, Letter(f"F_{mark}", a.n))


def point_forces_step(
    found: PointPotentials, forces: Applied, a: Alphabet, c: Chapter, C: Expr | None
) -> Step:
    """The step of the tensions, the forces and their sums: in the body where ĀA = 1 is at hand
    (``C``), else in space."""
    draft = c.draft("pushes", "variation")
    equations = _in_space(found) if C is None else _in_body(draft, found, a, C)
    prose = _prose(vectors=C is not None, radials=bool(found.radials))
    sums = _sums_over_points(draft, a, forces, C)
    return draft.step((*equations, *sums), prose)


def _prose(*, vectors: bool, radials: bool) -> Prose:
    prose = say("pushes.body" if vectors else "pushes.space")
    if radials and vectors:
        prose += say("pushes.element_and_length")
    elif radials:
        prose += say("pushes.element")
    return prose


def _in_space(found: PointPotentials) -> list[Equation]:
    """The equations σ_e = … and Q_i = Σ ± σ_e d_e − ∂U/∂r_i(t)."""
    equations = [Equation(x.sigma, x.tension) for x in found.radials]
    terms: dict[int, list[Tree]] = {}
    for x in found.radials:
        for i, sign in x.signs.items():
            terms.setdefault(i, []).append(_placed(found.problem, i, x.sigma, x.d, sign))
    for i, forces_on_point in found.forces.items():
        terms.setdefault(i, []).extend(forces_on_point)
    return equations + [Equation(("at", "Q", i), add(*x)) for i, x in sorted(terms.items())]


def _placed(problem: Problem, i: int, sigma: Tree, d: Tree, sign: int) -> Tree:
    """The tree ± σ d of a force on point i, in its block of a product."""
    group = problem.group
    assert group is not None
    if not group.factors:
        return mul(sign, sigma, d)
    _, factor = group.places[problem.block(i) - 1]
    entries = tuple(mul(sign, sigma, ("entry", d, k)) for k in range(1, factor.n + 1))
    return embedded(problem, i, entries, 0)


def _in_body(d: Draft, found: PointPotentials, a: Alphabet, C: Expr) -> list[Equation]:
    """The equations χ_e = Ād_e, σ_e = … and P_i = Σ ± σ_e χ_e − Ā ∂U/∂r_i(t)."""
    equations = []
    terms: dict[int, list[Tree]] = {}
    for x in found.radials:
        chi: Tree = ("at", "χ", x.d[2])  # type: ignore[index]
        equations.append(Equation(chi, _carried(d, x, a, C)))
        equations.append(Equation(x.sigma, replaced(x.tension, x.d, chi)))
        for i, sign in x.signs.items():
            terms.setdefault(i, []).append(mul(sign, x.sigma, chi))
    for i, forces_on_point in found.forces.items():
        terms.setdefault(i, []).extend(mul(("T", "A"), f) for f in forces_on_point)
    return equations + [Equation(("at", "P", i), add(*x)) for i, x in sorted(terms.items())]


def _carried(d: Draft, x: Radial, a: Alphabet, C: Expr) -> Tree:
    """The tree of Ād_e: the places in the body, by ĀA = 1, and Ā on what is in space."""
    g, total = word(a.A.position), zero(a.n, 1)
    display: dict[Letter, Tree] = {}
    for i, sign in x.signs.items():
        r = Letter(f"r_{i}", a.n)
        display[r] = ("at", "r", i)
        place = substitute(a.moved(g, word(a.T.position)), {a.r_i: word(r)})
        total = total + sign * place
    inside = without(total, a.T.position)
    outside = total - inside
    if x.anchor:
        anchor = Letter("a", a.n)
        display[anchor] = column(x.anchor)
        outside = outside - word(anchor)
    notation = WordNotation(display=display)
    body = d.tree(reduce(g.bar * inside, body_rule(a, C)), notation)
    return add(body, mul(("T", "A"), tree_of(outside, notation)) if outside else 0)


def _sums_over_points(d: Draft, a: Alphabet, forces: Applied, C: Expr | None) -> list[Equation]:
    """The equations N_Q = Σ ĀQ_i r̄_i and F_Q = Σ ĀQ_i, or μ_Q = Σ r_i ∧ P_i and F_Q = Σ P_i with
    AP_i = Q_i."""
    vectors = C is not None
    family, xi = "P" if vectors else "Q", Letter("ξ′", a.n, a.n)
    point_force = Letter(f"{family}_i", a.n)
    eta = Letter("η′", a.n)
    g = word(a.A.position)
    force = g.bar * word(point_force)
    if C is not None:
        force = reduce(g.bar * g * word(point_force), body_rule(a, C))
    turned = word(hat(OMEGA_P)) if vectors else word(xi)
    work = inner(force, turned * word(a.r_i))
    if vectors:
        work = reduce(work, anticommute(OMEGA_P))
    moment = gradient(work, OMEGA_P if vectors else xi)
    display = metrics(display={point_force: ("at", family, "i"), a.r_i: ("at", "r", "i")})
    equations = [Equation(forces.moments.name, ("sum", "i", d.tree(moment, display)))]
    if a.affine:
        pull = gradient(inner(force, word(eta)), eta)
        equations.append(Equation(forces.resultant.name, ("sum", "i", d.tree(pull, display))))
    return equations
