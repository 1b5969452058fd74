"""The body of a problem: its moments as parameters, given or integrated, or its points; and the
potentials on it: on words, or point by point, and their forces.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ...algebra.calculus import derivation, gradient, reduce, substitute, without
from ...algebra.word_trees import WordNotation, hat, metrics, tree_of
from ...algebra.words import Expr, Letter, inner, number, word, zero
from ...language.laurent import is_layered
from ...language.read import read
from ...language.show import in_sentence
from ...language.tree import Tree, add, coefficient, mul, neg, replaced
from ...problem.problem import Problem
from ...record.record import Equation, Hypothesis, Step, stated
from ...record.sentence import Prose, Sentence, listed
from ...schema.body_kinds import GivenBody, MomentBody, Moments, PointBody, Solid
from ...schema.potential_kinds import kinds
from ..chapter import Chapter, Draft, phrase, say, say_signed
from ..matrices.isomorphism import OMEGA_P, anticommute
from ..spine.alphabet import Alphabet
from ..spine.cartan import body_rule
from ..spine.lagrangian import PointLagrangian, of_moments
from .potential_terms import (
    POINTWISE,
    PointPotentials,
    PotentialLetter,
    Radial,
    Words,
    column,
    displaced_letters,
    embedded,
)
from .potential_words import WORDS

# The numbers of the body: moments as parameters, given or integrated, or points; other places.

SIZES = ("radius", "outer", "inner", "sides", "semi_axes", "quadric", "height", "vertices")
"""The sizes of a solid that are told in words."""


def body_step(
    problem: Problem, points: PointLagrangian | None, a: Alphabet, c: Chapter
) -> tuple[Step, ...]:
    """The step that states the numbers of the body, after that of its integrals for solids; none
    where there is no body.

    ``points``: what is said of the points of any body, with the alphabet ``a``; ``None``: of these
    integrals the moments alone are told.
    """
    body = problem.body
    steps: list[Step] = []
    equations: list[Equation] = []
    prose: Prose = ()
    supposed: tuple[Hypothesis, ...] = ()
    if isinstance(body, MomentBody):
        equations += _moments(body.moments())
        prose = say_signed("body.symbolic", problem.signed)
        supposed = of_moments(problem.signed)
    elif isinstance(body, GivenBody):
        if body.solids:
            steps += [continuum(points, a, c)] if points else []
            steps.append(_integrals(body.solids, c))
        equations += _moments(body.given)
        given = say("body.given")
        prose = say("body.moments") if body.solids else given
    if problem.points:
        equations = [*_points(problem), *equations]
        prose = say("body.points") + prose
        if problem.group and problem.group.factors:
            prose += say("body.homogeneous" if problem.homogeneous else "body.blocks")
    for k, p in enumerate(problem.places, problem.masses + 1):
        if isinstance(body, PointBody):
            equations.append(Equation(("at", "m", k), 0))
        equations.append(Equation(("at", "r", k), embedded(problem, k, p.at, 1)))
    prose += say("body.flow") if problem.flows else ()
    if problem.places:
        low, high = problem.masses + 1, problem.masses + len(problem.places)
        prose += _massless(low, high, "_read" if problem.outputs else "")
    if not equations:
        return ()
    draft = c.draft("body", "definition", *steps[-1:])
    return (*steps, draft.step(equations, prose, hypotheses=supposed))


def _massless(low: int, high: int, read: str) -> Prose:
    if low == high:
        return say(f"body.place{read}", point=str(low))
    return say(f"body.places{read}", low=str(low), high=str(high))


def _points(problem: Problem) -> list[Equation]:
    equations = []
    for i, p in enumerate(problem.points, 1):
        equations += [
            Equation(("at", "m", i), p.mass),
            Equation(("at", "r", i), embedded(problem, i, p.at, 1)),
        ]
    return equations


def _moments(own: Moments) -> list[Equation]:
    rows = tuple(("row", *row) for row in own.J)
    return [
        Equation("m", own.m),
        Equation("c", column(own.c)),
        Equation("J", ("matrix", *rows)),
    ]


def _described(s: Solid) -> Sentence:
    """A solid in words: kind, density, sizes, where it is."""
    if s.kind == "mesh":
        sizes = [
            phrase("integrals.count_of_vertices", count=str(len(s.sizes["vertices"]))),
            phrase("integrals.count_of_triangles", count=str(len(s.sizes["faces"]))),
        ]
    else:
        told = {k: _rows(x) if k == "quadric" else _size(x) for k, x in s.sizes.items()}
        sizes = [phrase(f"integrals.{k}", size=x) for k, x in told.items() if k in SIZES]
    solid = phrase(
        "integrals.layered" if is_layered(s.density) else "integrals.solid",
        kind=phrase(f"integrals.{s.kind}"),
        density=_size(s.density),
        sizes=listed("{first}, {second}", sizes),
    )
    if s.rotation and s.shift:
        moved = "integrals.turned_and_shifted"
        return phrase(moved, solid=solid, shift=_size(s.shift))
    if s.shift:
        return phrase("integrals.shifted", solid=solid, shift=_size(s.shift))
    return phrase("integrals.turned", solid=solid) if s.rotation else solid


def _rows(x: Any) -> str:
    return "; ".join(", ".join(_size(y) for y in row) for row in x)


def _size(x: Any) -> str:
    if isinstance(x, tuple) and x and not isinstance(x[0], str):
        return "(" + ", ".join(_size(y) for y in x) + ")"
    return in_sentence(x)


def _integrals(solids: tuple[Solid, ...], c: Chapter) -> Step:
    told = [*map(_described, solids)]
    return c.draft("integrals", "definition").step(
        stated("m = ∫ dm,  c = ∫ r dm,  J = ∫ rr̄ dm"),
        say("integrals.moments")
        + say("integrals.solids", solids=listed("{first}; {second}", told)),
        (39,),
    )


# A continuous body: L, ϖ and the group's action as integrals over it (36)–(38), and its moments.
#
# What was said of a point of mass m_i is said of one of mass dm: r, its place in the body, and v,
# its velocity in space, are functions on the body.


def continuum(points: PointLagrangian, a: Alphabet, c: Chapter) -> Step:
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


# The potentials of a problem on words: Ũ pulled back, and its force.
#
# A kind that has words (``WORDS``) is pulled back like L itself: gravity, springs of natural
# length 0, torsion, a far centre. The others enter as U_Q, with the forces Q_i on the points.

U_Q = Letter("U_Q")


@dataclass(frozen=True)
class Potentials:
    """The potentials of a problem: ``energy`` = Ũ on words in A, T, c, m, γ, K, U_Q; ``work(ξ, η)``
    of what U_Q exerts.

    ``pointwise``: what is in U_Q; ``own``: letters of the potentials beside these.
    """

    energy: Expr
    steps: tuple[Step, ...]
    work: Callable[[Expr, Expr | None], Expr]
    pointwise: PointPotentials
    own: tuple[PotentialLetter, ...] = ()

    def displaced(
        self, a: Alphabet, xi: Expr, eta: Expr | None = None, axis: Expr | None = None
    ) -> dict[Letter, Expr]:
        """The images of the letters of Ũ under δA = Aξ, δT = Aη; ``axis``: x for ξ = j(x)."""
        g = word(a.A.position)
        images = {a.A.position: g * xi, U_Q: -self.work(xi if axis is None else axis, eta)}
        return displaced_letters(
            self.own, images if eta is None else images | {a.T.position: g * eta}
        )


def potentials(problem: Problem, a: Alphabet, c: Chapter, C: Expr | None = None) -> Potentials:
    """The potentials of the problem, with the step of Ũ, and of the forces that are given point by
    point.

    ``C``: ĀA = 1, where the forces are to be said in vectors.
    """
    draft = c.draft("potential", "pull-back")
    vectors = C is not None
    having = [WORDS[kind] for kind in kinds().values() if kind in WORDS]
    parts: list[Words] = [w for words in having if (w := words(problem, a, vectors))]
    found, forces = PointPotentials(problem), applied(a, "Q", vectors=vectors)
    for p in problem.potentials:
        if type(p) in POINTWISE:
            POINTWISE[type(p)](found, p, problem)
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
    prose = sum(
        (w.prose for w in parts), say("potential.pulled_back" if over_points else "potential.none")
    )
    steps = [draft.step((*definitions, *energies), prose)]
    if found.energies:
        steps.append(point_forces_step(found, forces, a, c, C))
    own = tuple(x for w in parts for x in w.own)
    return Potentials(draft.mark(energy), tuple(steps), forces.work, found, own)


def virtual_work(
    v: Potentials, a: Alphabet, xi: Expr, eta: Expr | None, axis: Expr | None = None
) -> Expr:
    """−dŨ(Aξ, Aη) on words; the moments of Q are paired with the axis of ξ = j(axis), if that is
    said."""
    return -derivation(v.energy, v.displaced(a, xi, eta, axis).get)


# The forces of the potentials that are given point by point, and their sums over the points.


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
    group = problem.own_group
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
        equations.append(Equation(chi, _distance_in_body(d, x, a, C)))
        equations.append(Equation(x.sigma, replaced(x.tension, x.d, chi)))
        for i, sign in x.signs.items():
            terms.setdefault(i, []).append(mul(sign, x.sigma, chi))
    for i, forces_on_point in found.forces.items():
        terms.setdefault(i, []).extend(mul(("T", "A"), f) for f in forces_on_point)
    return equations + [Equation(("at", "P", i), add(*x)) for i, x in sorted(terms.items())]


def _distance_in_body(d: Draft, x: Radial, a: Alphabet, C: Expr) -> Tree:
    """The tree of Ād_e: the places in the body, by ĀA = 1, and Ā on what is in space."""
    g, total = word(a.A.position), zero(a.n, 1)
    display: dict[Letter, Tree] = {}
    for i, sign in x.signs.items():
        r = Letter(f"r_{i}", a.n)
        display[r] = ("at", "r", i)
        place = substitute(a.acted_on(g, word(a.T.position)), {a.r_i: word(r)})
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
