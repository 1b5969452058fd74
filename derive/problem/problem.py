"""A problem: group, body, potentials, inputs, parameters, as data."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from ..algebra.groups import Group
from ..algebra.structure import TorusLattice
from ..language.limits import Refused
from ..language.reserved import numbers_of_input, numbers_of_output, rate_of_mass
from ..language.tree import Tree, add
from ..schema.body_kinds import AnyBody, Body, MomentBody, NoBody, Place, Point
from ..schema.force_kinds import (
    Acting,
    CovectorInput,
    Damping,
    Flow,
    ForceInput,
    Input,
    LaplacianDamping,
    StatedCovector,
    StatedForce,
    TorqueInput,
)
from ..schema.kind import GROUP, Advected, Fluid, Kinematics, Lagrangian, Parameter
from ..schema.motion_kinds import Event, Output, Signal
from ..schema.potential_kinds import Potential
from ..schema.table import Table


class ProblemError(Refused, ValueError):
    """Bad input: the message names the key and the remedy."""


class SolidError(ValueError):
    """What is wrong with a solid, in one line."""


@dataclass(frozen=True)
class Initial:
    """Where a motion starts: ``numbers`` of the state and inputs by name, expressions of the
    parameters; the element of the group is exp of ``exp``, coordinates in the basis of 𝔤."""

    numbers: Mapping[str, Tree] = field(default_factory=dict)
    exp: tuple[Tree, ...] = ()

    def trees(self) -> list[Tree]:
        """All expressions."""
        return [*self.numbers.values(), *self.exp]


@dataclass(frozen=True)
class Problem:
    """``group`` is ``None`` for the general text: any group with the given ``action``.

    ``frame``: what its parameters stand for, if it is in a principal frame (``principal.py``).
    ``signed``: masses may be negative, so that nothing is said of the sign of the metric.
    ``lagrangian``: one that no points give; the group then acts by matrices on (r, 1).
    ``advected``: what the algebra carries along, where the state has no element of the group; the
    last blocks of the group's matrices. ``fluid``: of a problem whose group has no matrices.
    ``torus``: su(N) in the basis of the torus, where there is no table of the group; ``damping`` is
    of its modes there.
    ``flows``: of mass that leaves or comes; how it pushes is among ``forces``.
    ``kinematics``: ġ as a function of g, where there is no Lagrangian.
    ``initial``, ``events``, ``signals``: of motions that are followed; the record of the equations
    has none of them.
    """

    name: str
    group: Group | None
    action: str = "linear"
    title: str = ""
    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    body: Body | None = None
    potentials: tuple[Potential, ...] = ()
    inputs: tuple[Input, ...] = ()
    places: tuple[Place, ...] = ()
    damping: tuple[Damping | LaplacianDamping, ...] = ()
    forces: tuple[Acting, ...] = ()
    outputs: tuple[Output, ...] = ()
    frame: Mapping[str, Any] | None = None
    signed: bool = False
    lagrangian: Lagrangian | None = None
    advected: tuple[Advected, ...] | None = None
    torus: TorusLattice | None = None
    fluid: Fluid | None = None
    flows: tuple[Flow, ...] = ()
    kinematics: Kinematics | None = None
    initial: Initial = field(default_factory=Initial)
    events: tuple[Event, ...] = ()
    signals: tuple[Signal, ...] = ()

    def __repr__(self) -> str:
        return f"<problem {self.name}: {self.group_name}>"

    @property
    def group_name(self) -> str:
        """The name of the group, or that it is any."""
        if self.fluid:
            return GROUP
        moved = self.group or self.torus
        return moved.name if moved else "any group"

    @property
    def own_group(self) -> Group:
        """The group, of a problem that has one."""
        assert self.group is not None
        return self.group

    @property
    def own_lagrangian(self) -> Lagrangian:
        """The Lagrangian that no points give, of a problem that has one."""
        assert self.lagrangian is not None
        return self.lagrangian

    @property
    def without_matrices(self) -> str:
        """Why the problem has no group of matrices, for messages."""
        return (
            "the group of a fluid has no matrices" if self.fluid else "this text is about any group"
        )

    @property
    def with_matrices(self) -> str:
        """What to choose instead of a problem without, for messages."""
        finite = "zeitlin (a fluid on a torus) or dirichlet (an ellipsoid of fluid)"
        return f"choose {finite if self.fluid else 'a problem with a group and a body'}"

    @property
    def unsearched(self) -> str:
        """Why nothing is searched for in a problem without a group of matrices, for messages."""
        if self.torus:
            why = (
                f"; how the energy and Tr Wᵏ change by what acts: step {self.name}.power"
                if self.inputs or self.damping
                else f", which keeps the energy and Tr Wᵏ: step {self.name}.conserved"
            )
            return (
                f"{self.name}: symmetries, integrals, equilibria and reductions are not written "
                f"for the torus{why}"
            )
        if self.kinematics:
            return (
                f"{self.name}: kinematics of first order have no Lagrangian, in which symmetries, "
                "integrals, equilibria and reductions are sought"
            )
        return f"{self.name}: {self.without_matrices}; {self.with_matrices}"

    @property
    def affine(self) -> bool:
        """Does the group translate?"""
        return self.action == "affine"

    @property
    def masses(self) -> int:
        """How many points have a mass of their own."""
        return len(self.points)

    @property
    def points(self) -> tuple[Point, ...]:
        """The point masses, alone or among solids."""
        return points_of(self.body)

    @property
    def homogeneous(self) -> bool:
        """Is it an affine group that is kept as a linear one on (r, 1)?"""
        return bool(self.group and len(self.group.factors) == 1)

    def block(self, i: int) -> int:
        """The factor of a product that moves point i, counted from 1."""
        listed: tuple[Point | Place, ...] = (*self.points, *self.places)
        return listed[i - 1].block

    @property
    def covector(self) -> CovectorInput | None:
        """The covector input, if there is one."""
        return next((i for i in self.inputs if isinstance(i, CovectorInput)), None)

    @property
    def force_inputs(self) -> tuple[ForceInput | TorqueInput, ...]:
        """The inputs that are forces and torques."""
        return tuple(i for i in self.inputs if isinstance(i, ForceInput | TorqueInput))

    @property
    def damped_points(self) -> list[tuple[Tree, int]]:
        """The coefficients of damping, each with a point that it acts on."""
        return [(x.coefficient, i) for x in self.damping if isinstance(x, Damping) for i in x.on]

    @property
    def stated_forces(self) -> tuple[Acting, ...]:
        """The forces of the state without those of flows."""
        return tuple(x for x in self.forces if not x.table.startswith("flow"))

    @property
    def force_tables(self) -> list[dict[str, Any]]:
        """Of each force of the state but those of flows the ``table`` of the file, as "damping 1",
        and the ``wind`` that its v is relative to, which a record has in the expressions."""
        return [
            {"table": x.table or f"force {k}", "wind": getattr(x, "relative_to", ())}
            for k, x in enumerate(self.stated_forces, 1)
        ]

    @property
    def placed_forces(self) -> tuple[StatedForce, ...]:
        """The forces of the state that act at a place, by their numbers where these have names."""
        return tuple(x.by_name() for x in self.forces if isinstance(x, StatedForce))

    @property
    def stated_covectors(self) -> tuple[StatedCovector, ...]:
        """The covectors of the state, by their numbers where these have names."""
        return tuple(x.by_name() for x in self.forces if isinstance(x, StatedCovector))

    @property
    def named_numbers(self) -> dict[str, Tree]:
        """The numbers of the forces of the state that have names, and the rates of masses that are
        of the state, with their expressions."""
        found = {name: t for x in self.forces for name, t in x.numbers().items()}
        return found | {rate_of_mass(x): t for x, t in self.stored.items()}

    @property
    def stored(self) -> dict[str, Tree]:
        """The masses that are numbers of the state, in order, each with its rate."""
        return masses_of_state(self.flows)

    @property
    def driven(self) -> bool:
        """Are there functions of time and state that act from outside dϖ?"""
        return bool(self.inputs or self.forces)

    @property
    def timed(self) -> bool:
        """Does U depend on the time by itself?"""
        return any(_timed(t) for p in self.potentials for t in p.trees())

    def acted_on(self, x: ForceInput | TorqueInput | StatedForce) -> tuple[int, Group]:
        """The block, counted from 1, on which a force or a torque acts, with its factor."""
        block = x.block if isinstance(x, TorqueInput) else self.block(x.on)
        return block, self.own_group.places[block - 1][1]

    def numbers_of(self, x: Input) -> list[str]:
        """The names of the numbers of an input."""
        if self.torus:
            return [f"{x.name}_{coefficient}" for coefficient in self.torus.coefficients]
        size = self.own_group.dimension
        if isinstance(x, ForceInput | TorqueInput):
            size = self.acted_on(x)[1].n
        return numbers_of_input(x.plain(), size)

    def block_of(self, told: Mapping[str, Any]) -> int:
        """The block of a product at which what is ``told``, as in a record, is read."""
        return self.block(told["on"]) if "on" in told else int(told.get("block", 1))

    def numbers_of_output(self, x: Output) -> list[str]:
        """The names of the numbers of an output."""
        _, factor = self.own_group.places[self.block_of(x.plain()) - 1]
        return numbers_of_output(x.plain(), factor.n)


def masses_of_state(flows: Iterable[Flow]) -> dict[str, Tree]:
    """The masses that flows say to be numbers of the state, in order, each with its rate."""
    found: dict[str, Tree] = {}
    for x in flows:
        if x.mass:
            found[x.mass] = add(found.get(x.mass, 0), x.rate)
    return found


def _timed(t: Tree) -> bool:
    """Does t stand in a tree outside the places r_i(t)?"""
    if not isinstance(t, tuple):
        return t == "t"
    return t[0] != "call" and any(map(_timed, t[1:]))


def points_of(body: Body | None) -> tuple[Point, ...]:
    """The points of a body that have a mass, if any are listed."""
    return () if body is None or isinstance(body, MomentBody) else body.points or ()


# A problem as the record has it: plain data, trees as they are.


def data(problem: Problem) -> dict[str, Any]:
    """What the record says of the problem; trees as they are."""
    return {
        "name": problem.name,
        "title": problem.title,
        "group": problem.group_name,
        "action": problem.action,
        "homogeneous": problem.homogeneous,
        "parameters": {k: p.plain() for k, p in problem.parameters.items()},
        "body": _body(problem).plain(),
        "potentials": [*_plain(problem.potentials)],
        "inputs": [*_plain(problem.inputs)],
        "places": [*_plain(problem.places)],
        "damping": [*_plain(problem.damping)],
        **({"forces": [*_plain(problem.stated_forces)]} if problem.stated_forces else {}),
        **({"flows": [*_plain(problem.flows)]} if problem.flows else {}),
        **({"outputs": [*_plain(problem.outputs)]} if problem.outputs else {}),
        **({"frame": dict(problem.frame)} if problem.frame else {}),
        **({"masses": "of any sign"} if problem.signed else {}),
        **({"lagrangian": problem.lagrangian.plain()} if problem.lagrangian else {}),
        **({"fluid": problem.fluid.plain()} if problem.fluid else {}),
        **({"lagrangian": {"trivialisation": "right"}} if problem.torus else {}),
        **({"torus": {"N": problem.torus.N}} if problem.torus else {}),
        **({"kinematics": problem.kinematics.plain()} if problem.kinematics else {}),
        **({} if problem.advected is None else {"advected": [*_plain(problem.advected)]}),
    }


def _plain(tables: Iterable[Table]) -> Iterator[dict[str, Any]]:
    return (x.plain() for x in tables)


def _body(problem: Problem) -> Table:
    """The body, or why there is none."""
    given = problem.lagrangian or problem.torus or problem.fluid or problem.kinematics
    return problem.body or (NoBody() if given else AnyBody())
