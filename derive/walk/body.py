"""The numbers of the body: moments as parameters, given or integrated, or points; other places."""

from __future__ import annotations

from ..algebra.tree import Tree
from ..mechanics.problem import GivenBody, MomentBody, PointBody, Problem
from ..record.record import Equation, Step
from .elements import column, embedded

INTEGRANDS: dict[str, Tree] = {"m": 1, "c": "r", "J": ("mul", "r", ("T", "r"))}
"""(36)–(39): the moments of a measure of mass."""


def body_step(problem: Problem, prefix: str, scope: str) -> tuple[Step, ...]:
    """One step, and for solids the integrals that it evaluates; none for no body."""
    body = problem.body
    steps: list[Step] = []
    equations: list[Equation] = []
    prose = ""
    if isinstance(body, MomentBody):
        equations += _moments(body.mass(), body.first(), body.second())
        prose = "The moments of the body are parameters: those of some positive masses."
    elif isinstance(body, GivenBody):
        if body.solids:
            steps.append(_integrals(prefix, scope))
        equations += _moments(body.mass, body.first, body.second)
        prose = "The moments of the body." if body.solids else "The moments of the body are given."
    if problem.points:
        equations = [*_points(problem, problem.points), *equations]
        prose = f"The points of the body and their masses. {prose}"
        if problem.group and problem.group.factors:
            prose += " Each is in its block of coordinates; an affine block ends in 1."
    for k, p in enumerate(problem.places, problem.masses + 1):
        if isinstance(body, PointBody):
            equations.append(Equation(("at", "m", k), 0))
        equations.append(Equation(("at", "r", k), embedded(problem, k, p.at, 1)))
    if problem.places:
        prose += " The last points have no mass: forces are attached there."
    if not equations:
        return ()
    uses = (steps[0].label,) if steps else ()
    last = Step(f"{prefix}.body", "definition", uses, tuple(equations), prose.strip(), (), scope)
    return (*steps, last)


def _points(problem: Problem, body: PointBody) -> list[Equation]:
    equations = []
    for i, (m, r) in enumerate(zip(body.masses, body.positions, strict=True), 1):
        equations += [
            Equation(("at", "m", i), m),
            Equation(("at", "r", i), embedded(problem, i, r, 1)),
        ]
    return equations


def _moments(
    mass: Tree, first: tuple[Tree, ...], second: tuple[tuple[Tree, ...], ...]
) -> list[Equation]:
    rows = tuple(("row", *row) for row in second)
    return [
        Equation("m", mass),
        Equation("c", column(first)),
        Equation("J", ("matrix", *rows)),
    ]


def _integrals(prefix: str, scope: str) -> Step:
    return Step(
        f"{prefix}.integrals",
        "definition",
        (),
        tuple(Equation(name, ("call", "∫", form)) for name, form in INTEGRANDS.items()),
        "For a continuous body the sums over the points are integrals over its measure of mass; "
        "all else stays.",
        (36, 37, 38, 39),
        scope,
    )
