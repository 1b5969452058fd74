"""Problem files: TOML read into :class:`Problem`, every key checked, errors in one line."""

from __future__ import annotations

import difflib
import math
import re
import tomllib
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from ..algebra.families import group, on_homogeneous
from ..algebra.given import group_of_basis
from ..algebra.groups import Group
from ..algebra.rational import Matrix
from ..algebra.tree import Tree
from ..limits import (
    BASIS,
    BITS,
    COMMON_BITS,
    KEY_PARTS,
    LEAVES,
    MAGNITUDE,
    MATRIX,
    PARAMETERS,
    PROBLEM_BYTES,
)
from . import inertia
from .bodies import body
from .expression import names, numbers
from .fields import (
    LIKE_A_PLACE,
    NAME,
    PLACE,
    choice,
    expression,
    identifier,
    known,
    missing,
    tables,
    text,
)
from .forces import Points, damping, given_input, potential, trees
from .problem import (
    CovectorInput,
    GivenBody,
    MomentBody,
    Parameter,
    PointBody,
    Problem,
    ProblemError,
)
from .weight import weight

TOP = {"name", "title", "group", "action", "parameters", "point", "body", "potential", "input"}
TOP |= {"damping", "solid"}
DOTTED = re.compile(
    rb"\.(?:[ \t]*(?:[\w-]++|\"[^\"\n]*+\"|'[^'\n]*+')[ \t]*\.){%d}" % KEY_PARTS, re.ASCII
)
"""Tried at dots alone, and possessive: no text makes it slow."""


