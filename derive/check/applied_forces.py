"""The potentials of a problem at the exact points of a model, their forces, and damping.

U is computed from the problem's own data, term by term; its forces come from nilpotent numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.tree import Tree
from ..record.as_json import decode
from ..record.record import RecordError
from .draws import Draws
from .evaluate import Environment, evaluate
from .kinds import accounts
from .nilpotent import ETA, Nilpotent, nilpotent, part

Vector = tuple[Any, ...]
Distance = tuple[Vector, Callable[[Any], Any]]
"""d, and a potential as a function of ‖d‖²."""


RATE_SLOTS = 2
"""Indices of Ż, which may be anything where any forces act; f = Ż + Z² has twice as many."""

FORCE_SLOTS = 3 * RATE_SLOTS + 1
"""Those of F_i = m_i A f r_i and more, of which a force has what Ż needs."""


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


class AppliedForces:
    """The potentials of a problem and their forces, for points in these blocks."""

    def __init__(
        self, problem: Mapping[str, Any], group: Group, blocks: Sequence[int], env: Environment
    ):
        self.problem, self.group, self.blocks, self.env = problem, group, blocks, env
        self.potentials = [*problem.get("potentials", [])]
        self.single = [p for p in self.potentials if not self._summed(p)]

    def _summed(self, p: Mapping[str, Any]) -> bool:
        """Does the walk sum it up in words?"""
        account = _account(p)
        which = getattr(account, "summed", lambda *_: hasattr(account, "values"))
        return bool(which(self, p))

    def members(self) -> Iterator[tuple[Any, list[Mapping[str, Any]]]]:
        """The accounts of kinds of which some are summed up, with these."""
        for account in accounts().values():
            found = [p for p in self.potentials if _account(p) is account and self._summed(p)]
            if found:
                yield account, found

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

    def potential(
        self, t: Any, r: Sequence[Vector], masses: Sequence[Any], *, single: bool = False
    ) -> Any:
        """U(t, r); ``single``: U_Q, the part of it point by point."""
        chosen = self.single if single else self.potentials
        return sum((_account(p).energy(self, p, t, r, masses) for p in chosen), Fraction(0))

    def root(self, x: Any) -> Any:
        """√x."""
        assert self.env.elementary is not None
        return self.env.elementary("sqrt", x)

    def value(self, tree: Any, t: Any, r: Sequence[Vector], **names: Any) -> Any:
        """The value of an expression of the time and the places, and of other ``names``."""

        def point(head: Any, arguments: tuple[Tree, ...], env: Environment) -> Any:
            del arguments, env
            return q.column(r[head[2] - 1])

        env = replace(self.env, names={**self.env.names, **names, "t": t}, functions={"r": point})
        return evaluate(decode(tree, "U"), env)

    def forces(
        self, t: Any, r: Sequence[Vector], masses: Sequence[Any], *, single: bool = False
    ) -> list[Vector]:
        """−∂U/∂r_i for every point, of all of U or of U_Q."""
        return minus_gradient(lambda places: self.potential(t, places, masses, single=single), r)

    def tension(self, energy: Any) -> Any:
        """−2 dU/dq, from U at q + η."""
        return -2 * part(Nilpotent.of(energy), ETA)

    def radial(self, r: Sequence[Vector], masses: Sequence[Any]) -> list[tuple[Vector, Fraction]]:
        """d_e and σ_e of the elements that are functions of a distance, in order."""
        eta = nilpotent(ETA)
        return [
            (d, self.tension(energy(q.dot(d, d) + eta)))
            for p in self.single
            if hasattr(_account(p), "radial")
            for d, energy in _account(p).radial(self, p, r, masses)
        ]


def _account(p: Mapping[str, Any]) -> Any:
    """The checker's account of a potential."""
    if p["kind"] not in accounts():
        raise RecordError(f"unknown potential {str(p['kind'])[:20]!r}")
    return accounts()[p["kind"]]


def damping_members(model: Draws) -> dict[int, Fraction]:
    """κ_i of the points that are damped."""
    found: dict[int, Fraction] = {}
    for d in model.problem.get("damping", []):
        kappa = evaluate(decode(d["coefficient"], "damping"), model.expressions)
        for i in d["on"]:
            found[i] = found.get(i, Fraction(0)) + kappa
    return found
