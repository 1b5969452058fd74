"""What a problem file says, in comments of emitted files: plain ASCII, by the names typed there."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ..algebra.groups import Group, names_by_block
from ..language.reserved import SPELT, suffixed
from ..language.show import show
from ..language.tree import Tree, mul, plain
from ..record.as_json import decode

LONGEST_LAW = 200
"""Letters of the law of a force in a head; where it has more, the head says that there is one."""


def plain_text(text: str) -> str:
    """An expression as it may stand in an ASCII comment: 1/4 for the one letter, pi, ^2, v_1."""
    text = re.sub("[₀-₉]+", r"_\g<0>", text)
    text = re.sub("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+", lambda x: "^" + x[0].replace("⁻", "-"), text)
    spelt = str.maketrans(SPELT | {"\u2212": "-", "·": "*"})
    return unicodedata.normalize("NFKD", text.translate(spelt)).replace("\u2044", "/")


def law(components: Sequence[Any], group: Group | None = None) -> str:
    """The components of a vector, or of a force of the state, by the names of the problem file."""
    trees = [typed(decode(y, "law"), group) for y in components]
    text = ", ".join(plain_text(show(x)) for x in trees)
    return f" ({text})" if text.isascii() and len(text) <= LONGEST_LAW else ""


def typed(t: Tree, group: Group | None) -> Tree:
    """Entries as names: those of the velocity of the place as v_1, of A as A_12, in the second
    block of a product as A2_12 or T2_1, of Z as the coordinate that it is, zeta2_1 or w2_1."""
    if not isinstance(t, tuple):
        return t
    if t[0] != "entry":
        parts = [typed(x, group) for x in t[1:]]
        return mul(*parts) if t[0] == "mul" else (t[0], *parts)  # the signs of both are one
    letter, row, *more = t[1:]
    if isinstance(
        letter, tuple
    ):  # of a place: r of ("call", ("at", "r", i), "t"), v of ("at", "v", i)
        head = letter[1][1] if letter[0] == "call" else letter[1]
        return ("par", suffixed(plain_text(head), row - _block(group, row)[1]))
    if group and letter == "A" and group.factors:
        return ("par", _of_block(group, row, *more))
    if group and letter == "Z" and (found := _coordinate(group, row, *more)):
        return found
    name = suffixed(plain_text(letter), row, *more)
    return ("par", names_by_block(group).get(name, name) if group else name)


def _block(group: Group | None, row: int) -> tuple[int, int, Group | None]:
    """The block, from 1, in which a row is, how many rows are before it, and its factor."""
    places = group.places if group and group.factors else [(0, group)]
    return [(k, x, y) for k, (x, y) in enumerate(places, 1) if x < row][-1]


def _of_block(group: Group, row: int, column: int) -> str:
    """An entry of g by the letters of its block."""
    k, before, factor = _block(group, row)
    mark = str(k) if len(group.factors) > 1 else ""
    if factor and factor.affine and column == before + factor.n + 1:
        return suffixed(f"T{mark}", row - before)
    return suffixed(f"A{mark}", row - before, column - before)


def _coordinate(group: Group, row: int, column: int) -> Tree | None:
    """The entry of Z by the only coordinate that is a multiple of it alone, if one is."""
    for a in range(group.dimension):
        for x, i, j in group.coordinate_terms(a)[:1]:
            if (i, j) == (row - 1, column - 1) and len(group.coordinate_terms(a)) == 1:
                name = suffixed("zeta", a + 1)
                name = names_by_block(group).get(name, name)
                return mul(plain(Fraction(1) / x), ("par", name))
    return None
