"""A random exact point of the evolution space of a fluid, with two variations and the motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ..values.arithmetic import EPS, EPS_PRIME, ETA, Nilpotent, derivative_in, nilpotent, part
from ..values.residue import with_slots
from .curves import curve
from .exact_functions import ORDERS, Function, dot, shifted
from .fluid_spaces import crossed

Fields = tuple[Any, ...]


@dataclass(frozen=True)
class FluidLocus:
    """The points at which a step is to hold. ``contracted``: δt = 1, and X is the vector of δ;
    ``vertical``: δ′t = 0 and η′ = 0; ``along``: η(X) = u; ``lift``: X is the tangent of any lift,
    and the vector of δ′; ``free``: u̇ is any field of the algebra, and that of X; ``level``: ϑ
    leaves the density alone; ``one_level``: the curve is one of a level of the density; ``driven``:
    a force acts that is given."""

    contracted: bool = False
    vertical: bool = False
    along: bool = False
    lift: bool = False
    free: bool = False
    level: bool = False
    one_level: bool = False
    driven: bool = False


@dataclass(frozen=True)
class FluidVariation:
    """A tangent vector: δt, η with δg = η ∘ g, and δu."""

    time: Any
    displacement: Fields
    velocity: Fields


class FluidModel:
    """A point on a space; ``draw``: gives new numbers; ``advected``: is the density any series
    1 + sθ? ``forced``: is there a potential per unit mass, any function?"""

    def __init__(self, space: Any, draw: Any, at: FluidLocus, *, advected: bool, forced: bool):
        self.space, self.draw, self.at, self.advected = space, draw, at, advected
        self.points = space.of_points()
        self.one = Function(space, {(0,) * space.length: Fraction(1)})
        self.theta = space.layered(draw) if at.one_level else space.level(draw)
        self.V = space.energy(draw) if forced else self.one * 0
        self.force = space.any_field(draw) if at.driven else [-x for x in gradient(self.V)]
        self.u = self.solenoidal()
        self.first = FluidVariation(self.number(), self.solenoidal(), self.solenoidal())
        self.second = FluidVariation(self.number(), self.solenoidal(), self.solenoidal())
        self.mixed = FluidVariation(self.number(), self.solenoidal(), self.solenoidal())
        self.moved_field = self._displaced_field()
        self.any_pressure = space.function(draw)
        self.free_acceleration = self.solenoidal()
        self.acceleration = self.free_acceleration if at.free else self.motion[0]
        if at.along:
            self.first = FluidVariation(self.one, self.u, self.acceleration)
        if at.contracted:
            self.first = replace(self.first, time=self.one)
        if at.lift:
            self.second = FluidVariation(self.one, self.u, self.free_acceleration)
        if at.vertical:
            nothing = tuple(x * 0 for x in self.u)
            self.second = replace(self.second, time=self.one * 0, displacement=nothing)

    # -- draws ---------------------------------------------------------------------------------

    def number(self) -> Any:
        """A random number."""
        return self.one * with_slots(self.draw(), 0)

    def solenoidal(self) -> Fields:
        """A random field of the Lie algebra."""
        return tuple(self.space.solenoidal(self.draw))

    def _displaced_field(self) -> Fields:
        """ϑ: a field of the algebra; where it is to leave the density alone, one along the level
        lines of θ, or the curl of a function times grad θ."""
        if not (self.at.level and self.advected):
            return self.solenoidal()
        theta = [self.theta.d(j) for j in range(self.space.dimension)]
        if self.space.dimension == 2:
            return -theta[1], theta[0]
        other = self.space.function(self.draw)
        return tuple(crossed(theta, [other.d(j) for j in range(3)]))

    @cached_property
    def curve(self) -> Any:
        """A closed curve."""
        return curve(
            self.space, self.points, lambda: with_slots(self.draw(), 0), level=self.at.one_level
        )

    # -- the density ---------------------------------------------------------------------------

    @cached_property
    def density(self) -> Any:
        """ρ."""
        if not self.advected:
            return self.one
        s = Function(self.space, {(*(0,) * (self.space.length - 1), 1): Fraction(1)})
        return self.one + s * self.theta

    @cached_property
    def inverse_density(self) -> Any:
        """1/ρ, by the geometric series."""
        small = self.one - self.density
        found = power = self.one
        for _ in range(ORDERS - 1):
            power = power * small
            found = found + power
        return found

    @cached_property
    def mass(self) -> Any:
        """The density over the points, which displacements keep."""
        return self.at_points(self.density)

    # -- maps ----------------------------------------------------------------------------------

    def at_points(self, f: Any) -> Any:
        """f ∘ g₀, also of a nilpotent function."""
        if isinstance(f, Nilpotent):
            return Nilpotent(
                {k: self.space.pulled_back(x, self.points) for k, x in f.parts.items()}
            )
        return self.space.pulled_back(f, self.points)

    @cached_property
    def displacement(self) -> Fields:
        """φ of the family (id + εη) ∘ (id + ε′η′) ∘ (id + εε′χ) of displacements that keep the
        volume, to first order in each parameter."""
        e, e_prime = nilpotent(EPS), nilpotent(EPS_PRIME)
        chi = [e * e_prime * x for x in self.mixed.displacement]
        inner = [x + e_prime * y for x, y in zip(chi, self.second.displacement, strict=True)]
        outer = [shifted(x, inner) for x in self.first.displacement]
        return tuple(x + e * y for x, y in zip(inner, outer, strict=True))

    @cached_property
    def velocities(self) -> Fields:
        """u on the family."""
        return tuple(
            Nilpotent({0: x, EPS: a, EPS_PRIME: b, EPS | EPS_PRIME: c})
            for x, a, b, c in zip(
                self.u,
                self.first.velocity,
                self.second.velocity,
                self.mixed.velocity,
                strict=True,
            )
        )

    @cached_property
    def nu(self) -> Fields:
        """ν = u ∘ g on the family, over the points."""
        return self.composed(self.velocities)

    def composed(self, field: Sequence[Any]) -> Fields:
        """c ∘ g on the family, over the points."""
        return tuple(self.at_points(shifted(x, self.displacement)) for x in field)

    def eulerian(self, mask: int) -> Fields:
        """∂g/∂ε ∘ g⁻¹ for ε of ``mask``, to first order in the other parameter, in space."""
        other = EPS_PRIME if mask == EPS else EPS
        moved = [derivative_in(x, mask) for x in self.displacement]
        back = [nilpotent(other) * -part(x, other) for x in self.displacement]
        return tuple(_linear(shifted(x, back, 1), other) for x in moved)

    # -- forms ---------------------------------------------------------------------------------

    def over_points(self, a: Sequence[Any], b: Sequence[Any]) -> Any:
        """⟨a, b⟩ of fields over the points: the integral by the mass."""
        return mean(dot(a, b) * self.mass)

    @cached_property
    def potential(self) -> Any:
        """∫ V(g) dm on the family."""
        return mean(self.at_points(shifted(self.V, self.displacement)) * self.mass)

    def work(self, moved: Sequence[Any]) -> Any:
        """The derivative of ∫ V(g) dm along a field over the points."""
        place = [self.at_points(x) for x in gradient(self.V)]
        return self.over_points(place, moved)

    def lagrangian(self, nu: Sequence[Any], mask: int = 0) -> Any:
        """½ ∫ ‖ν‖² dm − U, with U on the family in the parameter of ``mask``."""
        return self.over_points(nu, nu) * Fraction(1, 2) - _linear(self.potential, mask)

    def momentum(self, nu: Sequence[Any], moved: Sequence[Any]) -> Any:
        """The derivative of L along ``moved``."""
        faster = [x + nilpotent(ETA) * y for x, y in zip(nu, moved, strict=True)]
        return derivative_in(self.lagrangian(faster), ETA)

    def energy(self, nu: Sequence[Any], mask: int = 0) -> Any:
        """⟨p, ν⟩ − L."""
        return self.momentum(nu, nu) - self.lagrangian(nu, mask)

    def cartan(self, direction: FluidVariation) -> Any:
        """ϖ of a tangent vector."""
        moved = [self.at_points(x) for x in direction.displacement]
        nu = [part(x, 0) for x in self.nu]
        return part(self.momentum(nu, moved) - self.energy(nu) * self.at_points(direction.time), 0)

    @cached_property
    def exterior(self) -> Any:
        """dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] on the family."""
        return self.cartan_varied(EPS) - self.cartan_varied(EPS_PRIME)

    def cartan_varied(self, mask: int) -> Any:
        """δ[ϖ(δ′)] on the family, δ′[ϖ(δ)] for the other ``mask``."""
        other, varied = (EPS_PRIME, self.second) if mask == EPS else (EPS, self.first)
        moved = [_linear(self.at_points(derivative_in(x, other)), mask) for x in self.displacement]
        nu = [_linear(x, mask) for x in self.nu]
        time = nilpotent(mask) * self.mixed.time + varied.time
        whole = self.momentum(nu, moved) - self.energy(nu, mask) * self.at_points(time)
        return part(whole, mask)

    @cached_property
    def action_varied(self) -> Any:
        """δ[L̃ dt(X)] on a family of lifts, by the Lagrangian alone: on each of them the velocity is
        that along it, and t is no less its function."""
        later = nilpotent(EPS) * self.at_points(self.mixed.time)
        moved = [self.at_points(derivative_in(x, EPS_PRIME)) for x in self.displacement]
        nu = [_linear(x, EPS) for x in moved]
        slowed = [x - x * later for x in nu]
        return part(self.lagrangian(slowed, EPS) * (later + self.at_points(self.one)), EPS)

    # -- the motion ----------------------------------------------------------------------------

    @cached_property
    def material(self) -> Fields:
        """The acceleration of the points where u does not change in time: of u ∘ (id + εu)."""
        along = [nilpotent(EPS) * x for x in self.u]
        return tuple(part(shifted(x, along, 1), EPS) for x in self.u)

    @property
    def acceleration_of_points(self) -> Fields:
        """That of the point at each place."""
        return tuple(x + y for x, y in zip(self.material, self.acceleration, strict=True))

    @cached_property
    def motion(self) -> tuple[Fields, Any]:
        """u̇ and p: the acceleration of the points is f − grad p/ρ, and u̇ is of the algebra, by
        d'Alembert's principle; order by order in s."""
        space, sigma = self.space, self.inverse_density
        falling = [x - y for x, y in zip(self.material, self.force, strict=True)]
        p = self.one * 0
        for _ in range(ORDERS if self.advected else 1):
            rest = tuple(
                a + (sigma - self.one) * y for a, y in zip(falling, gradient(p), strict=True)
            )
            p = -space.potential(rest)
        rate = tuple(-(a + sigma * y) for a, y in zip(falling, gradient(p), strict=True))
        return rate, p

    @cached_property
    def pressure(self) -> Any:
        """p of the motion, with any constant."""
        return self.motion[1] + self.number()

    @cached_property
    def rate_of_energy(self) -> Any:
        """d/dt of ½ ∫ ‖ν‖² dm + ∫ V(g) dm, over the points, whose mass stays: id + εu moves them,
        and ν is u + εu̇ where they are then."""
        e = nilpotent(EPS)
        ahead = [e * x for x in self.u]
        later = (x + e * y for x, y in zip(self.u, self.acceleration, strict=True))
        nu, V = ([self.at_points(shifted(x, ahead, 1)) for x in f] for f in (later, [self.V]))
        kinetic = self.over_points(nu, nu) * Fraction(1, 2)
        return part(kinetic + mean(V[0] * self.mass), EPS)

    def rate_of_displaced(self) -> Fields:
        """∂ϑ/∂t: ϑ is moved with the points by id + εu, ϑ ↦ D(id + εu)ϑ ∘ (id − εu)."""
        e, e_prime = nilpotent(EPS), nilpotent(EPS_PRIME)
        ahead = [e_prime * x for x in self.moved_field]
        pushed = [
            part(shifted(x, ahead, 1), EPS_PRIME) * e + y
            for x, y in zip(self.u, self.moved_field, strict=True)
        ]
        back = [-(e * x) for x in self.u]
        return tuple(part(shifted(x, back, 1), EPS) for x in pushed)

    def rate_on_curve(self, f: Any) -> Any:
        """The rate of a function along the curve, f alone being at rest: its points have the
        velocity ν of those that are there."""
        return self.curve.rate(f, self.velocity_of_curve)

    @cached_property
    def velocity_of_curve(self) -> Fields:
        """∂χ/∂t, ν along the curve of the points."""
        return tuple(self.curve.of_points(part(x, 0)) for x in self.nu)

    @property
    def rate_of_level(self) -> Function:
        """The rate of the density on the curve, where both are carried along."""
        found = self.curve.of_space(self.rate_of_density(self.u)) + self.rate_on_curve(self.density)
        return Function(self.curve, {m: x for m, x in found.terms.items() if x != 0})

    def rate_of_density(self, field: Sequence[Any]) -> Any:
        """The rate of ρ ∘ (id + εη)⁻¹."""
        back = [-(nilpotent(EPS) * x) for x in field]
        return part(shifted(self.density, back, 1), EPS)


def gradient(f: Function) -> Fields:
    """grad of a function."""
    return tuple(f.d(j) for j in range(f.space.dimension))


def mean(f: Any) -> Any:
    """The mean of a function, or of each part of a nilpotent one."""
    if isinstance(f, Nilpotent):
        parts: dict[int, Any] = f.parts
        return Nilpotent({mask: x.mean() for mask, x in parts.items()})
    return f.mean()


def _linear(x: Any, mask: int) -> Any:
    """What depends on the parameter of ``mask`` alone."""
    return Nilpotent({k: y for k, y in Nilpotent.of(x).parts.items() if not k & ~mask})
