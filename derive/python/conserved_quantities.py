"""The symmetries of a problem as Python holds them: their record, and functions of the state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..language.show import show
from ..language.tree import Tree
from ..language.values import approximate
from ..problem.fields import coordinates
from ..problem.problem import Problem, ProblemError
from ..record.record import Derivation
from ..search.symmetries.found_symmetries import SymmetriesFound
from ..search.symmetries.gradient import Floats, Tape
from ..search.symmetries.symmetry import Symmetry
from .shown import Finding, Shown


@dataclass(frozen=True)
class Conserved:
    """A symmetry and what the motion keeps by it; ``step``: in the record.

    ``kind``: "time", "rotation_space", "boost" …; ``exact``: is it a symmetry of L̃, not only up to
    dF?
    """

    symmetry: Symmetry
    step: Shown
    found: SymmetriesFound

    @property
    def kind(self) -> str:
        """What it is called."""
        return self.symmetry.kind

    @property
    def exact(self) -> bool:
        """Does it leave L̃ alone?"""
        return self.symmetry.exact

    @property
    def displacement(self) -> Tree:
        """δA, an operator tree; beside it δt is constant."""
        return self.symmetry.displacement

    @property
    def F(self) -> Tree:
        """F with δL̃ = dF/dt, an operator tree."""
        return self.symmetry.F

    def __repr__(self) -> str:
        return f"<{self.kind}: δA = {show(self.displacement)}>"

    def __str__(self) -> str:
        return str(self.step)

    def sympy(self) -> Any:
        """The quantity as a SymPy expression in the time, the names of the state in the emitted
        code, and the parameters."""
        from .expressions import expression

        return expression(self.symmetry, self.found)


@dataclass(frozen=True)
class SymmetriesOf(Finding):
    """All symmetries of a kind: a sequence of :class:`Conserved`; ``record``: their derivation."""

    _search = "symmetries"

    found: SymmetriesFound
    record: Derivation

    @property
    def problem(self) -> Problem:
        """The problem, its Lagrangian as one expression."""
        return self.found.problem

    def __repr__(self) -> str:
        return f"<symmetries of {self.record.name}: {len(self)}>"

    def __len__(self) -> int:
        return self.found.dimension

    def __getitem__(self, k: int) -> Conserved:
        step = Shown(self.record[f"conserved_{range(len(self))[k] + 1}"], self.record)
        return Conserved(self.found.symmetries[k], step, self.found)

    def __iter__(self) -> Iterator[Conserved]:
        return (self[k] for k in range(len(self)))

    @property
    def central(self) -> dict[tuple[int, int], Tree]:
        """The pairs of places, from 0, of symmetries that commute with dϖ(δ, δ′) not 0 → that
        number, an operator tree."""
        return {(x.first, x.second): x.number for x in self.found.central}

    @cached_property
    def _tape(self) -> Tape:
        return Tape(self.found.lagrangian.L)

    def values(self, t: Any, x: Any, parameters: Mapping[str, float] | None = None) -> Any:
        """The conserved quantities, n numbers, at a time and a state of the emitted code, which may
        have leading dimensions; ``parameters`` in the place of defaults."""
        self.found.require_whole()
        group = self.problem.own_group
        x = np.asarray(x, float)
        leaves: dict[Tree, Any] = {y: x[..., k] for k, y in enumerate(self.found.state.values())}
        leaves["t"], leaves["π"] = np.asarray(t, float), np.pi
        known = self._parameters(parameters or {})
        for name, number in known.items():
            leaves["par", name] = number
        at = self._tape.at(leaves, Floats(), Floats())
        slopes = at.gradient()
        momenta = [slopes.get(y, 0.0) + 0 * x[..., 0] for y in coordinates(group)]
        speeds = [leaves[y] for y in coordinates(group)]
        energy = sum(p * z for p, z in zip(momenta, speeds, strict=True)) - at.value
        g = _matrix(self._entries(leaves), x)
        found = [self._value(s, g, momenta, energy, leaves) for s in self.found.symmetries]
        return np.stack(found, axis=-1)

    def _parameters(self, given: Mapping[str, float]) -> dict[str, float]:
        """The values of the parameters in L̃; ``ProblemError`` for one without."""
        used = [t[1] for t in self._tape.places if isinstance(t, tuple) and t[0] == "par"]
        declared = self.problem.parameters
        found = {x: given.get(x, declared[x].default if x in declared else None) for x in used}
        missing = [x for x, value in found.items() if value is None]
        if missing:
            raise ProblemError(f"no value for the parameter {missing[0]!r}: it has no default")
        return {x: float(value) for x, value in found.items() if value is not None}

    def _entries(self, leaves: Mapping[Tree, Any]) -> list[list[Any]]:
        from ..problem.entries_on_orbit import element

        return [[leaves.get(x, x) for x in row] for row in element(self.problem.own_group)]

    def _value(
        self, s: Symmetry, g: Any, momenta: list[Any], energy: Any, leaves: Mapping[Tree, Any]
    ) -> Any:
        """⟨Π, η⟩ − τh̃ − F."""
        known = {x[1]: v for x, v in leaves.items() if isinstance(x, tuple) and x[0] == "par"}

        def number(t: Tree) -> float:
            found = approximate(t, known, float)
            assert found is not None
            return found

        def matrix(m: Any) -> Any:
            return np.array([[number(x) for x in row] for row in m])

        (Y, X), (Y1, X1) = (map(matrix, pair) for pair in (s.still, s.moving))
        t = np.asarray(leaves["t"])[..., None, None]
        Y, X = Y + t * Y1, X + t * X1
        back = np.linalg.inv(g)
        eta = back @ Y @ g - X if s.side == "left" else Y - g @ X @ back
        total = -number(s.tau) * energy
        for a, p in enumerate(momenta):
            terms = s.group.coordinate_terms(a)
            total = total + p * sum(float(c) * eta[..., i, j] for c, i, j in terms)
        for c, monomial in s.terms:
            product = number(c)
            for y in monomial:
                product = product * leaves[y]
            total = total - product
        return total


def _matrix(entries: list[list[Any]], x: Any) -> Any:
    """Entries, some of them numbers, as an array of matrices."""
    rows = [[np.broadcast_to(y, x.shape[:-1]) for y in row] for row in entries]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
