"""What changes the energy of a motion, or the kinetic energy, which is kept where nothing does."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..language.values import approximate
from ..record.as_json import decode

DAMPING, TIME, INPUTS, FORCES = "damping", "the time", "inputs", "forces"


def drives(
    problem: Mapping[str, Any],
    inputs: Mapping[str, float],
    parameters: Mapping[str, float] | None = None,
) -> list[str]:
    """What changes it, in the problem of a record, by held inputs and for some numbers of the
    ``parameters``, any where there are none: damping, the time where it stands in U or ℓ by itself,
    inputs that are not 0, forces of the state."""
    numbers = parameters or {}
    forces = (decode(x["coefficient"], "problem") for x in problem.get("damping") or ())
    damped = any(approximate(t, numbers, float) != 0 for t in forces)
    zero = [["par", name] for name, x in numbers.items() if x == 0]
    timed = _timed([problem.get(x) for x in ("potentials", "lagrangian")], zero)
    there = {DAMPING: damped, TIME: timed, INPUTS: any(inputs.values())}
    there[FORCES] = bool(problem.get("forces") or problem.get("flows"))
    return [what for what, is_there in there.items() if is_there]


def weight(problem: Mapping[str, Any]) -> list[Any]:
    """The entries of all accelerations of gravity in the problem of a record, as JSON has them; 1
    for one that depends on the time."""
    given = (p["g"] for p in problem.get("potentials") or () if p["kind"] == "gravity")
    return [1 if _timed(x, ()) else x for g in given for x in g]


def is_weightless(problem: Mapping[str, Any], given: Mapping[str, float]) -> bool:
    """Has the problem of a record gravity, which is 0 for some numbers of the parameters, the
    others at their defaults?"""
    numbers = {name: x.get("default") for name, x in problem.get("parameters", {}).items()}
    known = {name: x for name, x in {**numbers, **given}.items() if x is not None}
    entries = [decode(x, "problem") for x in weight(problem)]
    return bool(entries) and all(approximate(t, known, float) == 0 for t in entries)


def is_free(problem: Mapping[str, Any]) -> bool:
    """Does a motion keep the kinetic energy, as nothing can act on the body?"""
    acting = any(problem.get(x) for x in ("potentials", "inputs", "damping", "forces", "flows"))
    return not acting and not _anywhere(problem.get("lagrangian"), _placed)


def _anywhere(data: Any, found: Callable[[Sequence[Any]], bool]) -> bool:
    """Is there a list in data of a record that is ``found``?"""
    if isinstance(data, dict):
        return any(_anywhere(x, found) for x in data.values())
    if not isinstance(data, list | tuple):
        return False
    return found(data) or any(_anywhere(x, found) for x in data)


def _placed(x: Sequence[Any]) -> bool:
    """Does it tell where a body is: an entry of g, or of a vector that it carries?"""
    return [*x[:1]] == ["entry"] and x[1] != "ζ"


def _timed(data: Any, zero: Sequence[Any]) -> bool:
    """Does the time stand in data of a record, but as what a place r(t) depends on, and in products
    with a parameter that is ``zero``?"""
    if isinstance(data, dict):
        return any(_timed(x, zero) for x in data.values())
    if isinstance(data, list | tuple):
        vanishes = [*data[:1]] == ["mul"] and any(x in zero for x in data)
        return [*data[:1]] != ["call"] and not vanishes and any(_timed(x, zero) for x in data)
    return bool(data == "t")
