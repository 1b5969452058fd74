"""What the names of a record mean, computed from equation (3) alone, at one exact random point."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import Source
from ...language import rational as q
from ...language.rational import Matrix
from ...language.reserved import numbers_of_input
from ...record.as_json import decode
from ..values.arithmetic import (
    EPS,
    EPS_PRIME,
    ETA,
    Nilpotent,
    derivative_in,
    derivative_of,
    nilpotent,
    part,
)
from ..values.draws import LINEAR, TIME, TRANSLATION, Locus
from ..values.evaluate import Environment, evaluate
from ..values.residue import with_slots
from .point_masses import (
    RATE_SLOTS,
    AnyPotential,
    AppliedForces,
    Body,
    Vector,
    damping_members,
    listed_count,
)


@dataclass(frozen=True)
class TangentVector:
    """A tangent vector of the evolution space: δt, and the matrices ξ̂ = g⁻¹δg, δẐ in 𝔤."""

    time: Any
    xi: Matrix
    velocity: Matrix


class Model(Body):
    """One random point of the evolution space of a problem, with two variations and the motion.

    ``at``: the hypotheses that hold there. ``generic``: the potential is any polynomial; ``pi``:
    its value, else any. ``few``: no more points than are needed, and each of them once. ``zero``:
    the names of parameters that vanish.
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
        few: bool = False,
        zero: Collection[str] = (),
    ):
        super().__init__(problem, group, random, size, generic=generic, pi=pi, few=few, zero=zero)
        self.at = at
        self.s = group.size
        self.hypothesis_failures: dict[Any, str] = {}
        self._families: dict[tuple[int, int], tuple[Any, tuple[Any, Matrix, Matrix]]] = {}
        self.embody(principal=at.principal)
        self.applied = AppliedForces(
            {} if generic else problem, group, self.blocks, self.expressions
        )
        self.t = self.draw()
        inside = at.inside and group.has_inner_samples
        self.g = group.sample_inside(random, size) if inside else group.sample(random, size)
        self.any_potential = AnyPotential(self, self.t, self.images(self.g)) if generic else None
        self.Z = self.algebra()
        self.first, self.second, self.mixed = (
            TangentVector(self.draw(), self.algebra(), self.algebra()) for _ in range(3)
        )
        if at.vanishing:
            time = Fraction(0) if TIME in at.vanishing else self.second.time
            self.second = replace(
                self.second, time=time, xi=self._without_parts(at.vanishing, self.second.xi)
            )
        self.vector = None if at.along is None else self._motion_like(at.along)
        if at.contracted and self.vector is not None:
            self.first = self.vector
        turning = at.driven and bool(self.inputs_of("covector"))
        self.covector = [self.draw() if turning else Fraction(0) for _ in group.basis]
        acting = self.inputs_of("force", "torque")
        named = [numbers_of_input(data, self._acted_on(data)[1].n) for data in acting]
        given = {x: self.draw() if at.driven else Fraction(0) for names in named for x in names}
        self.input_forces = [tuple(given[x] for x in names) for names in named]
        self.parameters |= given | self.name_covector(self.covector)
        once = len(self.points) if few else listed_count(self)
        self.copies = [
            Fraction(1) if i < once else self.draw(positive=True) for i in range(len(self.points))
        ]
        self.draw_more()

    def draw_more(self) -> None:
        """What a kind of model draws beside this: nothing."""

    def _without_parts(self, parts: Collection[str], xi: Matrix) -> Matrix:
        """A random element of 𝔤 without these parts; ``xi`` where the group has none of them."""
        basis = self.group.basis
        rows = []
        for e in basis:
            linear = q.flatten(self.group.linear_part(e)) if LINEAR in parts else ()
            moved = self.group.affine and TRANSLATION in parts
            rows.append((*linear, *(row[-1] for row in e[:-1] if moved)))
        if not rows[0]:
            return xi
        kept = q.nullspace(q.transposed(tuple(rows)))
        total = q.scaled(Fraction(0), xi)
        for weights in kept:
            total = q.plus(total, q.scaled(self.draw(), self.group.hat(weights)))
        return total

    def _motion_like(self, along: Collection[str]) -> TangentVector:
        """X, with δt = 1 and the velocity of the motion in the parts ``along``, any in others."""
        free = self._without_parts(along, self.first.xi if self.at.contracted else self.algebra())
        xi = q.plus(self.Z, free) if along else free
        return TangentVector(Fraction(1), xi, self.algebra())

    @cached_property
    def nu(self) -> Matrix:
        """ν = g Z, the velocity of g."""
        return q.times(self.g, self.Z)

    # -- potential ----------------------------------------------------------------------------

    def potential(self, t: Any, r: list[Vector]) -> Any:
        """U(t, r): the problem's, or a random polynomial where the walk leaves it open."""
        if self.any_potential:
            return self.any_potential.energy(t, r)
        return self.applied.potential(t, r, self.masses)

    # -- Lagrangian, Cartan form and its derivative --------------------------------------------

    def lagrangian(self, t: Any, g: Matrix, nu: Matrix) -> Any:
        """L̃(t, g, ν) = L at the moved points: equation (3)."""
        return self.pairing(nu, nu) * Fraction(1, 2) - self.potential(t, self.images(g))

    def momentum(self, nu: Matrix, w: Matrix) -> Any:
        """p̃(w), the derivative of L̃ along the velocity: Σ m_i ⟨v_i, w r_i⟩, as ½ ‖v‖² has it."""
        return self.pairing(nu, w)

    def energy(self, t: Any, g: Matrix, nu: Matrix) -> Any:
        """h̃ = p̃(ν) − L̃."""
        return self.momentum(nu, nu) - self.lagrangian(t, g, nu)

    def family(self, a: TangentVector, b: TangentVector) -> tuple[Any, Matrix, Matrix]:
        """t, g and Z on a two-parameter family with these directions, to first order in each.

        The mixed part is arbitrary: dϖ does not depend on it, but δξ′ and δ′ξ do.
        """
        key = id(a), id(b)
        if key not in self._families:
            self._families[key] = (a, b), self._family(a, b)
        return self._families[key][1]

    def _family(self, a: TangentVector, b: TangentVector) -> tuple[Any, Matrix, Matrix]:
        e, f = nilpotent(EPS), nilpotent(EPS_PRIME)
        t = self.t + e * a.time + f * b.time + e * f * self.mixed.time
        Z = self.Z
        for weight, x in ((e, a.velocity), (f, b.velocity), (e * f, self.mixed.velocity)):
            Z = q.plus(Z, q.scaled(weight, x))
        return t, q.times(self.g, self.displaced(a, b)), Z

    @cached_property
    def varied_places(self) -> list[Vector]:
        """The moved points on the two-parameter family of δ and δ′, in nilpotent numbers."""
        return self.images(self.family(self.first, self.second)[1])

    @cached_property
    def varied(self) -> Matrix:
        """g₀⁻¹g on the two-parameter family of δ and δ′, a matrix of nilpotent numbers."""
        return self.displaced(self.first, self.second)

    def displaced(self, a: TangentVector, b: TangentVector) -> Matrix:
        """g₀⁻¹g = (1 + εξ_a)(1 + ε′ξ_b)(1 + εε′ξ_mixed) on the family of the directions a and b."""
        e, f = nilpotent(EPS), nilpotent(EPS_PRIME)
        g = one = q.identity(self.s)
        for weight, xi in ((e, a.xi), (f, b.xi), (e * f, self.mixed.xi)):
            g = q.times(g, q.plus(one, q.scaled(weight, xi)))
        return g

    def cartan(self, a: TangentVector) -> Any:
        """ϖ(δ) at the point."""
        momentum = self.momentum(self.nu, q.times(self.g, a.xi))
        return part(momentum - self.energy(self.t, self.g, self.nu) * a.time, 0)

    def exterior(self, a: TangentVector, b: TangentVector) -> Any:
        """dϖ(δ, δ′) = δ[ϖ(δ′)] − δ′[ϖ(δ)] on the family."""
        t, g, Z = self.family(a, b)
        nu = q.times(g, Z)
        energy = self.energy(t, g, nu)

        def form(mask: int) -> Any:
            """ϖ on the derivative of the family in one parameter, a function of the other."""
            dt, dg = derivative_in(t, mask), derivative_of(g, mask)
            return self.momentum(nu, dg) - energy * dt

        return part(form(EPS_PRIME), EPS) - part(form(EPS), EPS_PRIME)

    # -- forces and the motion -------------------------------------------------------------------

    def work(self, w: Matrix) -> Fraction:
        """dŨ(w), for a tangent matrix w at g."""
        shifted = q.plus(self.g, q.scaled(nilpotent(ETA), w))
        value = self.potential(self.t, self.images(shifted))
        return Nilpotent.of(value).part(ETA)

    @cached_property
    def forces(self) -> list[Vector]:
        """F_i = −∂U/∂r_i for each point, in space."""
        if self.any_potential:
            return self.any_potential.forces
        return self.applied.forces(self.t, self.images(self.g), self.masses)

    @cached_property
    def given_forces(self) -> list[Vector]:
        """The force on each point, in space, by force inputs."""
        total = [[Fraction(0)] * self.n for _ in self.points]
        linear = self.group.linear_part(self.g)
        for u, data in self._given():
            found = self._along(u, data, "direction" if "kind" in data else "force")
            if data.get("kind") == "torque" or not found:
                continue
            block, _ = self._acted_on(data)
            inside = q.column(self.group.in_block(block, found))
            force = q.times(linear, inside) if data["frame"] == "body" else inside
            for k, (x,) in enumerate(force):
                total[data["on"] - 1][k] += x
        return [tuple(f) for f in total]

    @cached_property
    def couple(self) -> Matrix:
        """The skew matrix N in the body of all torques that are given: their power is Tr Z N̄, as
        that of two opposite forces ±½j(τ)a at ±a, on axes a of length 1."""
        n, group = self.n, self.group
        total = q.scaled(Fraction(0), q.identity(n))
        linear = group.linear_part(self.g)
        for u, data in self._given():
            key = "direction" if data.get("kind") == "torque" else "moment"
            if key == "moment" and not data.get(key):
                continue
            block, factor = self._acted_on(data)
            torque, at = self._along(u, data, key), group.of_block(block)
            turn = tuple(row[at] for row in linear[at])
            body = turn if data["frame"] == "space" else q.identity(factor.n)
            planes = [(0, 1)] if factor.n == 2 else [(1, 2), (2, 0), (0, 1)]
            for x, (i, j) in zip(torque, planes, strict=True):
                across = q.times(q.column(body[j]), (body[i],))
                skew = q.scaled(x * Fraction(1, 2), q.minus(across, q.transposed(across)))
                for row, column in product(range(factor.n), repeat=2):
                    place = q.unit(n, at.start + row, at.start + column)
                    total = q.plus(total, q.scaled(skew[row][column], place))
        return total

    def work_of_couple(self, xi: Matrix) -> Any:
        """The work of all torques that are given in a displacement g ξ."""
        return q.dot(q.flatten(self.couple), q.flatten(self.group.linear_part(xi)))

    def _given(self) -> Iterator[tuple[tuple[Any, ...], Mapping[str, Any]]]:
        """The forces and torques that are given, each with its numbers, and those that are stated,
        which have none."""
        yield from zip(self.input_forces, self.inputs_of("force", "torque"), strict=True)
        if self.at.driven and not self.generic:
            yield from (((Fraction(1),), x) for x in self.problem.get("forces", ()))

    def _acted_on(self, data: Mapping[str, Any]) -> tuple[int, Group]:
        """The block, from 1, on which a force or torque acts, and its factor."""
        block = int(data["block"]) if "block" in data else self.blocks[data["on"] - 1]
        return block, self.group.places[block - 1][1]

    def _along(self, u: tuple[Any, ...], data: Mapping[str, Any], key: str) -> tuple[Any, ...]:
        """The vector that an input's numbers are, or of which its one number is the multiple."""
        if key not in data:
            return u
        return tuple(u[0] * evaluate(decode(x, key), self.of_state) for x in data[key])

    @cached_property
    def of_state(self) -> Environment:
        """The environment of expressions of the state: of t, the entries of g and of the velocity,
        places and their velocities."""
        group, places = self.group, [q.column(x) for x in self.images(self.g)]
        names: dict[str, Any] = {"t": self.t, "π": self.pi}
        for g, linear, translation in ((self.g, "A", "T"), (self.Z, "Z", "w")):
            names[linear] = group.linear_part(g)
            if group.affine:
                names[translation] = group.translation_part(g)
        if group.turns_space:
            names["ζ"] = q.column(group.nearest(self.Z)[:3])
        moving: dict[tuple[int, ...], Any] = {
            (i,): q.column(x) for i, x in enumerate(self.images(self.nu), 1)
        }
        return replace(
            self.expressions,
            names=names,
            families={"v": moving},
            functions={"r": lambda head, *_: places[head[2] - 1]},
            listed=len(places),
        )

    @cached_property
    def nonpotential_forces(self) -> list[Vector]:
        """The force on each point, in space, by force inputs and damping together."""
        total = [[*f] for f in self.given_forces]
        if self.at.driven:
            velocities = self.images(self.nu)
            for i, kappa in damping_members(self).items():
                for k, x in enumerate(velocities[i - 1]):
                    total[i - 1][k] -= kappa * x
        return [tuple(f) for f in total]

    @cached_property
    def input(self) -> list[Fraction]:
        """The values u(E_a) on the basis of the covector of all inputs and damping."""
        found = []
        for u, e in zip(self.covector, self.group.basis, strict=True):
            pairs = zip(self.nonpotential_forces, self.images(q.times(self.g, e)), strict=True)
            found.append(u + sum((q.dot(f, v) for f, v in pairs), self.work_of_couple(e)))
        return found

    @cached_property
    def metric(self) -> Matrix:
        """The d × d matrix of the kinetic energy's metric at g on the basis."""
        return self.metric_matrix([q.times(self.g, e) for e in self.group.basis])

    def solve_metric(self, covector: list[Fraction]) -> Matrix:
        """The element of 𝔤, as a matrix, that the kinetic metric at g sends to a covector, by its
        values on the basis; ``ZeroDivisionError`` where the metric is singular."""
        solution = q.solve(self.metric, q.column(covector))
        if solution is None:
            raise ZeroDivisionError("the kinetic metric is singular at this point")
        return self.group.hat([row[0] for row in solution])

    def as_indeterminates(self, x: Matrix, slots: int) -> Matrix:
        """A matrix that was found by solving, as one of new indeterminates of ``slots`` indices
        where any forces act: what they are is then as free as it is."""
        if not self.generic:
            return x
        return tuple(tuple(with_slots(y, slots) for y in row) for row in x)

    @cached_property
    def acceleration(self) -> Matrix:
        """Ż by d'Alembert: Σ ⟨m_i a_i − F_i, v′_i⟩ = u(ξ′) for every ξ′, with a = g(Ż + Z²)r."""
        if self.at.free_acceleration and self.vector is not None:
            return self.vector.velocity
        centripetal = q.times(self.g, q.times(self.Z, self.Z))
        covector = []
        for u, e in zip(self.input, self.group.basis, strict=True):
            displacement = q.times(self.g, e)
            covector.append(u - self.work(displacement) - self.pairing(centripetal, displacement))
        return self.as_indeterminates(self.solve_metric(covector), RATE_SLOTS)

    @cached_property
    def gradient(self) -> Matrix:
        """f in 𝔤, with ⟨A f, A ξ⟩ = −dŨ(A ξ) for every ξ: the metric sends A f to −dŨ."""
        covector = [-self.work(q.times(self.g, e)) for e in self.group.basis]
        return self.as_indeterminates(self.solve_metric(covector), 2 * RATE_SLOTS)

    @property
    def motion(self) -> TangentVector:
        """X, with δt = 1: the direction of the motion, or the random vector that stands for it."""
        return self.vector or TangentVector(Fraction(1), self.Z, self.acceleration)
