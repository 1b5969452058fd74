"""What the names of conserved quantities are in words, where they are not words."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

KEPT = {
    "momentum": "linear momentum",
    "angular_momentum": "angular momentum",
    "body_momentum": "linear momentum in the body",
    "body_angular_momentum": "angular momentum in the body",
    "circulation": "circulation in the body",
}


def parts(name: str) -> tuple[str, int]:
    """``angular_momentum_3`` → angular_momentum and 3; 0 where there is no number."""
    base, number = re.fullmatch(r"(.*?)(?:_(\d+))?", name, re.DOTALL).groups()  # type: ignore[union-attr]
    return base, int(number or 0)


def in_order(names: Sequence[str]) -> list[int]:
    """The places of names, those with one base together, where the first of them is, by number."""
    bases = [parts(x)[0] for x in names]
    return sorted(range(len(names)), key=lambda k: (bases.index(bases[k]), parts(names[k])[1]))


def in_words(name: str, word: Callable[[str], str]) -> str:
    """``angular_momentum_3`` → angular momentum 3, in the language of ``word``."""
    base, number = re.fullmatch(r"(.*?)((?:_\d+)?)", name, re.DOTALL).groups()  # type: ignore[union-attr]
    return word(KEPT.get(base, base.replace("_", " "))) + number.replace("_", " ")
