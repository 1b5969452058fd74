"""What may be meant otherwise in a problem that is good: said, not refused."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from ..language.derivatives import derivative
from ..language.tree import nodes
from .followed_names import faults
from .forces import negative_stiffness_of
from .inertia import impossible, negative_mass
from .null_directions import hessian, vanishes
from .problem import Problem
from .state_names import coordinates


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
    if metric_in_time(p):
        yield (
            "the metric ∂²L/∂Z² depends on the time: if by a mass m(t), the equations are "
            "d(mv)/dt = F, of what comes from rest or is left at rest in space; a rocket has "
            "m dv/dt = F + dm/dt c, with c the velocity relative to it of what leaves it"
        )
    yield from () if followed else faults(p)


def metric_in_time(p: Problem) -> bool:
    """Does the kinetic energy of a Lagrangian of one's own depend on the time?"""
    if not (p.group and p.lagrangian) or "t" not in nodes(p.lagrangian.L):
        return False
    second = hessian(p.lagrangian.L, coordinates(p.group))
    return any(not vanishes(derivative(x, "t")) for row in second for x in row)
