"""The reduction of a problem as Python holds it, and its record."""

from __future__ import annotations

from dataclasses import dataclass

from ..language.tree import Tree
from ..record.record import Derivation
from ..reduction.routhian import Routhian
from .checked import Checked
from .shown import Shown, ShownEquation


@dataclass(frozen=True)
class Reduced(Checked):
    """Routh's reduction by symmetries that commute.  ``found``: all that is known of it;
    ``record``: its derivation."""

    found: Routhian
    record: Derivation

    @property
    def kinds(self) -> tuple[str, ...]:
        """What the symmetries are called, in the order of the momenta: "rotation_space" …"""
        return tuple(x.kind for x in self.found.chosen)

    @property
    def freedom(self) -> int:
        """How many degrees of freedom are left."""
        return self.found.freedom

    def __getitem__(self, label: str) -> Shown:
        """A step by its label, with or without the problem's name: "locked", "effective" …"""
        return Shown(self.record[label], self.record)

    def _equation(self, label: str, lhs: Tree) -> ShownEquation:
        step = self.record[label]
        found = next(e for e in step.equations if e.lhs == lhs)
        return ShownEquation(found, self.record)

    @property
    def locked_inertia(self) -> ShownEquation:
        """𝕀 as a function of g."""
        return self._equation("locked", "𝕀")

    @property
    def effective_potential(self) -> ShownEquation:
        """𝒱 as a function of g and the momenta."""
        return self._equation("effective", "𝒱")

    @property
    def quadrature(self) -> ShownEquation | None:
        """The square of the rate of the coordinate that is left, by the energy and the momenta;
        ``None`` where more than one is left, or one that is no entry of g."""
        told = [s for s in self.record.steps if s.label.endswith(".quadrature")]
        return self._equation("quadrature", told[0].equations[0].lhs) if told else None

    def __str__(self) -> str:
        from ..reduction.reduced_record import shown
        from ..views.rendering import render

        return render(self.record, "text", steps=shown(self.record))
