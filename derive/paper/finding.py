"""What became of a numbered equation of the paper, as data: nothing is computed here."""

from __future__ import annotations

from dataclasses import dataclass

from ..record.record import Equation

CONFIRMED, DEFINITION = "confirmed", "definition"
SIGN, OMISSION, MISPRINT = "sign convention", "omission", "misprint"
VERDICTS = (CONFIRMED, SIGN, OMISSION, MISPRINT, DEFINITION)

HOLDS = {SIGN: "with −dϖ for dϖ, −ω for ω", OMISSION: "where there are no forces"}
"""How what is false as it stands is true, by its verdict."""


@dataclass(frozen=True)
class Finding:
    """What became of one numbered equation.

    ``verdict``: one of :data:`VERDICTS`; ``equations``: those that are false as printed.
    """

    number: int
    verdict: str
    printed: str
    derived: str | None
    counterexample: dict[str, str] | None
    remark: str
    equations: tuple[Equation, ...] = ()

    @property
    def holds(self) -> str | None:
        """In words, how a print that is false as it stands is true; ``None`` for any other."""
        return HOLDS.get(self.verdict)
