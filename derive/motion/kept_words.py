"""What the names of conserved quantities are in words, where they are not words."""

from __future__ import annotations

import re
from collections.abc import Callable

KEPT = {
    "momentum": "linear momentum",
    "angular_momentum": "angular momentum",
    "body_momentum": "linear momentum in the body",
    "body_angular_momentum": "angular momentum in the body",
    "deformation_body": "circulation in the body",
}


def in_words(name: str, word: Callable[[str], str]) -> str:
    """``angular_momentum_3`` → angular momentum 3, in the language of ``word``."""
    base, number = re.fullmatch(r"(.*?)((?:_\d+)?)", name, re.DOTALL).groups()  # type: ignore[union-attr]
    return word(KEPT.get(base, base.replace("_", " "))) + number.replace("_", " ")
