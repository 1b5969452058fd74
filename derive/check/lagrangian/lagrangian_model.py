"""A random exact point of the evolution space of a Lagrangian ℓ(t, g, Z) that no points give; at
it a variation that is a field on R × G, and what it and an algebra carry along.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import RandomSource
from ...algebra.user_groups import block
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree, nodes
from ...record.as_json import decode
from ...record.record import RecordError
from ..trials.given_forces import GivenForces
from ..trials.phase_point import PhasePoint, TangentVector
from ..trials.point_masses import Vector, listed_places
from ..values.arithmetic import (
    EPS,
    EPS_PRIME,
    EvaluationError,
    Value,
    derivative_of,
    is_matrix,
    nilpotent,
    part,
)
from ..values.draws import Locus
from ..values.evaluate import Environment, evaluate
from ..values.residue import with_slots

# A variation that is a field on R × G, and what it carries along: ϖ of it, along the motion too.
#
# The velocity goes with it by a two-parameter family, the motion moved by the field: no structure
# equation is used.


ARGUMENTS = ("t", "A", "π")
"""The names that the trees of a field may have."""


@dataclass(frozen=True)
class GivenField:
    """δt and δA as trees in t, A and the parameters."""

    time: Tree
    displacement: Tree

    def __post_init__(self) -> None:
        if any(x not in ARGUMENTS for x in nodes(self.displacement) if isinstance(x, str)):
            raise RecordError("a field δA is a function of t and A")

    def at(self, model: PhasePoint, t: Any, g: Matrix) -> tuple[Any, Matrix]:
        """δt and δA at a point, which may be nilpotent."""
        env = replace(model.expressions, names={"π": model.pi, "t": t, "A": g})
        moved = evaluate(self.displacement, env)
        if not is_matrix(moved):
            if self.displacement != 0:
                raise EvaluationError("δA is no matrix")
            moved = q.scaled(Fraction(0), model.g)
        return evaluate(self.time, env), moved

    def trivialised(self, model: PhasePoint, t: Any, g: Matrix, back: Matrix) -> tuple[Any, Matrix]:
        """δt, and δA carried to 𝔤."""
        time, moved = self.at(model, t, g)
        return time, model.ordered(back, moved)

    def direction(self, model: PhasePoint) -> TangentVector:
        """The variation at the point of the model; ``EvaluationError`` where it is not tangent to
        the group, or δt not constant."""
        back = q.inverted(model.g)
        time, xi = self.trivialised(model, model.t, model.g, back)
        ahead, _ = model.displaced((nilpotent(EPS), model.Z))
        later, ahead = model.t + nilpotent(EPS), model.ordered(model.g, ahead)
        _, moved = self.at(model, later, ahead)  # ∂ₛ of g(s) + εδA(s) is the velocity there
        rate = model.ordered(back, part(moved, EPS))
        velocity = q.minus(rate, model.ordered(xi, model.Z))
        if any(isinstance(x, str) for x in nodes(self.time)):
            raise RecordError("δt of a field is constant")
        if not model.graded and None in map(model.group.vee, (xi, velocity)):
            raise EvaluationError("the field is not tangent to the group")
        return TangentVector(time, xi, velocity)

    def rate(self, model: PhasePoint, subtracted: tuple[Tree, ...]) -> Any:
        """d/dt of ϖ of the field, and of functions of t and A added to it, along the motion."""
        t, g, Z, *_ = model.onward
        time, xi = self.trivialised(model, t, g, model.undone(model.onward))
        total = model.momentum(t, g, Z, xi) - model.energy(t, g, Z) * time
        env = replace(model.expressions, names={"π": model.pi, "t": t, "A": g})
        for x in subtracted:
            total = total + evaluate(x, env)
        return part(total, EPS)


# What an algebra carries along, at an exact point: Γ with ρ(g)^ε Γ = Γ₀, no rule of δΓ used.


class CarriedAlong:
    """Γ as a function of g near 1; ``start``: Γ₀, a column of any numbers."""

    def __init__(self, problem: Mapping[str, Any], group: Group, side: str):
        size = sum(x["size"] for x in problem["advected"])
        self.rows, self.side = range(group.n - size, group.n), side
        self.start: Matrix = ()

    def at(self, g: Matrix) -> Matrix:
        """ρ(g)⁻¹Γ₀ on the left, ρ(g)Γ₀ on the right; ρ(g) is a block of g."""
        if not self.rows:
            return ()
        whole = block(g, self.rows)
        return q.times(near_one(whole) if self.side == "left" else whole, self.start)


def near_one(m: Matrix) -> Matrix:
    """The inverse of 1 + x, x nilpotent in three parameters: 1 − x + x² − x³."""
    one = q.identity(len(m))
    x = q.minus(one, m)
    found = one
    for _ in range(3):
        found = q.plus(one, q.times(x, found))
    return found


PAIRED, WITH_BRACKET = 4, 6
"""The indices of ⟨Π, ξ⟩, of ⟨Π, [ξ′, ξ]⟩: what a claim contracts."""


class LagrangianModel(GivenForces):
    """One random point of a problem with the key ``lagrangian``.

    ``generic``: ℓ is any polynomial, on the problem's side. ``horizontal``: coordinates that are
    held are 0.  ``points``: the places at which forces act.  ``symmetries``: by which a record
    reduces.  All that is ``drawn``: see :class:`Draws`.
    """

    def __init__(
        self,
        problem: Mapping[str, Any],
        group: Group,
        random: RandomSource,
        size: int,
        at: Locus,
        *,
        generic: bool = False,
        horizontal: bool = False,
        **drawn: Any,
    ):
        own = {} if generic else problem
        self.side = str(problem["lagrangian"]["trivialisation"])
        self.held = {a - 1 for a in own.get("lagrangian", {}).get("held", ())}
        self.tree = None if generic else decode(problem["lagrangian"]["L"], "problem, L")
        fields = [decode(x, "problem, symmetries") for x in own.get("symmetries", ())]
        self.symmetries = [GivenField(0, x) for x in fields]
        inside = bool(at.field or at.field_prime or fields)  # else any coset, if need be
        inside = inside or group.has_inner_samples
        super().__init__(own, group, random, size, generic=generic, **drawn)
        self.stand(at, inside=inside)
        self.Z = self.algebra()
        self.advected: CarriedAlong | None = None
        if horizontal:
            coordinates = enumerate(group.nearest(self.Z))
            self.Z = group.hat([Fraction(0) if a in self.held else x for a, x in coordinates])
        if generic:
            self._any_polynomial()
        elif "advected" in problem:
            self.advected = CarriedAlong(problem, group, self.side)
            self.advected.start = tuple((self.draw(),) for _ in self.advected.rows)
        self.vary()
        self.given = [
            GivenField(*(x for _, x in field)) if field else None
            for field in (at.field, at.field_prime)
        ]
        if self.given[0]:
            self.first = self.given[0].direction(self)
        if self.given[1]:
            self.second = self.given[1].direction(self)
        told = at.contracted or at.along or at.free_acceleration
        self.aim(at_random=bool(told))
        self.points, self.blocks = listed_places(self, own.get("places", []))
        self.draw_inputs()

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
        square = q.contraction(q.times(Z, self.quadratic), Z)
        product = Fraction(1)
        for constant, later, at, moving in self.weights:
            linear = constant + later * (t - self.t)
            linear = linear + q.contraction(g, at) + q.contraction(Z, moving)
            product = product * linear
        return square * Fraction(1, 2) + product

    @cached_property
    def of_state(self) -> Environment:
        """The environment of expressions of the state: of t, g or what is carried along, and ζ."""
        place = {"Γ": self.advected.start} if self.advected else {"A": self.g}
        zeta = q.column(self.group.nearest(self.Z))
        names = {**self.expressions.names, **place, "t": self.t, "ζ": zeta}
        return self.with_places(names)

    def images(self, g: Matrix) -> list[Vector]:
        """The places in space of the points, (r, 1), moved by g; for a tangent matrix their
        velocities."""
        return [q.flatten(q.times(g, q.column(r))) for r in self.points]

    @cached_property
    def acting_covector(self) -> list[Any]:
        """With the work of forces and torques at places."""
        total = super().acting_covector
        if not self.points and not self.inputs_of("torque"):
            return total
        back = q.inverted(self.g)
        for a, e in enumerate(self.group.basis):
            moved = self.ordered(self.g, e)
            total[a] += self.work_of(self.given_forces, moved)
            total[a] += self.work_of_couple(q.times(back, moved))
        return total

    @cached_property
    def hoisted(self) -> tuple[Tree, dict[str, Any]]:
        """The tree of ℓ with names for what is the same at all points, and their values."""
        assert self.tree is not None
        return with_constants_named(self.tree, self.expressions)

    def indices(self, x: Any, slots: int) -> Any:
        """A number as one of so many indices, where ℓ is any function."""
        return with_slots(x, slots) if self.generic else x

    def brackets(self) -> Matrix:
        """The brackets of Π_1, …, then of the entries of Γ: the flows of the momenta move those."""
        whole = super().brackets()
        if not self.advected or not self.advected.rows:
            return whole
        ahead = (self.displaced((nilpotent(EPS), e))[0] for e in self.group.basis)
        moved = (self.advected.at(self.ordered(self.g, h)) for h in ahead)
        rates = tuple(q.flatten(part(x, EPS)) for x in moved)
        above = ((*row, *(-x for x in xs)) for row, xs in zip(whole, rates, strict=True))
        nothing = (Fraction(0),) * len(self.advected.rows)
        return (*above, *((*row, *nothing) for row in q.transposed(rates)))

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
        e = nilpotent(EPS)
        faster = [q.plus(self.Z, q.scaled(e, x)) for x in self.group.basis]
        columns = tuple(tuple(self.momenta(self.t, self.g, Z)) for Z in faster)
        return part(q.transposed(columns), EPS)  # type: ignore[no-any-return]

    def _force(self, e: Matrix) -> Any:
        """∂ᵥℓ − d/ds ⟨p, E⟩ where the velocity keeps its coordinates, and ξ = E for every s."""
        s, v = nilpotent(EPS), nilpotent(EPS_PRIME)
        h, back = self.displaced((s, self.Z), (v, e))
        Z = self.ordered(back, derivative_of(h, EPS))
        aside, _ = self.displaced((v, e))
        varied = part(self.lagrangian(self.t, self.ordered(self.g, aside), Z), EPS_PRIME)
        ahead, _ = self.displaced((s, self.Z))
        later = self.momentum(self.t + s, self.ordered(self.g, ahead), self.Z, e)
        return varied - part(later, EPS)

    @cached_property
    def load(self) -> list[Any]:
        """The right side of M ζ̇ = β, with the covector input; 0 for what is held."""
        return [Fraction(0) if a in self.held else x for a, x in enumerate(self.total_load)]

    @cached_property
    def total_load(self) -> list[Any]:
        """What ζ̇ must give by the second derivatives."""
        pairs = zip(self.acting_covector, self.group.basis, strict=True)
        return [u + self._force(e) for u, e in pairs]

    def solved(self, metric: Matrix, covector: list[Any]) -> Matrix:
        """``EvaluationError`` where what is held has an equation that is not satisfied."""
        found = super().solved(metric, covector)
        if self.held and not self.graded:
            rates = q.column(self.group.nearest(found))
            if q.times(self.second_derivatives, rates) != q.column(self.total_load):
                raise EvaluationError("what is held is no symmetry: the equations have no solution")
        return found


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
