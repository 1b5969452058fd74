"""Formulas of single names: a letter with what stands before, over and below it."""

from __future__ import annotations

import re
from functools import lru_cache

from .notation import Notation
from .typeset import (
    Formula,
    accented,
    barred,
    fraction,
    literal,
    lowered,
    primed,
    sans,
    upright,
)

NAME = re.compile(
    r"(?P<lead>(?:(?:\\delta|\\partial_t|\\mathrm\{d\})(?![A-Za-z])'?\s*)?)"
    r"(?P<over>(?:\\(?:tilde|dot|hat|bar|mathrm|mathbf)(?![A-Za-z])\s*\{?\s*)*)"
    r"(?P<letter>\\[A-Za-z]+|[A-Za-z])\}*(?P<primes>'*)"
    r"(?P<below>(?:_(?:[A-Za-z0-9]|\{[A-Za-z0-9]+\}))?)"
)
RATE = r"\frac{\mathrm{d}}{\mathrm{d}t}"
BARS = Notation()


@lru_cache(1024)
def named(tex: str) -> Formula:
    """The formula of a name, from its LaTeX."""
    if tex == RATE:
        return fraction(upright("d"), upright("d") + literal("t"), RATE)
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
    whole = _lead(found["lead"]) + primed(letter, len(found["primes"]))
    if found["below"]:
        whole = lowered(whole, literal(found["below"].strip("_{}")))
    return Formula(tex, whole.items)


def _lead(tex: str) -> Formula:
    """The formula of what stands before a letter: d, ∂_t, or δ with its primes."""
    if tex.startswith(r"\mathrm"):
        return upright("d")
    if tex.startswith(r"\partial"):
        return lowered(literal(r"\partial"), literal("t"))
    return primed(literal(r"\delta"), tex.count("'")) if tex else Formula("")


BARRED = re.compile(r"((?:\\delta'?\s*)?)\\(bar|overline)\{(.*?)\}('*)((?:_.+)?)")


def bar(tex: str) -> str:
    """The LaTeX of a transposed name: the bar is over its letter, not over its prime or index."""
    match = re.fullmatch(r"((?:\\delta'?\s*)?)(\\[a-z]+|[A-Za-z])('*)((?:_.+)?)", tex)
    if match:
        return rf"{match[1]}\bar{{{match[2]}}}{match[3]}{match[4]}"
    match = re.fullmatch(r"(\\delta'?\s*)(\\[a-z]+\s*(?:\\[a-z]+|[A-Za-z]))", tex)
    prefix, core = (match[1], match[2]) if match else ("", tex)
    return rf"{prefix}\overline{{{core}}}"


@lru_cache(1024)
def transposed(tex: str, notation: Notation) -> Formula:
    """The formula of the transpose of a name: a bar over its letter."""
    whole = bar(tex)
    lead, kind, inside, primes, below = BARRED.fullmatch(whole).groups()  # type: ignore[union-attr]
    single = kind == "bar" or re.fullmatch(r"\\[A-Za-z]+", inside) is not None
    letter = barred(named(inside), "", notation, letter=single)
    found = _lead(lead) + primed(letter, len(primes))
    if below:
        found = lowered(found, literal(below.strip("_{}")))
    return Formula(whole, found.items)


def parameter_formula(tex: str) -> Formula:
    """The formula of a parameter, from its LaTeX."""
    found = re.fullmatch(r"(\\mathsf\{(.*?)\}|\\[A-Za-z]+)(?:_\{\\mathsf\{(.*?)\}\})?", tex)
    if found is None:
        words = re.sub(r"\\[a-z]+\{\}|\\[a-z]+|[\\{}]", "", tex[6:-1])
        return Formula(tex, (f"<mtext>{words}</mtext>",))
    base, inside, below = found.groups()
    shown = literal(base) if inside is None else _sans(inside)
    if below:
        shown = lowered(shown, _sans(below))
    return Formula(tex, shown.items)


def _sans(inside: str) -> Formula:
    return sans(inside, inside.replace(r"\_", "_"))
