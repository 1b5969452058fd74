"""The momenta of a model as sums over its points, its names of R³, and its lifts; and the numbers
that are read off a motion at one exact point, from its points alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...language import rational as q
from ...language.rational import Matrix
from ...language.reserved import numbers_of_output, one_or_more, rate_of_mass
from ...language.tree import Tree
from ...record.as_json import decode
from ...record.record import RecordError
from ..values.arithmetic import EPS, EPS_PRIME, EvaluationError, derivative_in, part
from ..values.draws import at_time
from ..values.evaluate import Environment, evaluate, point_index
from .model import Model
from .point_masses import Vector, axial, outer_sum, scaled_each

# The names of R³ for rotations, Ω, ζ, φ, μ and the tensors of inertia, from the points.

Values = dict[str, Any]


def rigid_body_values(model: Model) -> Values:
    """The values of Ω, ζ, φ, μ, their variations and rates, and of I, I_c, λ for the rotations and
    displacements of space; none for other groups."""
    if not model.group.turns_space:
        return {}
    basis = model.group.basis
    values: Values = {}
    named = {
        "ζ": model.Z,
        "ζ̇": model.acceleration,
        "Ω": model.first.xi,
        "Ω′": model.second.xi,
        "δζ": model.first.velocity,
        "δ′ζ": model.second.velocity,
    }
    if not model.group.affine:
        named["φ"] = model.gradient
    for name, x in named.items():
        values[name] = axial(x)
    values["μ"] = q.column(-model.work(q.times(model.g, e)) for e in basis[:3])
    if model.at.driven:
        values["u"] = q.column(model.covector[:3])
        values["f_u"] = q.column(model.covector[3:])
    m, c, _ = model.moments
    centre = tuple(x[0] / m for x in c)
    values["I"] = _inertia_tensor(model, (Fraction(0),) * 3)
    values["I_c"] = _inertia_tensor(model, centre)
    if model.at.principal:  # else the diagonal of I is not its eigenvalues
        values["λ"] = q.column(values["I"][i][i] for i in range(3))
    return values


def _inertia_tensor(model: Model, origin: tuple[Fraction, ...]) -> Matrix:
    """Σ m_i (|r|² 1 − r r̄) about an origin: the classical tensor of inertia."""
    span = range(3)
    total = [[Fraction(0)] * 3 for _ in span]
    for m, point in zip(model.masses, model.points, strict=True):
        r = [x - o for x, o in zip(point, origin, strict=True)]
        square = sum(x * x for x in r)
        for i in span:
            for j in span:
                total[i][j] += m * ((square if i == j else 0) - r[i] * r[j])
    return q.matrix(total)


def moments_about(model: Model, origin: tuple[Fraction, ...]) -> Matrix:
    """Σ m_i (r_i − o)(r_i − o)‾ about an origin o."""
    arms = [tuple(x - o for x, o in zip(r, origin, strict=True)) for r in model.points]
    return outer_sum(scaled_each(model.masses, arms), arms)


# The momenta Π, p_b, their variations and rates, and the force Φ, as sums over the points.
#
# ℓ_b is the skew part of Π, twice, or its axis for the rotations of space; ℓ and p are momenta in
# space.

NAMES = (("Π", "δΠ", "δ′Π", "Π̇"), ("p_b", "δp_b", "δ′p_b", "ṗ_b"))
"""The names of the linear part of the momentum and of its translation part: the value, its two
variations, its rate."""
SPINS = ("ℓ_b", "δℓ_b", "δ′ℓ_b", "ℓ̇_b")


def momentum_values(model: Model) -> dict[str, Any]:
    """Π = Σ m Āv r̄ and p_b = Σ m Āv on the families of δ, δ′ and the motion; and Φ."""
    varied = model.varied
    places = ((varied, 0), (varied, EPS), (varied, EPS_PRIME), (model.onward, EPS))
    values = {}
    for names, arms in zip(NAMES, (model.points, model.units), strict=True):
        for name, (at, mask) in zip(names, places, strict=True):
            moving = _moment_in_body(model, at.g, _momenta(model, at.g, at.Z), arms)
            values[name] = part(moving, mask)
    for name, Pi in zip(SPINS, NAMES[0], strict=True):
        skew = q.minus(values[Pi], q.transposed(values[Pi]))
        values[name] = axial(skew) if model.group.turns_space else skew
    return values | {"Φ": _force_on_algebra(model)}


def basis_families(model: Model) -> dict[str, dict[tuple[int, ...], Any]]:
    """Π_a = p̃(gE_a) on the linear parts of the basis, and Π̇_a, its rate along the motion."""
    t, g, Z, *_ = model.onward
    moving = model.momenta(t, g, Z)[: len(model.group.linear_basis)]
    return {
        name: {(a,): part(x, mask) for a, x in enumerate(moving, 1)}
        for name, mask in (("Π", 0), ("Π̇", EPS))
    }


def poisson_values(model: Model) -> dict[str, Any]:
    """𝕁, the brackets of the momenta on the linear parts of the basis, and in R³ turned about those
    of all; Π_g."""
    if model.generic:
        return {}
    whole, group = model.brackets(), model.group
    d = group.dimension if group.turns_space else len(group.linear_basis)
    shadow = group.covector_matrix(model.momenta(model.t, model.g, model.Z))
    return {"𝕁": tuple(row[:d] for row in whole[:d]), "Π_g": group.linear_part(shadow)}


def _force_on_algebra(model: Model) -> Matrix:
    """Φ = Σ Ā(m v)(g⁻¹v)‾, the variation of the metric, and CfJ or Σ ĀF r̄, the forces."""
    own = _moment_in_body(model, model.g, _momenta(model, model.g, model.Z), model.images(model.Z))
    if model.group.affine:
        return q.plus(own, _moment_in_body(model, model.g, model.forces, model.points))
    A = model.group.linear_part(model.g)
    C = q.times(q.transposed(A), A)
    return q.plus(own, q.times(q.times(C, model.gradient), model.moments[2]))


def _momenta(model: Model, g: Matrix, Z: Matrix) -> list[Vector]:
    """The momenta m_i v_i of the points in space, v = g Z r."""
    return scaled_each(model.masses, model.images(q.times(g, Z)))


def _moment_in_body(
    model: Model, g: Matrix, vectors: Sequence[Vector], arms: Sequence[Vector]
) -> Matrix:
    """Σ Āv x̄, n × k, over vectors v in space and arms x of k numbers in the body."""
    back = q.transposed(model.group.linear_part(g))
    return q.times(back, outer_sum(vectors, arms))


def space_values(model: Model, acceleration: Matrix) -> dict[str, Any]:
    """ℓ = Σ m r ∧ v and p = Σ m v in space, as sums over the points; rates along the motion.

    ℓ is a vector in R³ turned about, else the matrix Σ m (v r̄ − r v̄).
    """
    places, speeds = model.images(model.g), model.images(model.nu)
    forces = model.images(acceleration)
    t, g, Z, *_ = model.onward
    return {
        "ℓ": _angular_momentum(model, places, speeds),
        "ℓ̇": _angular_momentum(model, places, forces),
        "p": _resultant(model, speeds),
        "ṗ": _resultant(model, forces),
        "ḣ": part(model.onward_body.energy(t, g, Z), EPS),
    }


def _angular_momentum(model: Model, places: list[Vector], vectors: list[Vector]) -> Matrix:
    """Σ m (v r̄ − r v̄), or in R³ turned about its axis Σ m r ∧ v."""
    half = outer_sum(scaled_each(model.masses, vectors), places)
    whole = q.minus(half, q.transposed(half))
    return axial(whole) if model.group.turns_space else whole


def _resultant(model: Model, vectors: list[Vector]) -> Matrix:
    """Σ m v, as a column."""
    return outer_sum(scaled_each(model.masses, vectors), model.units)


# The principle on one jet of a curve: X is the tangent of a lift, δ varies it through lifts.
#
# The curve and those it is varied through are one two-parameter family in the group; d/dt is its
# second parameter.

ON_TANGENT: Tree = ("call", "ϖ", "X")
ON_VARIATION: Tree = ("call", "ϖ", "δy")


def action_varied(model: Model) -> Any:
    """δ[L̃ dt(X)] = δ[ϖ(X)], by the Lagrangian alone: on each curve of the family the velocity is
    its own. ``EvaluationError`` where X is not the tangent of a lift."""
    if model.motion.xi != model.Z:
        raise EvaluationError("ϖ(X) is varied where X is the tangent of a lift")
    family = model.family(model.first, model.motion)
    passing = derivative_in(family.t, EPS_PRIME)
    Z = q.scaled(1 / passing, model.field(family, EPS_PRIME))
    return part(model.lagrangian(family.t, family.g, Z) * passing, EPS)


def rate(model: Model, what: Tree, env: Environment) -> Any:
    """d/dt along the motion of ϖ(δy), or of the place r_i(t) or the velocity v_i of a point;
    ``EvaluationError`` for any other."""
    family = model.family(model.first, model.motion)
    t, g, Z, *_ = family
    match what:
        case ("call", ("at", "r", i), "t"):
            return part(q.column(model.images(g)[point_index(i, env) - 1]), EPS_PRIME)
        case ("at", "v", i):
            moving = model.images(q.times(g, Z))
            return part(q.column(moving[point_index(i, env) - 1]), EPS_PRIME)
    if what != ON_VARIATION:
        raise EvaluationError("d/dt is of ϖ(δy), r_i(t) and v_i, where points give the Lagrangian")
    pushed = model.momentum(t, g, Z, model.field(family, EPS))
    return part(pushed - model.energy(t, g, Z) * derivative_in(t, EPS), EPS_PRIME)


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
            names = numbers_of_output(data, model.acted_on(data)[1].n)
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

    def seen(self, data: Data, vector: Vector) -> Vector:
        """A vector of space, of its block in a product; its products with the images of the axes of
        the body where it is seen in this."""
        group, (block, _) = self.model.group, self.model.acted_on(data)
        at = group.of_block(block) if group.factors else slice(None)
        inside = vector[at]
        if data.get("frame", "body") == "space":
            return inside
        linear = group.linear_part(self.model.g)
        axes = q.transposed(tuple(row[at] for row in linear[at]))
        return tuple(q.dot(axis, inside) for axis in axes)

    def _given(self, data: Data, trees: Any) -> Vector:
        """A vector that the problem states, among those of all blocks."""
        block, _ = self.model.acted_on(data)
        at = at_time(self.model.expressions, self.model.t)
        given = [evaluate(decode(x, "vector"), at) for x in trees]
        found: Vector = self.model.group.in_block(block, given)
        return found

    def specific_force(self, data: Data) -> Vector:
        """The acceleration less those of all uniform gravities, on the axes of the body."""
        found = accelerations(self.model)[data["on"] - 1]
        fields = [p["g"] for p in self.model.problem["potentials"] if p["kind"] == "gravity"]
        for g in (*fields, *([data["g"]] if "g" in data else ())):
            pairs = zip(found, self._given(data, g), strict=True)
            found = tuple(x - y for x, y in pairs)
        return self.seen(data, found)

    def rate(self, data: Data) -> Vector:
        """ω with Z x = ω ∧ x on the axes of the body."""
        block, factor = self.model.acted_on(data)
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
