"""Any U of the time and the places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..trials.point_masses import AppliedForces, Vector

KIND = "expression"


def energy(
    at: AppliedForces, p: Mapping[str, Any], r: Sequence[Vector], masses: Sequence[Any]
) -> Any:
    """Its value."""
    del masses
    return at.value(p["U"], r)
