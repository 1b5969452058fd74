"""Standard output in an encoding that lacks letters: they become ?, and stderr says so once."""

from __future__ import annotations

import codecs
import io
import sys
from collections.abc import Iterator
from contextlib import contextmanager

HANDLER = "derive.lost"


@contextmanager
def replacing_unencodable() -> Iterator[None]:
    """A context in which stdout writes ? for letters that it lacks; stderr says so at its end."""
    lost: set[str] = set()

    def shown(error: UnicodeError) -> tuple[str, int]:
        if not isinstance(error, UnicodeEncodeError):
            raise error
        lost.update(error.object[error.start : error.end])
        return "?" * (error.end - error.start), error.end

    out = sys.stdout
    if isinstance(out, io.TextIOWrapper):
        codecs.register_error(HANDLER, shown)
        out.reconfigure(errors=HANDLER)
    try:
        yield
    finally:
        if lost:
            count = f"{len(lost)} letter{'s' * (len(lost) != 1)}"
            print(
                f"derive: warning: the encoding of standard output, {out.encoding}, lacks {count}, "
                "shown as ?; where UTF-8 is read set PYTHONIOENCODING=utf-8; files of --out are "
                "in UTF-8",
                file=sys.stderr,
            )


def as_in_a_file() -> None:
    """Write stdout in UTF-8 from here on, as formats that name their encoding, but to a
    terminal."""
    out = sys.stdout
    if isinstance(out, io.TextIOWrapper) and not out.isatty():
        out.reconfigure(encoding="utf-8", errors=out.errors)
