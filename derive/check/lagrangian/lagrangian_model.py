"""A random exact point of the evolution space of a Lagrangian ℓ(t, g, Z), with two variations."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import Source
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ...record.as_json import decode
from ..trials.model import TangentVector
from ..values.arithmetic import (
    EPS,
    EPS_PRIME,
    ETA,
    EvaluationError,
    Nilpotent,
    Value,
    derivative_in,
    nilpotent,
    part,
)
from ..values.draws import Draws, Locus
from ..values.evaluate import Environment, evaluate
from ..values.residue import with_slots
from .given_field import CarriedAlong, GivenField

ENTRY, PAIRED, WITH_BRACKET = 2, 4, 6
"""The indices of an entry of a matrix, of ⟨Π, ξ⟩, of ⟨Π, [ξ′, ξ]⟩: what a claim contracts."""

Family = tuple[Any, Matrix, Matrix, Matrix, Matrix]
"""t, g, Z on a family, and h, h⁻¹ for g = g₀h, or hg₀."""


class LagrangianModel(Draws):
    """One random point of a problem with the key ``lagrangian``.

    ``generic``: ℓ is any polynomial, on the problem's side.  X is the motion; or, where the locus
    ``at`` tells some of it, a random vector with δt = 1 that has this.  ``pi``: its value, else
    any; ``zero``: the names of parameters that vanish; ``horizontal``: coordinates that are held
    are 0.  ``input_forces``: none, without points.  ``symmetries``: by which a record reduces.
    """

    def __init__(
        self,
        problem: Mapping[str, Any],
        group: Group,
        random: Source,
        size: int,
        at: Locus,
        *,
        generic: bool = False,
        pi: Fraction | None = None,
        zero: Collection[str] = (),
        horizontal: bool = False,
    ):
        own = {} if generic else problem
        super().__init__(own, group, random, size, generic=generic, pi=pi, zero=zero)
        self.side = str(problem["lagrangian"]["trivialisation"])
        held = () if generic else problem["lagrangian"].get("held", ())
        self.held = {a - 1 for a in held}
        self.tree = None if generic else decode(problem["lagrangian"]["L"], "problem, L")
        self.hypothesis_failures: dict[Any, str] = {}
        told = () if generic else problem.get("symmetries", ())
        self.symmetries = [GivenField(0, decode(x, "problem, symmetries")) for x in told]
        inside = bool(at.field or at.field_prime or self.symmetries)  # else any coset, if need be
        inside = inside or group.has_inner_samples
        g = group.sample_inside(random, size) if inside else group.sample(random, size)
        self.t, self.g, self.Z = self.draw(), g, self.algebra()
        self.advected: CarriedAlong | None = None
        if horizontal:
            coordinates = enumerate(group.nearest(self.Z))
            self.Z = group.hat([Fraction(0) if a in self.held else x for a, x in coordinates])
        if generic:
            self._any_polynomial()
        elif "advected" in problem:
            self.advected = CarriedAlong(problem, group, self.side)
            self.advected.start = tuple((self.draw(),) for _ in self.advected.rows)
        self.first, self.second, self.mixed = (
            TangentVector(self.draw(), self.algebra(), self.algebra()) for _ in range(3)
        )
        self._restrict(at)
        self.given = [
            GivenField(*(x for _, x in field)) if field else None
            for field in (at.field, at.field_prime)
        ]
        if self.given[0]:
            self.first = self.given[0].direction(self)
        if self.given[1]:
            self.second = self.given[1].direction(self)
        self.vector = None
        if at.contracted or at.along or at.free_acceleration:
            velocity = self.Z if at.along else self.algebra()
            self.vector = TangentVector(Fraction(1), velocity, self.algebra())
        if at.contracted and self.vector is not None:
            self.first = self.vector
        self.free_acceleration, self.driven = at.free_acceleration, at.driven
        pulled = self.driven and bool(self.inputs_of("covector"))
        self.covector = [self.draw() if pulled else Fraction(0) for _ in group.basis]
        self.input_forces: list[tuple[Any, ...]] = []
        self.parameters |= self.name_covector(self.covector)

    def _restrict(self, at: Locus) -> None:
        """Set the parts of δ and δ′ to 0 that vanish at a locus."""
        nothing = q.scaled(Fraction(0), self.Z)
        if at.still:
            self.first = replace(self.first, time=Fraction(0))
        if at.vanishing:
            self.second = TangentVector(
                Fraction(0) if "time" in at.vanishing else self.second.time,
                nothing if "linear" in at.vanishing else self.second.xi,
                self.second.velocity,
            )

    # -- the Lagrangian ------------------------------------------------------------------------

    def _any_polynomial(self) -> None:
        """½ Tr Z K Z̄ and a product of three sums of all entries: every derivative is any."""
        s = self.group.size
        span = range(s)
        rows = [[self.draw(slots=0) for _ in span] for _ in span]
        self.quadratic = tuple(tuple(rows[min(i, j)][max(i, j)] for j in span) for i in span)
        self.weights = [
            (self.draw(), self.draw(), self._weights(s), self._weights(s)) for _ in range(3)
        ]

    def _weights(self, s: int) -> Matrix:
        return tuple(tuple(self.draw(slots=0) for _ in range(s)) for _ in range(s))

    def lagrangian(self, t: Any, g: Matrix, Z: Matrix) -> Any:
        """ℓ(t, g, Z)."""
        if self.tree is not None:
            zeta = tuple((x,) for x in self.group.nearest(Z))
            place = {"Γ": self.advected.at(g)} if self.advected else {"A": g}
            tree, known = self.hoisted
            names = {**self.expressions.names, **known, **place, "t": t, "ζ": zeta}
            env = Environment(self.n, names, parameters=self.parameters, elementary=self.elementary)
            return evaluate(tree, env)
        square = q.trace(q.times(q.times(Z, self.quadratic), q.transposed(Z)))
        product = Fraction(1)
        for constant, later, at, moving in self.weights:
            linear = constant + later * (t - self.t)
            linear = linear + q.trace(q.times(g, at)) + q.trace(q.times(Z, moving))
            product = product * linear
        return square * Fraction(1, 2) + product

    @cached_property
    def of_state(self) -> Environment:
        """The environment of expressions of the state: of t, g or what is carried along, and ζ."""
        place = {"Γ": self.advected.start} if self.advected else {"A": self.g}
        zeta = q.column(self.group.nearest(self.Z))
        names = {**self.expressions.names, **place, "t": self.t, "ζ": zeta}
        return Environment(self.n, names, parameters=self.parameters, elementary=self.elementary)

    @cached_property
    def hoisted(self) -> tuple[Tree, dict[str, Any]]:
        """The tree of ℓ with names for what is the same at all points, and their values."""
        assert self.tree is not None
        return with_constants_named(self.tree, self.expressions)

    def momentum(self, t: Any, g: Matrix, Z: Matrix, eta: Matrix) -> Any:
        """The derivative of ℓ with respect to Z along eta."""
        faster = q.plus(Z, q.scaled(nilpotent(ETA), eta))
        return derivative_in(self.lagrangian(t, g, faster), ETA)

    def energy(self, t: Any, g: Matrix, Z: Matrix) -> Any:
        """⟨p, Z⟩ − ℓ."""
        return self.momentum(t, g, Z, Z) - self.lagrangian(t, g, Z)

    # -- the group -----------------------------------------------------------------------------

    def tangent_at(self, g: Matrix, xi: Matrix) -> Matrix:
        """The tangent vector at g that xi stands for: gξ on the left, ξg on the right."""
        return q.times(g, xi) if self.side == "left" else q.times(xi, g)

    def along(self, mask: int) -> Matrix:
        """1 + sZ: the motion is g(1 + sZ), or (1 + sZ)g."""
        return q.plus(q.identity(self.group.size), q.scaled(nilpotent(mask), self.Z))

    def back_along(self, back: Matrix, mask: int) -> Matrix:
        """The inverse of the motion: (1 − sZ)g⁻¹, or g⁻¹(1 − sZ)."""
        undo = q.minus(q.identity(self.group.size), q.scaled(nilpotent(mask), self.Z))
        return q.times(undo, back) if self.side == "left" else q.times(back, undo)

    def trivialised(self, h: Matrix, back: Matrix, rate: Matrix) -> Matrix:
        """h⁻¹ times a rate of h, or that rate times h⁻¹."""
        return q.times(back, rate) if self.side == "left" else q.times(rate, back)

    def displaced(self, *moves: tuple[Any, Matrix]) -> tuple[Matrix, Matrix]:
        """(1 + ε₁x₁)(1 + ε₂x₂) …, in the other order on the right; and its inverse."""
        h = back = one = q.identity(self.group.size)
        for weight, x in moves:
            step, undo = (q.plus(one, q.scaled(s * weight, x)) for s in (1, -1))
            if self.side == "left":
                h, back = q.times(h, step), q.times(undo, back)
            else:
                h, back = q.times(step, h), q.times(back, undo)
        return h, back

    def family(self, a: TangentVector, b: TangentVector) -> Family:
        """A two-parameter family with the derivatives a and b; its mixed part is any."""
        e, f = nilpotent(EPS), nilpotent(EPS_PRIME)
        t = self.t + e * a.time + f * b.time + e * f * self.mixed.time
        Z = self.Z
        for weight, x in ((e, a.velocity), (f, b.velocity), (e * f, self.mixed.velocity)):
            Z = q.plus(Z, q.scaled(weight, x))
        h, back = self.displaced((e, a.xi), (f, b.xi), (e * f, self.mixed.xi))
        return t, self.tangent_at(self.g, h), Z, h, back

    @cached_property
    def varied(self) -> Family:
        """The family of δ and δ′."""
        return self.family(self.first, self.second)

    def field(self, family: Family, mask: int) -> Matrix:
        """g⁻¹ ∂g, or ∂g g⁻¹, in a parameter of a family, a function of the other."""
        *_, h, back = family
        rate = tuple(tuple(derivative_in(x, mask) for x in row) for row in h)
        return self.trivialised(h, back, rate)

    # -- the forms -----------------------------------------------------------------------------

    def cartan(self, a: TangentVector) -> Any:
        """ϖ(δ) at the point."""
        pushed = self.momentum(self.t, self.g, self.Z, a.xi)
        return self.indices(part(pushed - self.energy(self.t, self.g, self.Z) * a.time, 0), PAIRED)

    def exterior(self, a: TangentVector, b: TangentVector) -> Any:
        """dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] on the family."""
        family = self.family(a, b)
        t, g, Z, *_ = family
        energy = self.energy(t, g, Z)

        def form(mask: int) -> Any:
            pushed = self.momentum(t, g, Z, self.field(family, mask))
            return pushed - energy * derivative_in(t, mask)

        return self.indices(part(form(EPS_PRIME), EPS) - part(form(EPS), EPS_PRIME), WITH_BRACKET)

    def indices(self, x: Any, slots: int) -> Any:
        """A number as one of so many indices, where ℓ is any function."""
        return with_slots(x, slots) if self.generic else x

    def as_letter(self, x: Matrix) -> Matrix:
        """A matrix as one of indeterminates, where ℓ is any function."""
        return tuple(tuple(self.indices(y, ENTRY) for y in row) for row in x)

    # -- the motion ----------------------------------------------------------------------------

    @cached_property
    def metric(self) -> Matrix:
        """∂²ℓ/∂Z² on the basis, d × d; 1 for the coordinates that are held."""
        whole, span = self.second_derivatives, range(len(self.group.basis))
        return tuple(
            tuple(Fraction(i == j) if {i, j} & self.held else whole[i][j] for j in span)
            for i in span
        )

    @cached_property
    def second_derivatives(self) -> Matrix:
        """∂²ℓ/∂Z² on the basis, d × d."""
        basis = self.group.basis
        e = nilpotent(EPS)
        faster = [q.plus(self.Z, q.scaled(e, x)) for x in basis]
        return tuple(
            tuple(part(self.momentum(self.t, self.g, Z, y), EPS) for Z in faster) for y in basis
        )

    def _load(self, e: Matrix) -> Any:
        """∂ᵥℓ − d/ds ⟨p, E⟩ where the velocity keeps its coordinates, and ξ = E for every s."""
        s, v = nilpotent(EPS), nilpotent(EPS_PRIME)
        h, back = self.displaced((s, self.Z), (v, e))
        rate = tuple(tuple(part_in(x, EPS) for x in row) for row in h)
        Z = self.trivialised(h, tuple(tuple(_at_start(x) for x in row) for row in back), rate)
        aside, _ = self.displaced((v, e))
        varied = part(self.lagrangian(self.t, self.tangent_at(self.g, aside), Z), EPS_PRIME)
        ahead, _ = self.displaced((s, self.Z))
        later = self.momentum(self.t + s, self.tangent_at(self.g, ahead), self.Z, e)
        return varied - part(later, EPS)

    @cached_property
    def load(self) -> list[Any]:
        """The right side of M ζ̇ = β, with the covector input; 0 for what is held."""
        return [Fraction(0) if a in self.held else x for a, x in enumerate(self.total_load)]

    @cached_property
    def total_load(self) -> list[Any]:
        """What ζ̇ must give by the second derivatives."""
        return [u + self._load(e) for u, e in zip(self.covector, self.group.basis, strict=True)]

    @cached_property
    def acceleration(self) -> Matrix:
        """Ż of the motion; of X where ``free_acceleration``."""
        if self.free_acceleration and self.vector is not None:
            return self.vector.velocity
        found = q.solve(self.metric, tuple((x,) for x in self.load))
        if found is None:
            raise ZeroDivisionError("∂²ℓ/∂Z² is singular at this point")
        wanted = tuple((x,) for x in self.total_load)
        if self.held and not self.graded and q.times(self.second_derivatives, found) != wanted:
            raise EvaluationError("what is held is no symmetry: the equations have no solution")
        return self.as_letter(self.group.hat([row[0] for row in found]))

    @property
    def motion(self) -> TangentVector:
        """X, with δt = 1: the direction of the motion, or the random vector that stands for it."""
        return self.vector or TangentVector(Fraction(1), self.Z, self.acceleration)


def part_in(x: Any, mask: int) -> Any:
    """The derivative in a parameter, where that is 0 from the beginning."""
    return _at_start(derivative_in(x, mask))


def _at_start(x: Any) -> Any:
    """A number at s = 0, a function of the other parameters."""
    return Nilpotent({k: y for k, y in Nilpotent.of(x).parts.items() if not k & EPS})


# A tree that is evaluated at many points, with what is the same at all of them computed once.
#
# Moments of a turned solid are long expressions in parameters, and stand in a Lagrangian a
# thousand times; with respect to the entries of g and the coordinates of Z they are numbers.


def with_constants_named(t: Tree, env: Environment) -> tuple[Tree, dict[str, Value]]:
    """The tree with a name for each of its largest parts that speak of parameters, numbers and
    names of ``env`` alone, and the values of these names, which no record can have; equal parts
    have one name.
    """
    named: dict[Tree, str] = {}

    def short(x: Tree) -> Tree:
        if not isinstance(x, tuple) or x[0] == "par":
            return x
        if is_constant(x, env):
            return named.setdefault(x, f"\0{len(named)}")
        return (x[0], *map(short, x[1:]))

    tree = short(t)
    return tree, {name: evaluate(x, env) for x, name in named.items()}


def is_constant(t: Tree, env: Environment) -> bool:
    """Does a tree speak of parameters, numbers and names of ``env`` alone?"""
    if isinstance(t, str):
        return t in env.names
    if not isinstance(t, tuple) or t[0] == "par":
        return True
    return all(is_constant(x, env) for x in t[2 if t[0] == "fun" else 1 :])