def load(path: Path, negative_mass: bool = False) -> Problem:
    """Read a problem file; :class:`ProblemError` names file, key and remedy."""
    try:
        with path.open("rb") as file:
            raw = file.read(PROBLEM_BYTES + 1)
    except OSError as error:
        raise ProblemError(f"{path}: {error.strerror}") from None
    if len(raw) > PROBLEM_BYTES:
        raise ProblemError(f"{path}: larger than {PROBLEM_BYTES} bytes")
    if DOTTED.search(raw):
        raise ProblemError(f"{path}: a key of more than {KEY_PARTS} parts; no key has so many")
    try:
        data = tomllib.loads(raw.decode("utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeError, RecursionError) as error:
        raise ProblemError(f"{path}: not TOML: {error}") from None
    except ValueError:  # Python reads no integer of thousands of digits
        raise ProblemError(f"{path}: {HUGE}") from None
    if _huge(data):
        raise ProblemError(f"{path}: {HUGE}")
    try:
        return problem_of(data, path.parent, negative_mass)
    except ProblemError as error:
        raise ProblemError(f"{path}: {error}") from None


HUGE = "an integer of hundreds of digits; numbers go up to 1e300"


def _huge(data: Any) -> bool:
    """Is there an integer that no message could show?"""
    left = [data]
    while left:
        x = left.pop()
        if isinstance(x, int) and x.bit_length() > BITS:
            return True
        left += x.values() if isinstance(x, dict) else x if isinstance(x, list) else ()
    return False


def problem_of(
    data: Mapping[str, Any], folder: Path = Path(), negative_mass: bool = False
) -> Problem:
    """A problem from the plain data of a file in a folder, where its meshes are.

    ``negative_mass``: may a mass be given as a negative number?
    """
    known(data, TOP, "file")
    name = identifier(text(data, "name", "file"), "key 'name'")
    moved, action = _group(data)
    parameters = _parameters(data.get("parameters", {}))
    own = body(data, moved, folder)
    if moved and own is None:
        raise ProblemError("no body: give [[point]] or [[solid]] tables, or a table [body]")
    if isinstance(own, MomentBody):
        named = {x: parameters.get(x, p) for x, p in own.parameters().items()}
        parameters = {**named, **{k: p for k, p in parameters.items() if k not in named}}
    if not negative_mass and (where := inertia.negative_mass(own, parameters)):
        raise ProblemError(
            f"{where} is negative; correct it, or allow it with --allow-negative-mass "
            "(in Python: negative_mass=True)"
        )
    listed = own.points if isinstance(own, GivenBody) else own
    masses = len(listed.masses) if isinstance(listed, PointBody) else 0
    blocks = listed.blocks if isinstance(listed, PointBody) else ()
    points = Points(moved, masses, blocks, parameters, heavy=not isinstance(own, PointBody))
    potentials = tuple(
        potential(p, f"potential {k}", points) for k, p in enumerate(tables(data, "potential"), 1)
    )
    inputs = tuple(
        given_input(i, f"input {k}", points) for k, i in enumerate(tables(data, "input"), 1)
    )
    drags = tuple(
        damping(d, f"damping {k}", points) for k, d in enumerate(tables(data, "damping"), 1)
    )
    if sum(isinstance(i, CovectorInput) for i in inputs) > 1:
        raise ProblemError("key 'input': one covector holds every component; give one such table")
    _distinct([i.name for i in inputs], parameters)
    title = text(data, "title", "file") if "title" in data else name
    problem = Problem(
        name,
        moved,
        action,
        title,
        parameters,
        own,
        potentials,
        inputs,
        tuple(points.places),
        drags,
    )
    _affordable(problem)
    _declared(problem, data.get("parameters", {}))
    if moved and own and (still := inertia.still_direction(moved, own)):
        raise ProblemError(f"{still} moves no mass of this body: its motion is open; add masses")
    if not negative_mass and inertia.impossible(own):
        raise ProblemError("body, given: no masses have these moments: J − c c̄/m must be positive")
    return problem


def _group(data: Mapping[str, Any]) -> tuple[Group | None, str]:
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


def _parameters(data: Any) -> dict[str, Parameter]:
    if not isinstance(data, dict):
        raise ProblemError("key 'parameters' must be a table")
    if len(data) > PARAMETERS:
        raise ProblemError(f"key 'parameters': more than {PARAMETERS}")
    found = {}
    for name, value in data.items():
        where = f"parameter {name[:40]!r}"
        identifier(name, where)
        if name == "t" or PLACE.fullmatch(name):
            what = "the time" if name == "t" else "a place of a point"
            raise ProblemError(f"{where}: this is {what} in an expression; choose another name")
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            value = {"default": value}
        if not isinstance(value, dict):
            raise ProblemError(f"{where}: expected a number or a table")
        known(value, {"default", "unit", "meaning"}, where)
        default = value.get("default")
        if default is not None and (
            isinstance(default, bool) or not isinstance(default, (int, float))
        ):
            raise ProblemError(f"{where}: key 'default' must be a number")
        texts = {k: text(value, k, where) for k in ("unit", "meaning") if k in value}
        if default is not None and not abs(default) <= MAGNITUDE:
            raise ProblemError(f"{where}: key 'default' must be a finite number, at most 1e300")
        found[name] = Parameter(None if default is None else float(default), **texts)
    return found


def _distinct(inputs: list[str], parameters: Mapping[str, Parameter]) -> None:
    """No two inputs of one name, and none with the name of a parameter."""
    for k, name in enumerate(inputs, 1):
        if name in inputs[: k - 1]:
            raise ProblemError(f"input {k}: a second input {name!r}; give each its own name")
        if name in parameters:
            raise ProblemError(f"input {k}: {name!r} is a parameter as well; choose another name")


def _declared(problem: Problem, given: Mapping[str, Any]) -> None:
    """Every name that is used is a parameter, and every parameter is used."""
    found = [*trees(problem.points), *trees(problem.body), *_forces(problem)]
    used = dict.fromkeys(x for t in found for x in names(t))
    for name in used:
        if name not in problem.parameters:
            if name == "t" or LIKE_A_PLACE.fullmatch(name):
                raise ProblemError(f"{name!r} is known in the 'U' of an expression alone")
            near = difflib.get_close_matches(name[:40], problem.parameters, 1)
            hint = f"did you mean {near[0]!r}? Else " if near else ""
            raise ProblemError(
                f"{name[:40]!r} is used but not declared; {hint}add it to [parameters]"
            )
    own = problem.body.parameters() if isinstance(problem.body, MomentBody) else {}
    for name in given:
        if name not in used and name not in own:
            raise ProblemError(f"parameter {name!r} is declared but not used; leave it out")


def _forces(problem: Problem) -> list[Tree]:
    parts = (*problem.potentials, *problem.damping, *problem.places)
    return [t for p in parts for t in trees(p)]


def _affordable(problem: Problem) -> None:
    """The expressions together are not too many, their numbers not too unlike one another."""
    solids = isinstance(problem.body, GivenBody) and problem.body.solids
    found = [*_forces(problem), *trees(problem.points if solids else problem.body)]
    leaves = sum(weight(t).leaves for t in found)
    if leaves > LEAVES:
        raise ProblemError(f"{leaves} names and numbers in expressions; at most {LEAVES}")
    common = 1
    for q in (x for t in found for x in numbers(t)):
        common = math.lcm(common, q.denominator)
        if common.bit_length() > COMMON_BITS:
            raise ProblemError("the fractions have no small common denominator; round them")
