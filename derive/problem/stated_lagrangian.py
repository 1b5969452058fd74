"""A Lagrangian that no points give: an expression ℓ(t, g, Z), or an inertia operator on 𝔤.

In an expression t is the time, and the names of the state are what they are in emitted code: A_11
and so on are the entries of g (A1_11, … in a product), T_1, … its translation, zeta_1, … the
coordinates of Z in the basis of 𝔤; of an algebra without g, those of what it carries along.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..algebra.structure import as_text
from ..language.derivatives import derivative
from ..language.expression import names
from ..language.tree import Tree, add, mul, neg, nodes, plain
from ..schema.lagrangian_kinds import SECTIONS, Inertia, Lagrangian
from .fields import used_at
from .file_reader import FileReader
from .moved_entries import EntriesOfElement, settled, vanishes_on
from .null_directions import Direction, along, held, hessian, null_directions, vanishes
from .problem import ProblemError
from .state_names import coordinates, no_entry, undeclared


def lagrangian(data: Mapping[str, Any], group: Group, reader: FileReader) -> Lagrangian:
    """The Lagrangian of the table [lagrangian] or [inertia] of a file; ``ProblemError`` where it is
    none, or its second derivative in the velocity is singular."""
    (where, own), *others = ((x, own) for x, own in SECTIONS.items() if x in data)
    if others:
        raise ProblemError("give either [lagrangian] or [inertia]")
    for name in data.get("parameters", {}):
        if name in reader.state_names:
            raise ProblemError(
                f"parameter {name!r}: an entry of the state in [{where}]; choose another name"
            )
        if fault := no_entry(name, group, reader.state_names):
            raise ProblemError(f"parameter {name[:40]!r}: {fault}; choose another name")
    if not isinstance(data[where], dict):
        raise ProblemError(f"key {where!r} must be a table [{where}]")
    table = reader.whole(own, data[where], where)
    for name in (x for t in table.trees() for x in names(t)):
        if name not in reader.parameters:
            at = used_at(data, name)
            known = reader.state_names
            raise ProblemError(undeclared(name, at, reader.parameters, group, known))
    found = of_inertia(table, group) if isinstance(table, Inertia) else table
    if not any(t in coordinates(group) for t in nodes(found.L)):
        raise ProblemError(f"{where}: no coordinate of the velocity, as zeta_1, so no motion")
    if reader.advected is None:
        try:
            found = replace(found, L=settled(found.L, group))
        except ZeroDivisionError:
            raise ProblemError(
                f"{where}: it divides by an entry of g that is 0 on {group.name}"
            ) from None
    return _with_null_directions(found, group, reader, where)


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


def _with_null_directions(
    found: Lagrangian, group: Group, reader: FileReader, where: str
) -> Lagrangian:
    """The same with the coordinates that are held, where ∂²ℓ/∂Z² is singular in directions that
    keep ℓ; ``ProblemError`` where it is so in others, or here in some and there in others."""
    zeta = coordinates(group)
    null = null_directions(hessian(found.L, zeta))
    if null is None:
        raise ProblemError(f"{where}: ∂²L/∂Z² is singular, in directions that are not constant")
    if len(null) == len(zeta):
        raise ProblemError(
            f"{where}: L is of first order in the velocities, which the kernel of dϖ leaves free; "
            "add a kinetic energy"
        )
    for direction in null:
        name = as_text({k: x for k, x in enumerate(direction) if x})
        if not vanishes(along([derivative(found.L, x) for x in zeta], direction)):
            raise ProblemError(
                f"{where}: ∂²L/∂Z² is singular along {name}, and L is linear there, so that no "
                "equation tells this acceleration; add its kinetic energy"
            )
        if reader.advected is not None or not vanishes_on(group, varied(found, group, direction)):
            raise ProblemError(
                f"{where}: ∂²L/∂Z² is singular along {name}, and that is no symmetry of L: the "
                "equations leave this velocity open; add its kinetic energy"
            )
    return replace(found, held=tuple(k + 1 for k in held(null)))


def varied(found: Lagrangian, group: Group, direction: Direction) -> Tree:
    """The derivative of ℓ where g goes on to g exp η, η constant, and Z to exp(−η) Z exp η; on the
    right to exp η g, and exp η Z exp(−η)."""
    span, table = range(group.dimension), group.structure_constants
    moved = EntriesOfElement(group, found.trivialisation)
    turned = along([moved.along(found.L, a) for a in span], direction)
    times = 1 if found.trivialisation == "left" else -1
    zeta = coordinates(group)
    terms = [
        mul(plain(times * x * table[b][a][k]), zeta[b], derivative(found.L, zeta[k]))
        for a, x in enumerate(direction)
        for b in span
        for k in span
        if x and table[b][a][k]
    ]
    return add(turned, *terms)
