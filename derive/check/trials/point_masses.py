"""The body of a model: its points, the masses that a matrix moves, the forces on them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.rational import Matrix
from ...language.tree import Tree
from ...record.as_json import decode
from ..values.arithmetic import EPS, ETA, Nilpotent, nilpotent, part
from ..values.draws import Draws, onward
from ..values.evaluate import Environment, evaluate
from .equimomental import equimomental_points, moments_of, remaining_moments
from .phase_point import ENTRY

# The points of a model: those of the problem, or random ones where it leaves them open.

Vector = tuple[Any, ...]
Points = tuple[list[Fraction], list[Vector], list[int]]
"""Masses, places in the body and blocks of the points; places without a mass are among them."""


def points_of(model: Draws) -> Points:
    """The points of a model: those that the problem lists, its other places without mass, and then
    points for what it does not list."""
    body = model.problem.get("body", {})
    listed = [] if model.generic else model.problem.get("places", [])
    places, blocks = listed_places(model, listed)
    empty = [Fraction(0)] * len(places)
    if body.get("kind") in ("points", "given") and not model.generic:
        listed = body.get("points", [])
        own = [evaluate(decode(p["mass"], "mass"), model.expressions) for p in listed]
        points, first = listed_places(model, listed)
        masses, rest = (
            _points_with_moments(model, *moments_of(model)) if body["kind"] == "given" else ([], [])
        )
        blocks = first + blocks + [1] * len(rest)
        return own + empty + masses, points + places + rest, blocks
    masses, points = _random_points(model, model.n + 1 + model.spare)
    return empty + masses, places + points, blocks + [1] * len(points)


def points_later(model: Body) -> tuple[list[Any], list[Vector]]:
    """The masses and places at t + ε of what :func:`points_of` drew at t: those that are at random
    stay, and those that complete the moments have those of then."""
    body, env = model.problem["body"], model.expressions
    later = copy(model)
    later.expressions = onward(env, model.problem["flows"], model.t, nilpotent(EPS))
    listed = body.get("points", [])
    own = [evaluate(decode(p["mass"], "mass"), later.expressions) for p in listed]
    first = listed_count(model)
    masses, points = [*own, *model.masses[len(own) : first]], [*model.points[:first]]
    if body["kind"] == "given":
        drawn = slice(first, first + model.spare)
        masses += model.masses[drawn]
        points += model.points[drawn]
        more = equimomental_points(
            *remaining_moments(model.masses[drawn], model.points[drawn], *moments_of(later))
        )
        masses += more[0]
        points += more[1]
    count = len(masses)
    return [*masses, *model.masses[count:]], [*points, *model.points[count:]]


def listed_count(model: Draws) -> int:
    """How many points the problem lists: they come first, and have numbers in equations."""
    if model.generic:
        return 0
    body = model.problem.get("body", {})
    return len(body.get("points", [])) + len(model.problem.get("places", []))


def principal_points(model: Draws) -> Points:
    """The points of a model with random m, c and diagonal J: as many random points as the problem
    lists, and those that complete the moments."""
    n, count = model.n, len(model.problem.get("body", {}).get("points", []))
    masses, points = _random_points(model, count)
    places, blocks = listed_places(model, model.problem.get("places", []))
    m, c = model.draw(positive=True), model.place()
    J = q.matrix(
        [[model.draw(slots=2) if i == j else Fraction(0) for j in range(n)] for i in range(n)]
    )
    more, rest = _points_with_moments(model, *remaining_moments(masses, points, m, c, J))
    empty = [Fraction(0)] * len(places)
    return masses + empty + more, points + places + rest, [1] * count + blocks + [1] * len(rest)


def _points_with_moments(
    model: Draws, m: Fraction, c: Vector, J: Matrix
) -> tuple[list[Fraction], list[Vector]]:
    """Points with the moments m, c, J, some at random: no more is known of them."""
    masses, points = _random_points(model, model.spare)
    more, rest = equimomental_points(*remaining_moments(masses, points, m, c, J))
    return masses + more, points + rest


def _random_points(model: Draws, count: int) -> tuple[list[Fraction], list[Vector]]:
    """So many random points: their masses, and their places."""
    masses = [model.draw(positive=True) for _ in range(count)]
    return masses, [model.place() for _ in range(count)]


def listed_places(model: Draws, listed: list[Mapping[str, Any]]) -> tuple[list[Vector], list[int]]:
    """The places that the problem lists, in the coordinates of a product, and their blocks."""
    places, blocks = [], []
    for data in listed:
        at = tuple(evaluate(decode(x, "at"), model.expressions) for x in data["at"])
        block = data.get("block", 1)
        blocks.append(block)
        at = model.group.in_block(block, at, 1)
        places.append(at)
    return places, blocks


# The body of a model: point masses that a matrix moves, their moments and their metric.


def outer_sum(vectors: Sequence[Vector], arms: Sequence[Vector]) -> Matrix:
    """Σ v_i x̄_i, n × k, over vectors of n numbers and arms of k, one of each for every point."""
    return q.times(q.transposed(tuple(vectors)), tuple(arms))


def axial(x: Matrix) -> Matrix:
    """The vector X (3 × 1) of a skew matrix j(X), or of the rotation part of a larger one."""
    return ((x[2][1],), (x[0][2],), (x[1][0],))


def scaled_each(weights: Iterable[Any], vectors: Iterable[Vector]) -> list[Vector]:
    """The vectors m_i v_i."""
    return [tuple(m * x for x in v) for m, v in zip(weights, vectors, strict=True)]


class Body(Draws):
    """The draws of a model with its body: masses, places and blocks of its points."""

    masses: list[Any]
    points: list[Vector]
    blocks: list[int]
    g: Matrix
    applied: PotentialData

    def embody(self, *, principal: bool, axes: bool) -> None:
        """Draw the points, with a diagonal J if ``principal``, and those of the ``axes`` of the
        body; symbolic moments m, c, J get the values that these points have."""
        self.masses, self.points, self.blocks = (
            principal_points(self) if principal else points_of(self)
        )
        if axes and not self.generic:
            # last of all the origin of the body and the ends of its axes, without mass
            rows = (q.scaled(Fraction(0), q.identity(self.n))[0], *q.identity(self.n))
            self.masses = [*self.masses, *(Fraction(0) for _ in rows)]
            self.points, self.blocks = [*self.points, *rows], [*self.blocks, *(1 for _ in rows)]
        if self.problem.get("body", {}).get("kind") != "moments":
            return
        m, c, J = self.moments
        self.parameters |= {"m": m} | {f"c_{i + 1}": c[i][0] for i in range(self.n)}
        self.parameters |= {
            f"J_{i + 1}{j + 1}": J[i][j] for i in range(self.n) for j in range(i, self.n)
        }

    @cached_property
    def moments(self) -> tuple[Fraction, Matrix, Matrix]:
        """m, c, J as sums over the points."""
        weighted = scaled_each(self.masses, self.points)
        first, second = outer_sum(weighted, self.units), outer_sum(weighted, self.points)
        return sum(self.masses, Fraction(0)), first, second

    @property
    def units(self) -> list[Vector]:
        """The number 1 for each point, as a vector."""
        return [(Fraction(1),)] * len(self.points)

    def about_centre(self, x: Matrix) -> Matrix:
        """A displacement of the body with the linear part x that leaves its centre of mass where it
        is, or the origin of a linear action."""
        if not self.group.affine:
            return x
        m, c, _ = self.moments
        return q.bordered(x, q.scaled(-1 / m, q.times(x, c)), Fraction(0))

    def homogeneous(self, r: Vector) -> Matrix:
        """A place as a column: r, or (r, 1) for an affine action."""
        return q.column((*r, Fraction(1)) if self.group.affine else r)

    def images(self, g: Matrix) -> list[Vector]:
        """The places in space of the points moved by g; for a tangent matrix their velocities."""
        ends = q.transposed(tuple(q.flatten(self.homogeneous(r)) for r in self.points))
        return [*q.transposed(q.times(g[: self.n], ends))]

    def pairing(self, a: Matrix, b: Matrix, weights: Sequence[Any] | None = None) -> Any:
        """Σ m_i ⟨a r_i, b r_i⟩, the kinetic metric of two tangent matrices at g; ``weights``: those
        of the points that stand for m_i."""
        weights = self.masses if weights is None else weights
        pairs = zip(weights, self.images(a), self.images(b), strict=True)
        return sum((m * q.dot(u, v) for m, u, v in pairs), Fraction(0))

    def metric_matrix(self, tangents: list[Matrix], weights: Sequence[Any] | None = None) -> Matrix:
        """The matrix of the kinetic metric on tangent matrices at g; ``weights`` as above."""
        moved = [[x for v in self.images(a) for x in v] for a in tangents]
        weights = self.masses if weights is None else weights
        each = [m for m in weights for _ in range(self.n)]
        rows = [[m * x for m, x in zip(each, u, strict=True)] for u in moved]
        return q.times(q.matrix(rows), q.transposed(q.matrix(moved)))


# The potentials of a problem at the exact points of a model, their forces, and damping.
#
# U is computed from the problem's own data, term by term; its forces come from nilpotent numbers.

Distance = tuple[Vector, Callable[[Any], Any]]
"""d, and a potential as a function of ‖d‖²."""


FORCE_SLOTS = 3 * ENTRY + 1
"""The indices of F_i = m_i A f r_i and more, of which a force has what Ż needs; f = Ż + Z² has
twice as many as Ż."""


class AnyPotential:
    """A polynomial that stands for any potential: any value and any forces at the places of a model
    at its time, and somewhere else others."""

    def __init__(self, model: Draws, t: Any, places: Sequence[Vector]):
        self.t, self.places, self.value = t, places, model.draw()
        self.forces = [tuple(model.draw(slots=FORCE_SLOTS) for _ in r) for r in places]
        self.later, *self.weights = (model.draw() for _ in (None, *places))

    def energy(self, t: Any, r: Sequence[Vector]) -> Any:
        """U(t, r)."""
        later = t - self.t
        total = self.value + later * self.later
        for force, weight, x, x0 in zip(self.forces, self.weights, r, self.places, strict=True):
            y = tuple(a - b for a, b in zip(x, x0, strict=True))
            total = total - q.dot(force, y) * (1 + later) + weight * q.dot(y, y)
        return total


def minus_gradient(energy: Callable[[Sequence[Vector]], Any], r: Sequence[Vector]) -> list[Vector]:
    """Minus the derivative of a function of the places by each of them."""
    eta = nilpotent(ETA)
    found = []
    for i, place in enumerate(r):
        force = []
        for k in range(len(place)):
            moved = tuple(x + eta if j == k else x for j, x in enumerate(place))
            value = energy([*r[:i], moved, *r[i + 1 :]])
            force.append(-part(Nilpotent.of(value), ETA))
        found.append(tuple(force))
    return found


class PotentialData:
    """What the potentials of a problem are given by, for points in these blocks; ``env``: that of
    their expressions, with a time."""

    def __init__(
        self, problem: Mapping[str, Any], group: Group, blocks: Sequence[int], env: Environment
    ):
        self.problem, self.group, self.blocks, self.env = problem, group, blocks, env
        self.potentials = [*problem.get("potentials", [])]

    def number(self, tree: Any) -> Any:
        """The value of an expression of the problem."""
        return evaluate(decode(tree, "problem"), self.env)

    def vector(self, trees: Any) -> Vector:
        """The values of a list of expressions."""
        return tuple(self.number(x) for x in trees)

    def place(self, r: Sequence[Vector], i: int) -> Vector:
        """Point i (from 1) in its space: its block of a product."""
        if not self.group.factors:
            return r[i - 1]
        return r[i - 1][self.group.of_block(self.blocks[i - 1])]

    def body_axes(self, r: Sequence[Vector]) -> tuple[Vector, list[Vector]]:
        """Where the origin of the body is, and its axes from there, as columns of A."""
        origin, *ends = r[-self.env.size - 1 :]
        return origin, [tuple(x - y for x, y in zip(e, origin, strict=True)) for e in ends]

    def root(self, x: Any) -> Any:
        """√x."""
        assert self.env.elementary is not None
        return self.env.elementary("sqrt", x)

    def value(self, tree: Any, r: Sequence[Vector], **names: Any) -> Any:
        """The value of an expression of the time and the places, and of other ``names``."""

        def point(head: Any, arguments: tuple[Tree, ...], env: Environment) -> Any:
            del arguments, env
            return q.column(r[head[2] - 1])

        env = replace(self.env, names={**self.env.names, **names}, functions={"r": point})
        return evaluate(decode(tree, "U"), env)


def damping_members(model: Draws) -> dict[int, Fraction]:
    """κ_i of the points that are damped."""
    found: dict[int, Fraction] = {}
    for d in model.problem.get("damping", []):
        kappa = evaluate(decode(d["coefficient"], "damping"), model.expressions)
        for i in d["on"]:
            found[i] = found.get(i, Fraction(0)) + kappa
    return found
