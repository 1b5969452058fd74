"""The part of a record that is about one group: its labels, scope and assumptions, said once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from ..record.record import Equation, Step
from ..record.sentence import Prose


@dataclass(frozen=True)
class Chapter:
    """``name`` prefixes the labels, ``general`` those of the text about any group."""

    name: str
    general: str
    scope: str
    given: tuple[str, ...] = ()

    def with_input(self) -> Chapter:
        """The same where an input acts."""
        return replace(self, given=("input",))

    def step(
        self, label: str, rule: str, uses: str, equations: Iterable[Equation], prose: Prose
    ) -> Step:
        """A step; ``uses`` lists labels, those of the general text with a leading dot."""
        used = tuple(
            f"{self.general}{x}" if x.startswith(".") else f"{self.name}.{x}" for x in uses.split()
        )
        return Step(
            f"{self.name}.{label}", rule, used, tuple(equations), prose, (), self.scope, self.given
        )
