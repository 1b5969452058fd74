"""The claims about where a body points at an equilibrium, and about its potential energy there."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ...algebra.groups import Group
from ...language.tree import Tree, nodes
from ...language.univariate import value_of
from ...record.record import Step
from ...record.sentence import Claim
from .integral_claims import Judge
from .reduced_system import ReducedSystem
from .spectra_and_residues import about, expansion, gradient
from .trim_claims import the_one

LARGEST = 2**30
"""Numbers are drawn up to this: of small ones some are where the energy has a pole."""


def _point(step: Step) -> dict[Tree, Tree]:
    """The coordinates that a step tells, in numbers or in letters."""
    rows = the_one(step, ("equilibrium.at", "family.at"))["point"]
    assert isinstance(rows, tuple)
    return {x: y for _, x, y in rows[1:]}


def _rotates(group: Group) -> bool:
    """Are the linear parts of a group, which is none of a product, rotations?"""
    parts = [*map(group.linear_part, group.basis)]
    span = range(group.n)
    skew = all(a[i][j] == -a[j][i] for a in parts for i in span for j in span)
    return skew and len(group.places) == 1


def _axis(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """The entry of a rotation A is 1, or −1: A e_j = e_i, or −e_i."""
    if not _rotates(system.group):
        return "the group does not rotate one body"
    i, j = claim["space"], claim["body"]
    there = value_of(_point(step).get(("entry", "A", i, j), 0))
    sign = 1 if claim.kind == "position.along" else -1
    within = {i, j} <= {*range(1, system.group.n + 1)}
    return "" if within and there == sign else "the axis points elsewhere"


def _energy(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """U = ⟨u, row of A⟩, a unit vector, which is along −u where U is the least, u where it is the
    greatest; for letters that are positive, and each of them negative in turn."""
    point, span, random = _point(step), range(1, system.group.n + 1), system.random
    entries = [x for x in system.variables if isinstance(x, tuple) and x[1] != "Π"]
    row = [("entry", "A", x[2], j) for x in entries[:1] for j in span]
    if not _rotates(system.group) or {*entries} != {*row}:
        return "the potential energy is of no row of A alone"
    there = [value_of(point.get(x, 0)) for x in row]
    letters = [*system.parameters, *(x for y in point.values() for x in nodes(y))]
    letters = [x for x in letters if isinstance(x, tuple) and x[0] == "par"]
    for negative in (None, *letters) * 2:
        several = {x: Fraction(random.randint(1, LARGEST), 7) for x in ("π", *letters)}
        numbers = system.with_numbers({x: -y if x == negative else y for x, y in several.items()})
        u, elsewhere = (_slopes(numbers, row) for _ in span[:2])
        if u != elsewhere:
            return "the potential energy is not linear"
        along = sum(x * y for x, y in zip(u, there, strict=True))
        down = along < 0 if claim.kind == "position.lowest" else along > 0
        if not down or along * along != sum(x * x for x in u):
            return "the potential energy is less, or greater, elsewhere"
    return ""


def _slopes(system: ReducedSystem, row: Sequence[Tree]) -> list[Any]:
    """The derivatives of the energy by entries of A, at a random point."""
    values = [Fraction(system.random.randint(1, LARGEST)) for _ in system.variables]
    found = gradient(expansion(system.energy, about(system.variables, values)), len(values))
    return [found[system.variables.index(x)] for x in row]


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(("position.along", "position.against"), _axis),
    **dict.fromkeys(("position.lowest", "position.highest"), _energy),
}
"""How claims about the position of a body are judged, of equations that are Hamiltonian."""
