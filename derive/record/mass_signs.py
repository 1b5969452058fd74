"""The sign of masses: does a record's problem allow negative ones, by its key or its numbers?"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from ..language import rational as q
from ..language.layers import at_levels
from ..language.tree import Tree
from ..language.values import approximate
from .as_json import decode
from .record import RecordError

ANY_SIGN = "of any sign"
"""The value of the key ``masses`` of a problem that says its masses may be negative."""

SUPPOSED = "it supposes positive masses, and some of this problem may be negative"

DIGITS = 10**3
"""Moments in few digits are those of positive masses where they are so but for this part of J."""


def any_sign(problem: Mapping[str, Any]) -> bool:
    """Does the problem say that masses may be negative, or has it a negative one, or one of the
    moments that are sums of masses times squares? ``RecordError`` for another value of the key
    ``masses``."""
    if problem.get("masses") not in (None, ANY_SIGN):
        raise RecordError(f"record, problem: key 'masses' can only be {ANY_SIGN!r}")
    body, known = problem.get("body", {}), defaults(problem)
    trees = [decode(p["mass"], "problem") for p in body.get("points", [])]
    trees.append(decode(body.get("given", {}).get("m", 1), "problem"))
    if body.get("kind") == "moments":
        m, _, J = moments(problem)
        trees += (m, *(row[i] for i, row in enumerate(J)))
    for x in body.get("solids", []):
        trees += (density for _, density in at_levels(decode(x["density"], "problem")))
    negative = any((default_value(t, known) or 0) < 0 for t in trees)
    return "masses" in problem or negative or of_no_masses(problem, {})


def of_no_masses(problem: Mapping[str, Any], values: Mapping[str, float]) -> bool:
    """Is [[J, c], [c̄, m]] of a body that is told by its moments not semidefinite, for ``values`` of
    the parameters? No, where one has none."""
    body = problem.get("body", {})
    if body.get("solids") or not (body.get("given") or body.get("kind") == "moments"):
        return False
    m, c, J = moments(problem)
    rows = [*([*row, x] for row, x in zip(J, c, strict=True)), [*c, m]]
    found = [[default_value(t, values) for t in row] for row in rows]
    whole = [[Fraction(x) for x in row if x is not None] for row in found]
    if any(len(row) < len(rows) for row in whole):
        return False
    few = sum((abs(row[i]) for i, row in enumerate(whole[:-1])), Fraction(0)) / DIGITS
    for i, row in enumerate(whole[:-1]):
        row[i] += few
    return not q.semidefinite(whole)


def moments(problem: Mapping[str, Any]) -> tuple[Tree, list[Tree], list[list[Tree]]]:
    """m, c and J of a body that is told by them, as expressions in parameters."""
    if given := problem["body"].get("given"):
        c, *J = ([decode(x, "problem") for x in row] for row in (given["c"], *given["J"]))
        return decode(given["m"], "problem"), c, J
    span = range(1, problem["n"] + 1)
    first: list[Tree] = [("par", f"c_{i}") for i in span]
    second: list[list[Tree]] = [[("par", f"J_{min(i, j)}{max(i, j)}") for j in span] for i in span]
    return ("par", "m"), first, second


def defaults(problem: Mapping[str, Any]) -> dict[str, float]:
    """Name → the default of a parameter that has one."""
    listed = problem.get("parameters", {}).items()
    return {x: about["default"] for x, about in listed if about["default"] is not None}


def default_value(t: Tree, known: Mapping[str, float]) -> float | None:
    """The value of an expression at its parameters' defaults; ``None`` if one has none."""
    try:
        return approximate(t, known, float)
    except ValueError:
        return None
