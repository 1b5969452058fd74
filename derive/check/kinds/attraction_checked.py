"""U = −Σ m_i μ / ‖r_i − centre‖."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from ...language import rational as q
from ..trials.point_masses import AppliedForces, Distance, Vector

KIND = "attraction"
Data = Mapping[str, Any]


def energy(at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]) -> Any:
    """The sum over the masses."""
    terms = (_pulled(at, pull, q.dot(d, d)) for d, pull in _attracted(at, p, r, masses))
    return sum(terms, Fraction(0))


def radial(
    at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]
) -> Iterator[Distance]:
    """The distance of each mass."""
    for d, pull in _attracted(at, p, r, masses):
        yield d, partial(_pulled, at, pull)


def _pulled(at: AppliedForces, pull: Any, square: Any) -> Any:
    return -pull / at.root(square)


def _attracted(
    at: AppliedForces, p: Data, r: Sequence[Vector], masses: Sequence[Any]
) -> Iterator[tuple[Vector, Any]]:
    """For each mass its place seen from the centre, and m · strength."""
    strength, centre = at.number(p["strength"]), at.vector(p["centre"])
    given = [(i, at.number(m)) for i, m in p.get("on", ())]
    for i, m in given or enumerate(masses, 1):
        if m:
            d = at.place(r, i)
            origin = centre or (Fraction(0),) * len(d)
            yield tuple(x - y for x, y in zip(d, origin, strict=True)), m * strength
