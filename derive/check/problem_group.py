"""The group of a record's problem, rebuilt from its name or basis, as the record must state it."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from ..algebra.carried import blocks_apart, of_matrices
from ..algebra.families import group, on_homogeneous
from ..algebra.groups import Group
from ..algebra.stated_basis import group_of_basis
from ..algebra.structure import rank
from ..record.record import ANY_GROUP, RecordError
from ..record.shape import IDENTIFIER
from .torus.torus_group import group_of_torus, torus_of


def group_of(problem: Mapping[str, Any]) -> Group | None:
    """The group of a record's problem, by its name or its basis; ``None`` for the text on any
    group.

    ``RecordError`` where the name, the action, the basis, 'n' or 'homogeneous' do not agree.
    """
    name, rows = str(problem.get("group")), problem.get("basis", [])
    basis = tuple(tuple(tuple(Fraction(x) for x in row) for row in e) for e in rows)
    if name == ANY_GROUP:
        if basis or problem.get("homogeneous"):
            raise RecordError(f"{ANY_GROUP} has no basis and is not homogeneous")
        if problem.get("n") != "any":
            raise RecordError(f"key 'n': {ANY_GROUP} moves the points of a space of any dimension")
        return None
    if "torus" in problem:
        return _of_torus(problem, name, basis)
    if "advected" in problem:
        return _carrying(problem, name, basis)
    found = _stated(problem, name, basis) if IDENTIFIER.fullmatch(name) else _named(name, basis)
    if "lagrangian" in problem:
        found = (on_homogeneous(found) if found.affine else found).stated
    homogeneous = len(found.factors) == 1
    if homogeneous != problem.get("homogeneous"):
        kept = "an affine group kept as a linear one on (r, 1)"
        raise RecordError(f"key 'homogeneous': {name} is {'' if homogeneous else 'not '}{kept}")
    if found.n != problem.get("n"):
        raise RecordError(f"key 'n': {name} moves the points of a space of dimension {found.n}")
    if found.action != problem.get("action"):
        raise RecordError(f"key 'action': {name} acts by {found.action} maps")
    return found


def _of_torus(problem: Mapping[str, Any], name: str, basis: tuple[Any, ...]) -> Group:
    """SU(N) in the basis of the torus, which no table has."""
    torus = torus_of(problem)
    if (name, basis) != (torus.name, ()) or problem.get("homogeneous"):
        raise RecordError(f"the torus of N = {torus.N} is of {torus.name}, and has no basis")
    if (problem.get("n"), problem.get("action")) != (torus.N, "linear"):
        raise RecordError(f"key 'n': the matrices of {torus.name} have {torus.N} rows")
    return group_of_torus(torus)


def _carrying(problem: Mapping[str, Any], name: str, basis: tuple[Any, ...]) -> Group:
    """The group of an algebra without an element in the state; ``RecordError`` where its matrices
    are not independent, not closed or not in blocks, or a known name is that of another algebra."""
    sizes = [x["size"] for x in problem["advected"]]
    if not basis or sum(sizes) > len(basis[0]) or rank(basis) < len(basis):
        raise RecordError("the basis is not one, or too small for what it carries along")
    found = of_matrices(name, basis)
    if not blocks_apart(found, sizes):
        raise RecordError("the basis has no blocks for what it carries along")
    try:
        constants = found.structure_constants
        known = None if IDENTIFIER.fullmatch(name) else group(name).stated.structure_constants
    except ValueError as error:
        raise RecordError(str(error)) from None
    if known not in (None, constants):
        raise RecordError(f"the brackets are not those of {name}")
    if (problem.get("n"), problem.get("homogeneous")) != (found.n, False):
        raise RecordError(f"key 'n': the matrices have {found.n} rows")
    return found


def _named(name: str, basis: tuple[Any, ...]) -> Group:
    """The group of a known name; ``RecordError`` for another spelling or another basis."""
    try:
        named = group(name)
    except ValueError as error:
        raise RecordError(str(error)) from None
    if named.name != name:
        raise RecordError(f"key 'group': {named.name} is written {ascii(name)[:60]}")
    if named.basis != basis:
        raise RecordError(f"the basis is not that of {name}, in its order")
    return named


def _stated(problem: Mapping[str, Any], name: str, basis: tuple[Any, ...]) -> Group:
    """The group of the basis that the problem states; ``RecordError`` where there is none."""
    affine = bool(problem.get("homogeneous")) or problem.get("action") == "affine"
    try:
        found = group_of_basis(name, "affine" if affine else "linear", basis)
    except ValueError as error:
        raise RecordError(f"the basis of {name}: {error}") from None
    return found if not affine or found.free_translations else on_homogeneous(found)
