"""Factors of a LaTeX product side by side: numbers, and what separates two factors."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

from ..language.show import ATOM, SUM
from ..language.tree import Tree
from .typeset import BEFORE_FACTOR, Formula, fraction, literal

SPACE, THIN, DOT = literal(" "), literal(r"\,"), literal(rf"{BEFORE_FACTOR} \cdot ")


def number(q: int | Fraction) -> tuple[Formula, int]:
    """A number and how tightly it holds together; a small fraction is set small."""
    level = ATOM if q >= 0 else SUM
    sign = literal("" if q > 0 else "-")
    if isinstance(q, int) or q.denominator == 1:
        return literal(str(int(q))), level
    size = "tfrac" if abs(q.numerator) < 100 and q.denominator < 100 else "frac"
    above, below = str(abs(q.numerator)), str(q.denominator)
    short = len(above) == len(below) == 1
    digits = above + below if short else f"{{{above}}}{{{below}}}"
    return sign + fraction(literal(above), literal(below), rf"\{size}{digits}"), level


def outside(tex: str) -> str:
    """The part of a LaTeX formula that is outside every brace and parenthesis."""
    inner = re.sub(r"\{[^{}]*\}|\([^()]*\)", "", tex)
    return tex if inner == tex else outside(inner)


def _simple(t: Any) -> bool:
    """Is it a letter with its marks, which stands beside another without a space?"""
    if isinstance(t, str):
        return not t.startswith("δ")
    simple = isinstance(t, tuple) and t[0] in ("T", "inv", "pow", "at", "entry", "par", "one")
    return simple and (len(t) < 2 or _simple(t[1]))


def separator(left: Tree, right: Tree) -> Formula:
    """The sign, or space, between two factors."""
    if isinstance(right, (int, Fraction)):
        return DOT
    if isinstance(left, (int, Fraction)):
        return SPACE
    if isinstance(left, tuple) and left[0] == "one":
        return THIN
    if _simple(left) and _simple(right):
        named = [isinstance(x, tuple) and x[0] == "par" for x in (left, right)]
        return THIN if any(named) else SPACE
    return literal(BEFORE_FACTOR) + THIN
