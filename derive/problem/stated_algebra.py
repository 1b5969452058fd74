"""The algebra of a problem file that moves no points: its brackets, and what it carries along."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..algebra.carried import carrying
from ..algebra.families import group, on_homogeneous
from ..algebra.groups import Group
from ..algebra.stated_basis import group_of_basis
from ..algebra.structure import (
    Algebra,
    Brackets,
    brackets_of,
    faithful,
    require_jacobi,
    require_representation,
)
from ..language.limits import CARRIED, TABLE
from ..language.rational import Matrix
from ..schema.algebra_kinds import Advected, StatedAdvected, StatedAlgebra
from .algebra_reader import AlgebraReader
from .problem import ProblemError

GIVEN = ("of", "basis", "brackets")
"""The keys of [algebra], of which one says it."""


def carried_group(data: Mapping[str, Any]) -> tuple[Group, tuple[Advected, ...]]:
    """The group of [algebra], and what [[advected]] tables say it carries along."""
    reader = AlgebraReader()
    if "group" in data or "action" in data:
        raise ProblemError("give either 'group' or [algebra]")
    own = _algebra(reader.whole(StatedAlgebra, data["algebra"], "algebra"), data["algebra"])
    reader.represents(own)
    listed = data.get("advected", [])
    if not isinstance(listed, list) or not all(isinstance(x, dict) for x in listed):
        raise ProblemError("key 'advected' must be tables [[advected]]")
    read = [reader.whole(StatedAdvected, x, f"advected {k}") for k, x in enumerate(listed, 1)]
    for k, x in enumerate(read, 1):
        if x.name in [y.name for y in read[: k - 1]] or x.name in ("zeta", "t"):
            raise ProblemError(f"advected {k}: {x.name!r} names something else; choose another")
        try:
            require_representation(x.representation, own.brackets)
        except ValueError as error:
            raise ProblemError(f"advected {k}, representation: {error}") from None
    try:
        stand = own.standard or faithful(own.brackets, own.dimension)
    except ValueError as error:
        raise ProblemError(f"algebra: {error}") from None
    found = carrying(own.name, own.dimension, stand, [x.representation for x in read])
    if found.n > CARRIED:
        raise ProblemError(
            f"advected: the matrices of the algebra and of all that it carries have {found.n} "
            f"rows together; at most {CARRIED}"
        )
    return found, tuple(Advected(name=x.name, size=len(x.representation[0])) for x in read)


def _algebra(given: StatedAlgebra, table: Mapping[str, Any]) -> Algebra:
    if len([key for key in GIVEN if key in table]) != 1:
        raise ProblemError(f"algebra: give one of {', '.join(GIVEN)}")
    if "dimension" in table and "brackets" not in table:
        raise ProblemError("algebra, dimension: it goes with 'brackets'; leave it out")
    if given.brackets or "brackets" in table:
        return _by_brackets(given)
    try:
        moved = group(given.of) if given.of else group_of_basis("G", "linear", [*given.basis])
    except ValueError as error:
        raise ProblemError(f"algebra, {'of' if given.of else 'basis'}: {error}") from None
    own = (on_homogeneous(moved) if moved.affine else moved).stated
    return Algebra(own.name, own.dimension, _sparse(own.structure_constants), own.basis)


def _by_brackets(given: StatedAlgebra) -> Algebra:
    largest = max((i for *indices, _ in given.brackets for i in indices), default=1)
    dimension = given.dimension or largest
    if largest > dimension:
        raise ProblemError(f"algebra, brackets: E_{largest}, of {dimension} elements (dimension)")
    if dimension > TABLE:
        raise ProblemError(f"algebra: {dimension} elements; at most {TABLE}")
    try:
        brackets = brackets_of(given.brackets)
        require_jacobi(brackets, dimension)
    except ValueError as error:
        raise ProblemError(f"algebra, brackets: {error}") from None
    return Algebra("G", dimension, brackets)


def _sparse(table: Sequence[Matrix]) -> Brackets:
    """The table without what is 0."""
    return {
        (a, b): {k: x for k, x in enumerate(own) if x}
        for a, rows in enumerate(table)
        for b, own in enumerate(rows)
        if any(own)
    }
