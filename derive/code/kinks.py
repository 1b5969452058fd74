"""Where what a problem says has no derivative: where the roots in its expressions are 0, of which
|x|, sign, min and max, hypot and atan2 are made."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..language.reserved import advected_entries
from ..language.show import show
from ..language.tree import Tree, add, mul, neg, nodes, replaced, sized
from ..record.as_json import decode
from .naming import LONGEST_LAW, plain_text, row_of_block, typed

OF_RATES = ("acceleration", "specific_force", "power")
"""The outputs in which all is that acts."""

LAWS = ("force", "moment", "covector", "velocity")
"""The keys of a force, or of a flow, that have expressions."""


def kinks(problem: Mapping[str, Any], group: Group) -> dict[str, tuple[str, ...]]:
    """A comment of ASCII for ``rates``, dx/dt, and one for ``outputs``, line by line; none where
    all is smooth.  ``problem``: of a record, with the ``wind`` of forces of the state as trees."""
    acting = [x for where, t in _acting(problem, group) for x in _loci(where, t, problem, group)]
    read = [
        x
        for y in problem.get("outputs", ())
        for t in y.get("y", ())
        for x in _loci(f"output {y['name']}", decode(t, "law"), problem, group)
    ]
    if any(y["kind"] in OF_RATES for y in problem.get("outputs", ())):
        read = acting + read
    return {"rates": _comment(acting), "outputs": _comment(read)}


STEEP = ("sqrt", "tanh", "atan")
"""A root, as in |v| and so in sign, min and max, has derivatives that jump where it is 0; the
others stand for a sign, and are nearly as steep as one there."""


def may_bend(problem: Mapping[str, Any]) -> bool:
    """Has a force of the problem of a record a function that is STEEP?"""
    given = [x for f in problem.get("forces", ()) for key in LAWS for x in f.get(key, ())]
    found = [x for t in given for x in nodes(decode(t, "law"))]
    return any(isinstance(x, tuple) and x[0] == "fun" and x[1] in STEEP for x in found)


def _comment(loci: list[str]) -> tuple[str, ...]:
    text = f"Kinks, where derivatives are one-sided or none: {'; '.join(dict.fromkeys(loci))}."
    return tuple(textwrap.wrap(text, 88, break_long_words=False)) if loci else ()


def _acting(problem: Mapping[str, Any], group: Group) -> Iterator[tuple[str, Tree]]:
    """The expressions in dx/dt, each with what it is of."""
    if L := problem.get("lagrangian", {}).get("L"):
        yield "L", decode(L, "law")
    for k, x in enumerate(problem.get("potentials", ()), 1):
        if x["kind"] == "expression":
            yield f"potential {k}", decode(x["U"], "law")
    for kind in ("force", "flow"):
        for k, x in enumerate(problem.get(f"{kind}s", ()), 1):
            told = [t for key in LAWS for t in x.get(key, ())]
            trees = [decode(t, "law") for t in (*told, *([x["rate"]] if "rate" in x else []))]
            called = f"{kind} {x['name']}" if "name" in x else x.get("table", f"{kind} {k}")
            yield from ((called, t) for t in _in_wind(trees, x.get("wind", ()), group))


def _in_wind(trees: list[Tree], wind: Sequence[Tree], group: Group) -> list[Tree]:
    """With v − c, what the file calls v where air moves by c, as v, and each such c."""
    met: list[Tree] = []
    for v in dict.fromkeys(x for t in trees for x in _velocities(t)):
        c = wind[row_of_block(group, v[2]) - 1] if wind else 0
        if c != 0 and any((less := add(v, neg(c))) in nodes(t) for t in trees):
            trees = [replaced(t, less, v) for t in trees]
            met.append(c)
    return trees + met


def _velocities(t: Tree) -> list[tuple[Any, ...]]:
    """The components of velocities of places in an expression."""
    entries = [x for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"]
    return [x for x in entries if isinstance(x[1], tuple) and x[1][:2] == ("at", "v")]


def _loci(where: str, t: Tree, problem: Mapping[str, Any], group: Group) -> Iterator[str]:
    """Where each root of an expression is 0, and what has it."""
    whole = _by_axes(t, group)
    if where.startswith("potential"):  # which know the places of all points
        for x in [x for x in nodes(whole) if isinstance(x, tuple) and x[0] == "entry"]:
            whole = replaced(whole, x, ("par", f"r{x[1][1][2]}_{row_of_block(group, x[2])}"))
    if isinstance(whole, tuple):
        for conditions, what in _roots(whole):
            if (at := _that_may_hold(conditions)) is None:
                continue
            told = " and ".join(
                f"{plain_text(show(_as_typed(x, problem, group)))} {relation} 0"
                for x, relation in at
            )
            short = told.isascii() and len(told) <= LONGEST_LAW
            yield f"in {where} {told} ({what})" if short else f"in {where} a root of 0 ({what})"


def _by_axes(t: Tree, group: Group) -> Tree:
    """With Āv, the velocity of a place along the axes of the body, as the file calls it."""
    for v in dict.fromkeys(x[1] for x in _velocities(t)):
        for first, factor in group.places:
            rows = range(first + 1, first + factor.n + 1)
            for k in rows:
                along = add(*(mul(("entry", "A", j, k), ("entry", v, j)) for j in rows))
                t = replaced(t, along, ("entry", v, k))
    return t


def _roots(whole: Tree) -> Iterator[tuple[list[tuple[Tree, str]], str]]:
    """What is 0, or not positive, at each kink, and the function that has it there."""
    found = [x for x in nodes(whole) if isinstance(x, tuple)]
    signs = {x[2] for x in found if x[0] == "div"}
    halves = [x[2] for x in found if x[:2] == ("mul", Fraction(1, 2)) and isinstance(x[2], tuple)]
    terms = [x for y in halves for x in y[1:] if isinstance(x, tuple)]
    halved = {x[-1] if x[0] == "mul" else x for x in terms}
    angles = dict(filter(None, map(_angle, found)))
    for root in dict.fromkeys(x for x in found if x[:2] == ("fun", "sqrt")):
        inside = root[2]
        if root in angles:
            yield angles[root], "atan2"
        elif (x := sized(root)) is not None:
            what = "sign" if root in signs else "min or max" if root in halved else "abs"
            yield [(x, "=")], what
        else:
            listed = inside[1:] if isinstance(inside, tuple) and inside[0] == "add" else (inside,)
            squares = [x[1] for x in listed if isinstance(x, tuple) and x[::2] == ("pow", 2)]
            if len(squares) == len(listed):
                yield [(x, "=") for x in squares], "hypot"
            else:
                yield [(inside, "=")], "sqrt"


def _that_may_hold(conditions: list[tuple[Tree, str]]) -> list[tuple[Tree, str]] | None:
    """Those that do not hold everywhere; ``None`` where one never does, or all always do."""
    held = {"=": {0}, "<=": {-1, 0}}
    found = [(x, relation, _signs(x)) for x, relation in conditions]
    if not all(signs & held[relation] for _, relation, signs in found):
        return None
    return [(x, relation) for x, relation, signs in found if not signs <= held[relation]] or None


def _signs(t: Tree) -> set[int]:
    """The signs that an expression may have, by those of its numbers, its even powers and exp."""
    any_sign = {-1, 0, 1}
    match t:
        case int() | Fraction():
            return {(t > 0) - (t < 0)}
        case ("fun", "exp" | "cosh", _):
            return {1}
        case ("fun", "sqrt", x):
            return _signs(x) & {0, 1} or any_sign
        case ("pow", x, int(n)):
            return {s if n % 2 else s * s for s in _signs(x)}
        case ("mul" | "div", *factors):
            found = {1}
            for x in factors:
                found = {a * b for a in found for b in _signs(x)}
            return found
        case ("add", *terms):
            signs = set[int]().union(*map(_signs, terms))
            cancel = {-1, 1} <= signs
            some = any(0 not in _signs(x) for x in terms)
            return any_sign if cancel else signs - {0} if some else signs
    return any_sign


def _angle(t: Any) -> tuple[Tree, list[tuple[Tree, str]]] | None:
    """The root r in atan2(y, x) = 2 atan(2ry/((r + x)² + y²)), and y = 0 with x ≤ 0."""
    match t:
        case ("fun", "atan", ("div", _, ("add", ("pow", ("add", *sum_of), 2), ("pow", y, 2)))):
            roots = [x for x in sum_of if isinstance(x, tuple) and x[:2] == ("fun", "sqrt")]
            if roots:
                x = add(*(z for z in sum_of if z != roots[0]))
                return roots[0], [(y, "="), (x, "<=")]
    return None


def _as_typed(t: Tree, problem: Mapping[str, Any], group: Group) -> Tree:
    """By the names of the problem file; what an algebra carries along by its own."""
    if isinstance(t, tuple) and t[0] == "entry" and t[1] == "Γ":
        return ("par", advected_entries(problem)[t[2] - 1])
    return typed(t, group)
