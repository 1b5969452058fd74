"""The claims about the symmetries of a Lagrangian: how many there are, which functions in it were
taken for any numbers."""

from __future__ import annotations

import re
from collections.abc import Callable

from ...record.claims import Claim
from ...record.record import Derivation, Step
from .symmetry_count import SymmetryCount

Judge = Callable[[SymmetryCount, Derivation, Step, Claim], str]
LISTED = re.compile(r"\.conserved_[0-9]+$")


def _dimension(found: SymmetryCount, record: Derivation, step: Step, claim: Claim) -> str:
    """The dimension is that of all symmetries, and as many are listed."""
    told = dict(claim.values).get("dimension", 0)
    held = bool(record.problem["lagrangian"].get("held"))
    if held is not (claim.kind == "symmetries.algebra_modulo") and told != 0:
        return "it is modulo those without kinetic energy, or not"
    if found.open_functions and not any(x.kind == "symmetries.open" for x in step.claims):
        return "functions were taken for any numbers"
    if told != found.dimension:
        return f"the dimension is {found.dimension}"
    listed = sum(bool(LISTED.search(x.label)) for x in record.steps)
    return "" if told == listed else f"{listed} are listed"


def _open(found: SymmetryCount, record: Derivation, step: Step, claim: Claim) -> str:
    names = claim["functions"]
    same = names == ("row", *found.open_functions)
    return "" if same else f"they are {', '.join(found.open_functions) or 'none'}"


JUDGES: dict[str, Judge] = {
    **dict.fromkeys(
        ("symmetries.algebra", "symmetries.algebra_modulo", "symmetries.none"), _dimension
    ),
    "symmetries.open": _open,
}
