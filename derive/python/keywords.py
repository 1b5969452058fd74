"""Messages that the command line shares, in the words of Python: keywords in place of options."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from ..language.refused import Refused

KEYWORDS = {"set": "start", "lang": "languages", "column": "columns"}
"""Option → its keyword, where that has another name."""


@contextmanager
def in_keywords() -> Iterator[None]:
    """What is refused inside is told with ``dt`` for ``--dt``, ``at_defaults`` for
    ``--at-defaults``."""
    try:
        yield
    except Refused as error:
        told = re.sub(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)", _keyword, str(error))
        raise type(error)(told) from None


def _keyword(option: re.Match[str]) -> str:
    """What an option of the command line is called in Python."""
    return KEYWORDS.get(option[1], option[1].replace("-", "_"))
