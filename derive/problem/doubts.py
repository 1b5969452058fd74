"""What may be meant otherwise in a problem that is good: said, not refused."""

from __future__ import annotations

from collections.abc import Iterator

from .followed_names import faults
from .forces import negative_stiffness_of
from .inertia import CAD, negative_mass, of_cad
from .problem import Problem


def doubts(p: Problem, *, followed: bool = False) -> Iterator[str]:
    """Each in words, as the values of the parameters by default have it; ``followed``: without the
    names of [initial] and [[event]], which a motion refuses."""
    negative = (
        negative_mass(p.body, p.parameters),
        negative_stiffness_of(p.potentials, p.damping, p.parameters),
    )
    yield from (f"{where} is negative" for where in negative if where)
    if of_cad(p.body, p.parameters):
        yield f"body, given: no masses have these moments; {CAD}"
    yield from () if followed else faults(p)
