"""The progress of a long command: one line on stderr, where that is a terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TypeVar

Item = TypeVar("Item")


def with_progress(items: Iterable[Item], total: int, what: str) -> Iterator[Item]:
    """The items unchanged; while each is made, stderr shows ``what: done of total``."""
    shown, left = sys.stderr is not None and sys.stderr.isatty(), iter(items)
    for done in range(total):
        line = f"{what}: {done} of {total}" if shown else ""
        try:
            if shown:
                print(line, end="\r", file=sys.stderr, flush=True)
            item = next(left)
        finally:  # also before an error is told
            if shown:
                print(" " * len(line), end="\r", file=sys.stderr, flush=True)
        yield item
