"""Formulas of single names: a letter with what stands before, over and below it."""

from __future__ import annotations

import re
from functools import lru_cache

from .notation import Notation
from .signs import STYLED
from .typeset import (
    Formula,
    accented,
    barred,
    fraction,
    literal,
    lowered,
    operator,
    primed,
    raised,
    upright,
)

NAME = re.compile(
    r"(?P<lead>(?:(?:\\delta|\\partial_t|\\mathrm\{d\})(?![A-Za-z])'?\s*)?)"
    r"(?P<over>(?:\\(?:tilde|dot|hat|bar|mathrm|mathbf)(?![A-Za-z])\s*\{?\s*)*)"
    r"(?P<letter>\\[A-Za-z]+|[A-Za-z])\}*(?P<primes>'*)"
    r"(?P<below>(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9]+\}))?)(?P<above>(?:\^[+-])?)"
)
RATE = r"\frac{\mathrm{d}}{\mathrm{d}t}"
DIFFERENTIAL = r"\mathrm{d}"
WORD = re.compile(r"\\operatorname\{([a-z]+)\}")
BOLD = {r"\mathbf m": "𝐦", r"\mathbf n": "𝐧"}
"""Points of a lattice: letters that MathML has in bold by themselves."""
BARS = Notation()


@lru_cache(1024)
def named(tex: str) -> Formula:
    """The formula of a name, from its LaTeX."""
    if tex == RATE:
        return fraction(upright("d"), upright("d") + literal("t"), RATE)
    if upright_word := WORD.fullmatch(tex):
        return operator(upright_word[1], near=True)
    if tex in STYLED | BOLD:
        return Formula(tex, (f"<mi>{(STYLED | BOLD)[tex]}</mi>",))
    if tex.startswith(DIFFERENTIAL) and tex.removeprefix(DIFFERENTIAL) in STYLED:
        styled = STYLED[tex.removeprefix(DIFFERENTIAL)]
        return Formula(tex, (*upright("d").items, f"<mi>{styled}</mi>"))
    found = NAME.fullmatch(tex)
    if found is None:
        return Formula(tex, literal(tex).items)
    letter = literal(found["letter"])
    for name in reversed(re.findall(r"\\([a-z]+)", found["over"])):
        if name in ("mathrm", "mathbf"):
            letter = upright(found["letter"])
        elif name == "bar":
            letter = barred(letter, "", BARS, letter=True)
        else:
            letter = accented(name, letter, "")
    whole = _whole(tex, found["lead"], letter, found["primes"], found["below"])
    if sign := found["above"].strip("^"):
        return Formula(tex, raised(whole, literal(sign)).items)
    return whole


def _whole(tex: str, lead: str, letter: Formula, primes: str, below: str) -> Formula:
    """What this LaTeX is: a letter with what stands before it, its primes and its index."""
    found = _lead(lead) + primed(letter, len(primes))
    if below:
        found = lowered(found, literal(below.strip("_{}")))
    return Formula(tex, found.items)


def _lead(tex: str) -> Formula:
    """The formula of what stands before a letter: d, ∂_t, or δ with its primes."""
    if tex.startswith(r"\mathrm"):
        return upright("d")
    if tex.startswith(r"\partial"):
        return lowered(literal(r"\partial"), literal("t"))
    return primed(literal(r"\delta"), tex.count("'")) if tex else Formula("")


SINGLE = re.compile(r"(\\delta'?\s*|)(\\[a-z]+|[A-Za-z])('*)(_.+|)")
ACCENTED = re.compile(r"(\\delta'?\s*|)(\\[a-z]+\s*(?:\\[a-z]+|[A-Za-z]))()()")


@lru_cache(1024)
def transposed(tex: str, notation: Notation) -> Formula:
    """The formula of a transposed name: a bar over its letter, not over its prime or index."""
    single = SINGLE.fullmatch(tex)
    parts = single or ACCENTED.fullmatch(tex)
    lead, inside, primes, below = parts.groups() if parts else ("", tex, "", "")
    alone = single is not None or re.fullmatch(r"\\[A-Za-z]+", inside) is not None
    over = "bar" if single else "overline"
    letter = barred(named(inside), "", notation, letter=alone)
    whole = rf"{lead}\{over}{{{inside}}}{primes}{below}"
    return _whole(whole, lead, letter, primes, below)
