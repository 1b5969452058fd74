"""Near names: the known name that a wrong one may stand for, and the question that asks so."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

LONGEST = 40
"""So many letters of a wrong name are compared."""


def near_name(word: str, known: Iterable[str], alike: float = 0.6) -> str:
    """The known name nearest to a word, ``alike`` from 0 (any) to 1 (the same); "" if none is."""
    return next(iter(difflib.get_close_matches(word[:LONGEST], [*known], 1, alike)), "")


def did_you_mean(name: str, before: str = "", after: str = "") -> str:
    """``did you mean 'spring'?`` between the texts ``before`` and ``after``; "" for no name."""
    return f"{before}did you mean {name!r}?{after}" if name else ""
