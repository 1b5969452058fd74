"""A problem as the record has it: plain data, trees as they are."""

from __future__ import annotations

from typing import Any

from ..schema.body_kinds import AnyBody
from .problem import Problem


def data(problem: Problem) -> dict[str, Any]:
    """What the record says of the problem; trees as they are."""
    return {
        "name": problem.name,
        "title": problem.title,
        "group": problem.group.name if problem.group else "any group",
        "action": problem.action,
        "homogeneous": problem.homogeneous,
        "parameters": {k: p.plain() for k, p in problem.parameters.items()},
        "body": (problem.body or AnyBody()).plain(),
        "potentials": [p.plain() for p in problem.potentials],
        "inputs": [i.plain() for i in problem.inputs],
        "places": [p.plain() for p in problem.places],
        "damping": [d.plain() for d in problem.damping],
        **({"frame": dict(problem.frame)} if problem.frame else {}),
        **({"masses": "of any sign"} if problem.signed else {}),
    }
