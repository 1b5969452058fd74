"""The numbers that are read off a motion at one exact point, from its points alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.reserved import numbers_of_output, one_or_more, rate_of_mass
from ...record.as_json import decode
from ...record.record import RecordError
from ..values.draws import at_time
from ..values.evaluate import evaluate
from .point_masses import Vector, scaled_each

Data = Mapping[str, Any]


class Observed(Mapping[str, Any]):
    """The parameters of a model, and by their names the outputs of its problem, the numbers of its
    forces of the state and the powers of what acts, each found when it is first asked for."""

    def __init__(self, model: Any):
        self.model, self.known = model, dict(model.parameters)
        self.kinds: dict[str, Callable[[Data], Vector]] = {
            "place": lambda x: self.seen(x, model.images(model.g)[x["on"] - 1]),
            "velocity": lambda x: self.seen(x, model.images(model.nu)[x["on"] - 1]),
            "acceleration": lambda x: self.seen(x, accelerations(model)[x["on"] - 1]),
            "specific_force": self.specific_force,
            "rate": self.rate,
            "direction": self.direction,
            "distance": self.distance,
            "momentum": self.momentum,
            "tension": self.tension,
            "power": lambda x: (model.power_of(x["of"]) if x["of"] else model.power(),),
            "expression": self.expression,
            "rate of mass": lambda x: (sum(self.expression(x)),),
        }
        self.told: dict[str, Data] = {}
        for data in () if model.generic else model.problem.get("outputs", ()):
            names = numbers_of_output(data, self._acted_on(data)[1].n)
            self.told |= dict.fromkeys(names, data | {"names": names})
        flows = () if model.generic else model.problem.get("flows", ())
        for data in () if model.generic else (*model.problem.get("forces", ()), *map(_push, flows)):
            for name, tree in _numbers_of(data):
                told = {"name": name, "kind": "expression", "names": [name], "y": [tree]}
                self.told[name] = told
        stored = [x for x in flows if "mass" in x]
        for called in (rate_of_mass(x["mass"]) for x in stored):
            rates = [x["rate"] for x in stored if rate_of_mass(x["mass"]) == called]
            self.told[called] = {"kind": "rate of mass", "names": [called], "y": rates}

    def __getitem__(self, name: str) -> Any:
        if name not in self.known and name not in self.told and name.startswith("P_"):
            self.known[name] = self.model.power_of(name[1:].lstrip("_"))
        if name not in self.known:
            data = self.told[name]
            values = self.kinds[data["kind"]](data)
            if len(values) != len(data["names"]):
                raise RecordError(f"output {data['name'][:40]!r}: not {len(values)} numbers")
            self.known |= dict(zip(data["names"], values, strict=True))
        return self.known[name]

    def __iter__(self) -> Iterator[str]:
        return iter({**self.known, **self.told})

    def __len__(self) -> int:
        return len({**self.known, **self.told})

    def _acted_on(self, data: Data) -> tuple[int, Group]:
        """The block, from 1, where an output is read, and its factor."""
        model = self.model
        block = model.blocks[data["on"] - 1] if "on" in data else int(data.get("block", 1))
        return block, model.group.places[block - 1][1]

    def seen(self, data: Data, vector: Vector) -> Vector:
        """A vector of space, of its block in a product; its products with the images of the axes of
        the body where it is seen in this."""
        group, (block, _) = self.model.group, self._acted_on(data)
        at = group.of_block(block) if group.factors else slice(None)
        inside = vector[at]
        if data.get("frame", "body") == "space":
            return inside
        linear = group.linear_part(self.model.g)
        axes = q.transposed(tuple(row[at] for row in linear[at]))
        return tuple(q.dot(axis, inside) for axis in axes)

    def _given(self, data: Data, trees: Any) -> Vector:
        """A vector that the problem states, among those of all blocks."""
        block, _ = self._acted_on(data)
        at = at_time(self.model.expressions, self.model.t)
        given = [evaluate(decode(x, "vector"), at) for x in trees]
        found: Vector = self.model.group.in_block(block, given)
        return found

    def specific_force(self, data: Data) -> Vector:
        """The acceleration less those of all uniform gravities, on the axes of the body."""
        found = accelerations(self.model)[data["on"] - 1]
        for p in self.model.problem["potentials"]:
            if p["kind"] == "gravity":
                pairs = zip(found, self._given(data, p["g"]), strict=True)
                found = tuple(x - y for x, y in pairs)
        return self.seen(data, found)

    def rate(self, data: Data) -> Vector:
        """ω with Z x = ω ∧ x on the axes of the body."""
        block, factor = self._acted_on(data)
        at = self.model.group.of_block(block)
        model = self.model
        velocity = model.Z if model.side == "left" else q.times(q.inverted(model.g), model.nu)
        Z = tuple(row[at] for row in velocity[at])
        if factor.n == 2:
            return (Z[1][0],)
        if factor.n != 3:
            raise RecordError("a rate is of rotations of the plane or of R³")
        return Z[2][1], Z[0][2], Z[1][0]

    def direction(self, data: Data) -> Vector:
        """A vector of the body as g moves it, or one of space on the axes of the body."""
        vector = self._given(data, data["direction"])
        if data["frame"] == "body":
            return self.seen(data, vector)
        linear = self.model.group.linear_part(self.model.g)
        return self.seen(data, q.flatten(q.times(linear, q.column(vector))))

    def distance(self, data: Data) -> Vector:
        """The root of the square of a difference."""
        model, places = self.model, self.model.images(self.model.g)

        def inside(vector: Vector, end: int) -> Vector:
            group = model.group
            return vector[group.of_block(model.blocks[end - 1])] if group.factors else vector

        on, other = data["on"], data.get("other_end")
        end = (
            inside(places[other - 1], other)
            if other
            else inside(self._given(data, data["anchor"]), on)
        )
        between = tuple(x - y for x, y in zip(inside(places[on - 1], on), end, strict=True))
        return (model.elementary("sqrt", q.dot(between, between)),)

    def momentum(self, data: Data) -> Vector:
        """Σ m_i v_i; in a product the points of other blocks have no part in this one."""
        model = self.model
        moving = scaled_each(model.masses, model.images(model.nu))
        return self.seen(data, tuple(sum(x) for x in zip(*moving, strict=True)))

    def tension(self, data: Data) -> Vector:
        """The derivative of ½ k (s − length)² by s."""
        applied, spring = self.model.applied, self.model.problem["potentials"][data["of"] - 1]
        ends = {"on": spring["on"], "anchor": spring["anchor"]} if "on" in spring else None
        i, j = (0, 0) if ends else spring["between"]
        (length,) = self.distance(ends or {"on": i, "other_end": j})
        k, at_rest = applied.number(spring["stiffness"]), applied.number(spring["length"])
        return (k * (length - at_rest),)

    def expression(self, data: Data) -> Vector:
        """What the problem states, of the state."""
        return tuple(evaluate(decode(x, "y"), self.model.of_state) for x in data["y"])


def _numbers_of(force: Data) -> Iterator[tuple[str, Any]]:
    """The numbers of a force of the state by their names, those of the force before the moment's;
    none where it has no name."""
    trees = [x for key in ("force", "moment", "covector") for x in force.get(key, ())]
    names = one_or_more(force["name"], len(trees)) if "name" in force else ()
    yield from zip(names, trees, strict=False)


def _push(flow: Data) -> Data:
    """What flows pushes with the force ṁ u."""
    return {**flow, "force": [["mul", flow["rate"], x] for x in flow["velocity"]]}


def accelerations(model: Any) -> list[Vector]:
    """g(Ż + Z²)r of all points, along the motion, on the right (Ż + Z²)gr."""
    rate = q.plus(model.acceleration, q.times(model.Z, model.Z))
    found: list[Vector] = model.images(model.ordered(model.g, rate))
    return found
