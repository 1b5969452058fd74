"""A Lagrangian that no points give: an expression ℓ(t, g, Z), or an inertia operator on 𝔤.

In an expression t is the time, and the names of the state are what they are in emitted code: A_11
and so on are the entries of g (A1_11, … in a product), T_1, … its translation, zeta_1, … the
coordinates of Z in the basis of 𝔤.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..language.derivatives import derivative
from ..language.divisors import PRIMES, residue
from ..language.tree import Tree, add, mul, neg, nodes
from ..schema.lagrangian_kinds import SECTIONS, Inertia, Lagrangian
from .file_reader import FileReader
from .problem import ProblemError
from .state_names import coordinates, state_names


def lagrangian(data: Mapping[str, Any], group: Group, reader: FileReader) -> Lagrangian:
    """The Lagrangian of the table [lagrangian] or [inertia] of a file; ``ProblemError`` where it is
    none, or its second derivative in the velocity is singular."""
    (where, own), *others = ((x, own) for x, own in SECTIONS.items() if x in data)
    if others:
        raise ProblemError("give either [lagrangian] or [inertia]")
    for name in data.get("parameters", {}):
        if name in state_names(group):
            raise ProblemError(
                f"parameter {name!r}: an entry of the state in [{where}]; choose another name"
            )
    if not isinstance(data[where], dict):
        raise ProblemError(f"key {where!r} must be a table [{where}]")
    table = reader.whole(own, data[where], where)
    found = of_inertia(table, group) if isinstance(table, Inertia) else table
    if not any(t in coordinates(group) for t in nodes(found.L)):
        raise ProblemError(f"{where}: no coordinate of the velocity, as zeta_1, so no motion")
    _require_regular(found.L, group, where)
    return found


def of_inertia(given: Inertia, group: Group) -> Lagrangian:
    """½⟨ζ, 𝕀ζ⟩ + ⟨a, ζ⟩ − U as an expression; ``ProblemError`` where 𝕀 is not symmetric."""
    zeta, rows, span = coordinates(group), given.operator, range(group.dimension)
    if any(rows[a][b] != rows[b][a] for a in span for b in range(a)):
        raise ProblemError("inertia, operator: the matrix must be symmetric")
    terms = [
        mul(Fraction(1, 2) if a == b else 1, rows[a][b], zeta[a], zeta[b])
        for a in span
        for b in span[a:]
    ]
    terms += [mul(x, z) for x, z in zip(given.momentum, zeta, strict=False)]
    return Lagrangian(L=add(*terms, neg(given.U)), trivialisation=given.trivialisation)


# -- ∂²ℓ/∂Z² -------------------------------------------------------------------------------------


def hessian(tree: Tree, zeta: Sequence[Tree]) -> list[list[Tree]]:
    """The second derivatives ∂²ℓ/∂ζ_a∂ζ_b, d × d."""
    slopes = [derivative(tree, x) for x in zeta]
    return [[derivative(slope, y) for y in zeta] for slope in slopes]


def _require_regular(tree: Tree, group: Group, where: str) -> None:
    """``ProblemError`` where ∂²ℓ/∂Z² is singular whatever the parameters: no velocity is found."""
    second = hessian(tree, coordinates(group))
    if all(_determinant(second, p) == 0 for p in PRIMES):
        still = [a for a, row in enumerate(second, 1) if not any(row)]
        left = f"zeta_{still[0]}" if still else "the velocity, in some direction,"
        raise ProblemError(
            f"{where}: ∂²L/∂Z² is singular: the equations leave {left} open; add its kinetic energy"
        )


def _determinant(rows: Sequence[Sequence[Tree]], p: int) -> int:
    """The determinant of a matrix of expressions modulo p, names by a hash."""
    left = [[residue(x, p) for x in row] for row in rows]
    found = 1
    for k in range(len(left)):
        pivot = next((i for i in range(k, len(left)) if left[i][k]), None)
        if pivot is None:
            return 0
        left[k], left[pivot] = left[pivot], left[k]
        found = found * left[k][k] % p
        scale = pow(left[k][k], -1, p)
        for i in range(k + 1, len(left)):
            factor = left[i][k] * scale
            left[i] = [(x - factor * y) % p for x, y in zip(left[i], left[k], strict=True)]
    return found
