"""What may be meant otherwise in a problem that is good: said, not refused."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from .followed_names import faults
from .forces import negative_stiffness_of
from .inertia import impossible, negative_mass
from .problem import Problem


def doubts(p: Problem, given: Mapping[str, float], *, followed: bool = False) -> Iterator[str]:
    """Each in words, as the values of the parameters have it that are ``given``, or by default;
    ``followed``: without the names of [initial] and [[event]], which a motion refuses."""
    values = {k: replace(x, default=given.get(k, x.default)) for k, x in p.parameters.items()}
    negative = (
        negative_mass(p.body, values),
        negative_stiffness_of(p.potentials, p.damping, values),
    )
    yield from (f"{where} is negative" for where in negative if where)
    if p.group and not p.signed and (why := impossible(p.group, p.body, values)):
        yield f"body: {why}"
    yield from () if followed else faults(p)
