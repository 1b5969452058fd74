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
from .equilibrium_claims import coordinates
from .integral_claims import Judge
from .reduced_system import ClaimedRecord, ReducedSystem
from .reduced_system import Judge as JudgeOfRecord
from .spectra_and_residues import about, expansion, gradient
from .trim_claims import POINTS, placed, the_one

LARGEST = 2**30
"""Numbers are drawn up to this: of small ones some are where the energy has a pole."""
SQUARE = Fraction(1, 10**8)
"""The square of the angle, in rad², that a direction in decimals may have to the one it is near."""


def _point(step: Step) -> dict[Tree, Tree]:
    """The coordinates that a step tells, in numbers or in letters."""
    rows = the_one(step, ("equilibrium.at", "equilibrium.near", "family.at"))["point"]
    assert isinstance(rows, tuple)
    return {x: y for _, x, y in rows[1:]}


def _turned(group: Group) -> list[range]:
    """The rows, from 1, of each factor of a group, or of the group, whose linear parts are
    rotations; none of another factor."""
    return [
        range(offset + 1, offset + factor.n + 1) if _rotates(factor) else range(0)
        for offset, factor in group.places
    ]


def _rotates(group: Group) -> bool:
    """Are the linear parts of a group that is no product rotations?"""
    parts, span = [*map(group.linear_part, group.basis)], range(group.n)
    return all(a[i][j] == -a[j][i] for a in parts for i in span for j in span)


def _axis(c: ClaimedRecord, step: Step, claim: Claim) -> str:
    """The entry of a rotation A is 1, or −1: A e_j = e_i, or −e_i; and of a trim AZe_j = 0."""
    bodies, values = _turned(c.group), dict(claim.values)
    body, *axes = values.get("body", 1), values["space"], values["axis"]
    if ("body" in values) is not (len(bodies) > 1) or not isinstance(body, int):
        return "of which body that is is not said"
    rows = bodies[body - 1] if body in range(1, len(bodies) + 1) else range(0)
    i, j = (rows.start - 1 + x if isinstance(x, int) else 0 for x in axes)
    if i not in rows or j not in rows:
        return "the group rotates no such axis"
    sign = 1 if claim.kind.startswith("position.along") else -1
    if any(x.kind in POINTS for x in step.claims):
        _, g, zeta, _ = placed(c.group, coordinates(the_one(step, POINTS)))
        Z = c.group.in_user_basis.hat(zeta)
        if any(Z[k - 1][j - 1] for k in rows):
            return "the axis moves"
        there = g[i - 1][j - 1]
    else:
        there = value_of(_point(step).get(("entry", "A", i, j), 0))
    return "" if there == sign else "the axis points elsewhere"


def _energy(system: ReducedSystem, step: Step, claim: Claim) -> str:
    """U = Σ ⟨u, row of A⟩, a unit vector of each body, which is along −u where U is the least, u
    where it is the greatest; for letters that are positive, and each of them negative in turn."""
    point, random = _point(step), system.random
    entries = {x for x in system.variables if isinstance(x, tuple) and x[1] != "Π"}
    rows: list[list[Tree]] = []
    for own in _turned(system.group):
        of_one: list[list[Tree]] = [[("entry", "A", i, j) for j in own] for i in own]
        rows += [row for row in of_one if entries & {*row}][:1]
    if not rows or entries != {x for row in rows for x in row}:
        return "the potential energy is of no one row of A of each body alone"
    letters = [*system.parameters, *(x for y in point.values() for x in nodes(y))]
    letters = [x for x in letters if isinstance(x, tuple) and x[0] == "par"]
    lowest = claim.kind.startswith("position.lowest")
    apart = SQUARE if claim.kind.endswith("_near") else 0
    if bool(apart) is not any(x.kind == "equilibrium.near" for x in step.claims):
        return "decimals are near a position, and no others"
    for negative in (None, *letters) * 2:
        several = {x: Fraction(random.randint(1, LARGEST), 7) for x in ("π", *letters)}
        numbers = system.with_numbers({x: -y if x == negative else y for x, y in several.items()})
        for row in rows:
            u, elsewhere = (_slopes(numbers, row) for _ in row[:2])
            if u != elsewhere:
                return "the potential energy is not linear"
            there = [value_of(point.get(x, 0)) for x in row]
            along = sum(x * y for x, y in zip(u, there, strict=True))
            both = sum(x * x for x in u) * sum(x * x for x in there)
            level = not along  # where the energy is of no entry, all positions are alike
            if level or (along < 0) is not lowest or both > (1 + apart) * along * along:
                return "the potential energy is less, or greater, elsewhere"
    return ""


def _slopes(system: ReducedSystem, row: Sequence[Tree]) -> list[Any]:
    """The derivatives of the energy by entries of A, at a random point."""
    values = [Fraction(system.random.randint(1, LARGEST)) for _ in system.variables]
    found = gradient(expansion(system.energy, about(system.variables, values)), len(values))
    return [found[system.variables.index(x)] for x in row]


AXES: dict[str, JudgeOfRecord] = dict.fromkeys(
    (f"position.{x}{y}" for x in ("along", "against") for y in ("", "_of")), _axis
)
"""How claims about the axes of bodies are judged, of equilibria and of trims."""
JUDGES: dict[str, Judge] = dict.fromkeys(
    (f"position.{x}{y}" for x in ("lowest", "highest") for y in ("", "_near")), _energy
)
"""How claims about the potential energy are judged, of equations that are Hamiltonian."""
