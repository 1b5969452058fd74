"""The reduced equations of a record, read from its step ``poisson``: variables, rates, energy."""

from __future__ import annotations

from ...algebra.groups import Group
from ...language.tree import Tree
from ...record.claims import Claim
from ...record.record import Derivation, RecordError

VARIABLE = {"Π̇": "Π", "Ȧ": "A", "Γ̇": "Γ"}
"""The variable that each rate is of."""


class ReducedSystem:
    """The ``variables`` of the equations, momenta first, their ``rates`` and the ``energy`` as
    trees; ``group``: whose brackets they have."""

    def __init__(self, d: Derivation, group: Group):
        try:
            energy, *rates = d["poisson"].equations
        except (KeyError, ValueError):
            raise RecordError("no reduced equations: the step poisson is missing") from None
        self.group = group
        self.energy = energy.rhs
        self.variables = tuple(_variable(e.lhs) for e in rates)
        self.rates = tuple(e.rhs for e in rates)

    @property
    def momenta(self) -> int:
        """How many of the variables are momenta."""
        return sum(x[1] == "Π" for x in self.variables)


def _variable(rate: Tree) -> tuple[Tree, ...]:
    """The variable that has a rate; ``RecordError`` for what is no rate."""
    if not isinstance(rate, tuple) or str(rate[1]) not in VARIABLE:
        raise RecordError("the step poisson has an equation that is no rate")
    return (rate[0], VARIABLE[str(rate[1])], *rate[2:])


def dimension_fault(system: ReducedSystem, claim: Claim, *, momenta_alone: bool) -> str:
    """Why the equations are not of the dimension that is claimed, or do not move among
    themselves."""
    size = len(system.variables)
    if claim["dimension"] != size or len({*system.variables}) != size:
        return f"{size} rates"
    if system.momenta != system.group.dimension:
        return f"{system.momenta} momenta of {system.group.dimension}"
    return "" if (system.momenta == size) is momenta_alone else "momenta alone, or not"
