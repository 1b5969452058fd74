"""What of emitted C is a loop that is not read, between two comments with its name."""

from __future__ import annotations

import re

LOOP = re.compile(
    r"/\* (Newton's method|Carlson's duplication) \*/\n.*?/\* end of \1 \*/\n", re.DOTALL
)


def without_loops(text: str) -> str:
    """The text with as many empty lines in the place of what is not read."""
    return LOOP.sub(lambda m: "\n" * m[0].count("\n"), text)


def loops(text: str) -> dict[str, str]:
    """What is not read, by its name."""
    return {m[1]: m[0] for m in LOOP.finditer(text)}
