"""What stands between the factors of a LaTeX product, and numbers as factors."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

from ..language.show import ATOM, SUM
from ..language.tree import Tree

Shown = tuple[str, int]
"""LaTeX, and how tightly it holds together."""
BEFORE_FACTOR = "\x04"
"""The mark of a place where a line may break between factors."""


def number(q: int | Fraction) -> Shown:
    """A number; a small fraction is set small."""
    level = ATOM if q >= 0 else SUM
    if isinstance(q, int) or q.denominator == 1:
        return str(int(q)), level
    size = "tfrac" if abs(q.numerator) < 100 and q.denominator < 100 else "frac"
    above, below = abs(q.numerator), q.denominator
    digits = f"{above}{below}" if above < 10 and below < 10 else f"{{{above}}}{{{below}}}"
    return rf"{'' if q > 0 else '-'}\{size}{digits}", level


def outside(tex: str) -> str:
    """What stands outside every brace and parenthesis."""
    inner = re.sub(r"\{[^{}]*\}|\([^()]*\)", "", tex)
    return tex if inner == tex else outside(inner)


def _simple(t: Any) -> bool:
    """A letter with its marks, which stands beside another without a space."""
    if isinstance(t, str):
        return not t.startswith("δ")
    simple = isinstance(t, tuple) and t[0] in ("T", "inv", "pow", "at", "entry", "par", "one")
    return simple and (len(t) < 2 or _simple(t[1]))


def glue(left: Tree, right: Tree) -> str:
    """What stands between two factors."""
    if isinstance(right, (int, Fraction)):
        return rf"{BEFORE_FACTOR} \cdot "
    if isinstance(left, (int, Fraction)):
        return " "
    if isinstance(left, tuple) and left[0] == "one":
        return r"\,"
    if _simple(left) and _simple(right):
        named = [isinstance(x, tuple) and x[0] == "par" for x in (left, right)]
        return r"\," if any(named) else " "
    return rf"{BEFORE_FACTOR}\,"
