"""The claims about the symmetries of a Lagrangian: how many there are, as many independent ones are
listed, which functions in it were taken for any numbers."""

from __future__ import annotations

import re
from collections.abc import Callable

from ...language.tree import Tree, add, neg, terms
from ...record.record import Derivation, RecordError, Step
from ...record.sentence import Claim
from .symmetry_count import Listed, SymmetryCount

Judge = Callable[[SymmetryCount, Derivation, Step, Claim], str]
ON_FORM: Tree = ("call", "ϖ", "δy")
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
    listed = [_listed(x) for x in record.steps if LISTED.search(x.label)]
    if told != len(listed):
        return f"{len(listed)} are listed"
    return "" if found.independent(listed) else "those that are listed depend on one another"


def _listed(step: Step) -> Listed:
    """The field of a step about a symmetry, and F, which is taken from ϖ of the field."""
    field = {e.lhs: e.rhs for e in step.given}
    forms = [terms(e.lhs) for e in step.equations if ON_FORM in terms(e.lhs)]
    if {*field} != {"δt", "δA"} or len(forms) != 1:
        raise RecordError(f"the step {step.label} lists no symmetry")
    F = neg(add(*(x for x in forms[0] if x != ON_FORM)))
    return Listed(field["δt"], field["δA"], F)


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
