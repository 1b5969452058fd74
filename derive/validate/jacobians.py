"""The exact Jacobians, derivatives of what ``rhs`` computes, by nilpotent numbers.

A variation is δg = g η and δζ; η̇ = δζ − [Z, η], and δζ̇ is the derivative of the rates; on the
right δg = η g and η̇ = δζ + [Z, η].
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..check.values.arithmetic import EPS, part
from ..language import rational as q
from ..language.rational import Matrix
from .chart import EPSILON, StateChart
from .emitted_file import Machine
from .exact_points import Point
from .terms import Array

ZERO = Fraction(0)


@dataclass(frozen=True)
class ExactJacobians:
    """The derivatives of the rates at one point; ``p``, ``k``: its parameters and constants."""

    machine: Machine
    state: StateChart
    point: Point
    p: Sequence[Fraction]
    k: Sequence[Fraction]

    @property
    def columns(self) -> Mapping[str, Iterator[list[Fraction]]]:
        """Name of a Jacobian → the columns of its matrix D, computed one by one."""
        return {
            "jacobian": self._state(),
            "jacobian_inputs": self._inputs(),
            "jacobian_parameters": self._parameters(),
            "jacobian_raw": self._raw(),
        }

    def _state(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the state: (η̇, δζ̇) for η = E_a, then for δζ = E_a."""
        group, Z = self.state.group, self.point.Z
        none = q.scaled(ZERO, Z)
        for e in group.basis:
            turn = group.nearest(q.bracket(Z, e) if self.state.right else q.bracket(e, Z))
            yield [*turn, *self._rates_along(e, none)]
        for a, e in enumerate(group.basis):
            yield [*(Fraction(a == b) for b in range(group.dimension)), *self._rates_along(none, e)]

    def _rates_along(self, eta: Matrix, change: Matrix) -> list[Fraction]:
        """δζ̇ for δg = g η and δZ = ``change``."""
        x = self.state.varied(self.point.g, self.point.Z, eta, change)
        rates = self._rates({"x": x})
        Z = q.plus(self.point.Z, q.scaled(EPSILON, change))
        back = q.times(q.minus(q.identity(len(eta)), q.scaled(EPSILON, eta)), self._inverse())
        return [part(y, EPS) for y in self.state.acceleration(Z, back, rates)]

    def _raw(self) -> Iterator[list[Fraction]]:
        """The columns of the derivative of ``rhs`` by the numbers of the state."""
        x = self.point.arguments["x"]
        for j in range(len(x)):
            rates = self._rates({"x": [y + EPSILON if i == j else y for i, y in enumerate(x)]})
            yield [part(y, EPS) for y in rates]

    def _inputs(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the inputs u."""
        u = self.point.arguments["u"]
        for j in range(len(u)):
            yield self._rates_column({"u": [y + EPSILON if i == j else y for i, y in enumerate(u)]})

    def _parameters(self) -> Iterator[list[Fraction]]:
        """The columns of the Jacobian in the parameters p."""
        for j in range(len(self.p)):
            p = [y + EPSILON if i == j else y for i, y in enumerate(self.p)]
            k = self.machine.call("constants", {"p": Array(p, "p")}, k=len(self.k))["k"]
            yield self._rates_column({"k": k})

    def _rates_column(self, changed: Mapping[str, Sequence[Any]]) -> list[Fraction]:
        """The column (0, δζ̇) where arguments of ``rhs`` have the changed values."""
        rates = self._rates(changed)
        found = self.state.acceleration(self.point.Z, self._inverse(), rates)
        return [ZERO] * len(found) + [part(y, EPS) for y in found]

    def _inverse(self) -> Matrix:
        found = q.inverse(self.point.g)
        assert found is not None
        return found

    def _rates(self, changed: Mapping[str, Sequence[Any]]) -> tuple[Any, ...]:
        values = {
            "x": self.point.arguments["x"],
            "u": self.point.arguments["u"],
            "k": self.k,
            **changed,
        }
        arguments = {name: Array(x, name) for name, x in values.items()}
        size = len(self.point.rates)
        found = self.machine.call("rhs", {"t": self.point.arguments["t"], **arguments}, dx=size)
        return tuple(found["dx"])
