"""What acts on a body from outside dϖ, at one exact random point: forces and torques at its
places; of what flows in it its thrust, and what the flow inside acts by, from the moments of
the body at two times further on.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any, NamedTuple

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.reserved import (
    UNNAMED_DAMPING,
    UNNAMED_FORCE,
    acting_in,
    numbers_of_input,
    suffixed,
)
from ...record.as_json import decode
from ..values.arithmetic import EPS, ETA, Nilpotent, nilpotent
from ..values.draws import integral, onward
from ..values.evaluate import Environment, evaluate
from .phase_point import PhasePoint
from .point_masses import Body, Vector, damping_members, outer_sum, scaled_each

Given = tuple[tuple[Any, ...], Mapping[str, Any]]
"""The numbers of what acts, and what the record tells of it."""


class GivenForces(PhasePoint):
    """The forces and torques of a point, whatever gives the Lagrangian; ``points`` are the places
    that have numbers, and others, and ``blocks`` those of the group that move them."""

    points: list[Vector]
    blocks: list[int]
    input_forces: list[tuple[Any, ...]]

    @abstractmethod
    def images(self, g: Matrix) -> list[Vector]:
        """The places in space of the points moved by g; for a tangent matrix their velocities."""

    def with_places(self, names: Mapping[str, Any]) -> Environment:
        """The environment of expressions of these names, of places and of their velocities."""
        places = [q.column(x) for x in self.images(self.g)]
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

    def draw_inputs(self) -> None:
        """Draw the numbers of forces and torques, which have names, and scalars."""
        acting = self.inputs_of("force", "torque")
        named = [numbers_of_input(data, self.acted_on(data)[1].n) for data in acting]
        driven = self.at.driven
        scalars = [x["name"] for x in self.inputs_of("scalar")]
        drawn = [*(x for names in named for x in names), *scalars]
        given = {x: self.draw() if driven else Fraction(0) for x in drawn}
        self.input_forces = [tuple(given[x] for x in names) for names in named]
        self.parameters |= given

    def hold(self, values: Mapping[str, Any]) -> None:
        """Let inputs have these values by their names, those of a covector on the basis that the
        problem states, and 0 where none is given, in the place of what was drawn."""
        acting = self.inputs_of("force", "torque")
        known = dict.fromkeys(self.parameters, Fraction(0)) | {**values}
        named = [numbers_of_input(data, self.acted_on(data)[1].n) for data in acting]
        self.input_forces = [tuple(known[x] for x in names) for names in named]
        scalars = {x["name"]: known[x["name"]] for x in self.inputs_of("scalar")}
        self.parameters |= {**scalars, **values}
        for data in self.inputs_of("covector"):
            basis = self.group.in_user_basis.basis
            rows = q.matrix([self.group.nearest(e) for e in basis])
            own = [known[suffixed(data["name"], a)] for a, _ in enumerate(basis, 1)]
            self.covector = [x for (x,) in q.solve(rows, q.column(own)) or ()]

    @cached_property
    def given_forces(self) -> list[Vector]:
        """The force on each point, in space, by force inputs."""
        return self._forces_of(self._given())

    def _forces_of(self, acting: Iterable[Given]) -> list[Vector]:
        total = [[Fraction(0)] * self.n for _ in self.points]
        linear = self.group.linear_part(self.g)
        for u, data in acting:
            found = self._along(u, data, "direction" if "kind" in data else "force")
            if data.get("kind") == "torque" or not found:
                continue
            block, _ = self.acted_on(data)
            inside = q.column(self.group.in_block(block, found))
            force = q.times(linear, inside) if data["frame"] == "body" else inside
            for k, (x,) in enumerate(force):
                total[data["on"] - 1][k] += x
        return [tuple(f) for f in total]

    @cached_property
    def couple(self) -> Matrix:
        """The skew matrix N in the body of all torques that are given: their power is Tr Z N̄, as
        that of two opposite forces ±½j(τ)a at ±a, on axes a of length 1."""
        return q.plus(self.moments_of_flow, self._couple_of(self._given()))

    def _couple_of(self, acting: Iterable[Given]) -> Matrix:
        n, group = self.n, self.group
        total, linear = q.scaled(Fraction(0), q.identity(n)), group.linear_part(self.g)
        for u, data in acting:
            key = "direction" if data.get("kind") == "torque" else "moment"
            if key == "moment" and not data.get(key):
                continue
            block, factor = self.acted_on(data)
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

    def flow_forces(self, name: str) -> list[tuple[int, Matrix]]:
        """The forces in the body, on its points by their numbers from 1, of flows of a name; what
        flows inside has none."""
        del name
        return []

    @property
    def moments_of_flow(self) -> Matrix:
        """What flows inside the body has of moments: none where nothing flows."""
        return q.scaled(Fraction(0), q.identity(self.n))

    def work_of(self, forces: Iterable[Vector], w: Matrix) -> Any:
        """The work of forces on the points, in space, in a displacement of g, a tangent matrix."""
        return sum(map(q.dot, forces, self.images(w)), Fraction(0))

    def work_of_couple(self, xi: Matrix, couple: Matrix | None = None) -> Any:
        """The work of all torques that are given, or of a ``couple``, in a displacement g ξ."""
        N = self.couple if couple is None else couple
        return q.dot(q.flatten(N), q.flatten(self.group.linear_part(xi)))

    def power(self) -> Any:
        """That of all that acts."""
        return sum(map(self.power_of, acting_in(self.problem)), Fraction(0))

    def power_of(self, name: str) -> Any:
        """The power of what acts by a name: of forces by the velocities of their points in space,
        of torques by that of the body, of covectors by that of 𝔤; ``KeyError`` where nothing
        does."""
        acting = [(u, x) for u, x in self._given() if (x.get("name") or UNNAMED_FORCE) == name]
        dual = [x for own, x in self.covectors() if (own or UNNAMED_FORCE) == name]
        damped = damping_members(self) if name == UNNAMED_DAMPING and self.at.driven else {}
        flowing = self.flow_forces(name)
        if not (acting or dual or damped or flowing):
            raise KeyError(name)
        velocities, turned = self.images(self.nu), q.times(q.inverted(self.g), self.nu)
        power = self.work_of_couple(turned, self._couple_of(acting))
        power += self.work_of(self._forces_of(acting), self.nu)
        linear = self.group.linear_part(self.g)
        for i, force in flowing:
            power += q.dot(q.flatten(q.times(linear, force)), velocities[i - 1])
        if flowing and name == UNNAMED_FORCE:
            power += self.work_of_couple(turned, self.moments_of_flow)
        for i, kappa in damped.items():
            power -= kappa * q.dot(velocities[i - 1], velocities[i - 1])
        return power + sum((q.dot(x, self.group.nearest(self.Z)) for x in dual), Fraction(0))

    def _given(self) -> Iterator[Given]:
        """The forces and torques that are given, each with its numbers, and those that are stated,
        which have none."""
        yield from zip(self.input_forces, self.inputs_of("force", "torque"), strict=True)
        if self.at.driven and not self.generic:
            stated = (x for x in self.problem.get("forces", ()) if "on" in x)
            yield from (((Fraction(1),), x) for x in stated)

    def acted_on(self, data: Mapping[str, Any]) -> tuple[int, Group]:
        """The block, from 1, on which a force or torque acts, or where an output is read, and its
        factor."""
        block = self.blocks[data["on"] - 1] if "on" in data else int(data.get("block", 1))
        return block, self.group.places[block - 1][1]

    def _along(self, u: tuple[Any, ...], data: Mapping[str, Any], key: str) -> tuple[Any, ...]:
        """The vector that an input's numbers are, or of which its one number is the multiple."""
        if key not in data:
            return u
        return tuple(u[0] * evaluate(decode(x, key), self.of_state) for x in data[key])


