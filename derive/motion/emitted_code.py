"""A program with its record, and the columns of what a motion of it gives: nothing is run here."""

from __future__ import annotations

from dataclasses import dataclass

from ..code.program import Program
from ..problem.problem import Problem
from ..record.record import Derivation
from .kept_words import in_order

KINDS = ("time", "state", "energy", "conserved", "defect", "multiplier")
"""What a column can be, in the order of a table."""


@dataclass(frozen=True)
class Column:
    """A column of a run: its name, what it is (of KINDS), its unit, empty where there is none."""

    name: str
    kind: str
    unit: str = ""


def in_si(problem: Problem) -> bool:
    """Are the numbers of a problem in SI?"""
    units = any(x.unit for x in problem.parameters.values())
    return units and problem.lagrangian is None


@dataclass(frozen=True)
class EmittedCode:
    """A program and its record; are the numbers of the problem in SI?"""

    program: Program
    record: Derivation
    in_si: bool

    @property
    def name(self) -> str:
        """The prefix of the emitted functions."""
        return self.program.name

    @property
    def kept(self) -> list[int]:
        """The places of what is conserved beside the energy, which has a column of its own."""
        names = self.program.conserved
        return [k for k in in_order(names) if names[k] != "energy"]

    def columns(self) -> tuple[Column, ...]:
        """The columns of a run: time, state, then what :meth:`table` adds."""
        has = self.program.functions
        names = [("t", "time"), *((x, "state") for x in self.program.state), ("energy", "energy")]
        names += [(self.program.conserved[k], "conserved") for k in self.kept]
        names += [("defect", "defect")] * ("defect" in has)
        names += [("multiplier", "multiplier")] * ("multiplier" in has)
        return tuple(Column(x, kind, self._unit(x, kind)) for x, kind in names)

    def _unit(self, name: str, kind: str) -> str:
        if kind == "time":
            return "s" if self.in_si else ""
        if not self.in_si or kind not in ("state", "energy", "multiplier"):
            return ""
        by_letter = {"T": "m", "z": "1/s", "w": "m/s"}
        return by_letter.get(name[0], "") if kind == "state" else "J"
