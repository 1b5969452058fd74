"""The numbers of the body: moments as parameters, given or integrated, or points; other places."""

from __future__ import annotations

from typing import Any

from ..language.layers import is_layered
from ..language.show import in_sentence
from ..problem.problem import Problem
from ..record.record import Equation, Hypothesis, Step, stated
from ..record.sentence import Prose, Sentence, listed
from ..schema.body_kinds import GivenBody, MomentBody, Moments, PointBody
from ..schema.solid_kinds import Solid
from .alphabet import Alphabet
from .chapter import Chapter
from .continuum import continuum
from .lagrangian import Lagrangian
from .point_potentials import column, embedded
from .regularity import of_moments
from .wording import phrase, say, say_signed

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
    points: Lagrangian | None,
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
    if problem.places:
        low, high = problem.masses + 1, problem.masses + len(problem.places)
        prose += _massless(low, high)
    if not equations:
        return ()
    draft = c.draft("body", "definition")
    draft.depends_on(*steps[-1:])
    return (*steps, draft.step(equations, prose, hypotheses=supposed))


def _massless(low: int, high: int) -> Prose:
    if low == high:
        return say("body.place", point=str(low))
    return say(
        "body.places",
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
