"""What changes the energy of a motion, which is kept where nothing does."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

DAMPING, TIME, INPUTS = "damping", "the time", "inputs"


def drives(problem: Mapping[str, Any], inputs: Mapping[str, float]) -> list[str]:
    """What changes it, in the problem of a record and by held inputs: damping, the time where it
    stands in U or ℓ by itself, inputs that are not 0."""
    timed = _timed([problem.get(x) for x in ("potentials", "lagrangian")])
    there = {DAMPING: problem.get("damping"), TIME: timed, INPUTS: any(inputs.values())}
    return [what for what, is_there in there.items() if is_there]


def _timed(data: Any) -> bool:
    """Does the time stand in data of a record, but as what a place r(t) depends on?"""
    if isinstance(data, dict):
        return any(map(_timed, data.values()))
    if isinstance(data, list | tuple):
        return [*data[:1]] != ["call"] and any(map(_timed, data))
    return bool(data == "t")