class Flowing(NamedTuple):
    """Forces in the body on its points, by their numbers from 1, those of the thrusts first, and a
    matrix N of moments."""

    forces: list[tuple[int, Matrix]]
    moments: Matrix


def flowing(model: Body, Z: Matrix) -> Flowing:
    """What flows with the velocity ``Z`` of the body, its linear part, in every block."""
    flows = model.problem["flows"]
    env = onward(model.expressions, flows, model.t, nilpotent(ETA) + nilpotent(EPS))
    thrusts, within = [], []
    for x in flows:
        rate = _value(x["rate"], env)
        u = [rate * _value(y, env) for y in x["velocity"]]
        push = q.column(model.group.in_block(model.blocks[x["on"] - 1], u))
        thrusts.append((x["on"], _part(push, 0)))
    moments = q.scaled(Fraction(0), q.identity(model.n))
    for block in dict.fromkeys(model.blocks):
        found = _flowing_inside(model, block, Z, env)
        within += found.forces
        moments = q.plus(moments, found.moments)
    return Flowing([*thrusts, *within], moments)


def _flowing_inside(model: Body, block: int, Z: Matrix, env: Environment) -> Flowing:
    """What flows inside the body of a block, its force on the first point there.

    A particle of the flow inside has Coriolis' acceleration 2Zv and its own rate; with Σ ρ v = p
    and Σ ρ (v r̄ + r v̄) = Q their moments are ZQ, less what is symmetric: −½ (ZQ + QZ).
    """
    group, step = model.group, nilpotent(ETA) + nilpotent(EPS)
    at = group.of_block(block) if group.factors else slice(None)
    own = tuple(row[at] for row in Z[at])
    first, second = _moments(model, block, env)
    push, on, steady = q.scaled(Fraction(-1), first), 1 + model.blocks.index(block), False
    for x in model.problem["flows"]:
        if model.blocks[x["on"] - 1] == block:
            steady = x.get("steady", False)
            place = model.points[x["on"] - 1][at]
            gone = integral(_value(x["rate"], env), step)
            push = q.plus(push, q.scaled(gone, q.column(place)))
            second = q.minus(second, q.scaled(gone, outer_sum([place], [place])))
    p, Q = q.scaled(Fraction(-1), _part(push, ETA)), _part(second, ETA)
    inside = q.scaled(Fraction(-2), q.times(own, p))
    if not steady:
        inside = q.plus(inside, _part(push, ETA | EPS))
    turning = q.scaled(Fraction(-1, 2), q.plus(q.times(own, Q), q.times(Q, own)))
    within, moments = (
        q.transposed(tuple(group.in_block(block, x) for x in q.transposed(y)))
        for y in (inside, turning)
    )
    moments = tuple(group.in_block(block, row) for row in moments)
    # carried from the origin to the point
    arm = group.in_block(block, model.points[on - 1][at])
    back = q.times(within, (arm,))
    if group.factors:  # C is not 1
        g: Matrix = model.g
        back = q.times(q.times(q.transposed(g), g), back)
    return Flowing([(on, within)], q.minus(moments, back))


def _moments(model: Body, block: int, env: Environment) -> tuple[Matrix, Matrix]:
    """Σ m r and Σ m r r̄ of a block in an environment, of listed points or as they are given."""
    body: Mapping[str, Any] = model.problem["body"]
    if body["kind"] == "given":
        given = body["given"]
        rows = tuple(tuple(_value(x, env) for x in row) for row in given["J"])
        return q.column(tuple(_value(x, env) for x in given["c"])), rows
    at = model.group.of_block(block) if model.group.factors else slice(None)
    listed = [k for k, _ in enumerate(body["points"]) if model.blocks[k] == block]
    masses = [_value(body["points"][k]["mass"], env) for k in listed]
    places = [model.points[k][at] for k in listed]
    weighted = scaled_each(masses, places)
    return outer_sum(weighted, [(Fraction(1),)] * len(masses)), outer_sum(weighted, places)


def _value(tree: Any, env: Environment) -> Any:
    return evaluate(decode(tree, "flow"), env)


def _part(x: Matrix, index: int) -> Matrix:
    return tuple(tuple(Nilpotent.of(y).part(index) for y in row) for row in x)
