"""What of emitted C is a loop that is not read: Newton's method, between two comments."""

from __future__ import annotations

import re

NEWTON = re.compile(r"/\* Newton's method \*/\n.*?/\* end of Newton's method \*/\n", re.DOTALL)


def without_loops(text: str) -> str:
    """The text with as many empty lines in the place of what is not read."""
    return NEWTON.sub(lambda m: "\n" * m[0].count("\n"), text)


def loops(text: str) -> list[str]:
    """What is not read, in order."""
    return NEWTON.findall(text)
