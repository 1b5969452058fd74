"""The body of a problem: its moments as parameters, given or integrated, or its points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...algebra.calculus import derivation, substitute
from ...algebra.word_trees import WordNotation
from ...algebra.words import Expr, Letter, number, word
from ...language.laurent import is_layered
from ...language.read import read
from ...language.show import in_sentence
from ...language.tree import Tree, add, coefficient, mul, neg
from ...problem.problem import Problem
from ...record.record import Equation, Hypothesis, Step, stated
from ...record.sentence import Prose, Sentence, listed
from ...schema.body_kinds import GivenBody, MomentBody, Moments, PointBody, Solid
from ..chapter import Chapter, Draft, phrase, say, say_signed
from ..spine.alphabet import Alphabet
from ..spine.lagrangian import PointLagrangian, of_moments
from .potential_terms import column, embedded

# The numbers of the body: moments as parameters, given or integrated, or points; other places.

SOLIDS = {
    "ball": phrase("integrals.ball"),
    "box": phrase("integrals.box"),
    "ellipsoid": phrase("integrals.ellipsoid"),
    "cylinder": phrase("integrals.cylinder"),
    "cone": phrase("integrals.cone"),
    "hollow_ball": phrase("integrals.hollow_ball"),
    "tetrahedron": phrase("integrals.tetrahedron"),
    "mesh": phrase("integrals.mesh"),
}
"""The name of each kind of solid."""
SIZES = ("radius", "outer", "inner", "sides", "semi_axes", "quadric", "height", "vertices")
"""The sizes of a solid that are told in words."""


def body_step(
    problem: Problem,
    points: PointLagrangian | None,
    a: Alphabet,
    c: Chapter,
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
    draft = c.draft("body", "definition")
    draft.depends_on(*steps[-1:])
    return (*steps, draft.step(equations, prose, hypotheses=supposed))


def _massless(low: int, high: int, read: str) -> Prose:
    if low == high:
        return say(f"body.place{read}", point=str(low))
    return say(
        f"body.places{read}",
        low=str(low),
        high=str(high),
    )


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
        kind=SOLIDS[s.kind],
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
