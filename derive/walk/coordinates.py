"""Coordinates ζ on 𝔤: Z = Σ ζ_a E_a, in the basis of the group or in one that the problem
states."""

from __future__ import annotations

from ..algebra.groups import Group
from ..language.tree import Tree, add, mul
from ..record.record import Equation, Step, stated
from .alphabet import Alphabet
from .chapter import Chapter
from .wording import say


def coordinates_step(group: Group, b: Alphabet, c: Chapter, *, with_rates: bool) -> Step:
    """The step Z = Σ ζ_a E_a, also entry by entry; ``with_rates``: and how ζ̇ is read off Ż."""
    span = range(len(group.linear_basis))
    rows = tuple(
        ("row", *(add(*_terms(group, i, j)) for j in range(group.n))) for i in range(group.n)
    )
    equations = [*stated("Z = Σ_a ζ_a E_a"), Equation("Z", ("matrix", *rows))]
    if with_rates:
        equations += [Equation(("entry", "ζ̇", a + 1), _rate(group, a)) for a in span]
    prose = say("coordinates.basis")
    if b.affine:
        prose = say("coordinates.linear_parts")
    return c.draft("coordinates", "coordinates").step(equations, prose)


def basis_equations(group: Group) -> list[Equation]:
    """Z = Σ ζ_a E_a, and entry by entry."""
    span = range(group.n)
    rows = (("row", *(add(*_terms(group, i, j)) for j in span)) for i in span)
    return [*stated("Z = Σ_a ζ_a E_a"), Equation("Z", ("matrix", *rows))]


def _terms(group: Group, i: int, j: int) -> list[Tree]:
    found = []
    for a, e in enumerate(group.linear_basis, 1):
        x = e[i][j]
        if x:
            found.append(mul(x, ("entry", "ζ", a)))
    return found


def _rate(group: Group, a: int) -> Tree:
    terms: list[Tree] = []
    for x, i, j in group.coordinate_terms(a):
        entry: Tree = ("entry", "Ż", i + 1, j + 1)
        terms.append(mul(x, entry))
    return add(*terms)


def stated_basis_step(group: Group, b: Alphabet, c: Chapter) -> tuple[Step, ...]:
    """The step that gives Z (and w) by coordinates in the basis that the problem states, where the
    equations are in that of j; none where there is one basis."""
    if not group.stated_basis:
        return ()
    span, size = range(group.n), group.dimension
    own = group.stated.basis

    def entry(i: int, j: int) -> Tree:
        terms = ((own[a][i][j], ("entry", "z", a + 1)) for a in range(size) if own[a][i][j])
        return add(*(mul(x, z) for x, z in terms))

    turned = ("matrix", *(("row", *(entry(i, j) for j in span)) for i in span))
    equations: list[Equation] = [Equation("Z", turned)]
    if b.affine:
        equations.append(Equation("w", ("matrix", *(("row", entry(i, group.n)) for i in span))))
    return (
        c.draft("coordinates", "coordinates").step(
            equations,
            say("coordinates.stated"),
        ),
    )
