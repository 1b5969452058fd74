"""Dimensions of expressions, where units say them: what is a force must be in N.

Only what is certain is refused: a term without a parameter that has a unit, and one with a unit
that is not of these, may be in anything.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from unicodedata import normalize

from ..language.tree import Tree, nodes, terms
from .problem import ProblemError

Dimension = tuple[Fraction | int, ...]
"""The exponents of kg, m and s."""
BASE = ("kg", "m", "s")
NUMBER: Dimension = (0, 0, 0)
FORCE, MOMENT, VELOCITY, PLACE, RATE = (1, 1, -2), (1, 2, -2), (0, 1, -1), (0, 1, 0), (0, 0, -1)
UNITS: Mapping[str, Dimension] = {
    **{"kg": (1, 0, 0), "m": PLACE, "s": (0, 0, 1), "rad": NUMBER, "1": NUMBER, "Hz": RATE},
    **{"N": FORCE, "J": MOMENT, "W": (1, 2, -3), "Pa": (1, -1, -2)},
}
WANTED: Mapping[str, Dimension] = {
    **{"a force": FORCE, "a moment": MOMENT, "a linear damping": (1, 0, -1)},
    **{"a quadratic damping": (1, -1, 0), "a rotational damping": (1, 2, -1)},
}
FACTOR = re.compile(r"\s*([*/· .]?)\s*([^\W\d_]+|1)(?:\^?\(?(-?\d+)\)?)?")
PURE = {"sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "atan"}


def measured(unit: str) -> Dimension | None:
    """The dimension of a unit, as N s/m; ``None`` where it is not made of these of SI, or where
    it is not clear what is below its line, as in N/m s."""
    found, at, text = NUMBER, 0, normalize("NFKC", unit).strip()
    below = False
    while at < len(text):
        factor = FACTOR.match(text, at)
        if not factor or factor[2] not in UNITS or (below and factor[1] != "/"):
            return None
        below = factor[1] == "/"
        k = int(factor[3] or 1) * (-1 if below else 1)
        found = tuple(a + k * b for a, b in zip(found, UNITS[factor[2]], strict=True))
        at = factor.end()
    return found if text else None


def in_units(d: Dimension) -> str:
    """A dimension as a unit: kg m/s^2."""
    told = {
        sign: [
            x + (f"^{abs(e)}" if abs(e) != 1 else "")
            for x, e in zip(BASE, d, strict=True)
            if e * sign > 0
        ]
        for sign in (1, -1)
    }
    return "/".join([" ".join(told[1]) or "1", *told[-1]])


def dimension(t: Tree, known: Mapping[str, Dimension]) -> Dimension | None:
    """That of a tree, numbers having none; ``None`` where it is not known."""
    if not isinstance(t, tuple):
        return NUMBER
    op, *parts = t
    if op == "par":
        return known.get(parts[0])
    if op == "fun":
        inside = dimension(parts[1], known) if parts[0] == "sqrt" else None
        return NUMBER if parts[0] in PURE else inside and tuple(Fraction(x) / 2 for x in inside)
    if op == "pow":
        inside = dimension(parts[0], known)
        return inside and tuple(x * parts[1] for x in inside)
    found = [dimension(x, known) for x in parts if op != "add" or isinstance(x, tuple)]
    if op == "add":  # a number in a sum is in what the others are in
        return next((x for x in found if x is not None), None)
    if op not in ("mul", "div") or None in found:
        return None
    signs = (1, -1) if op == "div" else (1,) * len(found)
    whole = [tuple(k * x for x in d) for k, d in zip(signs, found, strict=True) if d is not None]
    return tuple(map(sum, zip(*whole, strict=True)))


def require(
    t: Tree,
    what: str,
    where: str,
    stated: Mapping[str, str],
    of_state: Mapping[str, Dimension],
) -> None:
    """``ProblemError`` where a term of an expression is not in the unit of ``what`` it is;
    ``stated``: the units of parameters. None where no unit has a mass: the numbers of such a
    problem may be in parts of anything."""
    units = {x: d for x, unit in stated.items() if (d := measured(unit)) is not None}
    wanted = WANTED.get(what)
    if wanted is None or not any(d[0] for d in units.values()):
        return
    for term in terms(t):
        own = [x[1] for x in nodes(term) if isinstance(x, tuple) and x[0] == "par"]
        found = dimension(term, {**of_state, **units}) if {*own} & {*units} else None
        if found is not None and found != wanted:
            given = ", ".join(f"{x} in {stated[x]}" for x in dict.fromkeys(own) if x in units)
            raise ProblemError(
                f"{where}: with {given} it is in {in_units(found)}, and {what} is in "
                f"{in_units(wanted)}; correct the unit or the expression"
            )
