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
    """What is refused inside is told with ``dt`` for ``--dt``."""
    try:
        yield
    except Refused as error:
        told = re.sub(r"(?<![\w-])--([a-z]+)", lambda x: KEYWORDS.get(x[1], x[1]), str(error))
        raise type(error)(told) from None
