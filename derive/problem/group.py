"""The group of a problem file: by its name, or a table with a basis of one's own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..algebra.families import group, on_homogeneous
from ..algebra.groups import Group
from ..algebra.stated_basis import group_of_basis
from ..schema.declared import StatedGroup
from ..schema.fluid_kinds import GROUP
from ..schema.table import Slot
from .file_reader import FileReader
from .problem import ProblemError


def group_of(data: Mapping[str, Any], reader: FileReader) -> tuple[Group | None, str]:
    """The group, by its name or by a table with a basis, and its action."""
    which = data.get("group")
    if isinstance(which, dict):
        moved = _stated(reader.whole(StatedGroup, which, "group"))
        if "action" in data:
            raise ProblemError("key 'action' belongs into the table [group]")
        return moved, moved.action
    which = reader.text(Slot(data, "group", "file"))
    if which.casefold() == GROUP.casefold():
        raise ProblemError(f"key 'group': {GROUP} is that of a table [fluid]; leave this out")
    try:
        named = None if which == "any" else group(which)
    except ValueError as error:
        raise ProblemError(f"key 'group': {error}") from None
    if named and "action" not in data:
        return named, named.action
    action = reader.action(Slot(data, "action", "file"))
    if named and action != named.action:
        raise ProblemError(f"key 'action': {named.name} acts by {named.action} maps")
    return named, action


def _stated(own: StatedGroup) -> Group:
    try:
        moved = group_of_basis(
            own.name, "affine" if own.action == "affine" else "linear", [*own.basis]
        )
    except ValueError as error:
        raise ProblemError(f"group: {error}") from None
    return moved if not moved.affine or moved.free_translations else on_homogeneous(moved)
