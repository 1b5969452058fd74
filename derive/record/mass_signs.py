"""The sign of masses: does a record's problem allow negative ones, by its key or its numbers?"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.layers import at_levels
from ..language.tree import Tree
from ..language.values import approximate
from .record import RecordError
from .tree_data import decode

ANY_SIGN = "of any sign"
"""The value of the key ``masses`` of a problem that says its masses may be negative."""

SUPPOSED = "it supposes positive masses, and some of this problem may be negative"


def any_sign(problem: Mapping[str, Any]) -> bool:
    """Does the problem say that masses may be negative, or has it a negative one? ``RecordError``
    for another value of the key ``masses``."""
    if problem.get("masses") not in (None, ANY_SIGN):
        raise RecordError(f"record, problem: key 'masses' can only be {ANY_SIGN!r}")
    body = problem.get("body", {})
    defaults = {
        name: about["default"]
        for name, about in problem.get("parameters", {}).items()
        if about["default"] is not None
    }
    masses = [p["mass"] for p in body.get("points", [])]
    masses.append(body.get("given", {}).get("m", 1))
    trees = [decode(x, "problem") for x in masses]
    for x in body.get("solids", []):
        trees += (density for _, density in at_levels(decode(x["density"], "problem")))
    negative = any((_default_value(t, defaults) or 0) < 0 for t in trees)
    return "masses" in problem or negative or _of_no_positive_masses(body)


def _of_no_positive_masses(body: Mapping[str, Any]) -> bool:
    """Are the given m, c, J numbers for which [[J, c], [c̄, m]] is not semidefinite?"""
    given = body.get("given", {})
    if not given or body.get("solids"):
        return False
    m, *c = (_plain_number(x) for x in (given["m"], *given["c"]))
    J = [[_plain_number(x) for x in row] for row in given["J"]]
    whole = [[*row, x] for row, x in zip(J, c, strict=True)] + [[*c, m]]
    return all(x is not None for row in whole for x in row) and not q.semidefinite(whole)


def _plain_number(x: Any) -> Fraction | None:
    """The number that an expression of the record is; ``None`` where it has parameters."""
    t = decode(x, "problem")
    return Fraction(t) if isinstance(t, (int, Fraction)) else None


def _default_value(t: Tree, defaults: Mapping[str, float]) -> float | None:
    """The value of an expression at its parameters' defaults; ``None`` if one has none."""
    try:
        return approximate(t, defaults, float)
    except ValueError:
        return None
