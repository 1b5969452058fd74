"""[initial] and [[event]] of a problem file: where a motion starts, and what is watched on it.

They are no part of the equations: no record has them, and of emitted files those with steps
alone, which stop at events.  Which names the state
has is known where it is emitted, so that a name that it lacks is refused when a motion is started;
with the walk it is told (:mod:`.followed_names`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..language.expression import names
from ..language.tree import Tree, nodes
from ..schema.followed import Event
from ..schema.table import hint, nearest
from .fields import tables
from .file_reader import FileReader
from .problem import Initial, Problem, ProblemError

KEYS = ("initial", "event")


def stated_motion(data: Mapping[str, Any], reader: FileReader) -> dict[str, Any]:
    """The fields of a problem that a file says by KEYS; parameters are known to the ``reader``."""
    said = next((key for key in KEYS if key in data), "")
    if said and not reader.group and "algebra" not in data:
        raise ProblemError(f"key {said!r}: a text about any group has no motion to follow")
    events = tuple(
        reader.whole(Event, x, f"event {k}") for k, x in enumerate(tables(data, "event"), 1)
    )
    for k, x in enumerate(events, 1):
        moving = [name for name in names(x.when) if name not in reader.parameters]
        if not moving and "t" not in nodes(x.when):
            raise ProblemError(
                f"event {k}, when: nothing in it changes on a motion; write it of the numbers of "
                "the state, as zeta_1, or of t"
            )
    seen = [x.name for x in events]
    for k, name in enumerate(seen, 1):
        if name in seen[: k - 1]:
            raise ProblemError(f"event {k}: a second event {name!r}; give each its own name")
    return {"initial": _initial(data.get("initial", {}), reader), "events": events}


def named(problem: Problem) -> set[str]:
    """The names in the expressions of start and events, parameters among them."""
    trees = [*problem.initial.trees(), *(t for x in problem.events for t in x.trees())]
    return {name for t in trees for name in names(t)}


def _initial(table: Any, reader: FileReader) -> Initial:
    if not isinstance(table, dict):
        raise ProblemError("key 'initial' must be a table [initial]")
    found: dict[str, Tree] = {}
    for name, value in table.items():
        if name == "exp":
            continue
        where = f"initial, {name[:40]}"
        if name in reader.parameters:
            raise ProblemError(f"{where}: a parameter has its default in [parameters]")
        if isinstance(value, list):
            first, second = (f"{name[:40]}_{k} = …" for k in (1, 2))
            known = f"one number each, {first}, {second}; only exp is a list{hint(name, ())}"
            raise ProblemError(f"{where}: {known}")
        found[reader.identifier(name, where)] = _number(value, where, reader)
    where, exp = "initial, exp", table.get("exp", [])
    if not isinstance(exp, list):
        raise ProblemError(f"{where}: expected a list, the coordinates in the basis of 𝔤")
    if reader.group and reader.advected is None and len(exp) not in (0, reader.group.dimension):
        count = reader.group.dimension
        raise ProblemError(
            f"{where}: expected {count} coordinates in the basis, not {len(exp)}; their order is "
            f"that of {_order(reader)}"
        )
    return Initial(found, tuple(_number(x, where, reader) for x in exp))


def _number(value: Any, where: str, reader: FileReader) -> Tree:
    """An expression of the parameters."""
    found = reader.expression(value, where)
    for name in names(found):
        if name not in reader.parameters:
            near = nearest(name, reader.parameters)
            raise ProblemError(f"{where}: {name[:40]!r} is not declared in [parameters]{near}")
    return found


def _order(reader: FileReader) -> str:
    """The basis of the Lie algebra in words."""
    group = reader.moving()
    d, n = group.dimension, group.n
    if group.free_translations:
        return f"E_1 … E_{d}, the linear parts first, then the {n} translations"
    return f"E_1 … E_{d}" if d > 1 else "E_1"
