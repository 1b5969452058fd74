"""The group of a problem file: by its name, or a table with a basis of one's own."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from ..algebra.families import group, on_homogeneous
from ..algebra.groups import Group
from ..algebra.stated_basis import group_of_basis
from ..language.limits import BASIS, MATRIX
from ..language.rational import Matrix
from .fields import NAME, choice, expression, known, missing, text
from .problem import ProblemError


def group_of(data: Mapping[str, Any]) -> tuple[Group | None, str]:
    """The group, by its name or by a table with a basis, and its action."""
    which = data.get("group")
    if isinstance(which, dict):
        moved = _given_group(which)
        if "action" in data:
            raise ProblemError("key 'action' belongs into the table [group]")
        return moved, moved.action
    which = text(data, "group", "file")
    try:
        named = None if which == "any" else group(which)
    except ValueError as error:
        raise ProblemError(f"key 'group': {error}") from None
    action = choice(data, "action", ("linear", "affine"), "file", named.action if named else "")
    if named and action != named.action:
        raise ProblemError(f"key 'action': {named.name} acts by {named.action} maps")
    return named, action


def _given_group(data: Mapping[str, Any]) -> Group:
    where = "group"
    known(data, {"name", "action", "basis"}, where)
    name = text(data, "name", where)
    if not NAME.fullmatch(name):
        raise ProblemError(f"{where}: key 'name': letters, digits and _ only")
    action = choice(data, "action", ("linear", "affine"), where, "linear")
    basis = missing(data, "basis", where)
    if not isinstance(basis, list) or len(basis) > BASIS:
        raise ProblemError(f"{where}: key 'basis' must list at most {BASIS} matrices")
    matrices = [_matrix(e, f"{where}, element {a} of the basis") for a, e in enumerate(basis, 1)]
    try:
        moved = group_of_basis(name, "affine" if action == "affine" else "linear", matrices)
    except ValueError as error:
        raise ProblemError(f"{where}: {error}") from None
    return moved if not moved.affine or moved.free_translations else on_homogeneous(moved)


def _matrix(value: Any, where: str) -> Matrix:
    if not isinstance(value, list) or not all(isinstance(row, list) for row in value):
        raise ProblemError(f"{where}: expected a list of rows")
    if len(value) > MATRIX or any(len(row) > MATRIX for row in value):
        raise ProblemError(f"{where}: larger than {MATRIX} × {MATRIX}")
    return tuple(tuple(_rational(x, where) for x in row) for row in value)


def _rational(value: Any, where: str) -> Fraction:
    tree = expression(value, where)
    if not isinstance(tree, (int, Fraction)):
        raise ProblemError(f"{where}: the entries of a basis must be rational numbers")
    return Fraction(tree)
