"""A problem on the torus: [algebra] of = "torus", its N, and its inertia operator by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..algebra.torus import Torus
from ..schema.algebra_kinds import StatedTorus, TorusInertia
from .file_reader import FileReader
from .problem import Problem, ProblemError
from .stated_motion import KEYS as MOTION
from .stated_motion import stated_motion

KEYS = ("name", "title", "algebra", "inertia", *MOTION)
"""The keys of such a file."""


def on_torus(data: Mapping[str, Any]) -> bool:
    """Is the algebra of a file that of the torus, or of a name, with the N of a lattice?"""
    given = data.get("algebra")
    return isinstance(given, dict) and (given.get("of") == "torus" or {"of", "N"} <= {*given})


def torus_problem(data: Mapping[str, Any], reader: FileReader) -> Problem:
    """The problem of a file; ``ProblemError`` for what else it says."""
    for key, value in data.items():
        if key not in KEYS and (key, value) != ("parameters", {}):
            raise ProblemError(
                f"key {key!r}: on the torus there are {', '.join(KEYS)} alone; leave it out"
            )
    algebra = reader.whole(StatedTorus, data["algebra"], "algebra")
    if algebra.of != "torus":
        raise ProblemError(f'algebra, of: with N it is "torus", not {algebra.of[:40]!r}')
    torus = Torus(algebra.N)
    if "inertia" not in data:
        raise ProblemError('the torus needs its inertia: give [inertia] operator = "laplacian"')
    given = reader.whole(TorusInertia, data["inertia"], "inertia")
    if given.operator != "laplacian":
        raise ProblemError('inertia, operator: on the torus it is "laplacian", |n|² on T_n')
    if given.trivialisation != "right":
        raise ProblemError('inertia, trivialisation: a fluid moves on the "right"; leave it out')
    name = reader.name_of(data)
    title, motion = reader.title_of(data, name), stated_motion(data, reader)
    return Problem(name, None, title=title, torus=torus, **motion)
