"""What the names of a record mean, computed from equation (3) alone, at one exact random point."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from fractions import Fraction
from functools import cached_property
from itertools import chain, repeat
from typing import Any

from ...algebra.groups import Group
from ...algebra.samplers import RandomSource
from ...language import rational as q
from ...language.rational import Matrix
from ...language.reserved import UNNAMED_FORCE
from ...record.record import RecordError
from ..values.arithmetic import ETA, Nilpotent, nilpotent, part
from ..values.draws import Locus, at_time
from ..values.evaluate import Environment
from .given_forces import Flowing, GivenForces, flowing
from .phase_point import ENTRY
from .point_masses import (
    AnyPotential,
    Body,
    PotentialData,
    Vector,
    damping_members,
    listed_count,
    minus_gradient,
    points_later,
)
from .potential_accounts import ACCOUNTS, Account, uses_body_axes


class AppliedForces(PotentialData):
    """The potentials of a problem and their forces."""

    @cached_property
    def single(self) -> list[Mapping[str, Any]]:
        """Those that the walk does not sum up in words: the terms of U_Q."""
        return [p for p in self.potentials if not self._summed(p)]

    def _summed(self, p: Mapping[str, Any]) -> bool:
        account = _account(p)
        return account.values is not None and account.summed(self, p)

    def members(self) -> Iterator[tuple[Any, list[Mapping[str, Any]]]]:
        """The accounts of kinds of which some are summed up, with these."""
        for kind, account in ACCOUNTS.items():
            found = [p for p in self.potentials if p["kind"] == kind and self._summed(p)]
            if found:
                yield account, found

    def potential(
        self, t: Any, r: Sequence[Vector], masses: Sequence[Any], *, single: bool = False
    ) -> Any:
        """U(t, r); ``single``: U_Q, the part of it point by point."""
        chosen, at = self.single if single else self.potentials, self.at_time(t)
        return sum((_account(p).energy(at, p, r, masses) for p in chosen), Fraction(0))

    def at_time(self, t: Any) -> AppliedForces:
        """The same at another time."""
        return AppliedForces(self.problem, self.group, self.blocks, at_time(self.env, t))

    def forces(
        self, t: Any, r: Sequence[Vector], masses: Sequence[Any], *, single: bool = False
    ) -> list[Vector]:
        """−∂U/∂r_i for every point, of all of U or of U_Q."""
        return minus_gradient(lambda places: self.potential(t, places, masses, single=single), r)

    def radial(self, r: Sequence[Vector], masses: Sequence[Any]) -> list[tuple[Vector, Fraction]]:
        """d_e and σ_e = −2 dU/d‖d‖² of the elements that are functions of a distance, in order."""
        eta = nilpotent(ETA)
        return [
            (d, -2 * part(Nilpotent.of(energy(q.dot(d, d) + eta)), ETA))
            for p in self.single
            if (radial := _account(p).radial)
            for d, energy in radial(self, p, r, masses)
        ]


def _account(p: Mapping[str, Any]) -> Account:
    """The checker's account of a potential."""
    if p["kind"] not in ACCOUNTS:
        raise RecordError(f"unknown potential {str(p['kind'])[:20]!r}")
    return ACCOUNTS[p["kind"]]


