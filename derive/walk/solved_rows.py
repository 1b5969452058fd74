"""M ζ̇ = β with short entries, solved where that stays short: by the blocks of M."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..language.laurent import Laurent, grouped, written
from ..language.tree import Tree, add, mul, nodes, operands, terms
from ..record.record import Equation

LONGEST = 12
"""An equation with more terms than this is not written out."""
MOST = 60
"""As many terms has an entry at most while rows are solved."""
RATES = ("ζ", "w", "ζ̇", "ẇ")
STATE = (*RATES, "A", "T", "C", "Γ", "u", "f_u")


@dataclass(frozen=True)
class Balance:
    """Σ M_ab x_b = β_a for unknowns x_b, entries of ζ̇ (and ẇ)."""

    mass: tuple[tuple[Laurent, ...], ...]
    load: tuple[Laurent, ...]
    unknowns: tuple[Tree, ...]


def solved(stage: Balance) -> tuple[Equation, ...] | None:
    """The equations of the unknowns, in order; ``None`` where one would be too long."""
    found: dict[int, Equation] = {}
    for block in _blocks(stage.mass):
        tried = _alone(stage, block)
        if tried is None or _too_long(tried):
            tried = _together(stage, block)
        if _too_long(tried):
            return None
        found |= zip(block, tried, strict=True)
    return tuple(found[a] for a in sorted(found))


def told(rows: Sequence[tuple[Tree, Laurent]]) -> tuple[Equation, ...] | None:
    """Rates as they are; ``None`` where one is too long."""
    found = tuple(Equation(x, tree(p)) for x, p in rows)
    return None if _too_long(found) else found


def _too_long(equations: Sequence[Equation]) -> bool:
    return any(_length(e.lhs) + _length(e.rhs) > LONGEST for e in equations)


def _length(t: Tree) -> int:
    """How many terms a tree has, those of its quotients and sums in brackets among them."""
    if not isinstance(t, tuple):
        return 1
    if t[0] == "add":
        return sum(map(_length, t[1:]))
    return max([1, *map(_length, operands(t))]) if t[0] in ("mul", "div", "pow", "fun") else 1


def _blocks(mass: tuple[tuple[Laurent, ...], ...]) -> list[list[int]]:
    """The rows of M by what they share: those of one block are joined by entries that are not 0."""
    left, found = [*range(len(mass))], []
    while left:
        block = [left.pop(0)]
        for a in block:
            near = [b for b in left if mass[a][b] or mass[b][a]]
            block += near
            left = [b for b in left if b not in near]
        found.append(sorted(block))
    return found


def _alone(stage: Balance, block: list[int]) -> list[Equation] | None:
    """The rows of a block solved; ``None`` where that takes divisors of several terms, but for a
    single row, or of the state."""
    mass = [[stage.mass[a][b] for b in block] for a in block]
    load = [stage.load[a] for a in block]
    if not any(load):
        values: list[Tree] | None = [0 for _ in block]
    elif len(block) == 1 and len(mass[0][0].terms) > 1:
        values = [("div", tree(load[0]), written(mass[0][0]))]
    else:
        found = _eliminated(mass, load)
        values = None if found is None else [*map(tree, found)]
    if values is None:
        return None
    return [Equation(stage.unknowns[a], x) for a, x in zip(block, values, strict=True)]


def _eliminated(mass: list[list[Laurent]], load: list[Laurent]) -> list[Laurent] | None:
    """The x of M x = β by Gauss and Jordan, every pivot one constant term; ``None`` where there is
    no such pivot, or an entry is long."""
    rows = [[*row, x] for row, x in zip(mass, load, strict=True)]
    left = {*range(len(rows))}
    while left:
        k = next((k for k in sorted(left) if _is_pivot(rows[k][k])), None)
        if k is None:
            return None
        left.remove(k)
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i, row in enumerate(rows):
            if i != k and row[k]:
                rows[i] = [x - row[k] * y for x, y in zip(row, rows[k], strict=True)]
        if any(len(x.terms) > MOST for row in rows for x in row):
            return None
    return [row[-1] for row in rows]


def _is_pivot(p: Laurent) -> bool:
    return len(p.terms) == 1 and not any(depends(s) for m in p.terms for s, _ in m)


def _together(stage: Balance, block: list[int]) -> list[Equation]:
    """The rows of a block as they are."""
    sides = [
        add(*(_times(stage.mass[a][b], stage.unknowns[b]) for b in block if stage.mass[a][b]))
        for a in block
    ]
    return [Equation(x, tree(stage.load[a])) for a, x in zip(block, sides, strict=True)]


def _times(p: Laurent, name: Tree) -> Tree:
    factor = tree(p)
    return mul(factor, name) if len(terms(factor)) == 1 else ("mul", factor, name)


def tree(p: Laurent) -> Tree:
    """The tree of a polynomial: what depends on parameters together, velocities last."""
    return grouped(p, lambda x: not depends(x), _is_rate)


def _is_rate(x: Tree) -> bool:
    return isinstance(x, tuple) and x[0] == "entry" and x[1] in RATES


def depends(x: Tree) -> bool:
    """Does a symbol depend on the state, the time or inputs, or stand for a force that may?"""
    return any(
        y == "t"
        or (isinstance(y, tuple) and y[0] == "at")
        or (isinstance(y, tuple) and y[0] == "entry" and y[1] in STATE)
        for y in nodes(x)
    )
