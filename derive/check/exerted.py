"""Potentials and given forces of a problem at the exact points of a model.

U is computed from the problem's own data, term by term; its forces come from nilpotent numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.tree import Tree
from ..record.record import RecordError, decode
from .draws import Draws
from .evaluate import Environment, evaluate
from .nilpotent import ETA, Nilpotent, nilpotent, part

Vector = tuple[Any, ...]
QUADRATIC, SINGLE = "quadratic", "single"


@dataclass(frozen=True)
class Term:
    """One potential: what it is, and whether the walk sums it up or keeps it point by point."""

    data: Mapping[str, Any]
    kind: str


RATE = 2
"""Indices of Ż, which may be anything where any forces act; f = Ż + Z² has twice as many."""

PUSH = 3 * RATE + 1
"""Those of F_i = m_i A f r_i and more, of which a force has what Ż needs."""


class AnyPotential:
    """A polynomial that stands for any potential: any value and any forces at the places of a model
    at its time, and somewhere else others."""

    def __init__(self, model: Draws, t: Any, places: Sequence[Vector]):
        self.t, self.places, self.value = t, places, model.draw()
        self.pushes = [tuple(model.draw(slots=PUSH) for _ in r) for r in places]
        self.later, *self.weights = (model.draw() for _ in (None, *places))

    def energy(self, t: Any, r: Sequence[Vector]) -> Any:
        """U(t, r)."""
        later = t - self.t
        total = self.value + later * self.later
        for force, weight, x, x0 in zip(self.pushes, self.weights, r, self.places, strict=True):
            y = tuple(a - b for a, b in zip(x, x0, strict=True))
            total = total - _dot(force, y) * (1 + later) + weight * _square(y)
        return total


def pushed(energy: Callable[[Sequence[Vector]], Any], r: Sequence[Vector]) -> list[Vector]:
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


class Exerted:
    """The potentials, inputs and damping of a problem, for points with given blocks."""

    def __init__(
        self, problem: Mapping[str, Any], group: Group, blocks: Sequence[int], env: Environment
    ):
        self.problem, self.group, self.blocks, self.env = problem, group, blocks, env
        self.terms = [Term(p, self._kind(p)) for p in problem.get("potentials", [])]

    def _kind(self, p: Mapping[str, Any]) -> str:
        if p["kind"] == "gravity":
            return QUADRATIC
        if p["kind"] == "spring" and "between" in p and p["length"] == 0:
            i, j = p["between"]
            return QUADRATIC if self.blocks[i - 1] == self.blocks[j - 1] else SINGLE
        return SINGLE

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

    def potential(self, t: Any, r: Sequence[Vector], masses: Sequence[Any], kind: str = "") -> Any:
        """U(t, r), or the part of one kind."""
        chosen = (x.data for x in self.terms if kind in ("", x.kind))
        return sum((self._energy(p, t, r, masses) for p in chosen), Fraction(0))

    def _energy(
        self, p: Mapping[str, Any], t: Any, r: Sequence[Vector], masses: Sequence[Any]
    ) -> Any:
        kind = p["kind"]
        heavy = [i for i, m in enumerate(masses, 1) if m]
        if kind == "gravity":
            g = self.group.in_every_block(self.vector(p["g"]))
            return -sum((masses[i - 1] * _dot(g, r[i - 1]) for i in heavy), Fraction(0))
        if kind == "spring":
            return self.stretch(p, _square(self.difference(p, r)))
        if kind == "attraction":
            pulls = (-pull / self._root(_square(d)) for d, pull in self.attracted(p, r, masses))
            return sum(pulls, Fraction(0))
        if kind != "expression":
            raise RecordError(f"unknown potential {str(kind)[:20]!r}")
        return evaluate(decode(p["U"], "U"), self._at(t, r))

    def difference(self, p: Mapping[str, Any], r: Sequence[Vector]) -> Vector:
        """From the second end of a spring to the first."""
        if "between" in p:
            a, b = (self.place(r, i) for i in p["between"])
        else:
            a, b = self.place(r, p["on"]), self.vector(p["anchor"])
        return tuple(x - y for x, y in zip(a, b, strict=True))

    def attracted(
        self, p: Mapping[str, Any], r: Sequence[Vector], masses: Sequence[Any]
    ) -> Iterator[tuple[Vector, Any]]:
        """For each mass its place seen from the centre, and m · strength."""
        strength, centre = self.number(p["strength"]), self.vector(p["centre"])
        given = [(i, self.number(m)) for i, m in p.get("on", ())]
        for i, m in given or enumerate(masses, 1):
            if m:
                d = self.place(r, i)
                origin = centre or (Fraction(0),) * len(d)
                yield tuple(x - y for x, y in zip(d, origin, strict=True)), m * strength

    def stretch(self, p: Mapping[str, Any], square: Any) -> Any:
        """½ k (‖d‖ − ℓ)² as a function of ‖d‖²."""
        k, length = self.number(p["stiffness"]), self.number(p["length"])
        if p["length"] == 0:
            return k * square * Fraction(1, 2)
        stretched = self._root(square) - length
        return k * (stretched * stretched) * Fraction(1, 2)

    def _root(self, x: Any) -> Any:
        assert self.env.elementary is not None
        return self.env.elementary("sqrt", x)

    def _at(self, t: Any, r: Sequence[Vector]) -> Environment:
        def point(head: Any, arguments: tuple[Tree, ...], env: Environment) -> Any:
            del arguments, env
            return tuple((x,) for x in r[head[2] - 1])

        names = {**self.env.names, "t": t}
        return Environment(
            self.env.size,
            names,
            functions={"r": point},
            parameters=self.env.parameters,
            elementary=self.env.elementary,
        )

    def forces(
        self, t: Any, r: Sequence[Vector], masses: Sequence[Any], kind: str = ""
    ) -> list[Vector]:
        """−∂U/∂r_i for every point."""
        return pushed(lambda places: self.potential(t, places, masses, kind), r)

    def tension(self, energy: Any) -> Any:
        """−2 dU/dq, from U at q + η."""
        return -2 * part(Nilpotent.of(energy), ETA)

    def radial(self, r: Sequence[Vector], masses: Sequence[Any]) -> list[tuple[Vector, Fraction]]:
        """d_e and σ_e of the elements that are functions of a distance, in order."""
        found = []
        eta = nilpotent(ETA)
        for p in (x.data for x in self.terms if x.kind == SINGLE):
            if p["kind"] == "spring":
                d = self.difference(p, r)
                found.append((d, self.tension(self.stretch(p, _square(d) + eta))))
            elif p["kind"] == "attraction":
                for d, pull in self.attracted(p, r, masses):
                    found.append((d, self.tension(-pull / self._root(_square(d) + eta))))
        return found


def _dot(a: Vector, b: Vector) -> Any:
    return q.dot(a, b)


def _square(a: Vector) -> Any:
    return _dot(a, a)


def damping_members(model: Draws) -> dict[int, Fraction]:
    """κ_i of the points that are damped."""
    found: dict[int, Fraction] = {}
    for d in model.problem.get("damping", []):
        kappa = evaluate(decode(d["coefficient"], "damping"), model.expressions)
        for i in d["on"]:
            found[i] = found.get(i, Fraction(0)) + kappa
    return found
