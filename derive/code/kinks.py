"""Where what a problem says has no derivative: where the roots in its expressions are 0, of which
|x|, sign, min and max, hypot and atan2 are made."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group
from ..language.show import show
from ..language.tree import Tree, add, mul, nodes, replaced, sized
from ..record.as_json import decode
from .typed_names import LONGEST_LAW, plain_text, typed

OF_RATES = ("acceleration", "specific_force", "power")
"""The outputs in which all is that acts."""


def kinks(problem: Mapping[str, Any], group: Group) -> dict[str, tuple[str, ...]]:
    """A comment of ASCII for ``rates``, dx/dt, and one for ``outputs``, line by line; none where
    all is smooth."""
    acting = [x for where, t in _acting(problem) for x in _loci(where, t, problem, group)]
    read = [
        x
        for y in problem.get("outputs", ())
        for key in ("y", "relative_to")
        for t in y.get(key, ())
        for x in _loci(f"output {y['name']}", t, problem, group)
    ]
    if any(y["kind"] in OF_RATES for y in problem.get("outputs", ())):
        read = acting + read
    return {"rates": _comment(acting), "outputs": _comment(read)}


def _comment(loci: list[str]) -> tuple[str, ...]:
    text = f"Kinks, where derivatives are one-sided or none: {'; '.join(dict.fromkeys(loci))}."
    return tuple(textwrap.wrap(text, 88, break_long_words=False)) if loci else ()


def _acting(problem: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """The expressions in dx/dt, as JSON has them, each with what it is of."""
    if L := problem.get("lagrangian", {}).get("L"):
        yield "L", L
    for k, x in enumerate(problem.get("potentials", ()), 1):
        if x["kind"] == "expression":
            yield f"potential {k}", x["U"]
    for kind in ("force", "flow"):
        for k, x in enumerate(problem.get(f"{kind}s", ()), 1):
            for key in ("force", "moment", "covector", "velocity"):
                yield from ((f"{kind} {x.get('name', k)}", t) for t in x.get(key, ()))


def _loci(where: str, data: Any, problem: Mapping[str, Any], group: Group) -> Iterator[str]:
    """Where each root of an expression is 0, and what has it."""
    whole: Tree = _by_axes(decode(data, "law"), group)
    if where.startswith("potential"):  # which know the places of all points
        for x in [x for x in nodes(whole) if isinstance(x, tuple) and x[0] == "entry"]:
            whole = replaced(whole, x, ("par", f"r{x[1][1][2]}_{_row(group, x[2])}"))
    if isinstance(whole, tuple):
        for at, what in _roots(whole):
            told = " and ".join(
                f"{plain_text(show(_as_typed(x, problem, group)))} {relation} 0"
                for x, relation in at
            )
            short = told.isascii() and len(told) <= LONGEST_LAW
            yield f"in {where} {told} ({what})" if short else f"in {where} a root of 0 ({what})"


def _row(group: Group, row: int) -> int:
    """A row of its block, from 1, for one of all of the space of a product."""
    return row - max(first for first, _ in group.places if first < row)


def _by_axes(t: Tree, group: Group) -> Tree:
    """With Āv, the velocity of a place along the axes of the body, as the file calls it."""
    for v in dict.fromkeys(x[1] for x in nodes(t) if isinstance(x, tuple) and x[0] == "entry"):
        for first, factor in group.places if isinstance(v, tuple) and v[:2] == ("at", "v") else ():
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
            rest = [x for x in listed if not (isinstance(x, tuple) and x[::2] == ("pow", 2))]
            if not rest:
                yield [(x, "=") for x in squares], "hypot"
            elif not all(isinstance(x, int | Fraction) and x > 0 for x in rest):
                yield [(inside, "=")], "sqrt"


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
        names = [f"{x['name']}_{i}" for x in problem["advected"] for i in range(1, x["size"] + 1)]
        return ("par", names[t[2] - 1])
    return typed(t, group)
