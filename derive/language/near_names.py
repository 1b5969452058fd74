"""Near names: the known name that a wrong one may stand for, and the question that asks so."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from itertools import takewhile

LONGEST = 40
"""So many letters of a wrong name are compared."""


def near_name(word: str, known: Iterable[str], alike: float = 0.6) -> str:
    """The known name nearest to a word, ``alike`` from 0 (any) to 1 (the same), and of those as
    near the last that begins as it does for longest; "" if none is."""
    listed, word = [*known], word[:LONGEST]
    close = {*difflib.get_close_matches(word, listed, len(listed) or 1, alike)}

    def nearness(name: str) -> tuple[float, int]:
        alike = (a == b for a, b in zip(name, word, strict=False))
        return difflib.SequenceMatcher(None, name, word).ratio(), sum(takewhile(bool, alike))

    return max((x for x in reversed(listed) if x in close), key=nearness, default="")


def did_you_mean(name: str, before: str = "", after: str = "") -> str:
    """``did you mean 'spring'?`` between the texts ``before`` and ``after``; "" for no name."""
    return f"{before}did you mean {name!r}?{after}" if name else ""
