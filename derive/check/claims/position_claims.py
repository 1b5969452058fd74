"""The claims about where a body points at an equilibrium, and about its potential energy there."""

from __future__ import annotations

from fractions import Fraction

from ...algebra.groups import Group
from ...language.tree import Tree, nodes
from ...language.univariate import value_of
from ...record.record import RecordError, Step
from ...record.sentence import Claim
from .integral_claims import Judge
from .reduced_system import ReducedSystem
from .spectra_and_residues import about, expansion, gradient

DRAWS = 2
"""How many numbers the letters have, all positive, and each of them negative in turn."""


def _point(step: Step) -> dict[Tree, Tree]:
    """The coordinates that a step tells, in numbers or in letters."""
    told = [x for x in step.claims if x.kind in ("equilibrium.at", "family.at")]
    if len(told) != 1:
        raise RecordError("no one point is told")
    rows = told[0]["point"]
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
    greatest."""
    point, n = _point(step), system.group.n
    row = [x for x in system.variables if isinstance(x, tuple) and x[1] != "Π"]
    names = [("entry", "A", x[2], j) for x in row[:1] for j in range(1, n + 1)]
    if not _rotates(system.group) or {*row} != {*names}:
        return "the potential energy is of no row of A alone"
    letters = [*system.parameters, *(x for y in point.values() for x in nodes(y))]
    letters = [x for x in letters if isinstance(x, tuple) and x[0] == "par"]
    sign, random = (1 if claim.kind == "position.lowest" else -1), system.random

    def drawn() -> Fraction:
        return Fraction(random.randint(1, 40), random.randint(1, 12))

    for negative in (None, *letters) * DRAWS:
        signed = {x: -drawn() if x == negative else drawn() for x in ("π", *letters)}
        numbers = system.with_numbers(signed)
        several = [[drawn() for _ in system.variables] for _ in range(2)]
        slopes = [
            dict(zip(system.variables, gradient(expansion(numbers.energy, x), len(x)), strict=True))
            for x in (about(system.variables, values) for values in several)
        ]
        u, other = ([x[y] for y in names] for x in slopes)
        there = [value_of(point.get(y, 0)) for y in names]
        if u != other:
            return "the potential energy is not linear"
        along = sum(x * y for x, y in zip(u, there, strict=True))
        if along * sign >= 0 or along * along != sum(x * x for x in u):
            return "the potential energy is less, or greater, elsewhere"
    return ""


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(("position.along", "position.against"), _axis),
    **dict.fromkeys(("position.lowest", "position.highest"), _energy),
}
"""How claims about the position of a body are judged, of equations that are Hamiltonian."""
