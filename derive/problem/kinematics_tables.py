"""Problems of kinematics of first order: [kinematics], ġ as a function of the element g."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..algebra.families import on_homogeneous
from ..algebra.groups import Group
from ..language.derivatives import weight
from ..language.expression import names
from ..language.limits import LEAVES
from ..schema.kind import Kinematics, Parameter
from .fields import is_entry, undeclared
from .file_reader import FileReader
from .inertia import is_negative
from .problem import Problem, ProblemError

KEYS = ("name", "title", "group", "action", "parameters", "kinematics")
"""The keys of such a file."""


def kinematics_problem(
    data: Mapping[str, Any], moved: Group | None, parameters: Mapping[str, Parameter]
) -> Problem:
    """The problem of a file, on the matrices of its group, which act on (r, 1) where it is affine;
    ``ProblemError`` for what else the file says."""
    for key in data:
        if key not in KEYS:
            raise ProblemError(f"key {key!r}: [kinematics] says all of the motion; leave this out")
    if moved is None:
        raise ProblemError("key 'kinematics': a text about any group has none of its own")
    group = (on_homogeneous(moved) if moved.affine else moved).in_user_basis
    if not group.has_inner_samples:
        raise ProblemError(
            f"kinematics: no exact elements of {group.name} are known, on which f_u is tried"
        )
    reader = FileReader()
    reader.moves(group)
    reader.carries(None, parameters)
    name = reader.name_of(data)
    if not isinstance(data["kinematics"], dict):
        raise ProblemError("key 'kinematics' must be a table [kinematics]")
    found = reader.typed(Kinematics, data["kinematics"], "kinematics")
    _declared(found, group, reader)
    return Problem(
        name,
        group,
        title=reader.title_of(data, name),
        parameters=parameters,
        kinematics=found,
    )


def _declared(found: Kinematics, group: Group, reader: FileReader) -> None:
    """Every name that is used is a parameter or an input, every one of these is used, and the
    expressions are not too many."""
    leaves = sum(weight(t).leaves for t in found.trees())
    if leaves > LEAVES:
        raise ProblemError(f"{leaves} names and numbers in expressions; at most {LEAVES}")
    rates = {x for row in found.rate for t in row for x in names(t)}
    used = rates | {x for t in found.noise for x in names(t)}
    inputs = {*found.inputs}
    for name in sorted(used - inputs):
        if name not in reader.parameters:
            known = {x: t for x, t in reader.state_names.items() if is_entry(t)}
            raise ProblemError(undeclared(name, "kinematics", reader.parameters, group, known))
    if within := sorted(inputs & {x for t in found.noise for x in names(t)}):
        raise ProblemError(f"kinematics, noise: {within[0]!r} is an input; give parameters alone")
    for name, density in zip(found.inputs, found.noise, strict=False):
        if is_negative(density, reader.parameters):
            raise ProblemError(
                f"kinematics, noise of {name!r}: a density is not negative, and this one is, for "
                "the defaults of the parameters"
            )
    if left := next((x for x in found.inputs if x not in rates), ""):
        raise ProblemError(f"kinematics, inputs: {left!r} is not used in 'rate'; leave it out")
    if left := next((x for x in reader.parameters if x not in used), ""):
        raise ProblemError(f"parameter {left!r} is declared but not used; leave it out")
