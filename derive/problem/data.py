"""A problem as the record has it: plain data, trees as they are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from ..schema.body_kinds import AnyBody, NoBody
from ..schema.table import Table
from .problem import Problem


def data(problem: Problem) -> dict[str, Any]:
    """What the record says of the problem; trees as they are."""
    return {
        "name": problem.name,
        "title": problem.title,
        "group": problem.group_name,
        "action": problem.action,
        "homogeneous": problem.homogeneous,
        "parameters": {k: p.plain() for k, p in problem.parameters.items()},
        "body": _body(problem).plain(),
        "potentials": [*_plain(problem.potentials)],
        "inputs": [*_plain(problem.inputs)],
        "places": [*_plain(problem.places)],
        "damping": [*_plain(problem.damping)],
        **({"frame": dict(problem.frame)} if problem.frame else {}),
        **({"masses": "of any sign"} if problem.signed else {}),
        **({"lagrangian": problem.lagrangian.plain()} if problem.lagrangian else {}),
        **({"fluid": problem.fluid.plain()} if problem.fluid else {}),
        **({"lagrangian": {"trivialisation": "right"}} if problem.torus else {}),
        **({"torus": {"N": problem.torus.N}} if problem.torus else {}),
        **({} if problem.advected is None else {"advected": [*_plain(problem.advected)]}),
    }


def _plain(tables: Iterable[Table]) -> Iterator[dict[str, Any]]:
    return (x.plain() for x in tables)


def _body(problem: Problem) -> Table:
    """The body, or why there is none."""
    given = problem.lagrangian or problem.torus or problem.fluid
    return problem.body or (NoBody() if given else AnyBody())
