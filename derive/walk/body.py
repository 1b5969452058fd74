"""The numbers of the body: moments as parameters, given or integrated, or points; other places."""

from __future__ import annotations

from typing import Any

from ..algebra.show import show
from ..algebra.tree import Tree
from ..mechanics.problem import GivenBody, MomentBody, PointBody, Problem
from ..mechanics.solids import Solid
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
            steps.append(_integrals(body.solids, prefix, scope))
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
        low, high = problem.masses + 1, problem.masses + len(problem.places)
        which = f"Point {low} has" if low == high else f"Points {low} to {high} have"
        prose += f" {which} no mass: forces are attached there."
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


def _described(s: Solid) -> str:
    """A solid in words: kind, density, sizes, where it is."""
    sizes = [f"{k.replace('_', ' ')} {_size(x)}" for k, x in s.sizes.items() if k != "file"]
    if s.mesh is not None:
        vertices, faces = s.mesh
        sizes = [f"{len(vertices)} vertices", f"{len(faces)} triangles"]
    words = f"{s.kind.replace('_', ' ')} of density {show(s.density)} ({', '.join(sizes)})"
    moves = ["turned by a rotation"] * bool(s.rotation)
    moves += [f"shifted by {_size(s.shift)}"] if s.shift else []
    return f"{words}, {' and then '.join(moves)}" if moves else words


def _size(x: Any) -> str:
    if isinstance(x, tuple) and x and not isinstance(x[0], str):
        return "(" + ", ".join(map(_size, x)) + ")"
    return show(x)


def _integrals(solids: tuple[Solid, ...], prefix: str, scope: str) -> Step:
    return Step(
        f"{prefix}.integrals",
        "definition",
        (),
        tuple(Equation(name, ("call", "∫", form)) for name, form in INTEGRANDS.items()),
        "For a continuous body the sums over the points are integrals over its measure of mass, "
        f"dm = ρ dV; all else stays. Here: {'; '.join(map(_described, solids))}.",
        (36, 37, 38, 39),
        scope,
    )