class Model(Body, GivenForces):
    """One random point of the evolution space of a problem whose Lagrangian points give.

    ``generic``: the potential is any polynomial; ``few``: no more points than are needed, and each
    of them once; all that is ``drawn``: see :class:`Draws`.
    """

    applied: AppliedForces

    def __init__(
        self,
        problem: Mapping[str, Any],
        group: Group,
        random: RandomSource,
        size: int,
        at: Locus,
        **drawn: Any,
    ):
        super().__init__(problem, group, random, size, **drawn)
        self.s = group.size
        self.embody(principal=at.principal, axes=uses_body_axes(problem))
        self.stand(at, inside=at.inside and group.has_inner_samples)
        env = at_time(self.expressions, self.t)
        self.applied = AppliedForces({} if self.generic else problem, group, self.blocks, env)
        places = self.images(self.g)
        self.any_potential = AnyPotential(self, self.t, places) if self.generic else None
        self.Z = self.algebra()
        self.vary()
        self.aim(at_random=True)
        self.draw_inputs()
        once = listed_count(self) if self.spare else len(self.points)
        self.copies = [
            Fraction(1) if i < once else self.draw(positive=True) for i in range(len(self.points))
        ]
        self.draw_more()

    def draw_more(self) -> None:
        """What a kind of model draws beside this: nothing."""

    # -- potential ----------------------------------------------------------------------------

    def potential(self, t: Any, r: list[Vector]) -> Any:
        """U(t, r): the problem's, or a random polynomial where the walk leaves it open."""
        if self.any_potential:
            return self.any_potential.energy(t, r)
        return self.applied.potential(t, r, self.masses)

    def lagrangian(self, t: Any, g: Matrix, Z: Matrix) -> Any:
        """L̃(t, g, ν) = L at the moved points, ν = gZ: equation (3)."""
        nu = q.times(g, Z)
        return self.pairing(nu, nu) * Fraction(1, 2) - self.potential(t, self.images(g))

    def momentum(self, t: Any, g: Matrix, Z: Matrix, xi: Matrix) -> Any:
        """p̃(gξ), the derivative of L̃ along the velocity: Σ m_i ⟨v_i, gξr_i⟩, as ½ ‖v‖² has it."""
        return self.pairing(q.times(g, Z), q.times(g, xi))

    @cached_property
    def varied_places(self) -> list[Vector]:
        """The moved points on the two-parameter family of δ and δ′, in nilpotent numbers."""
        return self.images(self.varied.g)

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
    def of_state(self) -> Environment:
        """The environment of expressions of the state: of t, the entries of g and of the velocity,
        places and their velocities."""
        group = self.group
        names: dict[str, Any] = {"t": self.t, "π": self.pi}
        for g, linear, translation in ((self.g, "A", "T"), (self.Z, "Z", "w")):
            names[linear] = group.linear_part(g)
            if group.affine:
                names[translation] = group.translation_part(g)
        if group.turns_space:
            names["ζ"] = q.column(group.nearest(self.Z)[:3])
        return self.with_places(names)

    @cached_property
    def flow(self) -> Flowing | None:
        """What flows in the body pushes by this; ``None`` where nothing does."""
        flows = self.at.driven and not self.generic and self.problem.get("flows")
        return flowing(self, self.group.linear_part(self.Z)) if flows else None

    def flow_forces(self, name: str) -> list[tuple[int, Matrix]]:
        """Those of a name, with what flows inside among those without one."""
        names = [x.get("name", "") for x in self.problem["flows"]] if self.flow else []
        pairs = zip(self.flow.forces if self.flow else (), chain(names, repeat("")), strict=False)
        return [force for force, own in pairs if (own or UNNAMED_FORCE) == name]

    @cached_property
    def onward_body(self) -> Model:
        """The body a little later, where mass flows: other masses, and other points of moments."""
        if self.generic or not self.problem.get("flows"):
            return self
        found = copy(self)
        found.masses, found.points = points_later(self)
        return found

    @property
    def moments_of_flow(self) -> Matrix:
        """Those of what flows inside."""
        return self.flow.moments if self.flow else super().moments_of_flow

    @cached_property
    def nonpotential_forces(self) -> list[Vector]:
        """The force on each point, in space, by force inputs and damping together."""
        total = [[*f] for f in self.given_forces]
        if self.at.driven:
            velocities = self.images(self.nu)
            for i, kappa in damping_members(self).items():
                for k, x in enumerate(velocities[i - 1]):
                    total[i - 1][k] -= kappa * x
        if self.flow:
            for i, force in self.flow.forces:
                pushed = q.times(self.group.linear_part(self.g), force)
                total[i - 1] = [x + y for x, (y,) in zip(total[i - 1], pushed, strict=True)]
        return [tuple(f) for f in total]

    @cached_property
    def input(self) -> list[Fraction]:
        """The values u(E_a) on the basis of the covector of all inputs and damping."""
        return [
            u + self.work_of(self.nonpotential_forces, q.times(self.g, e)) + self.work_of_couple(e)
            for u, e in zip(self.acting_covector, self.group.basis, strict=True)
        ]

    @cached_property
    def metric(self) -> Matrix:
        """The d × d matrix of the kinetic energy's metric at g on the basis."""
        return self.metric_matrix([q.times(self.g, e) for e in self.group.basis])

    @cached_property
    def load(self) -> list[Any]:
        """By d'Alembert: Σ ⟨m_i a_i − F_i, v′_i⟩ = u(ξ′) for every ξ′, with a = g(Ż + Z²)r."""
        centripetal = q.times(self.g, q.times(self.Z, self.Z))
        covector = []
        for u, e in zip(self.input, self.group.basis, strict=True):
            displacement = q.times(self.g, e)
            covector.append(u - self.work(displacement) - self.pairing(centripetal, displacement))
        return covector

    @cached_property
    def gradient(self) -> Matrix:
        """f in 𝔤, with ⟨A f, A ξ⟩ = −dŨ(A ξ) for every ξ: the metric sends A f to −dŨ."""
        covector = [-self.work(q.times(self.g, e)) for e in self.group.basis]
        return self.as_letter(self.solved(self.metric, covector), 2 * ENTRY)
