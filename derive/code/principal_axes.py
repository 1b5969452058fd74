"""The body's tensor of inertia, and which parameters turn with the body's axes (paper, (35))."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .graph import Node
from .program import Turning
from .reader import RecordReader

MOMENTS = tuple(f"J_{i}{j}" for i in (1, 2, 3) for j in range(i, 4))


def inertia(reader: RecordReader) -> list[Node]:
    """I_11, I_12, I_13, I_22, I_23, I_33 about the body's origin; empty where space is not R³."""
    if not reader.group.turns_space or reader.record.definition("I") is None:
        return []
    tensor = reader.vector("I")
    return [tensor[i][j] for i in range(3) for j in range(i, 3)]


def turning(problem: Mapping[str, Any], parameters: Sequence[str]) -> Turning | None:
    """How parameters change with the body's axes; ``None`` where they cannot express that.

    ``problem`` as in the record; ``parameters``: the emitted ones, in order.
    """
    body = problem["body"]
    at = {name: i for i, name in enumerate(parameters)}
    if body["kind"] == "moments" and {*MOMENTS} <= {*at} - {*_parameters(problem)}:
        places = [place["at"] for place in problem["places"]]
        if "c_1" in at:
            places.append([("par", f"c_{i}") for i in (1, 2, 3)])
        matrix = tuple(at[name] for name in MOMENTS)
    elif body["kind"] == "points":
        places = [p["at"] for p in (*body["points"], *problem["places"])]
        matrix = ()
    else:
        return None
    vectors = _vectors(places, Counter(_parameters([problem, places])), at)
    return None if vectors is None else Turning(vectors, matrix)


def _vectors(
    places: Sequence[Sequence[Any]], uses: Mapping[str, int], at: Mapping[str, int]
) -> tuple[tuple[int, ...], ...] | None:
    """The indices of the parameters of the places that are not 0; ``None`` unless each is three
    parameters that stand nowhere else."""
    found = []
    for place in places:
        names = [x[1] for x in place if isinstance(x, (list, tuple)) and x[0] == "par"]
        if any(x != 0 for x in place):
            # once in the problem, and once more in the list of places
            if len(names) != 3 or any(uses[name] > 2 or name not in at for name in names):
                return None
            found.append(tuple(at[name] for name in names))
    return tuple(found)


def _parameters(data: Any) -> Iterator[str]:
    """The names of all parameters in the trees of plain data, with repetitions."""
    if isinstance(data, (list, tuple)):
        if len(data) == 2 and data[0] == "par" and isinstance(data[1], str):
            yield data[1]
        else:
            for x in data:
                yield from _parameters(x)
    elif isinstance(data, dict):
        for x in data.values():
            yield from _parameters(x)
