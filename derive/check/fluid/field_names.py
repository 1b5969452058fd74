"""The values of the names of a fluid."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..nilpotent import EPS, EPS_PRIME, part
from .field_algebra import Normal, Value, componentwise, field_of
from .fluid_model import FluidModel, gradient
from .functions import Field, divergence
from .operators import Operator


def _points(model: FluidModel, mask: int) -> Field:
    return tuple(part(x, mask) for x in model.nu)


def _moved(model: FluidModel, mask: int) -> Field:
    return tuple(model.at_points(part(x, mask)) for x in model.displacement)


def _lagrangian(model: FluidModel) -> Value:
    return part(model.lagrangian(_points(model, 0)), 0)


def _potential(model: FluidModel) -> Value:
    return part(model.potential, 0)


NAMES: dict[str, Callable[[Any], Value]] = {
    "u": lambda v: v.model.u,
    "η": lambda v: v.model.first.displacement,
    "η′": lambda v: v.model.second.displacement,
    "δu": lambda v: v.model.first.velocity,
    "δ′u": lambda v: v.model.second.velocity,
    "u̇": lambda v: v.model.acceleration,
    "δt": lambda v: v.model.first.time,
    "δ′t": lambda v: v.model.second.time,
    "v": lambda v: _points(v.model, 0),
    "ν": lambda v: _points(v.model, 0),
    "ν̇": lambda v: tuple(map(v.model.at_points, v.model.acceleration_of_points)),
    "ġ": lambda v: tuple(v.model.at_points(x) for x in v.model.u),
    "δν": lambda v: _points(v.model, EPS),
    "δ′ν": lambda v: _points(v.model, EPS_PRIME),
    "δg": lambda v: _moved(v.model, EPS),
    "δ′g": lambda v: _moved(v.model, EPS_PRIME),
    "U": lambda v: _potential(v.model),
    "Ũ": lambda v: _potential(v.model),
    "V": lambda v: v.model.V,
    "f": lambda v: tuple(-x for x in gradient(v.model.V)),
    "L": lambda v: _lagrangian(v.model),
    "L̃": lambda v: _lagrangian(v.model),
    "h̃": lambda v: part(v.model.energy(_points(v.model, 0)), 0),
    "G": lambda v: componentwise(lambda x: v.composed(x, 0)),
    "D": lambda v: Operator.of(lambda c: divergence(field_of(c))),
    "p": lambda v: v.model.any_pressure if v.model.at.free else v.model.pressure,
    "ρ": lambda v: v.product_with(v.model.density),
    "ρ̇": lambda v: v.product_with(v.model.rate_of_density(v.model.u)),
    "ρ_0": lambda v: v.product_with(v.model.mass),
    "ϑ": lambda v: v.model.moved_field,
    "ϑ̇": lambda v: v.model.rate_of_moved(),
    "n": lambda _: Normal(),
    "Γ": lambda v: componentwise(v.model.curve.of_space),
    "Γ_0": lambda v: componentwise(v.model.curve.of_points),
    "Γ̇": lambda v: componentwise(v.model.rate_on_curve),
    "∂_s": lambda v: componentwise(v.along_curve, on_curve=True),
    "γ_s": lambda v: v.model.curve.tangent,
    "γ̇": lambda v: v.model.velocity_of_curve,
    "κ": lambda v: v.of_level(v.model.curve.of_space(v.model.density)),
    "κ̇": lambda v: v.of_level(v.model.rate_of_level),
}
"""Name → what it is, by the ``FluidValues`` of a model."""
