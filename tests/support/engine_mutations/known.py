"""Survivors that are understood, each with the reason why nothing can or need catch it."""

from tests.support.engine_mutations.operators import Mutant

EXPLAINED: dict[tuple[str, str], str] = {}
"""(module, change) → reason."""


def reason(m: Mutant) -> str:
    """Empty for a survivor that is not explained."""
    return EXPLAINED.get((m.module, f"{m.kind}: {m.change}"), "")
