"""U = ½ k (‖d‖ − ℓ)², d from one end to the other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ..trials.model import Model
from ..trials.point_masses import AppliedForces, Distance, Vector, outer_sum, scaled_each

KIND = "spring"
Data = Mapping[str, Any]


def summed(at: AppliedForces, p: Data) -> bool:
    """Those of length 0 inside one block."""
    if "between" not in p or p["length"] != 0:
        return False
    i, j = p["between"]
    return bool(at.blocks[i - 1] == at.blocks[j - 1])


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """By the square of the distance."""
    del masses
    d = _difference(at, p, r)
    return _stretch(at, p, q.dot(d, d))


def radial(
    at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]
) -> Iterator[Distance]:
    """Its one distance."""
    del masses
    yield _difference(at, p, r), lambda square: _stretch(at, p, square)


def _difference(at: AppliedForces, p: Data, r: Sequence[Vector]) -> Vector:
    """From the second end to the first."""
    if "between" in p:
        a, b = (at.place(r, i) for i in p["between"])
    else:
        a, b = at.place(r, p["on"]), at.vector(p["anchor"])
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _stretch(at: AppliedForces, p: Data, square: Any) -> Any:
    k, length = at.number(p["stiffness"]), at.number(p["length"])
    if p["length"] == 0:
        return k * square * Fraction(1, 2)
    stretched = at.root(square) - length
    return k * (stretched * stretched) * Fraction(1, 2)


def values(model: Model, members: Sequence[Data]) -> dict[str, Any]:
    """K = Σ k_e s_e s̄_e."""
    strengths, ends = zip(*_ends(model, members), strict=True)
    return {"K": outer_sum(scaled_each(strengths, ends), ends)}


def families(model: Model, members: Sequence[Data]) -> dict[str, dict[tuple[int, ...], Any]]:
    """k_e and s_e."""
    pairs = [*enumerate(_ends(model, members), 1)]
    return {"k": {(e,): k for e, (k, _) in pairs}, "s": {(e,): q.column(s) for e, (_, s) in pairs}}


def _ends(model: Model, members: Sequence[Data]) -> Iterator[tuple[Fraction, Vector]]:
    for p in members:
        i, j = p["between"]
        ends = zip(model.points[i - 1], model.points[j - 1], strict=True)
        yield model.applied.number(p["stiffness"]), tuple(a - b for a, b in ends)
